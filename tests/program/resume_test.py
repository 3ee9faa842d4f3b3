# diptych: interrupted runs of the grains go on with the same bits
# SPDX-License-Identifier: LGPL-2.1-or-later
import json
import os
import random
import signal
import time

import h5py

from running import (bits, content, finished, Folder, half_files, listing, LONG, QUICK, read_json, setting, SMALL,
                     start, temporary, write)


class Resume(Folder):
    """What interrupts a run, and how often, cannot be seen in its results: every bit is that of a run left alone."""

    @classmethod
    def setUpClass(cls):
        cls.alone = temporary(cls)
        finished("discrete", QUICK, *LONG, "--output", cls.alone, "--quiet")
        with h5py.File(os.path.join(cls.alone, "discrete.h5"), "r") as file:
            assert len(file) == 21, "20 stages after the prepared sample"

    def expect_same_results(self):
        self.expect_same_files(self.alone, "discrete.csv", "discrete.pvd", "discrete/stage_0020.vtu",
                               "discrete_contacts/stage_0020.vtu")
        a, b = bits(os.path.join(self.alone, "discrete.h5")), bits(self.path("discrete.h5"))
        self.assertEqual(sorted(a), sorted(b))
        self.assertEqual([name for name in a if a[name] != b[name]], [])
        self.assertNotIn("checkpoint.h5", listing(self.folder))
        self.assertEqual(half_files(self.folder), [])

    def written(self, name):
        """When a file of the folder was written; 0 without one."""
        return os.stat(self.path(name)).st_mtime_ns if os.path.exists(self.path(name)) else 0

    def resume(self, *words, code=0, told=()):
        return self.expect(code, ["discrete", QUICK, *LONG, *words, "--output", self.folder, "--resume"], *told)

    def stop(self, signal_number):
        """A run that a signal ends a tenth of a second after the prepared sample was written."""
        self.expect_stopped(signal_number, lambda: self.written("discrete.h5") and not time.sleep(0.1),
                            "discrete", QUICK, *LONG, "--output", self.folder, "--quiet")
        self.assertIn("checkpoint.h5", listing(self.folder))
        self.assertEqual(half_files(self.folder), [])

    def test_killed_at_random_moments(self):
        """SIGKILL after a checkpoint, a resumed run each time."""
        dice, hits, often = random.Random(1), 0, setting(discrete_checkpoint_minutes=0.0005)
        for _ in range(4):
            before = self.written("checkpoint.h5")
            process = start("discrete", QUICK, *LONG, *often, "--output", self.folder, "--resume", "--quiet")
            while process.poll() is None and self.written("checkpoint.h5") <= before:
                time.sleep(0.002)
            time.sleep(dice.uniform(0, 0.1))
            process.kill()
            process.communicate()
            hits += process.returncode == -signal.SIGKILL and os.path.exists(self.path("checkpoint.h5"))
        self.assertGreaterEqual(hits, 2, "they ended before the signals")
        self.resume(*often)
        self.expect_same_results()

    def test_ctrl_c_and_two_threads_that_take_over(self):
        self.stop(signal.SIGINT)
        self.assertNotIn("beginning", self.resume("--threads", "2").stdout)
        self.expect_same_results()

    def test_sigterm_and_what_cannot_be_gone_on_from(self):
        """Another scene and a truncated checkpoint are refused, and nothing changes."""
        self.stop(signal.SIGTERM)
        path = self.path("checkpoint.h5")
        whole = content(path)
        for words, size, text in ((setting(sample_seed=2), len(whole), "--overwrite"),
                                  (setting(discrete_friction=0.3), len(whole), self.folder),
                                  ([], len(whole) // 2, path), ([], len(whole) // 50, path)):
            with self.subTest(words=words, size=size):
                os.truncate(path, size)
                self.resume(*words, code=2, told=[text])
        with open(path, "wb") as file:
            file.write(whole)
        record = read_json(self.folder, "provenance.json")
        next(phase for phase in record["phases"] if phase["name"] == "discrete")["cpu_s"] = 1000
        write(self.path("provenance.json"), json.dumps(record))
        self.resume()
        self.expect_same_results()
        costs = {phase["name"]: phase["cpu_s"] for phase in read_json(self.folder, "provenance.json")["phases"]}
        self.assertGreater(costs["discrete"], 1000, "the cost of the earlier session counts")

    def test_a_run_that_did_not_converge_in_its_last_stage_is_not_finished(self):
        """Springs with steps far too long blow up soon. In a loading of one stage the prepared sample and the last
        accepted step are two snapshots, as many as a whole run has."""
        words = SMALL + setting(sample_grains=100, loading_axial_strain=0.005, comparison_window_edges="0,0.005",
                                discrete_method="penalty", discrete_penalty_step_fraction=1.5,
                                discrete_penalty_preload=0)
        for more in ([], ["--resume"]):
            self.expect(3, ["discrete", QUICK, *words, "--output", self.folder, "--quiet", *more])
            with h5py.File(self.path("discrete.h5"), "r") as file:
                self.assertEqual(len(file), 2, "it did not blow up within the stage")

    def test_a_preparation_under_a_signal(self):
        process = start("discrete", QUICK, *SMALL, *setting(sample_preparation_steps=20000), "--output", self.folder)
        for line in process.stdout:
            if "300 grains" in line:
                break
        time.sleep(0.1)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate()
        self.assertEqual(process.returncode, 3, errors)
        self.assertIn("stopped on request", errors)
        self.assertNotIn("--resume", errors)
        self.assertNotIn("checkpoint.h5", listing(self.folder))
        self.assertEqual(half_files(self.folder), [])
