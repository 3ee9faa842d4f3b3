# diptych: statistics, histories and evaluation of campaigns on values with known answers
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Only the last tests run the program."""

import json
import math
import os

import numpy as np
import pandas as pd
import pytest
from scipy import stats

import diptych
from diptych.campaigns import ensemble, evaluation, histories, statistics
from diptych.campaigns.input_file import read_seeds
from diptych.campaigns.members import is_mirror_symmetric, member_of_record
from diptych.campaigns.points import Point, RunResult, points_of
from diptych.campaigns.folders import SceneRun
from diptych.campaigns.study_file import Axis, AxisPoint, Family, Study, quantity, read_study

FOUR = [1, 2, 3, 4]  # mean 2.5, deviation sqrt(5/3): the standard error of the mean is half of that


# ---- statistics -------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("degrees, exact", [(1, math.tan(0.475 * math.pi)), (2, 0.95 * math.sqrt(2 / (1 - 0.95**2)))])
def test_quantiles_with_a_closed_form(degrees, exact):
    assert statistics.student_quantile(0.975, degrees) == pytest.approx(exact, rel=1e-14)


@pytest.mark.parametrize("degrees", [3, 7, 30, 2.5])
def test_quantiles_invert_students_distribution(degrees):
    assert stats.t.cdf(statistics.student_quantile(0.975, degrees), degrees) == pytest.approx(0.975, rel=1e-14)


def test_the_interval_of_a_mean_is_students():
    s = statistics.statistics(FOUR)
    low, high = stats.t.interval(0.95, 3, loc=np.mean(FOUR), scale=stats.sem(FOUR))
    assert s == pytest.approx((4, 2.5, math.sqrt(5 / 3), low, high), rel=1e-9)
    assert statistics.statistics([3])[:2] == (1, 3) and math.isnan(statistics.statistics([3]).low)
    assert statistics.statistics([math.nan]).n == 0


def test_lines_across_the_vertical_have_a_vertical_mean():
    """Turns from 90: -5, 5, 0; the deviation is sqrt(50 / 2)."""
    s = statistics.line_statistics([85, -85, 90])
    assert (abs(s.mean), s.deviation) == pytest.approx((90, 5)) and s.low < s.mean < s.high
    assert statistics.line_statistics([-43, -45, -47]) == pytest.approx(statistics.statistics([-43, -45, -47]))
    assert math.isnan(statistics.line_statistics([10, -80]).mean)
    assert statistics.line_turn(80, -80) == -20 and statistics.line_turn(45, -45) == 90


@pytest.mark.parametrize("sign", [1, -1])
def test_equivalence_is_two_one_sided_tests(sign):
    """The margin at which the larger p-value of both tests of scipy is 5 % is the border of the verdict."""
    values = sign * np.array(FOUR)
    edge = 2.5 + stats.t.ppf(0.95, 3) * stats.sem(FOUR)
    found = statistics.paired(np.zeros(4), values)
    assert found.verdict(edge + 1e-6) == "equivalent" and found.verdict(edge - 1e-6) == "cannot tell"
    side = "less" if sign > 0 else "greater"
    assert stats.ttest_1samp(values, sign * edge, alternative=side).pvalue == pytest.approx(0.05)
    edge = 2.5 - stats.t.ppf(0.975, 3) * stats.sem(FOUR)
    assert found.verdict(edge - 1e-6) == "different" and found.verdict(edge + 1e-6) == "cannot tell"


def test_ends_of_the_relative_interval_are_those_of_paired_tests():
    """At the end q of Fieller's 90 % interval the one-sided test of continuum - (1 + q) grains has a p-value of 5 %."""
    grains, continuum = np.array([18, 15, 22, 11]), np.array([18, 18, 18.5, 18])
    e = statistics.paired(grains, continuum, "relative")
    for end in e.difference_90[1:]:
        assert stats.ttest_1samp(continuum - (1 + end) * grains, 0).pvalue == pytest.approx(0.1)
    for end in e.difference[1:]:
        assert stats.ttest_1samp(continuum - (1 + end) * grains, 0).pvalue == pytest.approx(0.05)
    assert e.difference.value == continuum.mean() / grains.mean() - 1


