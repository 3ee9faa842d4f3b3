# diptych: validation of an ensemble: coverage of its intervals, parts that are not known, the runs behind them
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Only the last test runs the program."""

import math

import numpy as np
import pytest
from conftest import QUICK, SMALL, options, program

import diptych
from diptych.campaigns.ensembles import ensemble
from diptych.campaigns.ensembles import validation
from diptych.campaigns.runs.input_file import settings_of
from diptych.campaigns.runs.members import Member
from diptych.campaigns.runs.statistics import paired

MARGINS = {"margin_angle": 3, "margin_thickness": 0.2, "margin_peak_stress_ratio": 0.005,
           "margin_volumetric_strain": 0.002}
NAMES = ("discrete_summary peak_stress_ratio", "continuum_summary peak_stress_ratio")


def members_of(grains, continuum, **expected):
    numbers = [dict(zip(NAMES, pair)) for pair in zip(grains, continuum)]
    return [Member(numbers={name: (value, "-", False) for name, value in {**one, **{
        f"discrete_summary {key}": error for key, error in expected.items()}}.items()}) for one in numbers]


def peak(members, *responses):
    record = ensemble.evaluate(members, MARGINS, *responses)
    return record["verdicts"][0], record["validation"][0]


@pytest.mark.parametrize("kind, n", [("absolute", 4), ("relative", 4), ("absolute", 16)])
def test_intervals_hold_the_true_error_in_92_to_96_of_100_ensembles(kind, n):
    """Grains of mean 1 scatter by 0.04; their step adds 0.02 as expected, the mesh an error of deviation 0.01, the
    parameters one of 0.015, known from 12 draws. The form of the law is wrong by 0.05."""
    random, hits, runs = np.random.default_rng(1), 0, 2000
    for _ in range(runs):
        grains = random.normal(1.02, 0.04, n)
        continuum = 1.05 + random.normal(0, 0.01) + random.normal(0, 0.015) + random.normal(0, 0.002, n)
        parts = {"grains_step": validation.SAFETY / 2 * 0.02, "mesh": 0.01, "load_step": math.nan,
                 "parameters": random.normal(0, 0.015, 12).std(ddof=1)}
        found, _row = validation.validated(kind, (grains, continuum), parts, 12)
        hits += found.difference.low < 0.05 < found.difference.high
    assert 0.91 < hits / runs < 0.97


def test_a_bias_within_u_num_is_no_verdict_different():
    """The grains' step adds 1.5 % of strength, as its rule of at most 2 % expects. The scatter alone tells the panels
    apart."""
    grains = 0.4 * 1.015 + 0.0004 * np.array([-1.0, 0, 1, 0])
    members = members_of(grains, [0.4] * 4)
    assert peak(members)[0]["verdict"] == "different"
    verdict, row = peak(members_of(grains, [0.4] * 4, expected_strength_error=0.02))
    assert verdict["verdict"] == row["verdict"] == "cannot tell" and row["ratio"] < 1.5
    assert row["parts"]["grains_step"] == pytest.approx(validation.SAFETY / 2 * 0.02 * 0.406)


def test_without_known_parts_the_interval_is_that_of_the_samples_and_the_parts_are_named():
    grains, continuum = [0.4, 0.41, 0.39, 0.4], [0.41, 0.41, 0.4, 0.4]
    verdict, row = peak(members_of(grains, continuum))
    assert verdict["difference"] == pytest.approx(paired(grains, continuum, "relative").difference)
    assert row["not_known"] == ["step of the grains", "mesh", "load step", "parameters"]
    assert math.isnan(row["u_num"]) and math.isnan(row["u_input"]) and row["u_val"] == row["u_D"]
    assert row["u_D"] == pytest.approx(np.subtract(continuum, grains).std(ddof=1) / 2)
    assert math.isnan(peak(members_of(grains[:1], continuum[:1]))[1]["u_val"])  # one sample has no scatter


def test_parts_follow_from_the_runs_of_the_continuum():
    """Errors of order 1: 0.03 h of the mesh, at h = 1 and 2, and 0.02 k of the load step k = 1. The draws deviate by
    0.01."""
    fine = [0.43] * 4
    responses = validation.Responses(coarse=[{NAMES[1]: 0.46}] * 4, size_ratio=2.0, base={NAMES[1]: 0.46},
                                     half_step={NAMES[1]: 0.45},
                                     draws=[{NAMES[1]: 0.4 + x} for x in (-0.01, 0, 0.01)] + [{}])
    row = peak(members_of([0.4, 0.41, 0.39, 0.4], fine, expected_strength_error=1e-9), responses)[1]
    assert row["parts"]["mesh"] == pytest.approx(validation.SAFETY / 2 * 0.03)
    assert row["parts"]["load_step"] == pytest.approx(validation.SAFETY / 2 * 0.02)
    assert row["u_input"] == pytest.approx(0.01) and not row["not_known"]
    assert row["u_val"] == pytest.approx(math.hypot(row["u_num"], row["u_input"], row["u_D"]))


def write_posterior(folder, text):
    (folder / "posterior.csv").write_text(text)
    (folder / "calibrated.prm").write_text("subsection continuum\n  set internal_length = 2\nend\n")
    return str(folder / "calibrated.prm")


def test_an_ensemble_with_a_posterior_knows_all_parts_of_its_strength(tmp_path, monkeypatch):
    """Three draws and half the load step are run on the coarse mesh. Other margins need no run."""
    monkeypatch.chdir(tmp_path)
    wrong = write_posterior(tmp_path, "internal_lenght\n2\n")
    with pytest.raises(diptych.SceneError, match="posterior.csv: continuum/internal_lenght is not a key"):
        validation.variations(QUICK, settings_of([], [wrong]), validation.draws_of([wrong], []))
    file = write_posterior(tmp_path, "friction_angle_peak,internal_length,friction_angle_start "
                           "(other)\n27,2,9\n29,2,9\n28,3,9\n")
    exact = settings_of(["continuum/internal_length=2"])
    assert [[one.key for one in draw] for draw in validation.draws_of([file], exact)] == [
        ["friction_angle_peak"]] * 3
    assert len(validation.draws_of([write_posterior(tmp_path, "internal_length\n" + "2\n" * 400)],
                                   [])) == validation.DRAWS
    write_posterior(tmp_path, "friction_angle_peak,internal_length\n27,2\n29,2\n28,3\n")
    words = options({**SMALL, "sample": {"grains": 200}})
    line = ["run", QUICK, *words, "--set-file", file, "--seeds", "1-2", "--output", "out", "--quiet"]
    program(*line)
    found = diptych.Campaign.load("out").numbers
    row = found["validation"][0]
    assert len(found["continuum_runs"]["values"]) == 4 and row["u_input"] > 0 and row["not_known"] == []
    assert not (tmp_path / "out" / "validation").exists()
    program("compare", "out", "--set", "comparison/margin_peak_stress_ratio=10", "--quiet")
    again = diptych.Campaign.load("out").numbers["validation"][0]
    assert again == {**row, "verdict": "equivalent"}
