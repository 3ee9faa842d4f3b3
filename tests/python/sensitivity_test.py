# diptych: tests of sensitivity studies: Sobol indices of known functions, and a study with ranges
# SPDX-License-Identifier: LGPL-2.1-or-later

import importlib.util
import json
import os
import signal
import sys
import time

import numpy as np
import pytest
from conftest import QUICK
from scipy.stats import qmc
from studies_test import expect_explained

import diptych
from diptych import __main__ as program
from diptych.campaigns.studies.points import points_of
from diptych.campaigns.studies.sensitivity import sobol_indices
from diptych.campaigns.studies.study_file import read_study

pytestmark = pytest.mark.skipif(importlib.util.find_spec("openturns") is None, reason="openturns is missing")


def ishigami(u):
    """sin a + 7 sin^2 b + 0.1 c^4 sin a on (-pi, pi)^3; c acts only together with a."""
    a, b, c = np.pi * (2 * u.T - 1)
    return np.sin(a) + 7 * np.sin(b) ** 2 + 0.1 * c**4 * np.sin(a)


def product(u):
    """A product of exponentials of seven parameters, the last without effect."""
    return np.exp(u @ EXPONENTS)


EXPONENTS = np.array([2, 1.5, 1, 0.5, 0.3, 0.1, 0])


def exact_indices_of_product():
    """A factor exp(b u) has mean (e^b - 1)/b and mean square (e^2b - 1)/2b; v: its variance over its squared mean."""
    b = np.maximum(EXPONENTS, 1e-9)
    v = np.expm1(2 * b) / (2 * b) / (np.expm1(b) / b) ** 2 - 1
    all_of_them = np.prod(1 + v)
    return v / (all_of_them - 1), v * all_of_them / (1 + v) / (all_of_them - 1)


@pytest.mark.parametrize("function, n, exact", [  # Ishigami: Sobol and Levitan, Comput. Phys. Commun. 117 (1999)
    (ishigami, 128, ([0.3139, 0.4424, 0], [0.5576, 0.4424, 0.2437])), (product, 96, exact_indices_of_product())])
def test_intervals_hold_the_exact_indices(function, n, exact):
    """19 of 20 intervals at least."""
    hits = []
    for seed in range(2):
        points = qmc.LatinHypercube(len(exact[0]), seed=seed).random(n)
        found = sobol_indices(points, function(points))
        assert found.q2 > 0.9
        hits += [one.low - 1e-3 <= value <= one.high + 1e-3
                 for name, values in zip(("first", "total"), exact) for one, value in zip(getattr(found, name), values)]
    assert np.mean(hits) >= 0.95


def test_noise_is_not_taken_for_an_effect():
    """Values without any relation to the points: Q2 shows it, and no interval excludes 0."""
    random = np.random.default_rng(1)
    found = sobol_indices(random.random((64, 3)), random.normal(size=64))
    assert found.q2 < 0.2 and all(one.low < 0.05 for one in found.first)


def test_ctrl_c_still_reaches_python_after_a_fit():
    """openturns would abort the process."""
    sobol_indices(np.linspace(0, 1, 20)[:, None], np.linspace(0, 1, 20))
    with pytest.raises(KeyboardInterrupt):
        os.kill(os.getpid(), signal.SIGINT)
        time.sleep(5)


RANGES = [{"key": "continuum/friction_angle_peak", "low": 20, "high": 35},
          {"key": "continuum/dilatancy_angle_peak", "low": 0, "high": 0.9, "of": "continuum/friction_angle_start"},
          {"key": "continuum/friction_angle_start", "low": 0.4, "high": 1, "of": "continuum/friction_angle_peak"}]
STUDY = {"scene": QUICK, "command": "continuum", "samples": 24, "ranges": RANGES,
         "set": {"continuum/mesh": "rectangle", "continuum/rectangle_width": 37, "continuum/rectangle_height": 53,
                 "continuum/element_size": 10, "continuum/max_step": 0.005, "continuum/initial_step": 0.005,
                 "comparison/coarse_element_size": 0}}


def test_a_study_with_ranges_ranks_the_parameters_of_the_continuum(tmp_path):
    found = diptych.study(STUDY, tmp_path / "out", jobs=2)
    table = found.sensitivity.set_index(["quantity", "parameter"])
    assert table.total["peak t/s"].idxmax() == "continuum/friction_angle_peak"
    assert table.total["volumetric strain at the end"].idxmax() == "continuum/dilatancy_angle_peak"
    assert (table.used == 24).all() and "10-90 % width of the band" in table.index
    assert list(found.table["continuum/friction_angle_start"]
                <= found.table["continuum/friction_angle_peak"]) == [True] * 24
    expect_explained(found)


@pytest.mark.parametrize("changes, words", [
    ({"samples": 5}, ["samples = 5", "from 20"]), ({"axes": []}, ["axes", "together with ranges"]),
    ({"ranges": [{**RANGES[0], "low": 40}]}, ["40", "ascend"]),
    ({"ranges": [{**RANGES[0], "low": -1}]}, ["-1", "a number from"]),
    ({"ranges": [{**RANGES[0], "coordinate": "share_of"}]}, ["'of'", "both or neither"]),
    ({"ranges": [{**RANGES[0], "low": 0, "coordinate": "logarithm"}]}, ["0", "above 0"]),
    ({"ranges": [{**RANGES[2], "of": "continuum/none"}]}, ["continuum/none", "has no value"])])
def test_wrong_ranges_are_named_with_their_lines(tmp_path, changes, words):
    (tmp_path / "study.json").write_text(json.dumps({**STUDY, **changes}, indent=1))
    with pytest.raises(diptych.SceneError) as refused:
        points_of(read_study(str(tmp_path / "study.json")))
    for word in [*words, "study.json, line"]:
        assert word in str(refused.value)


def test_a_missing_module_is_named_with_its_package_before_any_run(tmp_path, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "openturns", None)
    (tmp_path / "study.json").write_text(json.dumps(STUDY))
    assert program.main(["study", str(tmp_path / "study.json"), "--output", str(tmp_path / "out")]) == 4
    assert "apt-get install python3-openturns" in capsys.readouterr().err and not os.path.exists(tmp_path / "out")
