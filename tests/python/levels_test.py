# diptych: two-level means of samples with known biases and scatter
# SPDX-License-Identifier: LGPL-2.1-or-later
"""X = S + N + bias, Y = S + N' + ratio x bias: samples S, runs that diverge by N and N'. Nothing is run."""

import json
import os
import runpy
import subprocess
import sys
from types import SimpleNamespace

import numpy as np
import pytest

from diptych import Campaign, SceneError, benchmarks_dir
from diptych.campaigns.studies import levels
from diptych.campaigns.studies.level_runs import PairedPoint, add_summary, read_levels
from diptych.campaigns.studies.points import RunResult
from diptych.campaigns.runs.statistics import paired
from diptych.campaigns.studies.study_file import quantity

TRUTH, BIAS, RATIO, SCATTER, NOISE = 0.37, 0.013, 0.25, 0.012, 0.004  # as measured in benchmarks/rigid_limit


def drawn(rng, n, pairs):
    """X of n samples and Y of the first ones."""
    of_sample = TRUTH + SCATTER * rng.normal(size=n)
    x, y = (of_sample + NOISE * rng.normal(size=n) + bias for bias in (BIAS, RATIO * BIAS))
    y[pairs:] = np.nan
    return x, y


@pytest.mark.parametrize("n, pairs", [(40, 8), (12, 12), (100, 6)])
def test_intervals_hold_the_limit_in_95_of_100_cases(n, pairs, monkeypatch):
    """The order is exact here, so its part of the interval is left out. 2000 cases give the share to +- 1 %."""
    monkeypatch.setattr(levels, "ORDER_DEVIATION", 0.0)
    rng = np.random.default_rng(1)
    found = [levels.limit_of(*drawn(rng, n, pairs), RATIO) for _ in range(2000)]
    error = [one.limit.value - TRUTH for one in found]
    assert abs(np.mean(error)) < 4 * np.std(error) / np.sqrt(2000)  # without bias
    assert 0.93 < np.mean([one.limit.low <= TRUTH <= one.limit.high for one in found]) < 0.97
    assert np.sqrt(np.mean([one.error_samples**2 for one in found])) == pytest.approx(np.std(error), rel=0.06)
    expected = levels.predicted(SCATTER**2 + NOISE**2, 2 * NOISE**2, RATIO, (1 - RATIO) * BIAS)
    assert np.sqrt(expected.many / n + expected.pairs / pairs) == pytest.approx(np.std(error), rel=0.06)


def test_the_interval_holds_the_uncertainty_of_the_order():
    """The bias follows another order, drawn from 0.5 +- 0.1: the ratio of the biases is 0.25^(order / 0.5)."""
    rng, within = np.random.default_rng(2), []
    for _ in range(1000):
        x, _ = drawn(rng, 400, 400)
        y = x - BIAS * (1 - RATIO ** (1 + levels.ORDER_DEVIATION * rng.normal()))
        limit = levels.limit_of(x, y, RATIO).limit
        within.append(limit.low <= TRUTH <= limit.high)
    assert np.mean(within) > 0.93


def test_numbers_are_the_cheapest():
    v, costs = levels.Variances(1.2e-4, 4e-5, 2e-4), (0.16, 0.8)
    best = min((n * costs[0] + m * costs[1], n, m) for n in range(6, 200) for m in range(6, n + 1)
               if v.half_interval(n, m) <= 0.003)
    n, m = levels.numbers_for([v], costs, 0.003, 1000)
    assert v.half_interval(n, m) <= 0.003 and n * costs[0] + m * costs[1] < 1.03 * best[0]
    assert levels.numbers_for([v], costs, 3.9e-4, 10000) == (0, 0)  # no number of samples helps against the order
    assert levels.Variances(1.0, 100.0, 0.0).share((1, 1)) == 1 and levels.Variances(-1.0, 1.0, 0.0).share((1, 1)) == 1


def test_stored_runs_keep_what_the_benchmark_claims(monkeypatch):
    """Forty samples of dense_biaxial. The mean of 20 with pairs holds brute force in 19 of 20 subsets, at the finest
    step and in its limit. Its error of 0.5 % takes less than 1 / 2.5 of the CPU time of one level."""
    folder = os.path.join(benchmarks_dir(), "rigid_limit")
    monkeypatch.syspath_prepend(folder)
    benchmark = SimpleNamespace(**runpy.run_path(os.path.join(folder, "levels.py")))
    runs, seconds = benchmark.Runs(), np.geomspace(10, 1e4, 500)
    for fine in ("accuracy=0.01", "accuracy=0.005"):
        assert (20 * benchmark.coverage(runs, fine, 20)[:2] > 18.5).all()
        cost = [seconds[np.argmax(error < 0.5)] for error in (benchmark.one_level(runs, seconds),
                                                              benchmark.two_levels(runs, seconds, fine)[0])]
        assert cost[0] > 2.5 * cost[1]


def runs_of(values, error):
    return [RunResult(known=True, values=[value, 45.0], expected_error={"strength": error, "dilation": np.nan})
            for value in values]