def test_relative_differences_at_their_limits():
    shared = statistics.paired([5, 10, 20, 8], [5.5, 11, 22, 8.8], "relative")  # the scatter of both cancels
    assert shared.difference == pytest.approx((0.1, 0.1, 0.1), abs=1e-6)
    assert np.isnan(statistics.paired([-2, 2, 0, 1], [1, 1, 1, 1], "relative").difference[1:]).all()  # the mean may be zero
    assert statistics.paired([10], [12], "relative").difference.value == pytest.approx(0.2)
    assert statistics.paired([], [], "relative").n == 0
    assert statistics.paired([math.nan, 1, 2], [1, 2, math.nan]).n == 1


@pytest.mark.parametrize("order", [0.5, 1.0, 2.0, 3.7])
@pytest.mark.parametrize("unit", [1e-6, 1.0, 1e5])
def test_power_laws_are_found_in_any_unit(order, unit):
    h = np.array([1, 0.5, 0.25, 0.125])
    fit = statistics.fit_convergence(unit * h, 3 - 0.2 * h**order)
    assert (fit.order, fit.limit) == (pytest.approx(order, abs=0.006), pytest.approx(3, abs=1e-3))
    assert fit.coefficient * unit**fit.order == pytest.approx(-0.2, abs=2e-3)


def test_three_points_give_richardsons_limit():
    """v = 1 + 2 h^2 at h = 4, 2, 1: the limit is (4 v(1) - v(2)) / 3."""
    assert statistics.fit_convergence([4, 2, 1], [33, 9, 3]) == pytest.approx((1, 2, 2), abs=1e-9)


@pytest.mark.parametrize("h, values", [([1, 2], [1, 2]), ([1, 2, 2], [1, 2, 2.1]), ([1, 2, 4], [5, 5, 5]),
                                       ([6, 4, 3, 2, 1.5, 1], [0.391, 0.399, 0.3995, 0.372, 0.376, 0.411]),
                                       ([1, 2, 4, 8], [0, 10, 15, 17.5])])
def test_without_a_power_law_there_is_no_order(h, values):
    assert statistics.fit_convergence(h, values) is None


# ---- histories --------------------------------------------------------------------------------------------------------------


def table(progress, **columns):
    return pd.DataFrame({"progress": progress, **columns}, dtype=float)


def test_reductions_of_a_broken_line():
    """y = x at uneven rows: means over a range are its middle, whatever the rows."""
    rows = table([0, 0.1, 0.15, 0.6, 1], y=[0, 0.1, 0.15, 0.6, 1])
    take = lambda how, **ends: histories.reduced(rows, quantity(reduction=how, column="y", **ends))
    assert take("mean", **{"from": 0.05, "to": 0.85}) == pytest.approx(0.45)
    assert take("at", **{"from": 0.4}) == pytest.approx(0.4)
    assert take("peak", to=0.2) == pytest.approx(0.9)
    assert (take("largest"), take("last")) == (1, 1)
    assert math.isnan(take("mean", **{"from": 0.5, "to": 1.1})) and math.isnan(take("at", **{"from": 1.1}))
    assert take("at", **{"from": 1 + 1e-12}) == 1  # progress is a sum of steps
    assert math.isnan(histories.reduced(None, quantity(reduction="last", column="y")))


def test_running_means_and_curves():
    rows = table([0, 1, 2, 3], y=[0, 2, 4, 6])
    mean = histories.running_mean(rows, "y", 2.0)
    assert np.isnan(mean[:2]).all() and mean[2:] == pytest.approx([2, 4])  # y = 2 x: the value in the middle
    curve = histories.resampled(rows, mean, np.array([1.5, 2, 2.5, 3, 3.5]))
    assert np.isnan(curve[[0, 4]]).all() and curve[1:4] == pytest.approx([2, 3, 4])


