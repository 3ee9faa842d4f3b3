# diptych: grains homogenised without a continuum
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Samples with known bands and stresses, from tables and from files of other codes."""

import json
import os
import subprocess

import meshio
import numpy as np
import pandas as pd
import pytest

import diptych
from conftest import PROGRAM, explained, program
from foreign_sets import FOREIGN, copy  # noqa: F401  copy is a fixture

COLUMNS, ROWS, ANGLE, WIDTH = 16, 44, 45.0, 3.3  # hexagonal lattice of discs of diameter 1


def write_band(folder):
    """Tables of two frames: between them a tanh profile across a line through the middle, of the given angle and 10-90
    % width. Equal forces 1 along all contacts of a lattice of discs of diameter 1 give the isotropic stress sqrt(3)."""
    row, column = (part.ravel() for part in np.mgrid[:ROWS, :COLUMNS])
    start = np.column_stack([column + 0.5 * (row % 2), row * np.sqrt(0.75)])
    first, second = np.nonzero(np.triu(np.abs(np.linalg.norm(start[:, None] - start, axis=2) - 1) < 1e-9))
    force = start[first] - start[second]
    along = np.array([np.cos(np.radians(ANGLE)), np.sin(np.radians(ANGLE))])
    across = (start - start.mean(0)) @ [-along[1], along[0]]
    end = start - 0.4 * along * np.tanh(across / (WIDTH / 2.1972))[:, None]
    for k, x in enumerate((start, end)):
        pd.DataFrame({"id": range(len(x)), "x": x[:, 0], "y": x[:, 1], "r": 0.5}).to_csv(folder / f"particles_{k}.csv",
                                                                                         index=False)
        pd.DataFrame({"i": first, "j": second, "fx": force[:, 0], "fy": force[:, 1]}).to_csv(folder
                                                                                             / f"contacts_{k}.csv",
                                                                                             index=False)
    return sorted(folder.glob("*_[01].csv"))


def explained_with_ends():
    """Names that `diptych explain` has for the tables and fields, with the ends of intervals."""
    names = explained("homogenised.csv", "fields_0000.vtu ..., fields.pvd")
    return {name + end for name in names for end in ("", "_low", "_high")}


def test_a_band_of_known_angle_and_width_comes_out(tmp_path):
    out = tmp_path / "out"
    said = program("homogenise", "csv", *write_band(tmp_path), "--walls-touch", "--grid", "2", "--output", out)
    assert "averaging width" in said
    with open(out / "homogenised.json") as file:
        record = json.load(file)
    [increment] = record["increments"]
    [band] = increment["bands"]
    assert band["angle_deg"]["value"] == pytest.approx(ANGLE, abs=0.5)
    assert band["width_10_90_d"]["value"] == pytest.approx(WIDTH, rel=0.03)
    row = pd.read_csv(out / "homogenised.csv").iloc[1]
    assert row.band_angle_deg == pytest.approx(band["angle_deg"]["value"])
    # Simple shear along the line: no change of volume, and shear strains only near it.
    assert abs(row.strain_xx + row.strain_yy) < 1e-3 and row.strain_yy > 0.005
    fields = meshio.vtu.read(out / "fields_0001.vtu")
    shear, quads = fields.cell_data["shear_strain_increment"][0], fields.points[fields.cells_dict["quad"], :2].mean(1)
    distance = np.abs((quads - quads.mean(0)) @ [-np.sqrt(0.5), np.sqrt(0.5)])
    assert shear[distance < 1].min() > 10 * np.nanmax(shear[distance > 8])
    assert set(fields.cell_data) | set(pd.read_csv(out / "homogenised.csv").columns) <= explained_with_ends()
    assert (out / "fields.pvd").read_text().count("<DataSet") == 2 and "45" in (out / "report.html").read_text()


def test_a_lattice_under_equal_forces_has_its_stress_at_every_width(tmp_path):
    program("import", "csv", *write_band(tmp_path), "--walls-touch", "--output", tmp_path / "in", "--quiet")
    program("homogenise", tmp_path / "in", "--quiet")
    assert len(pd.read_csv(tmp_path / "in_homogenised" / "homogenised.csv")) == 2
    done = subprocess.run([PROGRAM, "homogenise", tmp_path / "in", "--thickness", "2", "--overwrite"],
                          capture_output=True, text=True, check=False)
    assert done.returncode == 2 and "--thickness has no effect on a folder" in done.stderr
    found = diptych.homogenise(diptych.load(tmp_path / "in").discrete.snapshots[:1], grid=4)
    for row in found.resolution_study["kernel"][2:5]:  # w = 1 to 2 d: wider kernels reach the edges
        middle = row["points"][0]
        assert middle["s"] == pytest.approx(np.sqrt(3), rel=5e-3) and middle["t_over_s"] < 0.01
    assert found.increments == [] and "band_verdict" not in found.table()
    assert [entry["quantity"] for entry in found.missing] == ["strain and bands"]


@pytest.mark.parametrize("name", ["lammps", "plain_csv"])
def test_the_stress_of_another_code_is_that_of_its_files(name, copy, tmp_path):  # noqa: F811
    kind, files, _ = copy(name)
    program("homogenise", kind, *files, "--output", tmp_path / "out", "--quiet")
    rows = pd.read_csv(tmp_path / "out" / "homogenised.csv")
    with open(FOREIGN / name / "truth.json") as file:
        truths = list(json.load(file)["frames"].values())
    assert len(rows) == len(truths)
    for (_, row), truth in zip(rows.iterrows(), truths):
        stress = -np.array(truth["mean_stress_from_contacts"])
        found = [row.sxx, row.sxy, row.syy]
        np.testing.assert_allclose(found, [stress[0][0], 0.5 * (stress[0][1] + stress[1][0]), stress[1][1]],
                                   atol=1e-4 * np.abs(stress).max())
        maps = meshio.vtu.read(tmp_path / "out" / f"fields_{row.frame:04.0f}.vtu").cell_data
        mean = np.average(maps["stress"][0], axis=0, weights=maps["area"][0])  # the map keeps the sum
        np.testing.assert_allclose(mean[[0, 4]], [row.sxx, row.syy], rtol=1e-6)


def test_maps_of_a_cell_keep_its_stress_and_follow_its_strain(tmp_path):
    """Simple shear to 2 exy = 1.2 in six stages: the cell takes other lattice vectors on the way. Over a stage the mean
    gradient of exp of the symmetric strain has the shear sinh(0.1)."""
    (tmp_path / "cell.prm").write_text("# all in the words\n")
    words = {"sample/grains": 150, "discrete/lateral": "cell", "discrete/friction": 0.4, "loading/mode": "path",
             "loading/path": "simple_shear", "loading/axial_strain": 1.2, "loading/stage_strain": 0.2,
             "loading/inertial_number": 0.03, "discrete/tolerance": 1e-3}
    program("discrete", tmp_path / "cell.prm", "--output", tmp_path / "cell", "--quiet",
            *(word for key, value in words.items() for word in ("--set", f"{key}={value}")))
    snapshots = diptych.load(tmp_path / "cell").discrete.snapshots
    last = snapshots[-1]
    assert abs(last.cell_a1_x - snapshots[0].cell_a1_x) < 0.5 * abs(snapshots[0].cell_a1_x), "other vectors"
    pairs = last.window
    branch = last.position[pairs.j] + np.column_stack([pairs.shift, pairs.shift_y]) - last.position[pairs.i]
    total = -np.einsum("ca,cb->ab", pairs.force, branch)
    for method in ("segments", "centroid", "laguerre", "kernel", "projection"):
        found = diptych.map_stress(last, method=method)
        assert found.area.sum() == pytest.approx(last.area, rel=1e-12) and found.outside_share == 0
        np.testing.assert_allclose((found.area[:, None, None] * found.stress).sum(0), total,
                                   atol=1e-12 * np.abs(total).max())
        assert found.solid_fraction @ found.area == pytest.approx(np.pi * np.sum(last.radius**2), rel=1e-12)
    found = diptych.homogenise(snapshots)
    for increment, fields in zip(found.increments, found.maps[1:]):
        assert increment["strain_xy"] == pytest.approx(np.sinh(0.1), rel=0.03)  # volume changes turn it a little
        assert np.average(fields["strain_increment"][:, 0, 1], weights=fields["area"]) == pytest.approx(0.1, rel=0.15)
    scatter = [row["scatter_s"] for row in found.resolution_study["kernel"]]
    assert scatter == sorted(scatter, reverse=True)


def test_one_frame_has_all_but_strain_and_bands(copy, tmp_path):  # noqa: F811
    kind, files, _ = copy("plain_csv")
    said = program("homogenise", kind, *files, "--frames", "2", "--output", tmp_path / "out")
    assert "missing: strain and bands: there is only one frame" in said
    page = (tmp_path / "out" / "report.html").read_text()
    assert "Missing: strain and bands" in page and "Shear strain from" not in page and "Stress ratio t/s." in page


def test_frames_without_contacts_say_that_their_stress_is_missing(copy, tmp_path):  # noqa: F811
    kind, files, _ = copy("plain_csv", {"contacts_0.csv": None})
    said = program("homogenise", kind, *files, "--output", tmp_path / "out", "--quiet")
    assert ("missing: stress, fabric and contacts at 0: no contact of this frame carries force, or the files hold none"
            in said)
    rows = pd.read_csv(tmp_path / "out" / "homogenised.csv")
    assert np.isnan(rows.t_over_s[0]) and rows.t_over_s[1] > 0.4 and rows.solid_fraction[0] > 0.8


def test_positions_alone_give_strain_and_bands_but_no_stress(tmp_path):
    """As measured on photographs: neither contacts nor radii."""
    files = [file for file in write_band(tmp_path) if file.name.startswith("particles")]
    for file in files:
        pd.read_csv(file).drop(columns="r").to_csv(file, index=False)
    words = [PROGRAM, "homogenise", "csv", *files, "--walls-touch", "--grid", "2", "--output", tmp_path / "out"]
    refused = subprocess.run(words, capture_output=True, text=True, check=False)
    assert refused.returncode == 2 and "need --mean-diameter D, their distance" in refused.stderr
    said = program(*words[1:], "--mean-diameter", "1")
    for text in ("no radii are in the files", "positions alone give strain and bands, but no stress", "missing: stress",
                 "no stress and no scene", "missing: radii: solid fractions are those of discs"):
        assert text in said
    with open(tmp_path / "out" / "homogenised.json") as file:
        record = json.load(file)
    [band] = record["increments"][0]["bands"]
    assert band["angle_deg"]["value"] == pytest.approx(ANGLE, abs=0.5)
    assert band["width_10_90_d"]["value"] == pytest.approx(WIDTH, rel=0.03)
    across = [y for y in band["profile"]["displacement"] if y is not None]
    assert abs(across[-1] - across[0]) == pytest.approx(abs(band["jump"]["value"]), rel=0.02)
    assert "10–90 % width" in (tmp_path / "out" / "report.html").read_text()
    assert "sxx" not in record["frames"][1] and "rattlers" not in record["frames"][1]
    assert "stress" not in meshio.vtu.read(tmp_path / "out" / "fields_0001.vtu").cell_data


def test_a_folder_without_grains_is_refused(tmp_path):
    (tmp_path / "empty").mkdir()
    for words, message in (([tmp_path / "empty"], "holds no discrete.h5"), (["csv", "nowhere.csv"], "add --output DIR"),
                           (["csv", "nowhere.csv", "--output", tmp_path / "out"],
                            "nowhere.csv: there is no such file")):
        done = subprocess.run([PROGRAM, "homogenise", *map(str, words)], capture_output=True, text=True, check=False)
        assert done.returncode == 2 and message in done.stderr
    assert os.listdir(tmp_path) == ["empty"]
