# diptych: tests of result folders and comparisons as arrays
# SPDX-License-Identifier: LGPL-2.1-or-later
import json
import shutil

import numpy as np
import pandas
import pytest

import diptych
from diptych import importers


@pytest.fixture(scope="module")
def written(folder):
    return json.loads((folder / "comparison.json").read_text())


def test_comparing_a_folder_again_gives_the_numbers_of_its_json(folder, written):
    numbers = diptych.compare(folder).numbers
    for part in set(written) - {"numbers", "cost"}:
        assert numbers[part] == written[part], part


def test_panels_of_this_process_give_the_same_comparison(panels, small, written):
    grains, nodes, coarse = panels
    comparison = diptych.compare(scene=small, discrete=grains, continuum=nodes, coarse=coarse)
    for part in ("stages", "windows", "continuum_coarse", "resolution_study", "theory", "walk"):
        assert comparison.numbers[part] == written[part], part


def test_fields_are_those_of_the_h5_file(folder):
    import h5py

    comparison = diptych.compare(folder)
    with h5py.File(folder / "comparison.h5") as file:
        found = {}
        file.visititems(lambda name, what: found.setdefault(name.rsplit("/", 1)[-1], []).append(what))
        last = comparison.fields[-1]
        shapes = {what.shape for what in found["discrete_mean_stress"]}
        assert last["discrete_mean_stress"].shape in shapes
        same = [np.array_equal(what[()], last["discrete_mean_stress"], equal_nan=True)
                for what in found["discrete_mean_stress"]
                if what.shape == last["discrete_mean_stress"].shape]
        assert any(same)
    assert comparison.mesh().polygons.shape == (len(last["cells"]), 4, 2)
    assert last["stress_difference"].shape == (len(last["cells"]), 2, 2)


def test_a_history_is_a_frame_with_units(folder):
    history = diptych.load(folder).discrete.history
    frame = history.frame()
    assert isinstance(frame, pandas.DataFrame) and list(frame.columns) == list(history)
    assert frame.attrs["unit"]["sxx"] == "pressure" and "t/s" in history.meaning["stress_ratio"]
    np.testing.assert_array_equal(frame["stress_ratio"], pandas.read_csv(folder / "discrete.csv",
                                                                         float_precision="round_trip")["stress_ratio"])


def test_what_a_user_prints_is_one_short_line(folder, tmp_path):
    results = diptych.load(folder)
    start, end = results.discrete.snapshots[0], results.discrete.snapshots[-1]
    stress, moved = diptych.map_stress(end), diptych.increment(start, end)
    bands = diptych.find_bands(**moved)
    (tmp_path / "plan.json").write_text("{}")
    frame = importers.Frame("1", {"id": np.arange(5)})
    shown = [results, results.discrete, results.continuum, results.discrete.history, start,
             results.continuum.snapshots[-1],
             end.contacts, stress, stress.mesh, moved, bands, *bands.bands, diptych.compare(results),
             diptych.biaxial({}),
             frame, diptych.probe(end, [(5, 5), (15, 5), (15, 15), (5, 15)]), diptych.PlanResult.load(tmp_path)]
    for one in shown:
        assert len(str(one)) <= 200 and "\n" not in str(one) and " object at " not in str(one), str(one)


def test_plots_draw_the_values_into_the_given_axes(folder):
    import matplotlib

    matplotlib.use("agg")
    results = diptych.load(folder)
    axes = results.plot("volumetric_strain")
    assert axes.get_ylabel() == "volumetric strain [%]" and axes.get_xlabel() == "axial strain [%]"
    for line, panel in zip(axes.lines, (results.discrete, results.continuum), strict=True):
        np.testing.assert_allclose(line.get_ydata(), 100 * panel.history["volumetric_strain"])
    stress = diptych.map_stress(results.discrete.snapshots[-1])
    axes = stress.plot("syy")
    cells = axes.collections[0]
    np.testing.assert_array_equal(cells.get_array()[stress.covered], stress.stress[stress.covered, 1, 1])
    assert cells.colorbar.ax.get_ylabel() == "syy [pressure]"
    band = diptych.Band(angle_deg=-40, width_10_90=10, half_width=4.55, offset=1, jump=1, dilation_deg=0, r_squared=1,
                        r_squared_strips=1, no_packs_because="", interval={}, centre=np.zeros(2))
    assert band.plot(axes) is axes and len(axes.lines) == 3  # its middle and both edges
    for wrong in (stress, results):
        with pytest.raises(ValueError, match="colour"):
            wrong.plot("colour", axes)


def test_a_table_is_searched_by_the_stages_of_the_scene(folder):
    assert set(pandas.read_csv(folder / "comparison.csv").progress_to.dropna()) == {0.005, 0.01}


def test_the_message_names_a_folder_without_results(tmp_path, folder):
    with pytest.raises(FileNotFoundError, match=str(tmp_path)):
        diptych.load(tmp_path)
    with pytest.raises(ValueError, match="scene, discrete and continuum"):
        diptych.compare(scene={})
    damaged = tmp_path / "damaged"
    damaged.mkdir()
    (damaged / "discrete.h5").write_bytes((folder / "discrete.h5").read_bytes()[:1000])
    (damaged / "discrete.csv").write_bytes((folder / "discrete.csv").read_bytes())
    with pytest.raises(ValueError, match="discrete.h5"):
        diptych.load(damaged)


def test_the_message_names_a_changed_file(tmp_path, folder):
    mine = tmp_path / "mine"
    shutil.copytree(folder, mine)
    table = mine / "discrete.csv"
    table.write_text(table.read_text().replace("0.", "1.", 1))
    with pytest.raises(ValueError, match="discrete.csv was changed"):
        diptych.load(mine)


def test_results_of_the_program_are_not_overwritten(small, folder):
    before = (folder / "discrete.h5").read_bytes()
    with pytest.raises(FileExistsError, match="scene.prm"):
        diptych.DiscretePanel(small).write(folder)
    assert (folder / "discrete.h5").read_bytes() == before
