# diptych: measured displacement fields beside both panels
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Known fields, and measurements that are made of the grains of a small run."""

import json
import math
import os
import shutil

import h5py
import numpy as np
import pandas as pd
import pytest

import diptych
from conftest import options, program, QUICK, SMALL
from foreign_sets import FOREIGN
from diptych import scenes
from diptych.campaigns.ensembles.measured import rows_of
from diptych.campaigns.measured.comparison import compared, increments, windows_of
from diptych.campaigns.measured.folder import write_measurement
from diptych.errors import SceneError
from diptych.levelling import field_of, levelled, on_sample, with_noise
from diptych.importers.fields.measure import tracked
from diptych.measurement import FieldFrame, Measurement, read_measurement
from diptych.operators import find_bands
from diptych.thickness import CONVENTIONS, thicknesses

FRAME = {"mean_diameter": 1.0, "centre": np.zeros(2), "width": 40.0, "height": 60.0}


def grid(width, height, spacing):
    axes = [np.arange(-side / 2 + spacing / 2, side / 2, spacing) for side in (width, height)]
    return np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, 2)


def tanh_band(points, angle_deg=50.0, delta=3.0):
    along = np.array([np.cos(np.radians(angle_deg)), np.sin(np.radians(angle_deg))])
    across = points @ np.array([-along[1], along[0]])
    return points * [0.004, -0.008] - 0.4 * np.tanh(across / delta)[:, None] * along


def test_a_subset_averages_over_a_square():
    # Against the mean over 101 x 101 places: five places along a side are enough where the field bends over a subset.
    points, side = grid(10, 10, 1), np.linspace(-1, 1, 101)
    places = (points[:, None] + np.stack(np.meshgrid(side, side), axis=-1).reshape(-1, 2)).reshape(-1, 2)
    mean = tanh_band(places, delta=1.5).reshape(len(points), -1, 2).mean(axis=1)
    found = levelled(lambda at: tanh_band(at, delta=1.5), points, 2.0)
    assert np.abs(found - mean).max() < 0.01 * np.ptp(mean)
    assert np.abs(tanh_band(points, delta=1.5) - mean).max() > 0.02 * np.ptp(mean)


def test_a_subset_keeps_a_linear_field_and_ends_where_half_of_it_is_outside():
    def inside(points):
        return np.where(points[:, :1] < 1, points @ np.array([[0.1, 0.2], [0.3, -0.1]]), np.nan)

    points = np.array([[0.0, 0.0], [-3.0, 2.0], [0.9, 0.0], [1.3, 0.0]])
    found = levelled(inside, points, 2.0)
    assert found[:2] == pytest.approx(inside(points)[:2])
    assert np.isfinite(found[:, 0]).tolist() == [True, True, True, False]


def test_points_are_followed_alike_through_displacements_since_the_first_image_or_the_one_before():
    points = grid(40, 60, 2)
    steps = [lambda x: x * [0.01, -0.02] + [0.3, 0.1], lambda x: x * [0.0, -0.03] + [0.0, 0.2]]
    first = points + steps[0](points)
    since_first = [FieldFrame("1", points, first - points), FieldFrame("2", points, first + steps[1](first) - points)]
    before = [FieldFrame(str(k), points, step(points), deviation=np.full(len(points), 0.1)) for k, step in
              enumerate(steps)]
    by_first, _ = tracked(since_first, True)
    by_steps, deviation = tracked(before, False)
    inside = np.isfinite(by_steps[2][:, 0])
    assert inside.mean() > 0.9
    assert by_steps[2][inside] == pytest.approx(by_first[2][inside], abs=1e-9)
    assert deviation[2][inside] == pytest.approx(0.1 * math.sqrt(2))
    with pytest.raises(SceneError, match="--reference previous"):
        tracked([since_first[0], FieldFrame("2", points + 1, points)], True)


def test_every_convention_of_thickness_is_its_multiple_of_the_half_width():
    points = grid(40, 60, 0.5)
    band, = find_bands(points, tanh_band(points), **FRAME, band_resamples=0).bands
    for name, found in thicknesses(points, tanh_band(points), band, 0.5).items():
        assert found == pytest.approx(CONVENTIONS[name][2] * 3.0, rel=0.02), name


def test_noise_of_the_points_widens_the_intervals_and_unknown_noise_does_not():
    points, options = grid(40, 60, 1.5), {"band_resamples": 40}
    moved = tanh_band(points) + 0.02 * np.random.default_rng(1).standard_normal(points.shape)
    report = find_bands(points, moved, **FRAME, **options)

    def half(found):
        _, low, high = found.bands[0].interval["angle_deg"]
        return high - low

    assert half(with_noise(report, points, moved, np.full(len(points), 0.08), options)) > 1.1 * half(report)
    assert half(with_noise(report, points, moved, np.full(len(points), np.nan), options)) == half(report)
    assert math.isnan(half(with_noise(report, points, moved, np.full(len(points), 2.0), options)))  # no band is left


def measurement_of(snapshots, **changes):
    """What an image correlation without noise would see of grains."""
    first, d = snapshots[0], snapshots[0].mean_diameter
    low, high = first.position.min(0) + d, first.position.max(0) - d
    points = np.stack(np.meshgrid(*(np.arange(a, b, d) for a, b in zip(low, high))), axis=-1).reshape(-1, 2)
    given = {"subset": 2 * d, "spacing": d, "mean_diameter": d, "centre": 0.5 * (low + high), **changes}
    moved = [-levelled(field_of(one, first), points, given["subset"]) for one in snapshots[1:]]
    return Measurement(position=np.array([points, *(points + u for u in moved)]),
                       deviation=np.full((len(snapshots), len(points)), 0.01 * d) * np.arange(len(snapshots))[:, None],
                       progress=np.array([0, *(one.progress for one in snapshots[1:])]), **given)


@pytest.fixture(scope="session")
def measured_folder(folder, tmp_path_factory):
    """The measurement of the grains of the small run."""
    path = tmp_path_factory.mktemp("measured")
    snapshots = diptych.load(folder).discrete.snapshots
    curves = pd.DataFrame({"axial_strain": [one.axial_strain for one in snapshots], "stress_ratio": 0.3,
                           "volumetric_strain": [1 - one.area / snapshots[0].area for one in snapshots]})
    write_measurement(path, measurement_of(snapshots), curves)
    return path


def test_a_measurement_of_the_grains_has_the_strain_and_band_of_the_levelled_grains(folder, measured_folder):
    results, scene = diptych.load(folder), scenes.read(os.path.join(folder, "scene.prm"))
    measurement = read_measurement(measured_folder)
    windows = windows_of(measurement, scene, {"discrete": results.discrete.snapshots,
                                              "continuum": results.continuum.snapshots})
    window, = compared(measurement, windows, scene.dict()["comparison"])["windows"]
    assert (window["from"], window["to"]) == (0, 0.01)
    # Grains are averaged where they are at the end of the window, the measurement where its points began.
    shear = window["levelled"]["measured"]["shear_strain"].value
    for name in ("shear_strain", "volumetric_strain"):
        assert abs(window["difference"]["discrete"][name].value) < 0.05 * shear
    fields = {pane: arrays["displacement_increment"] for pane, arrays in window["fields"].items()}
    assert fields["continuum"].shape == window["position"].shape == (window["points"], 2)
    error = fields["discrete"] - fields["measured"]
    assert np.sqrt(np.mean(error**2) / np.mean(fields["measured"] ** 2)) < 0.1
    assert set(window["unblurred"]) == set(window["difference"]) == {"discrete", "continuum"}


def test_a_scaled_and_moved_measurement_gives_the_same_places(folder):
    snapshots = diptych.load(folder).discrete.snapshots
    once, d, centre = measurement_of(snapshots), snapshots[0].mean_diameter, np.array([5.0, 6.0])
    twice = Measurement(position=2 * once.position + 7, deviation=once.deviation, progress=once.progress,
                        mean_diameter=2 * d, subset=1, spacing=1, centre=2 * once.centre + 7)
    places = [on_sample(one, 2, one.position[2], centre) for one in (once, twice.scaled(d))]
    assert places[1] == pytest.approx(places[0])


def test_a_band_that_may_be_as_narrow_as_the_subset_has_no_width():
    points = grid(40, 60, 1.0)
    position = np.array([points, points + tanh_band(points, delta=0.7)])
    narrow = Measurement(position=position, deviation=np.full(position.shape[:2], np.nan), progress=np.array([0, 0.01]),
                         mean_diameter=1.0, subset=3.0, spacing=1.0, centre=np.zeros(2))
    keys = scenes.read(SMALL).dict()["comparison"]
    band, = compared(narrow, increments(narrow), keys)["windows"][0]["levelled"]["measured"]["bands"]
    assert "resolution of 2.4 d" in band["unresolved"]
    assert math.isnan(band["width_10_90_d"].value) and band["thickness_d"] == {}
    assert band["angle_deg"].value == pytest.approx(50, abs=2)


def test_windows_that_were_not_measured_are_refused(folder):
    results, scene = diptych.load(folder), scenes.read(os.path.join(folder, "scene.prm"))
    measurement = measurement_of(results.discrete.snapshots)
    measurement.progress = np.array([0, 0.02, 0.03])[:len(measurement.progress)]
    with pytest.raises(SceneError, match="no window of the comparison was measured.*0, 0.02"):
        windows_of(measurement, scene, {"discrete": results.discrete.snapshots})


def test_errors_against_a_measurement_hold_all_known_uncertainties():
    def one(width):
        row = {"key": "band_width_10_90_d", "quantity": "width", "unit": "mean diameters",
               "measured": (10.0, 8.04, 11.96), "discrete": (width, math.nan, math.nan), "continuum": 3 * (math.nan,)}
        return {"windows": [{"from": 0, "to": 0.01}], "summary": [row]}

    parts = {"quantity": "window 0-0.01 band width_10_90_d", "parts": {"grains_step": 0.5}, "u_input": 9.0}
    grains, continuum = rows_of([one(11), one(12), one(13)], [parts], {"margin_thickness": 0.5}, False)
    # S = 12 with a deviation of 1: u_S = 1 / sqrt(3); u_D = 1.96 / 1.96; t(0.975, 2) = 4.3027
    assert (grains["S"], grains["D"], grains["E"].value, grains["u_num"]) == (12, 10, 2, 0.5)
    assert grains["u_val"] == pytest.approx(math.sqrt(1 / 3 + 1 + 0.25))
    assert grains["E"].high - 2 == pytest.approx(math.sqrt(4.30265**2 / 3 + 1.95996**2 * 1.25), rel=1e-5)
    assert (grains["margin"], grains["verdict"]) == (5, "equivalent (margin 5)")
    assert continuum["n"] == 0 and continuum["verdict"] == "not in both panels"


def contents(run):
    """Of the files of a comparison with a measurement; HDF5 itself stores the time of writing."""
    with h5py.File(run / "levelled.h5") as file:
        arrays = {name: values[()].tobytes() for name, values in file["window_0"].items()}
    return arrays, *((run / name).read_bytes() for name in ("levelled.json", "comparison.json", "summary.csv"))


def test_the_command_adds_a_third_pane_and_repeats_to_the_same_bits(folder, measured_folder, tmp_path):
    run = tmp_path / "run"
    shutil.copytree(folder, run)
    text = program("compare", run, "--measured", measured_folder)
    assert "inclination of the levelled band (0 to 0.01)" in text
    once = contents(run)
    program("compare", run, "--measured", measured_folder, "--quiet")
    assert once == contents(run)
    summary = diptych.load(run).summary()
    assert summary.loc["nominal peak t/s beside the measurement", "measured"] == pytest.approx(0.3)
    assert json.loads((run / "comparison.json").read_text())["measured"][0]["key"] == "peak_nominal_stress_ratio"
    program("report", run, "--quiet")
    page = (run / "report.html").read_text()
    assert page.count('data-panel="measured"') == 1 and "Grains, levelled" in page
    with h5py.File(run / "discrete.h5", "r+") as file:  # other snapshots than those that were levelled
        file.attrs["changed"] = 1
    with pytest.raises(AssertionError, match="discrete.h5"):
        program("compare", run, "--measured", measured_folder)


def test_grains_alone_beside_a_measurement_have_a_page(folder, measured_folder, tmp_path):
    run = tmp_path / "grains"
    program("discrete", os.path.join(folder, "scene.prm"), "--output", run, "--quiet")
    program("compare", run, "--measured", measured_folder, "--quiet")
    program("report", run, "--quiet")
    page = (run / "report.html").read_text()
    assert "Grains − measurement" in page and "Continuum" not in page.split("<main>")[1].split("Source")[0]


def test_imported_grains_without_rotations_beside_a_measurement(tmp_path):
    grains, field = tmp_path / "grains", tmp_path / "field"
    program("import", "lammps", *sorted(FOREIGN.glob("lammps/*.dump")), FOREIGN / "lammps" / "walls.txt",
            "--output", grains, "--quiet")
    field.mkdir()
    snapshots = diptych.load(grains).discrete.snapshots
    write_measurement(field, measurement_of(snapshots), pd.DataFrame({"axial_strain": [0.0]}))
    text = program("compare", grains, "--measured", field)
    record = json.loads((grains / "levelled.json").read_text())
    strains = {pane: one["shear_strain"]["value"] for pane, one in record["windows"][0]["levelled"].items()}
    assert strains["discrete"] == pytest.approx(strains["measured"], rel=0.05) and "continuum" not in strains
    assert "volumetric strain of the levelled fields" in text and (grains / "report.html").exists()


def test_an_ensemble_beside_a_measurement_judges_both_panels(measured_folder, tmp_path):
    program("run", QUICK, *options(SMALL), "--seeds", "1-2", "--output", tmp_path / "all", "--quiet")
    text = program("compare", tmp_path / "all", "--measured", measured_folder)
    rows = json.loads((tmp_path / "all" / "ensemble.json").read_text())["measured"]["rows"]
    volumes = [row for row in rows if row["quantity"].startswith("volumetric strain")]
    assert [(row["panel"], row["n"]) for row in volumes] == [("discrete", 2), ("continuum", 2)]
    grains = volumes[0]
    assert grains["E"]["value"] == pytest.approx(grains["S"] - grains["D"])
    assert grains["u_D"] > 0 and "against the measurement" in text
    assert rows[0]["u_D"] is None and rows[0]["verdict"].endswith(", u_D is not known)")  # the peak of a curve
    table = pd.read_csv(tmp_path / "all" / "summary.csv", index_col="quantity")
    assert table.loc[grains["quantity"], "measured"].iloc[0] == pytest.approx(grains["D"])
    again = program("compare", tmp_path / "all")  # keeps the measurement
    assert "against the measurement" in again
