# diptych: a calibration finds known parameters again, and its intervals hold
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A material point stands instead of the boundary problem, so the program does not run."""

import math
import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from calibration_file_test import CURVE

import diptych
from diptych import scenes
from diptych.campaigns.calibration import noise
from diptych.campaigns.calibration.calibration import calibrate, empty_record
from diptych.campaigns.runs.coordinates import Coordinates, Parameter
from diptych.campaigns.calibration.calibration_file import Calibration, Target, read_curve
from diptych.campaigns.calibration.findings import predictions, summary, write_calibration
from diptych.campaigns.calibration.grains import mean_of
from diptych.campaigns.calibration.noise import Data, Noise, Observable
from diptych.campaigns.calibration.profiles import PROFILE, STRIPS
from diptych.campaigns.calibration.observations import CURVE_POINTS, Observation, Path, observe_curve
from diptych.campaigns.calibration.search import least_squares
from diptych.campaigns.calibration.trials import Trials
from diptych.campaigns.runs.histories import mean_over
from diptych.campaigns.runs.input_file import Setting
from diptych.report.calibration import misfits

BINS = [0, 0.001, 0.002, 0.004, 0.006, 0.008, 0.01, 0.0125, 0.015, 0.02, 0.025, 0.03]


def parameter(key, coordinate, start, low, high, **more):
    return Parameter(key=key, coordinate=coordinate, start=start, low=low, high=high, **more)


SIX = [parameter("friction_angle_peak", "logarithm", 30, 12, 45),
       parameter("friction_angle_residual", "drop_from", 0.6, 0.02, 0.9, other="friction_angle_peak"),
       parameter("friction_angle_start", "share_of", 0.9, 0.3, 1, other="friction_angle_peak"),
       parameter("mobilisation_strain", "logarithm", 0.01, 5e-4, 0.05),
       parameter("dilatancy_angle_peak", "share_of", 0.3, 0.05, 1, other="friction_angle_start"),
       parameter("youngs_modulus", "logarithm", 4000, 100, 20000)]
TRUTHS = [23, 0.35, 0.6, 0.004, 0.7, 900]  # numbers of the coordinates
LEVELS = {"stress_level": 0.02, "stress_shape": 0.0045, "volume_start": 1e-4, "volume_growth": 0.04, "ln_width": 0.3}
USUAL = replace(noise.NO_SCATTER, **LEVELS)
SCENE = scenes.read({"loading": {"axial_strain": 0.03}, "comparison": {"window_edges": [0, 0.03]}})


def with_starts(parameters, numbers):
    return [replace(p, start=number) for p, number in zip(parameters, numbers)]


def response(settings, observables):
    """The material point, NaN if it does not converge."""
    values = {one.key: float(one.value) for one in settings}
    try:
        law = {"law": "mohr_coulomb", "hardening": "mobilisation", "softening_strain": 0.05, **values}
        table = diptych.biaxial({"continuum": law}, axial_strain=0.03, step=2.5e-4)
    except (diptych.NotConverged, diptych.SceneError):
        return np.full(len(observables), np.nan)
    x = table["axial_strain"]
    return np.array([mean_over(x, table[one.kind], one.low, one.high) for one in observables])


def calibration(parameters=SIX, targets=("only",), fixed=(), **options):
    """Synthetic data need no model tolerance."""
    own = Noise(stress_discrepancy=1e-5, early_stress_discrepancy=0, volume_discrepancy=1e-6, **options)
    return Calibration(name="c", file="c.json", title="c",
                       targets=[Target(name=name, scene="", settings=[], seeds=[1, 2]) for name in targets],
                       kinds=["stress_ratio", "volumetric_strain"], bins=BINS, parameters=list(parameters),
                       fixed=[Setting("continuum", *one, "") for one in fixed], noise=own, starts=1)


@pytest.fixture(autouse=True)
def few_steps(monkeypatch):
    monkeypatch.setattr("diptych.campaigns.calibration.posterior.STEPS", 500)
    monkeypatch.setattr("diptych.campaigns.calibration.posterior.SHORT", 200)


EXACT = {"stress_level": 1e-5, "stress_shape": 1e-5, "volume_start": 1e-6, "volume_growth": 1e-6}


def path_of(target, data):
    return Path(target=target, scene=SCENE, data=data, samples=[Observation(values=values) for values in data.values],
                left_out=[""] * len(data.observables))


def material_point(settings, path, _):
    return Observation(values=response(settings, path.data.observables))


def calibrated(c, paths, run=material_point, **model):
    """The record of a calibration whose runs are run(settings, path, is_fine)."""
    record = empty_record("c", **model)
    calibrate(Trials(c, Coordinates(c.parameters, {}), paths, lambda on, points, fine, step: [
        [run(s, path, fine) for path, s in zip(on, point)] for point in points], record))
    return record


def truth_of(c, target, numbers):
    there = Coordinates(with_starts(c.parameters, numbers), {})
    return response([*c.fixed, *there.settings(there.start, target)], c.observables_of(SCENE))


def drawn(model, observables, truth, n, seed):
    root = np.linalg.cholesky(noise.covariance(model, Data(observables=observables, values=truth)))
    return Data(observables=observables,
                values=truth + np.random.default_rng(seed).normal(size=(n, len(truth))) @ root.T)


def bins(kind, *edges):
    return [Observable(kind=kind, low=low, high=high) for low, high in zip(edges, edges[1:])]


def usual_observables():
    edges = np.linspace(0, 0.03, 14)
    found = [one for kind in noise.KINDS[:2] for one in bins(kind, *edges)]
    return found + bins("ln_width", 0, 0.01, 0.02, 0.03)


def test_shares_and_drops_refer_to_other_keys():
    there = Coordinates(with_starts(SIX, TRUTHS), {})
    assert there.values(there.start) == pytest.approx([23, 23 * 0.65, 23 * 0.6, 0.004, 23 * 0.6 * 0.7, 900])
    alone = [parameter("dilatancy_angle_peak", "share_of", 0.5, 0, 1, other="friction_angle_peak")]
    fixed = Coordinates(alone, {"friction_angle_peak": 30})
    assert fixed.values(fixed.start) == pytest.approx([15])
    for wrong in (alone, [parameter("cohesion", "share_of", 0.5, 0, 1, other="cohesion")]):
        with pytest.raises(ValueError):
            Coordinates(wrong, {})


def test_a_parameter_may_belong_to_some_targets():
    own = [parameter("friction_angle_start", "share_of", share, 0, 1, other="friction_angle_peak", targets=(name,))
           for name, share in (("dense", 0.8), ("loose", 0.2))]
    there = Coordinates([parameter("friction_angle_peak", "value", 30, 10, 40), *own], {})
    found = {name: [float(one.value) for one in there.settings(there.start, name)]
             for name in ("dense", "loose", "medium", "")}
    assert found == {"dense": pytest.approx([30, 24]), "loose": pytest.approx([30, 6]), "medium": [30], "": [30]}
    with pytest.raises(ValueError, match="other targets"):  # a common parameter has no value
        Coordinates([*own, parameter("dilatancy_angle_peak", "share_of", 0.5, 0, 1, other="friction_angle_start")],
                    {"friction_angle_peak": 30})


def decays(wall, scale=1.0):
    """r = 100 (data - a exp(-b t)) in scaled coordinates; beyond the wall the run fails. Returns the function and its
    count."""
    t, runs = 0.1 * np.arange(20), []

    def residuals(points):
        runs.extend(points)
        return [np.full(20, np.nan) if scale * p[0] > wall
                else 100 * ((0.2 + scale * p[0]) * np.exp(-3 * p[1] * t) - 0.7 * np.exp(-1.2 * t)) for p in points]

    return residuals, runs


@pytest.mark.parametrize("start", [(0.9, 0.9), (0.05, 0.05), (1, 0)])
def test_the_search_finds_the_minimum_with_few_runs(start):
    residuals, runs = decays(2)
    fit = least_squares(residuals, start)
    assert not fit.note
    assert fit.point == pytest.approx([0.5, 0.4], abs=1e-3)
    assert fit.evaluations == len(runs) <= 25


def test_the_search_keeps_to_bounds_and_avoids_failed_runs():
    walled = least_squares(decays(0.45)[0], (0.1, 0.6))
    assert 0.35 < walled.point[0] <= 0.45
    # the minimum lies at 1.67
    assert least_squares(decays(2, 0.3)[0], (0.5, 0.5)).point[0] == pytest.approx(1, abs=1e-6)
    nothing = least_squares(decays(-1)[0], (0.5, 0.5))
    assert nothing.note


def test_noise_is_found_again():
    data = drawn(USUAL, usual_observables(), np.full(29, 0.3), 200, 3)
    found = noise.noise_of([data], Noise())
    assert found.stress_level == pytest.approx(0.02, abs=0.003)
    assert found.stress_shape == pytest.approx(0.0045, abs=0.0002)
    assert found.volume_start == pytest.approx(1e-4, abs=4e-6)
    assert found.volume_growth == pytest.approx(0.04, abs=0.006)
    assert found.ln_width == pytest.approx(0.3, abs=0.03)
    assert found.degrees_of_freedom == 199
    assert noise.noise_of([data], Noise(stress_level=0.5)).stress_level == 0.5
    with pytest.raises(ValueError, match="stress_level, stress_shape.* must be given"):
        noise.noise_of([drawn(USUAL, usual_observables(), np.full(29, 0.3), 1, 3)], Noise())


def test_weights_leave_the_common_level_out():
    working = noise.working_covariance(USUAL, drawn(USUAL, usual_observables(), np.full(29, 0.3), 4, 3))
    # tolerance, shape on four samples
    assert working[12, 12] ** 0.5 == pytest.approx(math.hypot(0.008, 0.0045 / 2), abs=1e-4)


def test_a_calibration_finds_the_parameters_of_its_own_data():
    c = calibration(**EXACT)
    truth = truth_of(c, "", TRUTHS)
    record = calibrated(c, [path_of(c.targets[0], Data(observables=c.observables_of(SCENE), values=[truth, truth]))])
    assert record["status"] == "finished"
    assert [p["number"] for p in record["parameters"]] == pytest.approx(TRUTHS, rel=1e-3)
    assert record["coarse_runs"] <= 60 and record["fine_runs"] <= 10


def test_a_calibration_finds_values_of_single_targets():
    parameters = [parameter("friction_angle_peak", "logarithm", 28, 12, 45),
                  parameter("mobilisation_strain", "logarithm", 0.01, 5e-4, 0.05),
                  *(parameter("friction_angle_start", "value", start, 1, 20, targets=(name,)) for name,
                    start in (("dense", 15), ("loose", 10)))]
    c = calibration(parameters, ("dense", "loose", "other"),
                    [("dilatancy_angle_peak", "3"), ("friction_angle_residual", "12"), ("youngs_modulus", "900")],
                    **EXACT)
    c.targets[2].is_fitted, truths = False, [24, 0.004, 18, 5]
    paths = [path_of(target, Data(observables=c.observables_of(SCENE),
                                  values=[truth_of(c, target.name, truths)] * 2)) for target in c.targets[:2]]
    record = calibrated(c, paths)
    assert [p["number"] for p in record["parameters"]] == pytest.approx(truths, rel=1e-3)
    assert [(one["target"], round(one["value"], 2)) for one in record["own"]] == [("dense", 18), ("loose", 5)]
    assert len(record["settings"]) == 5  # a value of one target is no setting of all


def test_intervals_hold():
    """Eight data sets of four samples, from which the scatter is estimated; benchmarks/calibration/coverage has
    eighty."""
    c = calibration()
    c.noise, truth, held, share = Noise(), truth_of(c, "", TRUTHS), [], []
    for seed in range(8):
        record = calibrated(c, [path_of(c.targets[0], drawn(USUAL, c.observables_of(SCENE), truth, 4, seed))])
        held += [p["number_low"] < number < p["number_high"] for p, number in zip(record["parameters"], TRUTHS)
                 if p["is_identified"]]
        share += [p["share_known"] for p in record["parameters"]]
    assert len(held) >= 40 and np.mean(held) > 0.85 and np.mean(share) < 0.4  # of 48


def test_a_search_that_does_not_converge_gives_no_interval(tmp_path):
    """One Jacobian is too few for six parameters and exact data. A posterior of an earlier run does not stay."""
    c = calibration(**EXACT)
    c.jacobians, c.fine_jacobians, truth = 1, 1, truth_of(c, "", TRUTHS)
    record = calibrated(c, [path_of(c.targets[0], Data(observables=c.observables_of(SCENE), values=[truth, truth]))])
    assert not record["has_converged"] and "the search has not converged" in record["no_intervals"]
    assert record["findings"][0].startswith(record["no_intervals"]) and len(record["findings"]) == 3
    assert all(np.isnan(p["number_low"]) and not p["draws"] for p in record["parameters"])
    (tmp_path / "posterior.csv").write_text("of an earlier run")
    write_calibration(str(tmp_path), record, {}, pd.DataFrame())
    assert not (tmp_path / "posterior.csv").exists()


def test_failed_runs_are_left_out_and_told():
    """The law refuses friction above 29 degrees, as at the first start, and the samples' own mesh never comes to its
    end."""
    c = calibration(**EXACT)
    truth = truth_of(c, "", TRUTHS)

    def observed(settings, path, fine):
        angle = next(float(one.value) for one in settings if one.key == "friction_angle_peak")
        if fine or angle > 29:
            return Observation(values=np.full(len(path.data.observables), np.nan),
                               failure="no balance" if fine else f"angle {angle} exceeds 29")
        return material_point(settings, path, fine)

    path = path_of(c.targets[0], Data(observables=c.observables_of(SCENE), values=[truth, truth]))
    path.target.before = [Setting("continuum", "friction_angle_peak", "20", "")]
    record = calibrated(c, [path], observed)
    assert record["status"] == "finished"
    assert [p["number"] for p in record["parameters"]] == pytest.approx(TRUTHS, rel=1e-2)
    assert any("rests on the coarse mesh" in words for words in record["words"])
    n = record["coarse_runs"] + record["fine_runs"]
    assert any(f"{record['failed_runs']} of {n} coarse and fine runs" in words for words in record["words"])


@pytest.mark.parametrize("peak, volume, verdicts", [(0.4, -0.003, ["equivalent", "equivalent"]),
                                                    (0.3, -0.006, ["different", "different"])])
def test_given_deviations_of_a_curve_decide(peak, volume, verdicts):
    observables = bins("stress_ratio", 0, 0.03) + bins("volumetric_strain", 0, 0.03)
    path = path_of(Target(name="lab", scene="", settings=[], curve="lab.csv"),
                   Data(observables=observables, values=[0.4, -0.003], given=[0.004, 0.0005]))
    path.samples[0].numbers["peak_stress_ratio"] = 0.4
    now = Observation(values=np.array([peak, volume]), numbers={"peak_stress_ratio": peak})
    found = predictions(path, (now, now), np.zeros(2))
    assert [one["verdict"] for one in found] == verdicts
    assert found[1]["difference"].high == pytest.approx(volume + 0.003 + 1.96 * 0.0005, rel=1e-4)


def test_a_measured_curve_gives_means_over_bins_and_its_own_deviations(tmp_path):
    file = tmp_path / "lab.csv"
    file.write_text(CURVE)
    observables = bins("stress_ratio", 0, 0.01, 0.02, 0.03) + bins("volumetric_strain", 0.01, 0.02)
    o, deviations = observe_curve(SCENE, observables, str(file))
    assert o.values == pytest.approx([0.15, 0.35, np.nan, -0.003], nan_ok=True)  # beyond its end nothing is measured
    assert deviations == pytest.approx([0.01, 0.015, np.nan, np.nan], nan_ok=True)
    data = Data(observables=observables[:2], values=o.values[:2], given=deviations[:2])
    assert noise.noise_of([data], Noise()) == noise.NO_SCATTER  # no scatter is needed: all deviations are measured
    assert np.sqrt(np.diag(noise.covariance(noise.NO_SCATTER, data))) == pytest.approx([0.01, 0.015])
    with pytest.raises(ValueError, match="stress_level, stress_shape.* must be given"):
        noise.noise_of([Data(observables=observables[:2], values=o.values[:2])], Noise())


def test_a_law_is_fitted_to_a_measured_curve():
    c = calibration()
    c.targets[0].curve, c.targets[0].seeds = "lab.csv", []
    truth, observables = truth_of(c, "", TRUTHS), c.observables_of(SCENE)
    given = np.where([one.kind == "stress_ratio" for one in observables], 1e-5, 1e-6)
    record = calibrated(c, [path_of(c.targets[0], Data(observables=observables, values=truth, given=given))])
    assert [p["number"] for p in record["parameters"]] == pytest.approx(TRUTHS, rel=1e-3)
    assert all(p["number_low"] < truth < p["number_high"] for p, truth in zip(record["parameters"], TRUTHS))


@pytest.mark.filterwarnings("error")
def test_a_calibration_whose_own_meshes_fail_rests_on_the_coarse_one():
    """Neither the scene's parameters nor the calibrated ones have numbers there."""
    def run(settings, path, is_fine):
        values = response(settings, path.data.observables)
        return Observation(values=np.nan * values, failure="no answer") if is_fine else Observation(values=values)

    c = calibration([parameter("friction_angle_peak", "logarithm", 25, 14, 40)])
    c.targets[0].curve, c.targets[0].seeds = "lab.csv", []
    truth, observables = truth_of(c, "", [23]), c.observables_of(SCENE)
    data = Data(observables=observables, values=truth, given=np.full(len(truth), 1e-3))
    record = calibrated(c, [path_of(c.targets[0], data)], run)
    assert record["parameters"][0]["value"] == pytest.approx(23, rel=1e-3)
    told = summary(record, dict.fromkeys(("total_cpu_s", "grains_cpu_s", "continuum_cpu_s"), 1.0))
    assert re.match(r"c: .* observables: \(not finished\) before, [\d.]+(e-\d+)? calibrated\n", told), told
    assert "with the calibrated parameters 'only' did not finish: no answer" in told
    rows = misfits(SimpleNamespace(paths=record["paths"]))["rows"]
    assert rows and not any("nan" in cell for row in rows for cell in row)


