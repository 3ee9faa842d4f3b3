# diptych: samples of other codes in tests/foreign, and changed copies of them
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sets of files, the numbers of their checks, and the fixture `copy`."""

import shutil
from pathlib import Path

import numpy as np
import pytest

import diptych
from diptych import importers
from conftest import SOURCE

FOREIGN = Path(SOURCE) / "tests" / "foreign"
PUBLIC = FOREIGN / "public_cases"
FORMATS = {  # format, files below tests/foreign, options, tolerance of stresses relative to the largest component
    "lammps": ("lammps", ["lammps/*.dump", "lammps/walls.txt"], {}, 1e-6),
    "liggghts": ("liggghts", ["liggghts/*.dump", "liggghts/*.stl"], {"thickness": 1.0}, 1e-5),
    "yade": ("yade", ["yade/spheres_*.txt", "yade/contacts_*.txt", "yade/walls_*.txt"], {"thickness": 1.0}, 1e-6),
    "lmgc90": ("lmgc90", ["lmgc90/DATBOX/B*.DAT", "lmgc90/OUTBOX/*"], {}, 1e-6),
    "lmgc90_hdf5": ("lmgc90", ["lmgc90/DATBOX/B*.DAT", "lmgc90_hdf5/*.h5"], {}, 1e-6),
    "mercurydpm": ("mercurydpm", ["mercurydpm/*.data", "mercurydpm/*.fstat", "mercurydpm/*.ene",
                                  "mercurydpm/*.restart.4"], {},
                   1e-6),
    "plain_csv": ("csv", ["plain_csv/*.csv"], {}, 1e-4)}


@pytest.fixture
def copy(tmp_path):
    """A function that copies the files of a set with changes {file name: function of its text, or None to leave it
    out}."""
    def make(name, changes=()):
        kind, patterns, options, _ = FORMATS[name]
        files = []
        for path in sorted(path for pattern in patterns for path in FOREIGN.glob(pattern)):
            change = dict(changes).get(path.name, lambda text: text)
            if change is not None:
                files.append(tmp_path / path.name)
                shutil.copy(path, files[-1])
            if path.name in dict(changes) and change is not None:
                files[-1].write_text(change(path.read_text()))
        return kind, files, dict(options)
    return make


def checked(sample, **more):
    kind, files, options = sample
    return importers.check(kind, files, **{**options, **more})


def refusal(sample, **more):
    with pytest.raises(diptych.SceneError) as caught:
        checked(sample, **more)
    return caught.value


def stresses(record):
    return np.array([frame["contact_stress"] for frame in record["frames"]], dtype=float)


def once(old, new):
    def change(text):
        assert old in text
        return text.replace(old, new, 1)
    return change
