#!/usr/bin/env python3
# diptych: the grains alone as a user meets them: resume, wrong keys, scenes, step study, stored contact problems
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: discrete_test.py PROGRAM SOURCE_DIR [unittest arguments]."""

import concurrent.futures
import csv
import json
import math
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import h5py
import numpy

PROGRAM, SOURCE = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
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


def start(*words):
    return subprocess.Popen([PROGRAM, *words], env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def listing(folder):
    return sorted(os.path.relpath(os.path.join(root, name), folder) for root, _, names in os.walk(folder) for name in names)


def write(path, text):
    with open(path, "w") as file:
        file.write(text)
    return path


def content(path):
    with open(path, "rb") as file:
        return file.read()


def history(folder):
    """Columns of discrete.csv."""
    with open(os.path.join(folder, "discrete.csv")) as file:
        rows = list(csv.DictReader(file))
    return {name: numpy.array([float(row[name]) for row in rows]) for name in rows[0]}


def facts(folder):
    with open(os.path.join(folder, "provenance.json")) as file:
        return json.load(file)["discrete"]


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


class Resume(unittest.TestCase):
    """What interrupts a run, and how often, cannot be seen in its results: every bit is that of a run left alone."""

    @classmethod
    def setUpClass(cls):
        cls.keep = tempfile.TemporaryDirectory()
        cls.alone = cls.whole_run("alone", LONG)
        with h5py.File(os.path.join(cls.alone, "discrete.h5"), "r") as file:
            assert len(file) == 21, "20 stages after the prepared sample"

    @classmethod
    def tearDownClass(cls):
        cls.keep.cleanup()

    @classmethod
    def whole_run(cls, name, words):
        folder = os.path.join(cls.keep.name, name)
        process = diptych("discrete", QUICK, *words, "--output", folder, "--quiet")
        assert process.returncode == 0, process.stderr
        return folder

    def setUp(self):
        self.folder = os.path.join(self.keep.name, self.id().split(".")[-1])

    def expect_same_results(self, expected, found):
        self.assertEqual(content(os.path.join(expected, "discrete.csv")), content(os.path.join(found, "discrete.csv")))
        a, b = bits(os.path.join(expected, "discrete.h5")), bits(os.path.join(found, "discrete.h5"))
        self.assertEqual(sorted(a), sorted(b))
        self.assertEqual([name for name in a if a[name] != b[name]], [])
        self.assertEqual(content(os.path.join(expected, "discrete.xdmf")), content(os.path.join(found, "discrete.xdmf")))

    def wait_for(self, process, name, newer_than=0):
        """Until a file of the folder has been written. False where the process ended without."""
        path = os.path.join(self.folder, name)
        while process.poll() is None:
            try:
                if os.stat(path).st_mtime_ns > newer_than:
                    return True
            except FileNotFoundError:
                pass
            time.sleep(0.002)
        return False

    def stop_after(self, seconds, signal_number, *words):
        """Starts a run and sends a signal so long after its first result."""
        process = start("discrete", QUICK, *words, "--output", self.folder, "--quiet")
        self.assertTrue(self.wait_for(process, "discrete.h5"), "it ended before the signal")
        time.sleep(seconds)
        process.send_signal(signal_number)
        _, errors = process.communicate()
        return process.returncode, errors

    def resume(self, *words):
        return diptych("discrete", QUICK, *words, "--output", self.folder, "--resume")

    def kill_again_and_again(self, words, n_kills, seed):
        """SIGKILL at random moments after a checkpoint, a resumed run each time. How often it hit a loading under way."""
        dice, hits = random.Random(seed), 0
        checkpoint = os.path.join(self.folder, "checkpoint.h5")
        for _ in range(n_kills):
            before = os.stat(checkpoint).st_mtime_ns if os.path.exists(checkpoint) else 0
            process = start("discrete", QUICK, *words, "--output", self.folder, "--resume", "--quiet")
            self.wait_for(process, "checkpoint.h5", before)
            time.sleep(dice.uniform(0, 0.1))
            process.kill()
            process.communicate()
            hits += process.returncode == -signal.SIGKILL and os.path.exists(checkpoint)
        last = self.resume(*words)
        self.assertEqual(last.returncode, 0, last.stderr)
        return hits

    def test_killed_at_random_moments(self):
        hits = self.kill_again_and_again(LONG + setting(discrete_checkpoint_minutes=0.0005), 4, seed=1)
        self.assertGreaterEqual(hits, 2)
        self.expect_same_results(self.alone, self.folder)
        self.assertNotIn("checkpoint.h5", listing(self.folder))
        self.assertEqual([name for name in listing(self.folder) if name.endswith(".part")], [])

    def test_killed_with_springs(self):
        """Stages of 0.0005, 0.001 - 0.0005, ...: their steps differ by rounding."""
        words = SMALL + setting(sample_grains=100, discrete_method="penalty", loading_inertial_number=5e-3,
                                loading_stage_strain=0.0005, discrete_history_interval=5)
        alone = self.whole_run("springs_alone", words)
        hits = self.kill_again_and_again(words + setting(discrete_checkpoint_minutes=0), 4, seed=2)
        self.assertGreaterEqual(hits, 2)
        self.expect_same_results(alone, self.folder)

    def expect_stopped_and_resumed(self, signal_number):
        code, errors = self.stop_after(0.1, signal_number, *LONG)
        self.assertEqual(code, 3, errors)
        self.assertIn("stopped on request", errors)
        self.assertIn("--resume", errors)
        self.assertIn(self.folder, errors)
        files = listing(self.folder)
        self.assertIn("checkpoint.h5", files)
        self.assertEqual([name for name in files if name.endswith(".part")], [])
        resumed = self.resume(*LONG)
        self.assertEqual(resumed.returncode, 0, resumed.stderr)
        self.assertNotIn("beginning", resumed.stdout)
        self.expect_same_results(self.alone, self.folder)

    def test_ctrl_c(self):
        self.expect_stopped_and_resumed(signal.SIGINT)

    def test_sigterm(self):
        self.expect_stopped_and_resumed(signal.SIGTERM)

    def test_two_threads_give_the_same_bits_also_when_they_take_over(self):
        code, errors = self.stop_after(0.1, signal.SIGINT, *LONG)
        self.assertEqual(code, 3, errors)
        resumed = self.resume(*LONG, "--threads", "2")
        self.assertEqual(resumed.returncode, 0, resumed.stderr)
        self.expect_same_results(self.alone, self.folder)
        self.expect_same_results(self.alone, self.whole_run("two_threads", LONG + ["--threads", "2"]))

    def test_another_scene_is_refused_and_nothing_changes(self):
        code, errors = self.stop_after(0.1, signal.SIGINT, *LONG)
        self.assertEqual(code, 3, errors)
        before = {name: content(os.path.join(self.folder, name)) for name in listing(self.folder)}
        for other in [setting(sample_seed=2), setting(discrete_friction=0.3)]:
            refused = self.resume(*LONG, *other)
            self.assertEqual(refused.returncode, 2, refused.stderr)
            self.assertIn("--resume", refused.stderr)
            self.assertIn(self.folder, refused.stderr)
        self.assertEqual({name: content(os.path.join(self.folder, name)) for name in listing(self.folder)}, before)

    def test_a_truncated_checkpoint_is_named_and_nothing_changes(self):
        code, errors = self.stop_after(0.1, signal.SIGINT, *LONG)
        self.assertEqual(code, 3, errors)
        path = os.path.join(self.folder, "checkpoint.h5")
        for share in [2, 50]:
            with open(path, "r+b") as file:
                file.truncate(os.path.getsize(path) // share)
            before = {name: content(os.path.join(self.folder, name)) for name in listing(self.folder)}
            refused = self.resume(*LONG)
            self.assertEqual(refused.returncode, 2, refused.stderr)
            self.assertIn(path, refused.stderr)
            self.assertEqual({name: content(os.path.join(self.folder, name)) for name in listing(self.folder)}, before)

    def test_without_a_checkpoint_it_starts_from_the_beginning_and_a_finished_run_is_not_run_again(self):
        result = self.resume(*SMALL)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("from the beginning", result.stdout)
        before = os.stat(os.path.join(self.folder, "discrete.h5")).st_mtime_ns
        again = self.resume(*SMALL)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertIn("not run again", again.stdout)
        self.assertEqual(os.stat(os.path.join(self.folder, "discrete.h5")).st_mtime_ns, before)

    def test_a_run_that_did_not_converge_in_its_last_stage_is_not_finished(self):
        """Springs with steps far too long blow up soon. In a loading of one stage the prepared sample and the last accepted
        step are two snapshots, as many as a whole run has."""
        words = SMALL + setting(sample_grains=100, loading_axial_strain=0.005, comparison_window_edges="0,0.005",
                                discrete_method="penalty", discrete_penalty_step_fraction=1.5)
        first = diptych("discrete", QUICK, *words, "--output", self.folder, "--quiet")
        self.assertEqual(first.returncode, 3, first.stderr)
        with h5py.File(os.path.join(self.folder, "discrete.h5"), "r") as file:
            self.assertEqual(len(file), 2, "it did not blow up within the stage")
        again = self.resume(*words)
        self.assertEqual(again.returncode, 3, again.stdout + again.stderr)

    def test_a_preparation_under_a_signal(self):
        words = SMALL + setting(sample_preparation_steps=20000)
        process = start("discrete", QUICK, *words, "--output", self.folder)
        for line in process.stderr:
            if "preparing" in line:
                break
        time.sleep(0.1)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate()
        self.assertEqual(process.returncode, 3, errors)
        self.assertIn("stopped on request", errors)
        self.assertNotIn("--resume", errors)
        self.assertNotIn("checkpoint.h5", listing(self.folder))
        self.assertEqual([name for name in listing(self.folder) if name.endswith(".part")], [])



NUMBER = r"[-+0-9.e]+"


def explained_keys(section):
    """(key, what is allowed) of every key of a section, as `diptych explain` prints them."""
    text = diptych("explain", section).stdout
    return re.findall(r"^  (\w+) = .*?  \[[^\]]*\]  (.+)$", text, re.MULTILINE)


def wrong_value(allowed, above):
    """A value that a key must refuse, from the text that says what it allows; None for keys that take any text."""
    bounds = re.search("number(?:s)? from (" + NUMBER + ") to (" + NUMBER + ")", allowed)
    if bounds:
        low, high = float(bounds.group(1)), float(bounds.group(2))
        if "whole" in allowed:
            return str(int(high) + 1) if above else str(int(low) - 1)
        return repr(2 * high + 1) if above else repr(low - 0.01 * abs(low) - (0.1 if low == 0 else 0))
    return None if allowed == "any text" else "perhaps"


class WrongKeys(unittest.TestCase):
    """Exit code 2, key, value and place in the message, and no output folder."""

    def setUp(self):
        keep = tempfile.TemporaryDirectory()
        self.addCleanup(keep.cleanup)
        self.work, self.out = keep.name, os.path.join(keep.name, "out")

    def path(self, name):
        return os.path.join(self.work, name)

    def expect_wrong(self, words, *texts, command="discrete"):
        result = diptych(command, QUICK, *SMALL, *words, "--output", self.out, "--quiet")
        self.assertEqual(result.returncode, 2, result.stderr)
        for text in texts:
            self.assertIn(text, result.stderr)
        self.assertEqual(os.path.exists(self.out) and listing(self.out), False, result.stderr)

    def expect_refused(self, section):
        keys = explained_keys(section)
        self.assertGreater(len(keys), 10)
        cases = [(key, wrong_value(allowed, k % 2 == 1), allowed) for k, (key, allowed) in enumerate(keys)]
        cases += [(key, "rough", allowed) for key, _, allowed in cases if "number" in allowed][:1]

        def run(case):
            folder = self.path("out_" + case[0] + "_" + case[1])
            return diptych("discrete", QUICK, "--set", section + "/" + case[0] + "=" + case[1], "--output", folder), folder

        cases = [case for case in cases if case[1] is not None]
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            for (key, value, allowed), (result, folder) in zip(cases, pool.map(run, cases)):
                with self.subTest(key=key, value=value):
                    self.assertEqual(result.returncode, 2, result.stderr)
                    for text in ["--set " + section + "/" + key + "=" + value, section + "/" + key + " = '" + value + "'", allowed]:
                        self.assertIn(text, result.stderr)
                    self.assertFalse(os.path.exists(folder))
        return {key for key, allowed in keys if allowed == "any text"}

    def test_every_key_of_sample(self):
        self.assertEqual(self.expect_refused("sample"), {"file", "radius_table"})

    def test_every_key_of_loading(self):
        self.assertEqual(self.expect_refused("loading"), set())

    def test_every_key_of_discrete(self):
        """Those that take any text are drives, which are checked for themselves."""
        self.assertTrue(all(key.startswith("drive_") for key in self.expect_refused("discrete")))

    def test_files_that_are_not_there(self):
        self.expect_wrong(setting(sample_file="no_such.csv"), "no_such.csv", "sample/file")
        self.expect_wrong(setting(sample_radius_distribution="table", sample_radius_table="no_such.csv"), "no_such.csv",
                          "sample/radius_table")
        self.expect_wrong(setting(discrete_drive_lower_x="velocity no_such.csv"), "no_such.csv", "discrete/drive_lower_x")

    def test_texts_of_drives(self):
        for name in ["lower_x", "upper_y", "left_x", "right_y"]:
            self.expect_wrong(["--set", "discrete/drive_" + name + "=sideways 3"], "discrete/drive_" + name, "'sideways 3'",
                              "auto, velocity V or force F")
        for text in ["velocity", "velocity 1 2", ""]:
            self.expect_wrong(["--set", "discrete/drive_upper_x=" + text], text)

    def test_a_drive_with_a_blank_in_the_place_of_its_number(self):
        self.expect_wrong(["--set", "discrete/drive_upper_x=force "], "discrete/drive_upper_x", "'force '")

    def test_a_drive_of_a_wall_that_is_not_there(self):
        self.expect_wrong(["--set", "discrete/drive_left_x=velocity 1"], "discrete/drive_left_x", "rigid_walls")

    def test_tables_that_are_not_ascending(self):
        times = write(self.path("times.csv"), "time,velocity\n0,0\n2,1\n1,0\n")
        self.expect_wrong(["--set", "discrete/drive_lower_x=velocity " + times], "times.csv, line 4", "'time' = '1'")
        self.expect_wrong(["--set", "discrete/drive_lower_x=force " + times], "times.csv, line 1", "'force'")
        curve = write(self.path("curve.csv"), "radius,passing\n0.3,0\n0.5,0.6\n0.4,1\n")
        self.expect_wrong(setting(sample_radius_distribution="table", sample_radius_table=curve), "curve.csv, line 4", "0.4")
        falling = write(self.path("falling.csv"), "radius,passing\n0.3,0\n0.4,0.6\n0.5,0.5\n0.7,1\n")
        self.expect_wrong(setting(sample_radius_distribution="table", sample_radius_table=falling), "falling.csv, line 4", "0.5")

    def grains(self, *rows):
        return setting(sample_file=write(self.path("grains.csv"), "x,y,r\n" + "".join(row + "\n" for row in rows)))

    def test_grains_of_a_csv_that_overlap(self):
        rows = [str(x) + ",0.5,0.5" for x in range(12)]
        self.expect_wrong(self.grains(*rows, "2.5,1.2,0.5"), "grains.csv, line", "line 14", "overlap")

    def test_grains_of_a_csv_outside_the_platens(self):
        rows = [str(x) + ",0.5,0.5" for x in range(12)]
        self.expect_wrong(self.grains(*rows) + setting(sample_lower_platen=0.2), "grains.csv, line 2", "lower platen", "0.2")
        self.expect_wrong(self.grains(*rows) + setting(sample_upper_platen=0.9), "grains.csv, line 2", "upper platen", "0.9")

    def test_columns_of_a_csv(self):
        path = write(self.path("short.csv"), "x,y\n0,0\n1,0\n")
        self.expect_wrong(setting(sample_file=path), "short.csv, line 1", "'r' is missing")
        self.expect_wrong(self.grains("0,0,0.5", "1,0,-0.5"), "grains.csv, line 3", "'r' = '-0.5'")
        self.expect_wrong(self.grains("0,0,0.5", "1,0"), "grains.csv, line 3", "2 fields")
        self.expect_wrong(self.grains("0,0,0.5", "1,zero,0.5"), "grains.csv, line 3", "'y' = 'zero'")

    def test_a_truncated_snapshot_file(self):
        folder = self.path("earlier")
        self.assertEqual(diptych("discrete", QUICK, *SMALL, "--output", folder, "--quiet").returncode, 0)
        path = os.path.join(folder, "discrete.h5")
        with open(path, "r+b") as file:
            file.truncate(os.path.getsize(path) // 2)
        self.expect_wrong(setting(sample_file=path), path)

    def test_keys_that_contradict_each_other(self):
        for words, texts in [
                (setting(loading_mode="plane_shear"), ["plane_shear", "periodic or rigid_walls", "end_grains"]),
                (setting(sample_radius_max=0.8), ["sample/radius_min", "sample/radius_max", "1.1"]),
                (setting(sample_box_solid_fraction=0.88), ["sample/box_solid_fraction", "sample/solid_fraction", "0.88"]),
                (setting(sample_lower_platen=2, sample_upper_platen=1), ["sample/lower_platen", "sample/upper_platen"]),
                (setting(sample_radius_distribution="table"), ["sample/radius_distribution", "sample/radius_table"]),
                (setting(loading_axial_strain=0.012), ["loading/axial_strain", "loading/stage_strain"]),
                (setting(loading_mode="time", loading_stage_time=3), ["loading/duration", "loading/stage_time"])]:
            with self.subTest(words=words):
                self.expect_wrong(words, *texts)

    def test_a_periodic_sample_from_a_file_needs_its_width(self):
        rows = [str(x) + ",0.5,0.5" for x in range(12)]
        self.expect_wrong(self.grains(*rows) + setting(discrete_lateral="periodic"), "sample/width")

    def test_a_solid_fraction_out_of_reach_is_named_with_what_can_be_reached(self):
        """Only the preparation can tell, so the folder with the scene is there by then."""
        result = diptych("discrete", QUICK, *SMALL, *setting(sample_target_solid_fraction=0.7), "--output", self.out, "--quiet")
        self.assertEqual(result.returncode, 2, result.stderr)
        reach = re.search("sample/target_solid_fraction = 0.700 is out of reach: (0.8[0-9]+) to (0.8[0-9]+)", result.stderr)
        self.assertTrue(reach, result.stderr)
        self.assertLess(float(reach.group(1)) + 0.02, float(reach.group(2)))
        self.assertEqual([name for name in listing(self.out) if name.endswith(".part")], [])

    def test_what_the_continuum_does_not_have(self):
        for words, key in [(setting(discrete_lateral="periodic"), "discrete/lateral"), (setting(loading_mode="shear"), "loading/mode"),
                           (setting(discrete_gravity_y=-1), "discrete/gravity_y"),
                           (["--set", "discrete/drive_lower_x=velocity 1"], "discrete/drive_")]:
            self.expect_wrong(words, key, "diptych discrete", command="run")

    def test_studies_that_cannot_be(self):
        self.expect_wrong(["--study", "grid"], "--study grid", "step")
        self.expect_wrong(setting(discrete_step="auto") + ["--study", "step"], "--study step", "discrete/step")

    def test_an_earlier_result_survives_wrong_input(self):
        """Nothing written over: also not where the mistake lies in a file of grains."""
        self.assertEqual(diptych("discrete", QUICK, *SMALL, "--output", self.out, "--quiet").returncode, 0)
        before = {name: content(os.path.join(self.out, name)) for name in listing(self.out)}
        rows = [str(x) + ",0.5,0.5" for x in range(12)]
        result = diptych("discrete", QUICK, *SMALL, *self.grains(*rows, "2.5,1.2,0.5"), "--output", self.out, "--quiet")
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual({name: content(os.path.join(self.out, name)) for name in listing(self.out)}, before)


class Scenes(unittest.TestCase):
    """One small run of every kind, and one physical statement about each."""

    def run_small(self, *words):
        keep = tempfile.TemporaryDirectory()
        self.addCleanup(keep.cleanup)
        folder = os.path.join(keep.name, "out")
        result = diptych("discrete", QUICK, *SMALL, *words, "--output", folder, "--quiet")
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = history(folder)
        self.assertLess(numpy.abs(rows["energy_residual"]).max(), 1e-10)
        self.assertLess(rows["momentum_residual"].max(), 1e-11)
        self.assertEqual([name for name in listing(folder) if name.endswith(".part")], [])
        return folder, rows

    def stage(self, folder, number, name):
        with h5py.File(os.path.join(folder, "discrete.h5"), "r") as file:
            group = file["stage_%04d" % number if number >= 0 else sorted(file)[number]]
            return group[name][()] if name in group else group.attrs[name]

    def test_rigid_walls_carry_the_pressure(self):
        """The right wall, M v' = P H - contacts: the sum over all steps of h (right_fx + P H) is -M v at the end, and its
        kinetic energy M v^2 / 2 cannot exceed that of all bodies. H is the height at mid-step."""
        folder, rows = self.run_small(*setting(discrete_lateral="rigid_walls"))
        mass = self.stage(folder, 0, "grains/mass")
        wall_mass = mass.sum() / math.sqrt(len(mass))
        step = numpy.diff(rows["time"], prepend=0)
        strain = rows["axial_strain"] - 0.5 * numpy.diff(rows["axial_strain"], prepend=0)
        impulse = (step * (rows["right_fx"] + facts(folder)["initial_height"] * (1 - strain))).sum()
        self.assertLess(abs(impulse), math.sqrt(2 * wall_mass * rows["kinetic_energy"][-1]) * (1 + 1e-6))
        self.assertLess(abs(rows["right_fx"].mean() / facts(folder)["initial_height"] + 1), 0.02)
        self.assertEqual(numpy.abs(rows["left_fy"]).max(), 0)  # smooth walls

    def test_a_free_period_keeps_the_lateral_stress_at_the_pressure(self):
        """Smooth platens: every vertical section carries P x height, so s_xx = P but for the inertia of cell and grains. Rough
        ones push inwards, too, and the mean lies above P."""
        slow = dict(discrete_lateral="periodic", loading_inertial_number=3e-4, discrete_step=0.3)
        folder, rows = self.run_small(*setting(**slow, discrete_platen_friction=0, loading_horizontal_over_vertical=0))
        _, rough = self.run_small(*setting(**slow, loading_horizontal_over_vertical=0))
        self.assertLess(abs(rows["sxx"].mean() - 1), 0.03)
        self.assertGreater(rough["sxx"].mean(), rows["sxx"].mean())
        width, first = self.stage(folder, -1, "cell_width"), self.stage(folder, 0, "cell_width")
        self.assertAlmostEqual(rows["volumetric_strain"][-1], 1 - 0.99 * width / first, places=9)

    def test_a_fixed_period_stays(self):
        """At fixed width the volume decreases with the height alone."""
        folder, rows = self.run_small(*setting(discrete_lateral="periodic", discrete_side_motion="velocity"))
        self.assertEqual(self.stage(folder, -1, "cell_width"), self.stage(folder, 0, "cell_width"))
        self.assertLess(numpy.abs(rows["volumetric_strain"] - rows["axial_strain"]).max(), 1e-9)

    def test_plane_shear_carries_the_normal_pressure(self):
        """s_yy = 2 on the platen that is free to rise; its travel is the stage's; the dense sample dilates."""
        folder, rows = self.run_small(*setting(discrete_lateral="periodic", discrete_side_motion="velocity",
                                               loading_mode="plane_shear", loading_normal_pressure=2, loading_pressure=2))
        width = self.stage(folder, -1, "cell_width")
        self.assertLess(abs(rows["upper_fy"].mean() / width + 2), 0.02)
        self.assertLess(abs(rows["syy"].mean() - 2), 0.05)
        self.assertAlmostEqual(rows["shear_strain"][-1], 0.01, places=9)
        self.assertGreater(rows["upper_fx"].mean(), 0)
        self.assertLess(rows["axial_strain"][-1], 0)

    def test_shear_keeps_the_height(self):
        """The platens' shear forces on the sample are equal and opposite, up to the momentum of the grains."""
        folder, rows = self.run_small(*setting(loading_mode="shear"))
        self.assertEqual(numpy.abs(rows["axial_strain"]).max(), 0)
        self.assertAlmostEqual(rows["shear_strain"][-1], 0.01, places=9)
        self.assertLess(abs(rows["upper_fx"].mean() + rows["lower_fx"].mean()), 0.2 * abs(rows["upper_fx"].mean()))
        self.assertGreater(rows["upper_fx"].mean(), 0)
        self.assertLess(rows["sxy"].mean(), 0)

    def shaken_box(self, folder):
        """Twenty discs above a floor, one of them fixed where nothing rests on it, and a floor that is shaken and put down."""
        grains = ["1,7.5,0.3,1"] + ["%g,%g,0.5,0" % (1.1 + 1.2 * (k % 5), 1 + 1.1 * (k // 5)) for k in range(20)]
        write(os.path.join(folder, "grains.csv"), "x,y,r,fixed\n" + "".join(g + "\n" for g in grains))
        write(os.path.join(folder, "shaking.csv"), "time,velocity\n0,0\n1,0.5\n2,0\n3,-0.5\n4,0\n")
        return setting(sample_file=os.path.join(folder, "grains.csv"), sample_lower_platen=0, sample_upper_platen=9,
                       loading_mode="time", loading_duration=24, loading_stage_time=4, discrete_gravity_y=-1,
                       discrete_lateral="rigid_walls", discrete_side_motion="velocity", discrete_step=0.04,
                       discrete_drive_lower_y="velocity " + os.path.join(folder, "shaking.csv"))

    def test_a_shaken_box_comes_to_rest_and_its_floor_carries_the_weight(self):
        """Twenty discs of mass pi/4 under g = 1 weigh 5 pi. The floor rises by 0.5 and sinks by 0.5: it ends where it began."""
        with tempfile.TemporaryDirectory() as work:
            folder, rows = self.run_small(*self.shaken_box(work))
        self.assertEqual(rows["time"][-1], 24)
        self.assertAlmostEqual(self.stage(folder, 1, "lower_y"), 0, places=9)
        self.assertAlmostEqual(self.stage(folder, -1, "lower_y"), 0, places=9)
        self.assertAlmostEqual(rows["lower_fy"][-10:].mean(), 5 * math.pi, delta=0.02)
        self.assertLess(rows["kinetic_energy"][-1], 1e-3 * rows["kinetic_energy"].max())
        fixed = self.stage(folder, -1, "grains/fixed") == 1
        self.assertEqual(self.stage(folder, -1, "grains/position")[fixed].tolist(), [[1, 7.5, 0]])
        self.assertEqual(numpy.abs(self.stage(folder, -1, "grains/velocity")[fixed]).max(), 0)

    def test_grains_in_free_fall_have_snapshots_although_nothing_touches(self):
        """Stages at t = 0.5, 1, ...: y falls by g t^2 / 2 = 2 at the end (exactly, but for h t / 2 of the scheme's first step)."""
        with tempfile.TemporaryDirectory() as work:
            path = write(os.path.join(work, "grains.csv"), "x,y,r\n" + "".join("%g,50,0.5\n" % (2 * k) for k in range(12)))
            folder, rows = self.run_small(*setting(
                sample_file=path, sample_lower_platen=0, sample_upper_platen=60, discrete_lateral="none", loading_mode="time",
                loading_duration=2, loading_stage_time=0.5, discrete_gravity_y=-1))
        with h5py.File(os.path.join(folder, "discrete.h5"), "r") as file:
            self.assertEqual(len(file), 5, "the sample as it was read and four stages")
        self.assertTrue(numpy.allclose(self.stage(folder, -1, "grains/position")[:, 1], 48, atol=0.11))

    def test_an_automatic_step_keeps_to_its_bound(self):
        """d sqrt(rho/P) = 1 for forces; 0.1 d / speed; the solver's 0.6 I / tolerance = 6. Stages shorten it to fit."""
        folder, rows = self.run_small(*setting(discrete_step="auto"))
        self.assertIn(facts(folder)["step_bound"], ["forces", "motion", "solver"])
        self.assertLessEqual(facts(folder)["step"], 1)
        self.assertAlmostEqual(rows["axial_strain"][-1], 0.01, places=9)

    def test_an_impulsive_start_starts_from_rest(self):
        """The energy before the first step, from its ledger, against M |V|^2 / 4: an affine field holds M |V|^2 / 6, two thirds
        of that; at rest there is none."""
        for affine, expected, margin in [("true", 2 / 3, 0.15), ("false", 0, 1e-6)]:
            _, rows = self.run_small(*setting(loading_axial_strain=0.005, comparison_window_edges="0,0.005",
                                              loading_affine_start=affine))
            first = {name: column[0] for name, column in rows.items()}
            before = first["kinetic_energy"] - first["external_work"] + first["friction_dissipation"] + first["impact_dissipation"]
            scale = first["kinetic_energy"] / first["kinetic_energy_ratio"]
            self.assertAlmostEqual(before / scale, expected, delta=margin)

    def test_a_strain_rate_stands_in_the_place_of_the_inertial_number(self):
        """0.01 at 2e-3 a unit of time takes 5."""
        folder, rows = self.run_small(*setting(loading_strain_rate=2e-3))
        self.assertAlmostEqual(rows["time"][-1], 5, places=9)
        self.assertAlmostEqual(facts(folder)["platen_speed"], 2e-3 * facts(folder)["initial_height"], places=12)

    def test_radii_uniform_by_mass(self):
        """Sorted by radius the mass grows linearly with it; the mean diameter is 1."""
        folder, _ = self.run_small(*setting(sample_radius_distribution="uniform_by_mass", sample_radius_min=0.25,
                                            sample_radius_max=0.75))
        radius = numpy.sort(self.stage(folder, 0, "grains/radius"))
        share = numpy.cumsum(radius**2) / (radius**2).sum()
        self.assertAlmostEqual(2 * radius.mean(), 1, places=9)
        self.assertLess(numpy.abs(share - (radius - radius[0]) / (radius[-1] - radius[0])).max(), 0.02)
        self.assertAlmostEqual(radius[-1] / radius[0], 3, delta=0.1)

    def test_radii_of_a_grading_curve(self):
        """Thirty per cent of the mass below 2 units, seventy between 3 and 4, nothing between."""
        with tempfile.TemporaryDirectory() as work:
            curve = write(os.path.join(work, "curve.csv"), "radius,passing\n1.5,0\n2,30\n3,30\n4,100\n")
            folder, _ = self.run_small(*setting(sample_radius_distribution="table", sample_radius_table=curve))
        radius = numpy.sort(self.stage(folder, 0, "grains/radius"))
        gap = numpy.argmax(numpy.diff(radius))
        self.assertAlmostEqual(2 * radius.mean(), 1, places=9)
        self.assertAlmostEqual(radius[gap + 1] / radius[gap], 1.5, delta=0.02)
        self.assertAlmostEqual((radius[:gap + 1]**2).sum() / (radius**2).sum(), 0.3, delta=0.01)

    def test_a_loose_sample_has_the_wanted_fraction_and_a_lower_peak(self):
        strain = setting(loading_axial_strain=0.03, comparison_window_edges="0,0.03")
        dense, dense_rows = self.run_small(*strain)
        loose, loose_rows = self.run_small(*strain, *setting(sample_target_solid_fraction=LOOSE))
        self.assertAlmostEqual(facts(loose)["preparation_solid_fraction"], LOOSE, delta=0.002)
        self.assertGreater(facts(dense)["preparation_solid_fraction"], LOOSE + 0.01)
        self.assertGreater(facts(loose)["preparation_friction"], 0)

        def peak(rows):
            return numpy.convolve(rows["stress_ratio"], numpy.ones(50) / 50, "valid").max()

        self.assertLess(peak(loose_rows), peak(dense_rows))
        self.assertLess(-loose_rows["volumetric_strain"][-1], -dense_rows["volumetric_strain"][-1])

    def test_a_sample_goes_on_from_the_file_of_another_run(self):
        first, _ = self.run_small()
        second, rows = self.run_small(*setting(sample_file=os.path.join(first, "discrete.h5")))
        for name in ["grains/position", "grains/radius", "grains/mass"]:
            self.assertEqual(self.stage(first, -1, name).tobytes(), self.stage(second, 0, name).tobytes(), name)
        self.assertEqual(self.stage(first, -1, "upper_y"), self.stage(second, 0, "upper_y"))
        self.assertGreater(rows["stress_ratio"][:20].mean(), 0.2)  # it is sheared already

    def test_springs_overlap_by_what_their_stiffness_says(self):
        """kn = 1000 P: a mean contact force of about P d presses two discs 1e-3 d into each other, the largest some times that."""
        folder, rows = self.run_small(*setting(sample_grains=100, discrete_method="penalty"))
        self.assertTrue(1e-3 < rows["max_penetration"].max() < 2e-2)
        self.assertTrue(0.2 < rows["stress_ratio"][-100:].mean() < 0.6)


class Study(unittest.TestCase):
    def test_three_steps_and_a_verdict(self):
        words = SMALL + setting(sample_grains=200, loading_axial_strain=0.005, comparison_window_edges="0,0.005")
        with tempfile.TemporaryDirectory() as folder:
            result = diptych("discrete", QUICK, *words, "--study", "step", "--output", folder)
            self.assertEqual(result.returncode, 0, result.stderr)
            for name in ["study_step.csv", "study_step.json", "study_step.png"]:
                self.assertGreater(os.path.getsize(os.path.join(folder, name)), 100, name)
            with open(os.path.join(folder, "study_step.json")) as file:
                study = json.load(file)
            self.assertEqual(study["steps"], [0.1, 0.05, 0.025])
            self.assertRegex(study["verdict"], "^step 0.1 against 0.025: the step (matters|does not matter), largest difference")
            self.assertIn(study["verdict"], result.stdout)
            self.assertEqual([q["name"] for q in study["quantities"]],
                             ["stress_ratio", "external_work", "friction_dissipation", "impact_dissipation"])
            for quantity in study["quantities"]:
                self.assertEqual(quantity["largest_difference"][2], 0)
            with open(os.path.join(folder, "study_step.csv")) as file:
                rows = list(csv.DictReader(file))
            self.assertEqual([sum(float(row["step"]) == step for row in rows) for step in study["steps"]], [50, 100, 200])
            # One and the same prepared sample for all three.
            prepared = [bits(os.path.join(folder, name, "discrete.h5"))["stage_0000/grains/position"]
                        for name in ["step_1", "step_2", "step_4"]]
            self.assertEqual(prepared[0], prepared[1])
            self.assertEqual(prepared[0], prepared[2])


class Solve(unittest.TestCase):
    """`diptych solve` on stored problems; what it writes is judged from W, q and mu of the file alone."""

    def solve(self, problem, *words):
        return diptych("solve", os.path.join(PROBLEMS, problem), *words)

    def printed(self, result):
        return dict(line.split(": ", 1) for line in result.stdout.splitlines())

    def judge(self, path, tolerance):
        """|r - P(r)| / |r| with u = W r + q, and the worst of each condition relative to |r| or |u|."""
        with h5py.File(path, "r") as file:
            r = file["solution/r"][()]
            w, q, mu = file["fclib_local/W"], file["fclib_local/vectors/q"][()], file["fclib_local/vectors/mu"][()]
            self.assertEqual(int(w["nz"][()].item()), -2, "stored by rows")
            rows, columns, values = w["p"][()], w["i"][()], w["x"][()]
            u = q + numpy.array([values[a:b] @ r[columns[a:b]] for a, b in zip(rows[:-1], rows[1:])])
            diagonal = numpy.array([values[a:b][columns[a:b] == k].sum() for k, (a, b) in enumerate(zip(rows[:-1], rows[1:]))])
            written = file["solution/u"][()]
        self.assertLess(numpy.abs(u - written).max(), 1e-10 * max(1, numpy.abs(u).max()))
        rn, rt, un, ut = r[0::2], r[1::2], u[0::2], u[1::2]
        normal = numpy.maximum(0, rn - un / diagonal[0::2])
        tangential = numpy.clip(rt - ut / diagonal[1::2], -mu * normal, mu * normal)
        residual = math.sqrt(((rn - normal)**2 + (rt - tangential)**2).sum() / (r**2).sum())
        self.assertLessEqual(residual, 1.01 * tolerance)
        self.assertGreaterEqual(rn.min(), 0)
        self.assertTrue((numpy.abs(rt) <= mu * rn * (1 + 1e-12)).all())
        scale = numpy.abs(r).max() * (diagonal[0::2] * rn.size**0.5)
        self.assertTrue((un >= -10 * tolerance * scale).all(), "closing velocity left")
        self.assertTrue((numpy.minimum(rn * diagonal[0::2], numpy.abs(un)) <= 10 * tolerance * scale).all(), "complementarity")

    def expect_solved(self, problem, solver, form, tolerance, *words):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "solved.h5")
            result = self.solve(problem, "--solver", solver, "--form", form, "--tolerance", str(tolerance), "--output", path, *words)
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
            printed = self.printed(result)
            self.assertEqual((printed["status"], printed["solver"], printed["form"]), ("converged", solver, form))
            self.assertLessEqual(float(printed["residual"]), tolerance)
            self.judge(path, tolerance)
            self.assertEqual(listing(folder), ["solved.h5"])
            return bits(path)["solution/r"]

    def test_small_with_each_solver_and_form(self):
        for solver in ["psor", "nsgs"]:
            for form in ["body", "local"]:
                with self.subTest(solver=solver, form=form):
                    self.expect_solved("small.h5", solver, form, 1e-8)

    def test_medium_with_each_solver_and_form(self):
        for solver, tolerance in [("psor", 1e-6), ("nsgs", 1e-5)]:
            for form in ["body", "local"]:
                with self.subTest(solver=solver, form=form):
                    self.expect_solved("medium.h5", solver, form, tolerance)

    def test_two_threads_give_the_same_bits(self):
        alone = self.expect_solved("small.h5", "psor", "body", 1e-8)
        self.assertEqual(alone, self.expect_solved("small.h5", "psor", "body", 1e-8, "--threads", "2"))

    def test_too_few_sweeps_are_exit_code_three_and_what_was_reached_is_kept(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "reached.h5")
            result = self.solve("small.h5", "--max-sweeps", "5", "--output", path)
            self.assertEqual(result.returncode, 3, result.stderr)
            printed = self.printed(result)
            self.assertEqual((printed["status"], printed["sweeps"]), ("max_sweeps_reached", "5"))
            self.assertGreater(float(printed["residual"]), 1e-8)
            with h5py.File(path, "r") as file:
                self.assertEqual(len(file["solution/r"]), 2 * int(printed["contacts"]))

    def test_files_that_hold_no_problem(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "problem.h5")
            shutil.copy(os.path.join(PROBLEMS, "small.h5"), path)
            with open(path, "r+b") as file:
                file.truncate(os.path.getsize(path) // 2)
            other = os.path.join(folder, "other.h5")
            with h5py.File(other, "w") as file:
                file["numbers"] = [1, 2, 3]
            text = write(os.path.join(folder, "text.h5"), "no HDF5\n")
            for wrong in [path, other, text, os.path.join(folder, "none.h5")]:
                result = diptych("solve", wrong)
                self.assertEqual(result.returncode, 2, result.stderr)
                self.assertIn(wrong, result.stderr)

    def test_words_that_are_wrong(self):
        for words in [["--solver", "lemke"], ["--form", "global"], ["--tolerance", "0"], ["--tolerance", "2"], ["--max-sweeps", "0"]]:
            result = self.solve("small.h5", *words)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertIn(words[1], result.stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
