# diptych: measured displacement fields in the layouts of their writers
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Each test writes its files. The field is a compression with a band: known at every point."""

import h5py
import meshio
import numpy as np
import pytest

import diptych
from diptych import measurement
from diptych.importers import fields
from diptych.importers.fields import measure, outliers
from diptych.campaigns.commands import result_entries
from diptych.campaigns.measured.folder import write_measurement

X, Y = (grid.ravel() for grid in np.meshgrid(20.0 * np.arange(12), 20.0 * np.arange(15), indexing="ij"))
GRID, FAILED = np.column_stack([X, Y]), 7
HEAD = ("PIVlab, ASCII chart output - 01-Jan-2026\r\nFRAME: 1, filenames: a.png & b.png, "
        "conversion factor xy (px -> m): 0.5, conversion factor uv (px/frame -> m/s): 0.25\r\n")


def moved(points, share=1.0):
    """Displacement: 1 % shorter, 0.5 % wider, and a slip of 1.5 over a band of thickness 30 that falls to the right."""
    slip = 0.75 * np.tanh((points @ (0.6, 0.8) - 180) / 15)
    return share * np.column_stack([0.005 * points[:, 0] + 0.8 * slip, -0.01 * points[:, 1] - 0.6 * slip])


def down(values):
    return values * (1, -1)


def table(path, head, columns, mark="\t", *, top="", end="\n"):
    rows = [mark.join(map(repr, map(float, row))) for row in np.column_stack(columns)]
    path.write_text(top + end.join([mark.join(head) if isinstance(head, list) else head, *rows, ""]))
    return path


def spam(path, u, old=False, grains=True):
    names = ["F24", "F34", "SubPixReturnStat"] if old else ["Ydisp", "Xdisp", "returnStatus"]
    p, u, status = down(GRID), down(u).copy(), np.where(np.arange(len(u)) == FAILED, -7, 2)
    u[FAILED] = np.nan
    columns = [np.arange(1, len(u) + 1), 0 * X + 1, p[:, 1], p[:, 0], u[:, 1], u[:, 0], status]
    if grains:
        columns = [np.append(0, column) for column in columns]
    return table(path, ["Label" if grains else "NodeNumber", "Zpos", "Ypos", "Xpos", *names], columns)


def dice(path, u, mark=","):
    sigma = np.where(np.arange(len(u)) == FAILED, -1, 0.02)
    names = "SUBSET_ID COORDINATE_X COORDINATE_Y DISPLACEMENT_X DISPLACEMENT_Y SIGMA STATUS_FLAG".split()
    top = "***\n*** Digital Image Correlation Engine (DICe), Copyright\n*** Subset size: 27\n*** Step size: x 20\n***\n"
    return table(path, names, [np.arange(len(u)), down(GRID), down(u), sigma, 4 + 0 * X], mark, top=top)


def pivlab(path, u, mark=",", *, top=HEAD, unit=("px", "px/frame"), factor=(1, 1)):
    names = [f"x [{unit[0]}]", f"y [{unit[0]}]", f"u [{unit[1]}]", f"v [{unit[1]}]", "Vector type [-]",
             "shear rate (magnitude of the rate-of-strain tensor) [1/frame]", f"uncertainty [{unit[1]}]"]
    kind = np.where(np.arange(len(u)) == FAILED, 0, 1)
    columns = [factor[0] * down(GRID), factor[1] * np.where(kind[:, None] == 1, down(u), np.nan), kind, 0 * X,
               factor[1] * 0.02 + 0 * X]
    return table(path, mark.join(names), columns, mark, top=top, end="\r\n")


def tecplot(path, u):
    lines = [*HEAD.splitlines(), "x [px] y [px] u [px/frame] v [px/frame] isNaN?"]
    top = "".join(f"# {line}\r\n" for line in lines) + 'TITLE = "PIVlab frame: 1"\r\nVARIABLES = "x", "y", "u", "v"\r\n'
    lost = np.arange(len(u)) == FAILED
    return table(path, 'ZONE I=12, J=15, K=1, F=POINT, T="1"', [down(GRID), np.where(lost[:, None], 0, down(u)), lost],
                 " ", top=top, end="\r\n")


def ncorr(path, *all_u, units="pixels", scale=1.0, mask=True):
    """A struct of one element holds its arrays, of more elements references to them. Arrays are transposed."""
    inside = (np.arange(len(GRID)) != FAILED).reshape(12, 15)
    with h5py.File(path, "w", userblock_size=512) as file:
        info, found = file.create_group("data_dic_save/dispinfo"), file.create_group("data_dic_save/displacements")
        for name, value in (("pixtounits", scale), ("spacing", 19), ("radius", 15)):
            info[name] = [[float(value)]]
        info["units"] = np.array([[ord(letter)] for letter in units], np.uint16)
        items = {"plot_u_ref_formatted": [], "plot_v_ref_formatted": [], "roi_ref_formatted": []}
        for k, u in enumerate(all_u):
            u = np.where(inside.reshape(-1, 1), scale * u * (1, -1), 0).reshape(12, 15, 2)
            for name, part in zip(items, (u[..., 0], u[..., 1], inside)):
                place = f"#refs#/{name}{k}" if len(all_u) > 1 else f"data_dic_save/displacements/{name}"
                if name.startswith("roi") and mask:
                    file.create_group(place)["mask"] = part.astype(np.uint8)
                else:
                    file[place] = part if not name.startswith("roi") else np.zeros((1, 6), np.uint32)
                items[name].append(file[place].ref)
        for name, references in items.items() if len(all_u) > 1 else ():
            found.create_dataset(name, data=[[one] for one in references], dtype=h5py.ref_dtype)
    return path


def vtk(path, u, **more):
    u = np.where(np.arange(len(u))[:, None] == FAILED, np.nan, u)
    mesh = meshio.Mesh(np.pad(GRID, ((0, 0), (0, 1))), [("vertex", np.arange(len(u))[:, None])],
                       point_data={"displacement": np.pad(u, ((0, 0), (0, 1))), "match": X, **more})
    (meshio.vtk if path.suffix == ".vtk" else meshio.vtu).write(path, mesh)
    return path


def csv(path, u, mark=","):
    return table(path, ["x", "y", "u", "v", "sigma"], [GRID, np.where(np.arange(len(u))[:, None] == FAILED, np.nan, u),
                                                       0.02 + 0 * X], mark)


def read(kind, *paths, **options):
    return fields.read_fields(kind, fields.FieldOptions([str(path) for path in paths], **options))


def measured(frames, **options):
    given = fields.FieldOptions([], **{"mean_diameter": 10.0, "scale": 1.0, "subset": 31.0, **options})
    return (*measure.measure(frames, given), given.notes)


CASES = {  # format, writer and its options
    "spam grains": ("spam", spam, {}),
    "spam grid, old names": ("spam", spam, {"old": True, "grains": False}),
    "dice": ("dice", dice, {}), "dice blanks": ("dice", dice, {"mark": " "}),
    "pivlab": ("pivlab", pivlab, {}), "pivlab tabs": ("pivlab", pivlab, {"mark": "\t", "top": ""}),
    "pivlab blanks": ("pivlab", pivlab, {"mark": " "}), "tecplot": ("pivlab", tecplot, {}),
    "ncorr": ("ncorr", ncorr, {}), "ncorr, object": ("ncorr", ncorr, {"mask": False}),
    "vtu": ("vtk", vtk, {}), "vtk": ("vtk", vtk, {}), "csv": ("csv", csv, {}),
    "semicolons": ("csv", csv, {"mark": ";"})}


@pytest.mark.parametrize("name", CASES)
def test_the_same_field_is_read_from_every_format(name, tmp_path):
    kind, writer, options = CASES[name]
    [frame] = read(kind, writer(tmp_path / f"field_1.{name if kind == 'vtk' else 'txt'}", moved(GRID), **options))
    at, expected = GRID, moved(GRID)
    expected[FAILED] = np.nan
    if kind == "ncorr":  # row by row, from the top of the image
        at, expected = (values.reshape(12, 15, 2).swapaxes(0, 1).reshape(-1, 2) for values in (down(at), expected))
    np.testing.assert_allclose(frame.points, at, atol=1e-12)
    np.testing.assert_allclose(frame.displacement, expected, rtol=1e-12, atol=1e-12)
    assert frame.unit == ("" if kind in ("vtk", "csv") else "px")
    if kind in ("dice", "csv") or name in ("pivlab", "pivlab tabs"):
        assert np.nanmax(abs(frame.deviation - 0.02)) < 1e-15
    assert frame.subset == {"dice": 27, "ncorr": 30}.get(kind)


def test_velocities_become_displacements(tmp_path):
    """Factors 0.5 m/px and 0.25 m/s: 2 s between the images. They overrule the unit, which the writers confuse."""
    expected = 0.5 * np.delete(moved(GRID), FAILED, axis=0)
    for unit, top, time in (("m/s", HEAD, None), ("m/frame", HEAD, None), ("m/s", "", 2.0)):
        [frame] = read("pivlab", pivlab(tmp_path / "a.txt", moved(GRID), top=top, unit=("m", unit), factor=(0.5, 0.25)),
                       time_between=time)
        np.testing.assert_allclose(np.delete(frame.displacement, FAILED, axis=0), expected, rtol=1e-12)
        assert frame.unit == "m" and np.nanmax(abs(frame.deviation - 0.01)) < 1e-15
    [frame] = read("pivlab", pivlab(tmp_path / "b.txt", down(moved(GRID)), unit=("m", "m/frame"), top=""), y="up")
    np.testing.assert_allclose(np.delete(frame.displacement, FAILED, axis=0), 2 * expected, rtol=1e-12)


def test_files_of_several_frames(tmp_path):
    """Ncorr with 0.1 mm a pixel; a file a frame in the order of its numbers; a file a subset with FRAME."""
    path = ncorr(tmp_path / "a.mat", moved(GRID), moved(GRID, 2), units="mm", scale=0.1)
    for frame, share in zip(read("ncorr", path), (1, 2), strict=True):
        assert frame.unit == "mm" and frame.subset == pytest.approx(3)
        assert np.nanmax(frame.displacement[:, 0]) == pytest.approx(0.1 * moved(GRID, share)[:, 0].max())
    paths = [csv(tmp_path / f"step_{k}.csv", moved(GRID, k)) for k in (2, 10)]
    assert [frame.name for frame in read("csv", *paths[::-1])] == ["step_2.csv", "step_10.csv"]
    paths = []
    for k, (point, u) in enumerate(zip(GRID, moved(GRID))):
        head = ["FRAME", "COORDINATE_X", "COORDINATE_Y", "DISPLACEMENT_X", "DISPLACEMENT_Y", "SIGMA"]
        rows = [(share, *down(point), *down(share * u), 0.01) for share in (1, 2)]
        paths.append(table(tmp_path / f"DICe_solution_{k}.txt", head, [np.array(rows)], ","))
    for frame, share in zip(read("dice", *paths), (1, 2)):
        np.testing.assert_allclose(frame.points, GRID, atol=1e-12)
        np.testing.assert_allclose(frame.displacement, moved(GRID, share), rtol=1e-12)


def frames_of(steps, moves=lambda points: points * 0):
    """Homogeneous steps, each a gradient that acts on the places before it; on a grid in the image before."""
    return [measurement.FieldFrame(str(k), GRID, GRID @ np.array(step).T + moves(GRID), unit="px")
            for k, step in enumerate(steps, 1)]


def test_both_references_give_the_same_instants():
    steps = [np.diag([0.002, -0.01]), np.array([[0.001, 0.003], [0.001, -0.02]])]
    total = (np.eye(2) + steps[1]) @ (np.eye(2) + steps[0]) - np.eye(2)
    first, curves, _ = measured(frames_of([steps[0], total]), reference="first")
    previous, _, notes = measured(frames_of(steps), reference="previous")
    both = np.isfinite(previous.position).all(axis=(0, 2))
    assert both.sum() > 100
    np.testing.assert_allclose(previous.position[:, both], first.position[:, both], atol=1e-9)
    np.testing.assert_allclose(curves["axial_strain"], [0, 0.01, -total[1, 1]], atol=1e-12)
    np.testing.assert_allclose(curves["volumetric_strain"][2], 1 - np.linalg.det(np.eye(2) + total), atol=1e-12)
    assert first.spacing == 20 and first.centre.tolist() == [110, 140]
    assert any("mean vertical" in text for text in notes)
    with pytest.raises(diptych.SceneError, match="--reference is required for 2 frames"):
        measured(frames_of(steps))


def test_a_hole_is_not_filled():
    """A single lost point is followed between its neighbours; in the middle of 9 lost ones a point is lost."""
    frames = frames_of([np.diag([0.0, -0.01])] * 2)
    hole = (abs(GRID - (100, 100)) < 30).all(axis=1)
    frames[1].displacement[hole | (GRID == (180, 220)).all(axis=1)] = np.nan
    result, _, _ = measured(frames, reference="previous")
    known = np.isfinite(result.position[2]).all(axis=1)
    at = {tuple(place): k for k, place in enumerate(result.position[0].tolist())}
    assert known[at[180, 220]] and not known[at[100, 100]]


def test_mean_strains_are_those_of_the_region_of_points_also_if_points_are_lost_in_a_band():
    """A jump across the middle is a mean strain of jump / height; a fit would give 1.5 times as much."""
    u = np.where(GRID[:, 1:] > 150, [0.0, -1.0], [0.0, 0.0])
    position = np.array([GRID, GRID + u])
    position[1, (abs(GRID[:, 1] - 150) < 40) & (GRID[:, 0] % 60 > 0)] = np.nan  # two thirds of four rows at the jump
    lost = measurement.Measurement(position=position, deviation=np.zeros((2, len(GRID))), progress=np.array([0, 0.01]),
                                   mean_diameter=10.0, subset=0, spacing=20, centre=np.zeros(2))
    np.testing.assert_allclose(lost.mean_gradient(0, 1), [[0, 0], [0, -1 / 280]], atol=1e-12)


def test_an_increment_of_added_frames_has_only_their_own_noise():
    noise = np.full(len(GRID), 0.1)
    frames = [measurement.FieldFrame(str(k), GRID, -0.01 * k * GRID, deviation=noise) for k in (1, 2, 3)]
    previous, _, _ = measured(frames, reference="previous", outliers=0)
    first, _, _ = measured(frames, reference="first", outliers=0)
    np.testing.assert_allclose(previous.increment(1, 2).deviation, 0.1)
    np.testing.assert_allclose(first.increment(1, 2).deviation, 0.1 * np.sqrt(2))


@pytest.mark.parametrize("options", [{"mean_diameter": 100.0}, {"subset": 150.0}])
def test_lengths_in_different_units_are_refused(options):
    frames = [measurement.FieldFrame("1", GRID, moved(GRID), unit="px")]
    with pytest.raises(diptych.SceneError, match="--subset in the unit of the files"):
        measured(frames, **options)


def test_per_cent_are_refused():
    with pytest.raises(diptych.SceneError, match="3 % is 0.03"):
        measured([measurement.FieldFrame("1", GRID, moved(GRID), unit="px")], progress=[0, 1.2])


def test_lengths_are_scaled_and_y_is_turned(tmp_path):
    frames = read("spam", spam(tmp_path / "a.tsv", moved(GRID)))
    result, curves, notes = measured(frames, scale=0.1, centre=(110, -140), progress=[0.02, 0.03], outliers=0,
                                     mean_diameter=1.0)
    assert (result.subset, result.spacing) == pytest.approx((3.1, 2)) and result.centre == pytest.approx([11, 14])
    step = result.increment(0, 1)
    np.testing.assert_allclose(step.displacement, 0.1 * np.delete(moved(GRID), FAILED, axis=0), atol=1e-12)
    assert result.progress.tolist() == [0.02, 0.03] and any(text.endswith("left out: 1 of 180") for text in notes)
    write_measurement(tmp_path, result, curves)
    again = measurement.read_measurement(tmp_path)
    assert np.array_equal(again.position, result.position) and again.facts["frames"] == result.facts["frames"]
    names = [*again.facts, *("frames/" + name for name in again.facts["frames"][0])]
    assert set(names) <= {one["entry"] for one in result_entries() if one["file"] == "measured.json"}


def test_outliers_are_found_and_the_band_is_not():
    """Vectors that are 3 px wrong; the noise of 0.1 px keeps the slip of 1.5 px over 30 px."""
    u, wrong = moved(GRID), [20, 77, 130]
    u[wrong] += [(3, 0), (0, -3), (2, 2)]
    flags = outliers.outliers(GRID, u, spacing=20, threshold=5, noise=0.1)
    assert np.flatnonzero(flags).tolist() == wrong
    assert not outliers.outliers(GRID, 0.01 * GRID, spacing=20, threshold=2, noise=0.1).any()
    result, _, _ = measured([measurement.FieldFrame("1", GRID, u, unit="px")])
    assert result.facts["frames"][0]["outliers"] == 3 and len(result.position[0]) == len(GRID) - 3


@pytest.mark.parametrize("pair, reference", [((0, 1), "first"), ((1, 2), "first"), ((1, 3), "previous")])
def test_a_pair_at_rest_gives_the_standard_deviation(pair, reference):
    """Noise of 0.05 px in every field: that of the difference is 0.05 times the root of the number of fields in it."""
    noise = np.random.default_rng(3)
    frames = frames_of([np.zeros((2, 2))] * 3, lambda points: noise.normal(0, 0.05, points.shape))
    result, _, _ = measured(frames, reference=reference, static=pair, outliers=0, progress=[0, 0, 0, 0])
    times = np.sqrt([0, 1, 2, 3]) if reference == "previous" else [0, 1, 1, 1]
    np.testing.assert_allclose(result.deviation[:, 100], 0.05 * np.array(times), rtol=0.2)


def test_curves_of_the_boundary(tmp_path):
    path = table(tmp_path / "force.csv", ["axial_strain", "sxx", "syy"], [[0, 0.01], [100, 100], [100, 300]], ",")
    result, curves, notes = measured([measurement.FieldFrame("1", GRID, moved(GRID), unit="px")], boundary=str(path))
    assert curves["stress_ratio"].tolist() == [0, 0.5] and result.progress.tolist() == [0, 0.01]
    assert any("row by row" in text for text in notes)


def test_a_reader_of_your_own(tmp_path):
    @fields.register("mine")
    def mine(options):
        rows = [np.loadtxt(path) for path in options.files]
        return [fields.FieldFrame("one", row[:, :2], row[:, 2:], y_down=True) for row in rows]
    np.savetxt(tmp_path / "a.txt", np.column_stack([down(GRID), down(moved(GRID))]))
    np.testing.assert_allclose(read("mine", tmp_path / "a.txt")[0].displacement, moved(GRID))


def word(old, new):
    return lambda text: text.replace(old, new, 1)


@pytest.mark.parametrize("kind, writer, change, says", [
    ("spam", spam, word("Xdisp", "Qdisp"), "a.txt: lacks a column Xdisp or F34; its columns are"),
    ("spam", spam, word("1.0\t1.0\t-0.0", "1.0\t2.0\t-0.0"), "line 4: column Zpos = 1, but 2 before"),
    ("dice", dice, word("-20.0", "far"), "line 8: column COORDINATE_Y = 'far' is not a number"),
    ("dice", dice, word(",0.02,", ","), "line 7: 6 entries; expected 7"),
    ("pivlab", pivlab, lambda text: "\n".join(text.split("\n")[3:]), "--columns 'field=x [px]"),
    ("pivlab", pivlab, word("0.0,-20.0,", "0.0,"), "line 5: 6 entries; expected 7: x, y, u, v, Vector type"),
    ("csv", csv, word("20.0", ""), "line 3: column y is empty"),
    ("csv", csv, lambda text: "\n".join(text.split("\n")[:9]), "7 of 8 points have a displacement; at least 30"),
    ("ncorr", csv, str, "MATLAB's format 7.3"), ("vtk", csv, str, "is no complete VTK file"),
    ("csv", csv, lambda text: "\x80\x04", "a.txt: is a Python pickle, as muDIC writes it"),
    ("csv", csv, lambda text: "x\x9c", "as SUN-DIC writes it"), ("spm", csv, str, "the nearest is 'spam'")])
def test_wrong_files_are_refused_with_their_line(kind, writer, change, says, tmp_path):
    path = writer(tmp_path / "a.txt", moved(GRID))
    path.write_bytes(change(path.read_text()).encode("latin-1"))
    with pytest.raises(diptych.SceneError) as caught:
        read(kind, path)
    assert says in str(caught.value)


@pytest.mark.parametrize("options, says", [
    ({"scale": None}, "lengths are pixels; give --scale"), ({"subset": None}, "--subset is required"),
    ({"progress": [0.0]}, "--progress has 1 values; expected 2"), ({"progress": [0.02, 0.01]}, "at instant 0 to 0.01"),
    ({"static": (0, 2)}, "--static 0,2: give two different whole numbers from 0 (the first image) to 1"),
    ({"static": (1, 1)}, "--static 1,1: give two different"),
    ({"boundary": "absent.csv"}, "absent.csv: there is no such file"),
    ({"boundary": "force.csv"}, "force.csv, line 3: column axial_strain does not ascend")])
def test_wrong_options_are_refused(options, says, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    table(tmp_path / "force.csv", ["axial_strain", "stress_ratio"], [[0.1, 0], [0, 0]], ",")
    with pytest.raises(diptych.SceneError) as caught:
        measured([measurement.FieldFrame("1", GRID, moved(GRID), unit="px", path="a.txt")], **options)
    assert says in str(caught.value)


def test_options_without_effect_and_choices_are_named(tmp_path):
    for kind, writer, options, says in (("spam", spam, {"time_between": 1.0}, "--time-between would have no effect"),
                                        ("csv", csv, {"columns": ["particles=x"]}, "would have no effect")):
        with pytest.raises(diptych.SceneError, match=says):
            read(kind, writer(tmp_path / "a.txt", moved(GRID)), **options)
    path = vtk(tmp_path / "a.vtu", moved(GRID), other=np.pad(2 * moved(GRID), ((0, 0), (0, 1))))
    with pytest.raises(diptych.SceneError, match="2 vectors: displacement, other; choose"):
        read("vtk", path)
    np.testing.assert_allclose(read("vtk", path, columns=["field=other"])[0].displacement, 2 * moved(GRID))
