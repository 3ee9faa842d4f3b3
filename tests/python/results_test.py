# diptych: tests of result folders and comparisons as arrays
# SPDX-License-Identifier: LGPL-2.1-or-later
import json
import shutil

import numpy as np
import pandas
import pytest

import diptych


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
        same = [np.array_equal(what[()], last["discrete_mean_stress"], equal_nan=True) for what in found["discrete_mean_stress"]
                if what.shape == last["discrete_mean_stress"].shape]
        assert any(same)
    assert comparison.mesh().polygons.shape == (len(last["cells"]), 4, 2)
    assert last["stress_difference"].shape == (len(last["cells"]), 2, 2)


def test_a_history_is_a_frame_with_units(folder):
    history = diptych.load(folder).discrete.history
    frame = history.frame()
    assert isinstance(frame, pandas.DataFrame) and list(frame.columns) == list(history)
    assert frame.attrs["unit"]["sxx"] == "pressure" and "t/s" in history.meaning["stress_ratio"]
    np.testing.assert_array_equal(frame["stress_ratio"], pandas.read_csv(folder / "discrete.csv", float_precision="round_trip")["stress_ratio"])


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