def test_strength_is_the_ratio_of_the_means():
    """Pure t = 1, s = 2 and then t = 3, s = 4 with equal weights: 4 / 6, not the mean of 1/2 and 3/4."""
    rows = table([0, 1, 1 + 1e-9, 2], sxx=[3, 3, 7, 7], syy=[1, 1, 1, 1], sxy=[0] * 4)
    assert histories.stress_ratio_of_means(rows, 0, 2) == pytest.approx(4 / 6)


# ---- studies ----------------------------------------------------------------------------------------------------------------


def study_of(n, **changes):
    """A quantity with a limit of 2 %, four samples, one axis of n points h = 1, 2, 4 ..."""
    axis = Axis("step", [AxisPoint(str(k), [], 2.0**k) for k in range(n)], converges=True)
    strength = quantity("strength", **{"limit": 0.02, **changes})
    return Study(seeds=[1, 2, 3, 4], families=[Family(axes=[axis])], quantities=[strength])


def points_on(n):
    return [Point(runs=[SceneRun("run", "reference")]), *(Point(0, 0, (k,), [str(k)], [], [SceneRun("run", str(k))])
                                                         for k in range(n))]


def runs(share, cpu_s=1.0, **changes):
    """Four samples around 0.4, all changed by the same share."""
    phases = [{"name": "discrete", "cpu_s": cpu_s, "peak_memory_mb": 100},
              {"name": "report", "cpu_s": 9, "peak_memory_mb": 100}]
    return [RunResult(**{"known": True, "values": [value * (1 + share)], "phases": phases, **changes})
            for value in (0.38, 0.40, 0.41, 0.43)]


def point(results, study=None, reference=None):
    study = study or study_of(1)
    return evaluation.evaluate(study, points_on(1), [reference or runs(0)[:len(results)], results])[1]


def test_errors_are_paired_by_sample():
    """The samples scatter by 5 %. The change of 1 % is visible because it is the same in each sample."""
    found = point(runs(0.01))
    assert found["quantities"][0]["error"] == pytest.approx((0.01, 0.01, 0.01), abs=1e-9)
    assert found["quantities"][0]["scatter"] == pytest.approx(np.std([0.38, 0.4, 0.41, 0.43], ddof=1) / 0.405)
    assert (found["class"], found["certain"], found["quantities"][0]["pairs"]) == ("right", True, 4)


def test_errors_that_scatter_leave_a_doubt():
    scattered = runs(0.01)
    scattered[0].values[0] *= 1.05
    scattered[1].values[0] *= 0.95
    found = point(scattered)
    assert (found["class"], found["certain"], found["quantities"][0]["verdict"]) == ("right", False, "cannot tell")


@pytest.mark.parametrize("changes, expected", [
    ({}, "silently wrong"), ({2: {"warned": True}}, "wrong, warned"), ({3: {"exit_code": 3, "words": "no"}}, "stopped"),
    ({3: {"exit_code": 3}, 0: {"exit_code": 2}}, "refused"), ({0: {"exit_code": 2}, 1: {"known": False}}, "not run")])
def test_the_worst_run_decides(changes, expected):
    results = runs(0.03)
    for k, change in changes.items():
        vars(results[k]).update(change)
    assert point(results)["class"] == expected


def test_a_point_that_halved_steps_struggled():
    assert point(runs(0, halved_steps=3))["class"] == point(runs(0, cut_backs=1.0))["class"] == "struggled"


def test_a_value_that_only_the_reference_has_is_beyond_any_limit():
    none = runs(0, values=[math.nan])
    assert point(none)["class"] == "silently wrong"
    assert point(none, reference=none)["class"] == "unjudged"
    assert point(runs(0.5), study_of(1, limit=None))["class"] == "unjudged"


def test_an_unknown_interval_leaves_a_doubt_unless_there_is_one_sample():
    study = study_of(1)
    study.seeds = [1]
    found = point(runs(0.05)[:1], study)
    assert (found["class"], found["certain"]) == ("silently wrong", False)
    study.seeds = []
    assert point(runs(0.05)[:1], study)["certain"]


def test_lines_are_compared_by_their_turn():
    study = study_of(1, line=True, relative=False, limit=5)
    found = point(runs(0, values=[-88.0]), study, runs(0, values=[89.0]))
    assert found["quantities"][0]["error"].value == pytest.approx(3)


