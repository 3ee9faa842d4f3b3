# diptych: measured fields as data of a calibration
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fields of a known band, and a continuum that is measured and found again."""

import json
import os

import numpy as np
import pandas as pd
import pytest
from conftest import QUICK

import diptych
from diptych.campaigns.calibration import posterior
from diptych.campaigns.calibration.calibration_file import Calibration, read_calibration, Target
from diptych.campaigns.calibration.fields import measured_windows, observe_field, observe_levelled
from diptych.campaigns.calibration.noise import Data, FittedData, Noise, noise_of
from diptych.campaigns.calibration.observations import Observation, windows_of
from diptych.campaigns.calibration.reading import checked
from diptych.campaigns.measured.folder import write_measurement
from diptych.levelling import field_of, levelled
from diptych.measurement import Measurement

PX, TURN, JUMP = 10.0, np.radians(50), 0.8  # pixels of a mean diameter, band of the synthetic fields
SCENE = {"loading": {"axial_strain": 0.02, "stage_strain": 0.02}, "comparison": {"window_edges": [0, 0.02]},
         "continuum": {"law": "cosserat_drucker_prager", "mesh": "rectangle", "rectangle_width": 30,
                       "rectangle_height": 40, "element_size": 2, "hardening": "exponential", "friction_angle_peak": 30,
                       "friction_angle_residual": 15, "dilatancy_angle_peak": 5, "softening_strain": 0.03,
                       "internal_length": 1, "youngs_modulus": 1000, "weak_spot_strain": 0.02,
                       "initial_step": 0.001, "max_step": 0.001}}
GRID = np.stack(np.meshgrid(np.arange(1, 29.5), np.arange(1, 39.5)), axis=-1).reshape(-1, 2)


def measured(folder, displacement, noise=0.02, subset=2.0):
    """Writes a measurement of the displacements of GRID [d]."""
    end = GRID + displacement + noise * np.random.default_rng(1).standard_normal(GRID.shape)
    os.makedirs(folder)
    write_measurement(folder, Measurement(
        position=PX * (np.array([GRID, end]) + 3), progress=np.array([0, 0.02]), mean_diameter=PX, spacing=PX,
        deviation=PX * noise * np.outer([0, 1], np.ones(len(GRID))), subset=PX * subset,
        centre=PX * np.array([18, 23])), pd.DataFrame({"axial_strain": [0, 0.02], "volumetric_strain": [0, -0.001]}))
    return str(folder)


def sheared(jump, half_width):
    """Displacements of a band through the middle of a sample that shortens beside it."""
    y = (GRID - [15, 20]) @ [-np.sin(TURN), np.cos(TURN)]
    return GRID * [0.002, -0.002] - 0.5 * jump * np.tanh(y / half_width)[:, None] * [np.cos(TURN), np.sin(TURN)]


def observed(folder):
    """Observables, what was measured, deviations, reasons, and windows."""
    scene, target = diptych.scenes.read(SCENE), Target(name="a", scene="", settings=[], curve="a.csv", measured=folder)
    observables = Calibration(name="c", file="c.json", title="c", targets=[target], bins=[], parameters=[], fixed=[],
                              kinds=["ln_width", "angle", "strip_profile"],
                              noise=Noise()).observables_of(scene, target)
    o, deviations = Observation(values=np.full(len(observables), np.nan)), np.full(len(observables), np.nan)
    windows = measured_windows(scene, folder, windows_of(observables))
    return observables, o, deviations, observe_field(o, deviations, scene, observables, windows), windows


def test_a_known_band_gives_its_width_angle_and_strips_with_deviations(tmp_path):
    """u = (jump / 2) tanh(y / 2) has the 10-90 % width 2 ln 9. The strain beside the band adds 0.004 sin cos y."""
    u = sheared(JUMP, 2)
    observables, o, deviations, left_out, _ = observed(measured(tmp_path / "field", u, subset=0))
    y = np.array([0.5 * (one.near + one.far) for one in observables[2:]])
    strips = 0.5 * JUMP * np.tanh(y / 2) + 0.004 * np.sin(TURN) * np.cos(TURN) * y
    travel = np.hypot(*(u[GRID[:, 1] >= 37].mean(0) - u[GRID[:, 1] <= 3].mean(0)))
    assert left_out == [""] * 7
    assert (abs(o.values - [np.log(2 * np.log(9)), 50, *strips / travel]) < 3 * deviations).all()
    data = Data(observables=observables, values=o.values, given=deviations)
    assert FittedData(noise_of([data], Noise()), [data], [left_out]).used.all()


@pytest.mark.parametrize("jump, half_width, of_width, of_others", [
    (0, 1, "no band was measured", "no band was measured"), (JUMP, 8, "", "the measured band is a diffuse zone"),
    (JUMP, 0.3, "the measured band may be as narrow as the resolution", "")])
def test_a_band_that_is_not_seen_does_not_count(tmp_path, jump, half_width, of_width, of_others):
    _, o, _, left_out, _ = observed(measured(tmp_path / "field", sheared(jump, half_width)))
    assert left_out == [of_width, *6 * [of_others]]
    assert list(np.isnan(o.values)) == list(map(bool, left_out))


def test_a_continuum_without_a_band_counts_as_half_a_sample_sheared_at_45_degrees(tmp_path):
    """Its displacement is affine: the strips grow with the distance, but for the strain along the band."""
    panel = diptych.ContinuumPanel({**SCENE, "continuum": SCENE["continuum"] | {
        "element_size": 5, "platens": "smooth", "friction_angle_peak": 45, "weak_spot_strain": 0}})
    assert panel.run() == "finished"
    observables, *_, windows = observed(measured(tmp_path / "field", sheared(JUMP, 2)))
    o = observe_levelled(Observation(values=np.zeros(7)), diptych.scenes.read(SCENE), observables, panel.snapshots,
                         windows)
    assert o.bands == [None] and o.values[:2] == pytest.approx([np.log(20), 45])
    assert o.values[2:] / o.values[2] == pytest.approx([1, 3, 5, 7, 9], rel=0.15)


def contents(**changes):
    target = {"name": "rods", "scene": "scene.prm", "measured": "field", **changes.pop("target", {})}
    return {"targets": [target], "quantities": ["ln_width", "angle"], "starts": 1, "more_runs": 2, "load_step": 0.002,
            "parameters": [{"key": "internal_length", "start": 1.6, "low": 0.5, "high": 3}], "coarse_element_size": 2,
            "noise": {"width_discrepancy": 0.01}, **changes}


def test_the_internal_length_of_a_measured_continuum_is_found_again(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(posterior, "STEPS", 500)
    panel = diptych.ContinuumPanel(SCENE)
    assert panel.run() == "finished"
    measured(tmp_path / "field", -levelled(field_of(*panel.snapshots[::-1]), GRID, 2.0))
    (tmp_path / "scene.prm").write_text(diptych.scenes.read(SCENE).text())
    found = diptych.calibrate(contents(), "out")
    [p], observables = found.parameters.to_dict("records"), found.observables
    assert p["value_low"] < 1 < p["value_high"] and p["value"] == pytest.approx(1, rel=0.15)
    assert observables["counts"].all() and (abs(observables["after"] - observables["mean"])
                                            < 2 * observables["deviation"]).all()
    assert list(found.predictions["verdict"]) == ["equivalent"] * 2


@pytest.mark.parametrize("changes, words", [
    ({"target": {"measured": "nowhere"}}, "line .*: measured = 'nowhere' has no measured.h5; name a folder"),
    ({"target": {"curve": "a.csv"}}, "line .*: measured brings its own curve"),
    ({"target": {"seeds": "1-2"}}, "line .*: measured replaces grains; leave out seeds"),
    ({"target": {"seeds": "1-2"}, "parameters": [{"key": "discrete/friction", "start": 0.3, "low": 0.1, "high": 0.9}]},
     "line .*: measured: grains are fitted to its curves only; leave ln_width, angle out"),
    ({"targets": [{"name": "grains", "scene": QUICK, "seeds": "1-2"}]}, "line .*: quantities: angle and strip_profile"),
    ({"target": {"set": {"loading/axial_strain": 0.03, "loading/stage_strain": 0.01,
                         "comparison/window_edges": "0, 0.01, 0.03"}}}, "target 'rods': no window .* was measured")])
def test_wrong_measured_targets_are_refused(tmp_path, monkeypatch, changes, words):
    monkeypatch.chdir(tmp_path)
    measured(tmp_path / "field", sheared(JUMP, 2))
    (tmp_path / "scene.prm").write_text(diptych.scenes.read(SCENE).text())
    (tmp_path / "c.json").write_text(json.dumps(contents(**changes), indent=1))
    with pytest.raises(diptych.SceneError, match=words):
        checked(read_calibration("c.json"))