def test_friction_of_noisy_grains_is_found_within_its_interval():
    """Curves of a laboratory against eight noisy samples, the same at every point. A run depends on friction through
    its mean and through a part of its noise, as chaotic grains do."""
    c = calibration([parameter("discrete/friction", "logarithm", 0.3, 0.1, 0.9)])
    c.noise = Noise(stress_discrepancy=0, early_stress_discrepancy=0, volume_discrepancy=0)
    c.targets[0].curve = "lab.csv"
    observables = c.observables_of(SCENE)
    stress = np.array([one.kind == "stress_ratio" for one in observables])
    x = np.array([one.high for one in observables])

    def mean(friction):
        return np.where(stress, 0.36 + 0.1 * np.log(friction / 0.4), -x * (0.6 + 0.4 * np.log(friction / 0.4)))

    found = []
    for seed in range(8):
        lab = drawn(USUAL, observables, mean(0.4), 16, 1000 + seed).mean
        common = drawn(USUAL, observables, 0 * x, 8, seed).values

        def samples(settings):
            friction = float(settings[0].value) if settings else 0.3
            own = drawn(USUAL, observables, 0 * x, 8, int(1e6 * friction)).values
            return [Observation(values=mean(friction) + 0.95 * a + 0.3 * b, progress=np.linspace(0, 0.03, CURVE_POINTS))
                    for a, b in zip(common, own)]

        given = np.sqrt(np.diag(noise.covariance(USUAL, Data(observables=observables, values=0 * x))) / 16)
        path = path_of(c.targets[0], Data(observables=observables, values=lab, given=given, runs=8))
        path.scatter = Data(observables=observables, values=[one.values for one in samples([])])
        record = calibrated(c, [path], lambda settings, *_: mean_of(samples(settings), 0.005), model="grains")
        found.append(record["parameters"][0])
    assert sum(p["number_low"] < 0.4 < p["number_high"] for p in found) >= 7
    assert np.sqrt(np.mean([(p["value"] - 0.4) ** 2 for p in found])) < 0.04
    assert max(p["number_high"] - p["number_low"] for p in found) < 0.25