def test_orders_are_fitted_along_axes_that_converge():
    study, points = study_of(4), points_on(4)
    results = [runs(0), *(runs(0.01 * 2**k) for k in range(4))]
    order, = evaluation.orders_of(study, points, evaluation.evaluate(study, points, results))
    assert order["order"].value == pytest.approx(1, abs=0.02)
    assert order["limit"].value == pytest.approx(0.405, abs=1e-3) and order["limit"].low < 0.405 < order["limit"].high


def cost(n, results, study=None, points=None):
    study, points = study or study_of(n), points or points_on(n)
    return evaluation.cost_of(study, points, results, evaluation.evaluate(study, points, results))


def test_the_cheapest_right_point_is_found_and_the_reference_does_not_compete():
    found = cost(3, [runs(0, 0.1), runs(0.005, 8), runs(-0.015, 2), runs(0.04, 1)])
    cheapest = {(one["quantity"], one["accuracy"]): one["point"] for one in found["cheapest"]}
    assert [cheapest["strength", accuracy] for accuracy in (0.05, 0.02, 0.01)] == [3, 2, 1]
    assert cheapest["", 0.5] == 1
    assert found["points"][2]["cpu_s"] == 2 and found["phases"] == ["discrete"]  # the report does not count
    assert [one["front_of"] for one in found["points"]] == [[], ["strength"], ["strength"], ["strength"]]


def test_a_point_that_costs_more_and_is_worse_is_not_on_the_front():
    found = cost(2, [runs(0), runs(0.01, 1), runs(0.02, 2)], study_of(2, limit=None))
    assert [one["front_of"] for one in found["points"]] == [[], ["strength"], []]
    assert found["cheapest"] == []


def test_points_compete_only_with_those_of_the_same_reference():
    points = [Point(runs=[SceneRun("run", "other")]), *points_on(2)]
    points[1].reference = points[3].reference = 1
    found = cost(2, [runs(0), runs(1), runs(0.01, 1), runs(1.01, 2)], points=points)
    assert [one["front_of"] for one in found["points"][2:]] == [["strength"], ["strength"]]
    assert len(found["cheapest"]) == 12 and found["cheapest"][-1]["point"] == 3


def test_other_work_on_the_machine_is_noticed():
    assert not RunResult(load=2.3, at_once=2).disturbed and RunResult(load=3.1, at_once=2).disturbed


# ---- study files ------------------------------------------------------------------------------------------------------------

AXES = [{"key": "discrete/step", "values": [0.1, 0.2]}, {"key": "discrete/friction", "values": [0.3, 0.4, 0.5]}]
FILE = {"scene": "scene.prm", "command": "discrete", "axes": AXES, "reference": {"discrete/step": 0.1},
        "quantities": [{"strength": [0.005, 0.02]}]}


@pytest.fixture
def read(tmp_path):
    """Points of a study file with other entries."""
    (tmp_path / "scene.prm").write_text("subsection sample\n  set grains = 100\nend\n")

    def read_points(**changes):
        entries = {**FILE, **changes}
        (tmp_path / "study.json").write_text(json.dumps({k: v for k, v in entries.items() if v is not None}, indent=1))
        return points_of(read_study(str(tmp_path / "study.json")))

    read_points.folder = tmp_path
    return read_points


def test_a_grid_has_every_pair_the_last_axis_fastest(read):
    points = read()
    assert [one.labels for one in points] == [[]] + [[a, b] for a in ("0.1", "0.2") for b in ("0.3", "0.4", "0.5")]
    scene = points[6].runs[0].scene.dict()
    assert scene["discrete"]["friction"] == 0.5 and not scene["output"]["report"]
    assert points[0].runs[0].name == points[2].runs[0].name != points[1].runs[0].name  # the default friction is 0.4


def test_a_list_moves_its_axes_together(read):
    axes = [AXES[0], {**AXES[1], "values": [0.3, 0.4]}]
    assert [one.labels for one in read(combine="list", axes=axes)[1:]] == [["0.1", "0.3"], ["0.2", "0.4"]]
    with pytest.raises(diptych.SceneError, match="'step' has 2, 'friction' 3"):
        read(combine="list")


