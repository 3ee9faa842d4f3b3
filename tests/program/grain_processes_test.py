# diptych: one sample of grains on several processes
# SPDX-License-Identifier: LGPL-2.1-or-later
import os
import resource
import shutil
import signal
import subprocess
import time
import unittest

from running import ENVIRONMENT, finished, Folder, half_files, PROGRAM, QUICK, setting, SOURCE, temporary

# Three blocks of contacts, with ten snapshots.
GRAINS = setting(sample_grains=3000, loading_inertial_number=1e-2, loading_axial_strain=0.01,
                 loading_stage_strain=0.001, discrete_step=0.05, discrete_tolerance=1e-3,
                 comparison_window_edges="0,0.01", output_report="false")


def together(n, *words):
    return ["mpirun", "-np", str(n), "--oversubscribe", PROGRAM, *words]


class SameFiles(Folder):
    SCENE, SETTINGS, FILES = QUICK, GRAINS, ["discrete.csv", "discrete/stage_0010.vtu",
                                             "discrete_contacts/stage_0010.vtu"]

    @classmethod
    def setUpClass(cls):
        cls.alone = temporary(cls)
        finished("discrete", cls.SCENE, *cls.SETTINGS, "--output", cls.alone, "--quiet")

    def on(self, n, *words):
        return subprocess.run(together(n, "discrete", self.SCENE, *self.SETTINGS, *words, "--output", self.folder),
                              env=ENVIRONMENT, capture_output=True, text=True, timeout=1500)

    def expect_same_results(self):
        self.expect_same_files(self.alone, "discrete.h5", *self.FILES)
        self.assertEqual(half_files(self.folder), [])

    def expect_same_on(self, *processes_and_threads):
        for n, threads in processes_and_threads:
            with self.subTest(processes=n, threads=threads):
                result = self.on(n, "--threads", str(threads), "--overwrite")
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertEqual(result.stdout.count("t/s at the end"), 1)
                self.expect_same_results()


@unittest.skipUnless(shutil.which("mpirun"), "mpirun is not installed (openmpi-bin)")
class Reference(SameFiles):
    """A tenth of the loading of moreau_1997."""
    SCENE, FILES = os.path.join(SOURCE, "benchmarks/moreau_1997/scene.prm"), ["discrete.csv"]
    SETTINGS = setting(loading_axial_strain=0.006, loading_stage_strain=0.003, comparison_window_edges="0,0.006")

    def test_every_number_gives_the_same_files(self):
        self.expect_same_on((2, 1), (2, 2), (3, 1), (3, 2), (4, 1), (4, 2))


@unittest.skipUnless(shutil.which("mpirun"), "mpirun is not installed (openmpi-bin)")
class Processes(SameFiles):
    def started_on_two(self, reached, *words):
        """A job that has written that file."""
        job = subprocess.Popen(together(2, "discrete", QUICK, *GRAINS, *words, "--output", self.folder, "--quiet"),
                               env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        while job.poll() is None and not os.path.exists(self.path(reached)):
            time.sleep(0.002)
        self.assertIsNone(job.poll(), "it ended before that")
        return job

    def processes_of(self, job):
        """Their numbers, the first process first."""
        def parent(number):
            try:
                with open(f"/proc/{number}/stat", encoding="utf-8") as file:
                    return int(file.read().rpartition(")")[2].split()[1])
            except OSError:  # it has ended
                return 0

        return [number for number in sorted(int(name) for name in os.listdir("/proc") if name.isdigit())
                if parent(number) == job.pid]

    def test_every_number_gives_the_same_files(self):
        self.expect_same_on((2, 2), (3, 1))

    def test_stopped_on_two_and_resumed_on_three(self):
        job = self.started_on_two("discrete/stage_0003.vtu")
        os.kill(self.processes_of(job)[0], signal.SIGTERM)
        _, errors = job.communicate()
        self.assertEqual(job.returncode, 3, errors)
        self.assertIn("--resume", errors)
        result = self.on(3, "--resume")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.expect_same_results()

    def test_a_killed_process_ends_all_and_one_goes_on(self):
        job = self.started_on_two("checkpoint.h5", *setting(discrete_checkpoint_minutes=0.0005))
        os.kill(self.processes_of(job)[1], signal.SIGKILL)
        job.communicate()
        self.assertNotEqual(job.returncode, 0)
        self.expect(0, ["discrete", QUICK, *GRAINS, *setting(discrete_checkpoint_minutes=0.0005), "--output",
                        self.folder, "--resume"])
        self.expect_same_results()

    def test_what_the_first_cannot_write_ends_all(self):
        job = self.started_on_two("discrete/stage_0001.vtu")
        os.rename(self.folder, self.folder + "_moved")
        _, errors = job.communicate(timeout=1500)
        self.assertEqual(job.returncode, 4, errors)
        self.assertIn(self.folder, errors)

    def test_a_full_disk_ends_all(self):
        job = self.started_on_two("discrete/stage_0001.vtu")
        resource.prlimit(self.processes_of(job)[0], resource.RLIMIT_FSIZE, (60000, 60000))
        _, errors = job.communicate(timeout=1500)
        self.assertEqual(job.returncode, 4, errors)
        self.assertIn("kept in " + self.folder, errors)

    def test_more_than_the_sample_can_use_are_refused_once(self):
        result = self.on(4)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(result.stderr.count("at most 3 processes"), 1)
        self.assertFalse(os.path.exists(self.folder))
        self.assertEqual(self.on(2).returncode, 0)
        before = os.stat(self.path("discrete.csv"))
        held = self.on(2)
        self.assertEqual(held.returncode, 0, held.stderr)
        self.assertIn("--overwrite starts again", held.stdout)
        self.assertEqual(os.stat(self.path("discrete.csv")), before)
