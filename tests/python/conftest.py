# diptych: fixtures for the tests of the Python package
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The program, and a small scene that both the program and the package run."""

import json
import os
import subprocess

import pytest

import diptych

PROGRAM, SOURCE = os.environ["DIPTYCH_PROGRAM"], os.environ["DIPTYCH_SOURCE"]
QUICK = os.path.join(SOURCE, "benchmarks", "moreau_quick", "scene.prm")

# The scene moreau_quick with 300 grains and two stages.
SMALL = {"sample": {"grains": 300}, "loading": {"axial_strain": 0.01, "inertial_number": 1e-3},
         "comparison": {"window_edges": [0, 0.01]}, "output": {"report": False}}


def options(overrides):
    """Keys as options of the program."""
    for section, keys in overrides.items():
        for key, value in keys.items():
            text = ", ".join(map(str, value)) if isinstance(value, list) else str(value).replace("False", "false")
            yield from ("--set", f"{section}/{key}={text}")


def program(*arguments):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def explained(*files):
    """Entries of result files by `diptych explain --json`."""
    return {one["entry"] for one in json.loads(program("explain", "--json"))["results"] if one["file"] in files}


@pytest.fixture(scope="session")
def small():
    return diptych.scene(QUICK, compares=True, **SMALL)


@pytest.fixture(scope="session")
def folder(tmp_path_factory):
    """The result folder of the small scene."""
    path = tmp_path_factory.mktemp("program") / "out"
    program("run", QUICK, *options(SMALL), "--output", path, "--quiet")
    return path


@pytest.fixture(scope="session")
def panels(small):
    """Both panels of the small scene, run in this process; the continuum on the fine and the coarse mesh."""
    grains = diptych.DiscretePanel(small)
    assert grains.run() == "finished"
    nodes = diptych.ContinuumPanel(small, grains.snapshots[0])
    assert nodes.run() == "finished"
    edge = small["comparison"]["coarse_element_size"]
    coarse = diptych.ContinuumPanel(diptych.scene(small, continuum={"element_size": edge}), grains.snapshots[0])
    assert coarse.run() == "finished"
    return grains, nodes, coarse