def test_pairs_follow_from_scatter_and_quantities_without_a_rule_have_no_limit():
    x, y = drawn(np.random.default_rng(3), 40, 8)
    asked = [quantity("T/S", reduction="strength"), quantity("angle", source="comparison", line=True)]
    point, closer = (PairedPoint(runs_of(x, 0.04), runs_of(fine, 0.01), asked) for fine in (y[:8], (x[:8] + y[:8]) / 2))
    assert point.pairs_wanted() > 1.5 * closer.pairs_wanted() > 0  # n / N grows with the scatter of the differences
    [(limit, extrapolated)] = point.limits().values()
    assert limit.limit == levels.limit_of(x, y, RATIO).limit and np.isfinite(extrapolated).sum() == 8
    assert np.nanmean(extrapolated) - limit.limit.value == pytest.approx(x[:8].mean() - x.mean())
    same_step = PairedPoint(runs_of(x, 0.04), runs_of(y[:8], 0.039), asked)
    assert np.isnan(same_step.ratio) and same_step.pairs_wanted() == 0


@pytest.mark.parametrize("wrong", ["on", "0.05", "0.01,0.05", "0.05,0.04", "0.1,0.01", "0.05,0.0001", "0.05,0.02,0.01"])
def test_wrong_levels_are_refused(wrong):
    with pytest.raises(SceneError, match="--levels"):
        read_levels(wrong, 8)
    assert read_levels("", 1) is None and read_levels("auto", 2) == (levels.CHEAP, levels.FINE)
    assert read_levels("0.04,0.005", 8) == (0.04, 0.005)
    with pytest.raises(SceneError, match="at least two samples"):
        read_levels("auto", 1)


def test_an_ensemble_gets_rows_in_the_limit():
    """With all samples paired, the limits are means of extrapolated samples, and so is continuum minus grains. The
    verdict is that of the extrapolated samples, and errors of the continuum take it away."""
    x, y = drawn(np.random.default_rng(4), 8, 8)
    continuum = 0.36 + 0.001 * np.arange(8)
    verdict = {"key": "peak_stress_ratio", "discrete": x.tolist(), "continuum": continuum.tolist(), "n": 8,
               "relative": True, "margin": 0.0}
    first = {"key": "peak_stress_ratio", "quantity": "peak t/s", "continuum": (0.3635, 0.361, 0.366)}
    record = {"verdicts": [verdict], "summary": [first],
              "validation": [{"key": "peak_stress_ratio", "parts": {"mesh": np.nan, "load_step": 0.0},
                              "u_input": np.nan}],
              "continuum_runs": {"values": []},
              "checks": [{"key": "discrete_summary/" + name} for name in ("impact_share", "energy_residual")]}
    limit = x - (x - y) / (1 - RATIO)
    rows = {"cheap": 0.05, "quantities": [{"key": "peak_stress_ratio", "quantity": "peak t/s", "unit": "-",
                                            "ratio": RATIO, "fine": y.tolist()}]}
    ends = paired(limit, continuum, "relative").difference_90
    verdict["margin"] = 1.1 * max(-ends.low, ends.high)  # the order widens the interval by less
    add_summary(record, rows)
    row = record["summary"][-1]
    assert [one["key"] for one in record["checks"]] == ["discrete_summary/energy_residual"]
    assert record["summary"][0]["quantity"] == "peak t/s (accuracy 0.05)"
    assert row["quantity"] == "peak t/s, limit of short steps" and row["verdict"].startswith("equivalent within")
    record["validation"][0]["parts"]["mesh"] = verdict["margin"] * TRUTH
    add_summary(record, rows)
    assert record["summary"][-1]["verdict"].startswith("cannot tell")
    assert row["grains"].value == pytest.approx(limit.mean())
    assert row["difference"].value == pytest.approx((continuum - limit).mean())


def test_a_study_gives_means_in_the_limit(tmp_path):
    scene = tmp_path / "scene.json"
    loading = {"axial_strain": 0.01, "inertial_number": 2e-3}
    scene.write_text(json.dumps({"sample": {"grains": 100}, "loading": loading}))
    words = ["study", scene, "--vary", "discrete/friction=0.1,0.6", "--seeds", "1-7", "--panels", "discrete",
             "--levels", "auto"]
    done = subprocess.run([sys.executable, "-m", "diptych", *words, "--output", tmp_path / "out"],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    found = Campaign.load(tmp_path / "out")
    rows = found.effects[found.effects.quantity.str.startswith("strength")].set_index(["discrete/friction", "quantity"])
    for friction in (0.1, 0.6):
        usual, limit = (rows.loc[friction, name] for name in rows.loc[friction].index)
        assert limit["low"] < limit["mean"] < limit["high"] and limit["n"] == found.numbers["levels"]["pairs"] >= 6
        assert 0 < abs(limit["mean"] / usual["mean"] - 1) < 0.2
    assert {"peak t/s, limit of short steps"} <= set(found.changes.quantity)
    assert found.cost["runs"] == 14 + 2 * found.numbers["levels"]["pairs"]
    assert "limit of short steps" in (tmp_path / "out/report.html").read_text()