def test_an_axis_may_have_a_reference_of_its_own_at_each_point(read):
    points = read(axes=[{**AXES[1], "values": [0.3, 0.5], "own_reference": True}, {**AXES[0], "values": [0.2, 0.4]}])
    assert [one.labels for one in points[:2]] == [["friction 0.3"], ["friction 0.5"]]
    reference = points[1].runs[0].scene.dict()["discrete"]
    assert (reference["friction"], reference["step"]) == (0.5, 0.1)
    assert [one.reference for one in points] == [0, 1, 0, 0, 1, 1]


def test_seeds_are_samples_and_replace_the_word_in_file_names(read):
    points = read(seeds="3-5")
    assert [run.scene.dict()["sample"]["seed"] for run in points[1].runs] == [3, 4, 5]
    (read.folder / "grains_7.csv").write_text("x,y,r\n0,0.5,0.5\n1,0.5,0.5\n")
    scene = read(seeds=7, set={"sample/file": "grains_{seed}.csv"})[1].runs[0].scene
    assert scene.dict()["sample"]["file"] == str(read.folder / "grains_7.csv")


def test_contradictory_settings_refuse_only_their_point(read):
    """No whole number of stages fits into 0.013."""
    points = read(set={"loading/stage_strain": 0.005}, axes=[{"key": "loading/axial_strain", "values": [0.01, 0.013]}])
    assert points[1].runs[0].scene and points[2].runs[0].scene is None and "0.013" in points[2].runs[0].refusal


@pytest.mark.parametrize("changes, words", [
    ({"scene": "none.prm"}, ["line 2", "none.prm"]), ({"seed": 3}, ["seed: unknown key", "'seeds'"]),
    ({"seeds": "5-3"}, ["5-3", "descends"]), ({"command": "runn"}, ["line 3", "runn", "material-point"]),
    ({"axes": [{"key": "discrete/stepp", "values": [0.1]}]}, ["discrete/stepp", "discrete/step"]),
    ({"axes": [{"key": "discrete/friction", "values": [0.1, -1]}]}, ["discrete/friction = '-1'", "a number from"]),
    ({"axes": [{"key": "discrete/step", "values": [0.1, 0.1]}]}, ["'0.1' twice"]),
    ({"axes": [{"key": "discrete/method", "values": ["nscd"], "converges": True}]}, ["converges", "nscd"]),
    ({"quantities": [{"column": "stres_ratio", "last": True}]}, ["stres_ratio", "stress_ratio"]),
    ({"quantities": [{"strength": [0.02, 0.01]}]}, ["ascending"]),
    ({"quantities": [{"last": True, "largest": True, "column": "time"}]}, ["exactly one of"]),
    ({"quantities": []}, ["quantities", "missing or empty"]), ({"reference": None}, ["'reference' is missing"]),
    ({"quantities": [{"of": "continuum", "strength": [0.005, 0.02]}]}, ["discrete does not write", "continuum"]),
    ({"reference": {"loading/axial_strain": 0.013}}, ["the reference is refused", "0.013"]),
    ({"command": "run", "quantities": [{"number": "window 0-0.01 discrete band width"}]}, ["'width'", "nearest"]),
    ({"command": "run", "quantities": [{"number": "band angle"}]}, ["'band angle'", "'angle_deg'", "ensemble.csv"]),
    ({"cost": ["discret"]}, ["'discret'", "'discrete'"])])
def test_wrong_keys_and_values_are_named_with_their_lines(read, changes, words):
    with pytest.raises(diptych.SceneError) as refused:
        read(**changes)
    for word in [*words, "study.json"]:
        assert word in str(refused.value)


@pytest.mark.parametrize("text, seeds", [("1-4", [1, 2, 3, 4]), ("5-7,1,3", [1, 3, 5, 6, 7])])
def test_lists_of_seeds(text, seeds):
    assert read_seeds(text) == seeds


@pytest.mark.parametrize("text", ["", ",", "1,", "1-", "-3", "one", "1.5", "1 2", "8-1", "1,1", "1-3,2", "0-10000",
                                  "2147483648", "1--2", "1-2-3"])
