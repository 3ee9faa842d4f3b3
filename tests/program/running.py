# diptych: the program run by tests, and what it leaves
# SPDX-License-Identifier: LGPL-2.1-or-later
"""In this folder: DIPTYCH_PROGRAM=PROGRAM PYTHONPATH=BUILD/python python3 -B -m unittest NAME_test[.CLASS[.TEST]]"""

import ctypes
import json
import os
import re
import subprocess
import tempfile
import time
import unittest

import h5py
import numpy

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PROGRAM = os.path.abspath(os.environ["DIPTYCH_PROGRAM"])
QUICK = os.path.join(SOURCE, "benchmarks", "moreau_quick", "scene.prm")
PROBLEMS = os.path.join(SOURCE, "tests", "discrete", "contact_problems")
ENVIRONMENT = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
LOOSE = 0.845  # solid fraction of a loose sample of 300 grains


def setting(**keys):
    """Words for `--set`: sample_grains=300 is sample/grains=300."""
    words = []
    for name, value in keys.items():
        words += ["--set", name.replace("_", "/", 1) + "=" + str(value)]
    return words


# A sample that takes a second: the physics of the quick scene on 300 grains, loosely solved.
SMALL = setting(sample_grains=300, loading_inertial_number=1e-3, loading_axial_strain=0.01, discrete_step=0.1,
                discrete_tolerance=1e-4, discrete_snapshot_max_sweeps=200, discrete_reference_sweeps=0,
                comparison_window_edges="0,0.01")
# The same long enough to be interrupted, with a snapshot every 20 steps.
LONG = SMALL + setting(sample_grains=200, loading_axial_strain=0.04, loading_stage_strain=0.002,
                       comparison_window_edges="0,0.04")


def diptych(*words, **options):
    return subprocess.run([PROGRAM, *words], env=ENVIRONMENT, capture_output=True, text=True, **options)


def start(*words, **options):
    return subprocess.Popen([PROGRAM, *words], env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                            text=True, **options)


def listing(folder):
    return sorted(os.path.relpath(os.path.join(root, name), folder) for root, _,
                  names in os.walk(folder) for name in names)


def write(path, text):
    with open(path, "w") as file:
        file.write(text)
    return path


def content(*names):
    with open(os.path.join(*names), "rb") as file:
        return file.read()


def contents(folder):
    """The bytes of every file; a pipe would wait for a writer."""
    return {name: content(folder, name) for name in listing(folder) if os.path.isfile(os.path.join(folder, name))}


def half_files(folder):
    return [name for name in listing(folder) if name.endswith(".part")]


def finished(*words):
    """What a run printed that must end with code 0; for setUpClass."""
    result = diptych(*words)
    if result.returncode != 0:
        raise RuntimeError(result.stdout + result.stderr)
    return result


def temporary(owner):
    """A folder as long as a test or a class of tests runs."""
    enter = owner.enterClassContext if isinstance(owner, type) else owner.enterContext
    return enter(tempfile.TemporaryDirectory())


def read_json(*names):
    with open(os.path.join(*names), encoding="utf-8") as file:
        return json.load(file)


def member_of(ensemble, seed):
    """The result folder of a member."""
    record = read_json(ensemble, "ensemble.json")
    return os.path.join(ensemble, record["folders"][record["seeds"].index(seed)])


class Folder(unittest.TestCase):
    """A test with a folder `work` for its files, and a path `folder` in it for results."""

    def setUp(self):
        self.work = temporary(self)
        self.folder = os.path.join(self.work, "out")

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def expect(self, code, words, *texts, **options):
        """Ends with that code and a message with those texts. With code 2 everything stays as it was."""
        before = os.path.exists(self.folder), contents(self.work)
        result = diptych(*words, **{"cwd": self.work, **options})
        self.expect_message(result, code, *texts)
        if code == 2:
            self.assertEqual((os.path.exists(self.folder), contents(self.work)), before)
        return result

    def expect_message(self, result, code, *texts):
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        for text in texts:
            self.assertIn(text, result.stderr)
        self.assertNotIn("Traceback", result.stderr)
        left = [name for name in listing(self.work) if name.endswith((".part", ".lock"))]
        # a killed run is set aside whole
        self.assertEqual([name for name in left if not re.search(r"\.\d/", name)], [])

    def started_until(self, is_reached, *words, **options):
        """A program that still runs when something is reached."""
        process = start(*words, **options)
        while process.poll() is None and not is_reached():
            time.sleep(0.002)
        self.assertIsNone(process.poll(), "it ended before that")
        return process

    def signalled(self, number, is_reached, *words, **options):
        """(exit code, message) of a program that gets a signal when something is reached."""
        process = self.started_until(is_reached, *words, **options)
        process.send_signal(number)
        _, errors = process.communicate()
        return process.returncode, errors

    def expect_stopped(self, number, is_reached, *words):
        """A run that a signal ends tells how it goes on."""
        code, errors = self.signalled(number, is_reached, *words)
        self.assertEqual(code, 3, errors)
        for text in ("stopped on request", "--resume", self.folder):
            self.assertIn(text, errors)
        return errors

    def expect_same_files(self, other, *names):
        for name in names:
            self.assertEqual(content(self.path(name)), content(other, name), name)


def history(folder, name="discrete.csv"):
    """Columns of a table: numbers, or texts."""
    rows = numpy.genfromtxt(os.path.join(folder, name), delimiter=",", names=True, dtype=None, encoding="utf-8")
    return {column: numpy.atleast_1d(rows[column]) for column in rows.dtype.names}


def facts(folder):
    return read_json(folder, "provenance.json")["discrete"]


def bound_by_permissions():
    """For preexec_fn: the system's administrator, too, may not write where nobody may (CAP_DAC_OVERRIDE is given
    up)."""
    drop_of_the_bounding_set, override_of_permissions = 24, 1
    if os.getuid() == 0 and ctypes.CDLL(None, use_errno=True).prctl(drop_of_the_bounding_set, override_of_permissions,
                                                                    0, 0, 0) != 0:
        raise OSError(ctypes.get_errno(), "prctl")


def bits(path):
    """Every dataset and attribute of an HDF5 file as (type, shape, bytes) by name."""
    found = {}

    def add(name, item):
        if isinstance(item, h5py.Dataset):
            found[name] = (str(item.dtype), item.shape, item[()].tobytes())
        for key, value in item.attrs.items():
            found[name + "@" + key] = numpy.asarray(value).tobytes()

    with h5py.File(path, "r") as file:
        file.visititems(add)
    return found