def banded(settings, observables):
    """Profile of a band whose width is 5 internal lengths."""
    delta = 5 * float(next((one.value for one in settings), 3)) / 2.197
    return np.array([0.5 / delta / np.cosh(0.5 * (one.near + one.far) / delta) ** 2 for one in observables])


@pytest.mark.parametrize("parts", [1, 4])
def test_a_profile_gives_the_internal_length_and_no_more_for_finer_strips(parts):
    """Bands of four samples vary by 20 % in width: their mean is known to 10 %, however many strips show it."""
    observables = [Observable(kind=PROFILE, low=low, high=low + 0.01, near=a + (b - a) * k / parts,
                              far=a + (b - a) * (k + 1) / parts)
                   for low in (0.01, 0.02) for a, b in zip(STRIPS, STRIPS[1:]) for k in range(parts)]
    c, truth, held, deviations = calibration([parameter("internal_length", "logarithm", 3, 0.8, 8)]), 2.0, 0, []
    mean = banded([Setting("continuum", "internal_length", str(truth), "")], observables)
    c.noise = Noise(width_discrepancy=1e-3)
    for seed in range(12):
        data = drawn(replace(noise.NO_SCATTER, profile_stretch=0.2, profile_noise=0.08), observables, mean, 4, seed)
        [p] = calibrated(c, [path_of(c.targets[0], data)],
                         lambda settings, *_: Observation(values=banded(settings, observables)))["parameters"]
        held += p["number_low"] < truth < p["number_high"]
        deviations.append(np.log(p["draws"]).std())
    # Twelve intervals of 90 %: fewer than 9 hold the truth in 3 of 100 such tests.
    assert held >= 9 and 0.08 < np.mean(deviations) < 0.15


def test_element_tests_have_their_own_scatter_and_no_bands(tmp_path):
    """element.csv gives means of grains with errors; a prescribed volume does not count."""
    header = ("progress,grains_stress_ratio,grains_stress_ratio_error,grains_volumetric_strain,"
              "grains_volumetric_strain_error")
    (tmp_path / "element.csv").write_text(header + "\n0,0,0.01,0,0\n0.02,0.3,0.02,0,1e-17\n2,0.3,0.02,0,0\n")
    table = read_curve(str(tmp_path / "element.csv"))
    assert list(table) == ["progress", "stress_ratio", "stress_ratio_deviation"] and len(table) == 3
    data = drawn(USUAL, usual_observables(), np.full(29, 0.3), 200, 3)
    wild = replace(USUAL, stress_level=0.1, stress_shape=0.02, volume_growth=0.1)
    cell = drawn(wild, usual_observables(), np.full(29, 0.3), 8, 4)
    cell.own = noise.noise_of([cell], Noise())
    assert noise.noise_of([data, cell], Noise()).stress_level == pytest.approx(0.02, abs=0.003)
    assert noise.covariance(USUAL, cell)[0, 0] ** 0.5 == pytest.approx(0.1, rel=0.5)