def test_invalid_lists_of_seeds_are_refused(text):
    with pytest.raises(diptych.SceneError, match="--seeds"):
        read_seeds(text)


# ---- ensembles --------------------------------------------------------------------------------------------------------------

MARGINS = {"margin_angle": 3, "margin_thickness": 0.2, "margin_peak_stress_ratio": 0.03, "margin_volumetric_strain": 0.002}


def band(angle, width):
    return {"angle_deg": {"value": angle, "low": angle - 1, "high": None}, "width_10_90_d": width, "offset_d": -2.0,
            "jump": 0.8 if angle < 0 else -0.8}


def comparison(seed, grains, continuum):
    """A comparison with one stage and one window, as the program writes it."""
    panels = {name: {"stress_ratio": 0.3, "bands": bands, "strips": {"angle_deg": [12]}}
              for name, bands in (("discrete", grains), ("continuum", continuum))}
    zone = {"name": "zone", "t_over_s": {"value": 0.4}, "interval": {"low": 1, "high": 2}, "s1": 2, "polygon": [[0, 0], [1, 1]]}
    stage = {"progress": 0.04 * (1 + 1e-9 * seed), "axial_strain": 0.04, "continuum": panels["continuum"],
             "discrete": {**panels["discrete"], "probes": [zone]},
             "difference": {"angle_deg": 3, "offset_d": None, "stress": [{"label": "6 d", "relative_l2": 0.2}]}}
    return {"seed": seed, "stages": [stage], "windows": [{"from": 0.0, "to": 0.04, **panels}], "cost": {"discrete_cpu_s": 1.5},
            "discrete_summary": {"peak_stress_ratio": 0.36 + 0.001 * seed, "ns_per_update": seed, "message": "finished"},
            "continuum_summary": {"peak_stress_ratio": 0.36, "finished": True}}


def ensemble_of(*comparisons, folded=False):
    return ensemble.evaluate([member_of_record(one, "", folded) for one in comparisons], MARGINS)


def named(record, key="name"):
    return {one[key]: one for one in record}


def test_numbers_are_found_by_their_place_and_only_those_that_have_a_mean():
    found = named(ensemble_of(comparison(1, [band(-44, 18)], []), comparison(2, [band(-46, 20)], []))["quantities"])
    assert found["stage 0.04 discrete stress_ratio"]["n"] == 2  # stages that differ by rounding are one
    assert found["window 0-0.04 discrete band angle_deg"]["mean"] == pytest.approx(-45)
    assert found["window 0-0.04 discrete band angle_deg"]["unit"] == "degrees"
    assert found["stage 0.04 discrete probe zone t_over_s"]["mean"] == 0.4
    assert found["stage 0.04 difference stress 6 d relative_l2"]["mean"] == 0.2
    for word in ("cpu", "ns_per_update", "message", "finished", "strips", "polygon", "axial_strain", "interval"):
        assert not [name for name in found if word in name]


def test_only_members_with_a_band_count_for_it():
    record = ensemble_of(comparison(1, [band(-44, 18), band(40, 9)], [band(-45, 18)]), comparison(2, [], [band(-45, 18)]),
                         comparison(3, [band(-46, 22)], [band(-45, 18)]))
    width = named(record["quantities"])["window 0-0.04 discrete band width_10_90_d"]
    assert (width["n"], width["mean"]) == (2, 20) and math.isnan(width["values"][1])  # the strongest band is the first
    pairs = {name: one["n"] for name, one in named(record["verdicts"], "quantity").items()}
    assert pairs == {"peak_stress_ratio": 3, "strength": 0, "final_volumetric_strain": 0, "window 0-0.04 band angle_deg": 2,
                     "window 0-0.04 band width_10_90_d": 2}
    assert {key: one["text"] for key, one in named(record["bands"]).items() if key.startswith("window")} == {
        "window 0-0.04 continuum": "one band in 3 of 3",
        "window 0-0.04 discrete": "one band in 1 of 3, two bands in 1, none in 1"}


