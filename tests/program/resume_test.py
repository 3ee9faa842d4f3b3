#!/usr/bin/env python3
# diptych: interrupted runs of the grains go on with the same bits
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: resume_test.py PROGRAM SOURCE_DIR [unittest arguments]."""

import os
import random
import signal
import tempfile
import time
import unittest

import h5py

from running import bits, content, diptych, listing, LONG, main, QUICK, setting, SMALL, start


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
            self.assertIn("--overwrite", refused.stderr)
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
                                discrete_method="penalty", discrete_penalty_step_fraction=1.5, discrete_penalty_preload=0)
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


if __name__ == "__main__":
    main()
