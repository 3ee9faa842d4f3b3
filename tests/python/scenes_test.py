# diptych: tests that scenes given as dicts are checked like files
# SPDX-License-Identifier: LGPL-2.1-or-later
import os
import re
import warnings

import numpy as np
import pytest

import diptych
from conftest import QUICK


def test_a_scene_has_every_key_that_explain_knows():
    scene = diptych.scene({})
    assert {f"{section}/{key}" for section, keys in scene.items() for key in keys} == set(diptych.keys())
    unit, allowed, meaning = diptych.keys("sample")["sample/radius_min"]
    assert allowed.startswith("a number") and unit and meaning


def test_a_file_and_its_dict_are_the_same_scene():
    scene = diptych.scene(QUICK)
    assert scene["sample"]["grains"] == 2000 and scene["continuum"]["law"] == "cosserat_mohr_coulomb"
    assert scene["comparison"]["window_edges"] == [0, 0.01, 0.02, 0.03]
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # a scene with every key gives no warning
        assert diptych.scene(scene) == scene


def test_values_may_be_numbers_of_numpy_lists_paths_and_none(tmp_path):
    path = tmp_path / "grains.csv"
    path.write_text("x,y,r\n" + "".join(f"{k % 5},{k // 5 + 0.5},0.5\n" for k in range(25)))
    scene = diptych.scene({"sample": {"file": path}, "discrete": {"step": None, "friction": np.float64(0.25)},
                           "comparison": {"window_edges": np.array([0, 0.02])}})
    assert scene["sample"]["file"] == str(path) and scene["discrete"]["step"] == "auto"
    assert scene["discrete"]["friction"] == 0.25 and scene["comparison"]["window_edges"] == [0, 0.02]


def test_overrides_win_over_the_scene():
    assert diptych.scene(QUICK, sample={"seed": 7})["sample"]["seed"] == 7
    assert diptych.scene({"sample": {"seed": 2}}, **{"sample/seed": 3})["sample"]["seed"] == 3


@pytest.mark.parametrize("scene, key, message", [
    ({"sample": {"grians": 3}}, "sample/grians", "nearest is 'sample/grains'"),
    ({"sample": {"grains": -3}}, "sample/grains", "a whole number from 10"),
    ({"sample": {"grains": 20.5}}, "sample/grains", "20.5"),
    ({"discrete": {"lateral": "tape"}}, "discrete/lateral", "one of end_grains, rigid_walls, periodic, cell, none"),
    ({"loading": {"affine_start": "yes"}}, "loading/affine_start", "true or false"),
    ({"comparison": {"probe_rectangles": [1, 2]}}, "comparison/probe_rectangles", "five"),
    ({"continuum": {"poisson_ratio": float("nan")}}, "continuum/poisson_ratio", "nan"),
    ({"smaple": {}}, "smaple", "there are sample, loading"),
    ({"smaple": {"grains": 3}}, "smaple", "sample"),
    ({"sample": 3}, None, "must be a section"),
])
def test_the_error_of_a_wrong_scene_has_its_key(scene, key, message):
    with pytest.raises(diptych.SceneError) as thrown:
        diptych.scene(scene)
    assert isinstance(thrown.value, ValueError)
    assert thrown.value.key == key and message in str(thrown.value)


def wrong_values(allowed):
    """Values that a key must refuse, from the text that says what it allows."""
    bounds = re.search(r"numbers? from (\S+) to ([-+.\de]+)", allowed)
    if not bounds:
        return ["perhaps"]
    low, high = map(float, bounds.groups())
    if "whole" in allowed:
        return ["perhaps", int(low) - 1, int(high) + 1]
    return ["perhaps", low - (0.01 * abs(low) or 0.1), high + (0.01 * abs(high) or 0.1)]


def test_every_key_refuses_what_it_does_not_allow():
    free = []  # checked in use
    for key, (_, allowed, _) in diptych.keys().items():
        if allowed in ("any text", "auto or any text") or key == "loading/path" or (allowed.endswith("file") and "auto"
                                                                                    not in allowed):
            free.append(key)
            continue
        section, name = key.split("/")
        for value in wrong_values(allowed):
            with pytest.raises(diptych.SceneError) as thrown:
                diptych.scene({section: {name: value}})
            assert thrown.value.key == key and allowed in str(thrown.value), value
    assert len(free) == 8


def test_the_error_of_a_wrong_file_has_file_line_and_key(tmp_path):
    path = tmp_path / "sample" / "scene.prm"  # the folder "sample" in the path is not a key
    path.parent.mkdir()
    path.write_text("subsection sample\n  set grains = many\nend\n")
    with pytest.raises(diptych.SceneError, match="line 2") as thrown:
        diptych.scene(path)
    assert thrown.value.key == "sample/grains"
    with pytest.raises(diptych.SceneError, match="cannot be read"):
        diptych.scene(os.path.join(tmp_path, "none.prm"))


def test_a_comparison_needs_windows_between_stages():
    short = {"loading": {"axial_strain": 0.01}}
    assert diptych.scene(short, compares=True)["comparison"]["window_edges"] == [0, 0.005, 0.01]
    with pytest.raises(diptych.SceneError) as thrown:
        diptych.scene({**short, "comparison": {"window_edges": [0, 0.02]}}, compares=True)
    assert thrown.value.key == "comparison/window_edges"


def test_a_key_without_effect_gives_a_warning():
    with pytest.warns(diptych.SceneWarning, match="penalty_stiffness"):
        diptych.scene({"discrete": {"penalty_stiffness": 500}})