def test_mirror_images_of_a_band_are_folded_together():
    """Chance decides between left and right: bands at 55 and -55 degrees are the same kind, and their jumps get one sign."""
    both = (comparison(1, [band(55, 10)], [band(-54, 10)]), comparison(2, [band(-53, 10)], [band(54, 10)]))
    record = ensemble_of(*both, folded=True)
    found = named(record["quantities"])
    assert found["window 0-0.04 discrete band angle_deg"]["mean"] == pytest.approx(54)
    assert found["window 0-0.04 discrete band offset_d"]["values"] == [2, 2]
    assert found["window 0-0.04 discrete band jump"]["values"] == [-0.8, -0.8]
    assert "stage 0.04 difference angle_deg" not in found
    assert "stage 0.04 difference angle_deg" in named(ensemble_of(*both)["quantities"])
    turn = named(record["verdicts"], "quantity")["window 0-0.04 band angle_deg"]["difference"]
    assert turn.value == pytest.approx(0, abs=1e-12)  # 54 - 55 and 54 - 53


@pytest.mark.parametrize("keys, symmetric", [
    ({}, False), ({"loading/horizontal_over_vertical": 0}, True),
    ({"loading/horizontal_over_vertical": 0, "discrete/gravity_x": 0.1}, False),
    ({"loading/horizontal_over_vertical": 0, "discrete/lateral": "rigid_walls", "discrete/drive_left_x": "velocity 1"}, False)])
def test_only_a_vertical_descent_is_its_own_mirror_image(keys, symmetric):
    from diptych import scenes

    assert is_mirror_symmetric(scenes.read(keys)) == symmetric


@pytest.mark.parametrize("record", [{}, {"seed": 1, "windows": [{"from": 0}]}])
def test_a_file_that_is_no_comparison_is_refused(record):
    with pytest.raises(ValueError, match="does not compare two panels"):
        member_of_record(record, "comparison.json")


def test_means_of_curves_need_all_members():
    mean, low, high = ensemble.with_means(np.array([[1.0, 2, np.nan], [3, 2, 1]]))
    half = stats.t.ppf(0.975, 1) * stats.sem([1, 3])
    assert (mean[0], low[0], high[0]) == pytest.approx((2, 2 - half, 2 + half))
    assert (mean[1], low[1], high[1]) == (2, 2, 2) and np.isnan([mean[2], low[2], high[2]]).all()


# ---- from Python ------------------------------------------------------------------------------------------------------------


def test_a_study_of_a_dict_gives_data_frames_and_explained_keys(tmp_path):
    steps = {"scene": os.path.join(diptych.benchmarks_dir(), "moreau_quick", "scene.prm"), "command": "material-point",
             "set": {"loading/axial_strain": 0.02}, "reference": {"continuum/initial_step": 1e-5},
             "axes": [{"key": "continuum/initial_step", "values": [4e-4, 2e-4, 1e-4], "converges": True}],
             "quantities": [{"name": "peak", "column": "stress_ratio", "largest": True, "limit": {"relative": 0.01}}]}
    with pytest.raises(diptych.SceneError, match="'quantities'"):
        diptych.study({**steps, "quantity": []}, tmp_path / "out")
    found = diptych.study(steps, tmp_path / "out", jobs=2)
    assert list(found.points["class"]) == ["right"] * 4 and found.points["peak"][0] == 0
    assert len(found.table) == 4 and found.cost["runs"] == 4
    explained = pd.read_csv(os.path.join(os.path.dirname(statistics.__file__), "result_entries.tsv"), sep="\t", keep_default_na=False)

    def keys(record, place=""):
        for key, value in record.items():
            yield place + key
            for entry in value if isinstance(value, list) else [value]:
                if isinstance(entry, dict) and set(entry) != {"value", "low", "high"}:
                    yield from keys(entry, f"{place}{key}/")

    for file, record in (("study.json", found.numbers), ("study_cost.json", found.cost)):
        assert set(keys(record)) <= set(explained[explained.file == file].entry)
    with pytest.raises(diptych.SceneError, match="--resume"):
        diptych.study(steps, tmp_path / "out")
    assert diptych.Campaign.load(tmp_path / "out").numbers == found.numbers
