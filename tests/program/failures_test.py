#!/usr/bin/env python3
# diptych: exit code 2 is wrong input alone; what the system refuses ends with 4 and says what is kept
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: failures_test.py PROGRAM SOURCE_DIR [unittest arguments]."""

import os
import resource
import subprocess
import signal
import tempfile
import time
import unittest

from running import ENVIRONMENT, PROGRAM, QUICK, SMALL, diptych, facts, history, listing, main, setting, write

FEW = SMALL + setting(sample_grains=150, output_report="false")
RECTANGLE = setting(continuum_mesh="rectangle", continuum_rectangle_width=40, continuum_rectangle_height=60)
ROOM = 60000  # bytes that a file may have: what a full disk does, for every user and on every system


def told_before_it_begins():
    """A signal that waits when the program starts: it comes as soon as the program takes any, whatever the machine's speed."""
    signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGTERM])
    os.kill(os.getpid(), signal.SIGTERM)


class Failures(unittest.TestCase):
    def setUp(self):
        keep = tempfile.TemporaryDirectory()
        self.addCleanup(keep.cleanup)
        self.work, self.folder = keep.name, os.path.join(keep.name, "out")

    def expect_system_failure(self, result, *texts):
        self.assertEqual(result.returncode, 4, result.stdout + result.stderr)
        for text in texts:
            self.assertIn(text, result.stderr)
        if os.path.isdir(self.folder):
            self.assertEqual([name for name in listing(self.folder) if name.endswith(".part")], [])

    def test_a_signal_that_comes_first_ends_with_code_3_and_writes_nothing(self):
        for command in ("discrete", "run", "continuum"):
            with self.subTest(command=command):
                result = diptych(command, QUICK, *FEW, "--output", self.folder, preexec_fn=told_before_it_begins)
                self.assertEqual(result.returncode, 3, result.stdout + result.stderr)
                self.assertIn("stopped on request; nothing was written", result.stderr)
                self.assertFalse(os.path.exists(self.folder))

    def test_the_program_behind_an_exec_takes_the_signal_too(self):
        """`diptych` becomes diptych-panels; what waits over the exec is taken before MPI and a second time behind it."""
        panels = os.path.join(os.path.dirname(PROGRAM), "diptych-panels")
        if not os.path.exists(panels):
            self.skipTest("installed elsewhere, or a build without the continuum")
        result = subprocess.run([panels, "continuum", QUICK, *FEW, *RECTANGLE, "--output", self.folder], env=ENVIRONMENT,
                                capture_output=True, text=True, preexec_fn=told_before_it_begins)
        self.assertEqual(result.returncode, 3, result.stdout + result.stderr)
        self.assertIn("stopped on request; nothing was written", result.stderr)
        self.assertFalse(os.path.exists(self.folder))

    def test_a_pipe_as_an_input_is_refused_before_it_is_opened(self):
        """Opening it would wait for one who writes into it."""
        pipes = {ending: os.path.join(self.work, "pipe." + ending) for ending in ("prm", "csv", "h5", "json")}
        for pipe in pipes.values():
            os.mkfifo(pipe)
        for words in (["discrete", pipes["prm"]], ["discrete", QUICK, *FEW, *setting(sample_file=pipes["csv"])],
                      ["discrete", QUICK, *FEW, *setting(sample_file=pipes["h5"])], ["solve", pipes["h5"]],
                      ["study", pipes["json"]], ["calibrate", pipes["json"]]):
            with self.subTest(words=words):
                output = [] if words[0] == "solve" else ["--output", self.folder]
                result = diptych(*words, *output)
                self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
                self.assertIn("is no regular file", result.stderr)
                self.assertFalse(os.path.exists(self.folder))

    def fill_the_disk(self, begun, *words):
        """Runs until the file `begun` of the folder is there; from then on nothing grows any more."""
        process = subprocess.Popen([PROGRAM, *words, "--output", self.folder, "--quiet"], env=ENVIRONMENT, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        while process.poll() is None and not os.path.exists(os.path.join(self.folder, begun)):
            time.sleep(0.002)
        self.assertIsNone(process.poll(), "it ended before the disk was full")
        resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (ROOM, ROOM))
        out, errors = process.communicate()
        return subprocess.CompletedProcess(process.args, process.returncode, out, errors)

    def test_a_full_disk_while_the_grains_are_loaded(self):
        result = self.fill_the_disk("discrete/stage_0000.h5", "discrete", QUICK, *FEW,
                                    *setting(loading_axial_strain=0.2, comparison_window_edges="0,0.2"))
        self.expect_system_failure(result, self.folder, "kept in", "scene.prm", "discrete.h5")

    def test_a_full_disk_under_the_continuum(self):
        result = self.fill_the_disk("continuum/stage_0000.vtu", "continuum", QUICK, *FEW, *RECTANGLE,
                                    *setting(loading_axial_strain=0.2, continuum_initial_step=1e-3, continuum_max_step=1e-3))
        self.expect_system_failure(result, self.folder, "kept in", "scene.prm")

    @unittest.skipIf(os.geteuid() == 0, "root may write everywhere")
    def test_a_folder_that_must_not_be_written_to(self):
        os.mkdir(self.folder, 0o500)
        self.expect_system_failure(diptych("discrete", QUICK, *FEW, "--output", self.folder, "--quiet"), self.folder)

    def test_a_folder_that_cannot_be_made(self):
        """Below a file no folder can be; root or not."""
        path = write(os.path.join(self.work, "file"), "mine")
        for command in ("run", "discrete", "continuum"):
            result = diptych(command, QUICK, *FEW, "--output", os.path.join(path, "out"), "--quiet")
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertIn(path, result.stderr)
            self.assertIn("nothing was written", result.stderr)

    def test_a_report_script_that_dies(self):
        """The results stay; what the script said and its exit code are told."""
        self.assertEqual(diptych("run", QUICK, *FEW, "--output", self.folder, "--quiet").returncode, 0)
        os.mkdir(os.path.join(self.folder, "report.html.part"))  # whatever it draws, it cannot put it there
        result = diptych("report", self.folder, "--quiet")
        self.assertEqual(result.returncode, 4, result.stderr)
        for text in ("the report could not be drawn", "exit code", "kept in", "comparison.json"):
            self.assertIn(text, result.stderr)

    def test_a_mesh_that_is_none_and_one_that_is_too_large(self):
        """gmsh refuses the geometry of a file that is one by its name and place, but draws nothing: wrong input, code 2; a mesh
        that would run out of memory is none."""
        geometry = write(os.path.join(self.work, "mesh.geo"), "Point(1) = {0, 0, 0};\n")
        wrong = diptych("continuum", QUICK, *FEW, *setting(continuum_mesh=geometry), "--output", self.folder, "--quiet")
        self.assertEqual(wrong.returncode, 2, wrong.stderr)
        self.assertFalse(os.path.exists(self.folder))

        def with_little_memory():
            resource.setrlimit(resource.RLIMIT_AS, (2 << 30, 2 << 30))
        words = setting(continuum_mesh="rectangle", continuum_rectangle_width=400, continuum_rectangle_height=600,
                        continuum_element_size=1.2, comparison_coarse_element_size=0)
        result = diptych("continuum", QUICK, *FEW, *words, "--output", self.folder, "--quiet", preexec_fn=with_little_memory)
        self.expect_system_failure(result, "GB of memory", "nothing was written")

    def test_springs_that_blow_up_are_not_called_unsolved(self):
        words = FEW + setting(sample_grains=100, discrete_method="penalty", discrete_penalty_step_fraction=1.5)
        result = diptych("discrete", QUICK, *words, "--output", self.folder, "--quiet")
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertIn("blew up", result.stderr)
        for wrong in ("max_sweeps", "did not converge"):
            self.assertNotIn(wrong, facts(self.folder)["message"])

    def test_mpi_that_cannot_start(self):
        """It needs room for files of its own, and where it has none would end the process by itself, with exit code 1."""
        def with_no_room():
            resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))
        result = diptych("continuum", QUICK, *FEW, *RECTANGLE, "--output", self.folder, "--quiet", preexec_fn=with_no_room)
        self.expect_system_failure(result, "TMPDIR", "nothing was written")
        self.assertFalse(os.path.exists(self.folder))

    def test_on_two_processes_one_code_and_one_message(self):
        os.makedirs(os.path.join(self.folder, "continuum.csv.part", "mine"))
        write(os.path.join(self.folder, "scene.prm"), "# every parameter, as it was used\n")
        words = ["mpirun", "--oversubscribe", "-np", "2", PROGRAM, "continuum", QUICK, *FEW,
                 *RECTANGLE, "--output", self.folder, "--quiet"]
        result = subprocess.run(words, env=ENVIRONMENT, capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 4, result.stderr)
        self.assertEqual(result.stderr.count("diptych: "), 1, result.stderr)
        self.assertIn("continuum.csv", result.stderr)


class Places(unittest.TestCase):
    """Files that a scene names are found from the scene's own folder, wherever the program is started."""

    def test_files_beside_the_scene(self):
        with tempfile.TemporaryDirectory() as work:
            scenes = os.path.join(work, "scenes")
            os.makedirs(os.path.join(scenes, "data"))
            rows = "".join(f"{x},{y},0.5\n" for x in range(12) for y in (0.5, 1.5))
            write(os.path.join(scenes, "data", "grains.csv"), "x,y,r\n" + rows)
            write(os.path.join(scenes, "data", "speed.csv"), "time,velocity\n0,0\n5,-0.001\n")
            scene = write(os.path.join(scenes, "mine.prm"), """subsection sample
  set file = data/grains.csv
end
subsection loading
  set mode = time
  set duration = 1
  set stage_time = 1
end
subsection discrete
  set drive_upper_y = velocity data/speed.csv
  set step = 0.1
end
""")
            folder = os.path.join(work, "out")
            result = diptych("discrete", scene, "--output", folder, "--quiet", cwd="/")
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertAlmostEqual(history(folder)["time"][-1], 1, places=9)
            # The echo runs from anywhere, too: it holds whole paths.
            again = diptych("discrete", os.path.join(folder, "scene.prm"), "--output", os.path.join(work, "again"), "--quiet",
                            cwd=tempfile.gettempdir())
            self.assertEqual(again.returncode, 0, again.stderr)
            missing = diptych("discrete", scene, "--set", "sample/file=data/grains.csv", "--output", folder + "2", cwd="/")
            self.assertEqual(missing.returncode, 2)  # an override's from the working directory
            self.assertIn("/data/grains.csv", missing.stderr)


class Units(unittest.TestCase):
    """Stresses count in P, lengths in d, times in d sqrt(rho/P)."""

    COLUMNS = (("axial_strain", "-"), ("stress_ratio", "-"), ("volumetric_strain", "-"), ("syy", "stress"), ("upper_fy", "force"),
               ("time", "time"))

    def run_in(self, command, diameter, density, pressure):
        """Columns of a small run in units of its own d, rho and P."""
        time_unit = diameter * (density / pressure) ** 0.5
        units = {"-": 1, "stress": pressure, "force": pressure * diameter, "time": time_unit}
        words = setting(sample_mean_diameter=diameter, sample_density=density, loading_pressure=pressure,
                        discrete_step=0.1 * time_unit, continuum_mesh="outline" if command == "discrete" else "rectangle",
                        continuum_rectangle_width=40 * diameter, continuum_rectangle_height=60 * diameter,
                        continuum_youngs_modulus=500)  # ten times as stiff its solver's tolerance is as many stresses
        with tempfile.TemporaryDirectory() as folder:
            result = diptych(command, QUICK, *FEW, *words, "--output", folder, "--quiet")
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertNotIn("modulus", result.stderr)
            rows = history(folder, command + ".csv")
        self.assertGreater(len(rows["time"]), 5)
        return {name: rows[name] / units[kind] for name, kind in self.COLUMNS}

    def expect_same(self, one, other, tolerance):
        for name, _ in self.COLUMNS:
            self.assertEqual(len(one[name]), len(other[name]))
            self.assertLess(abs(one[name] - other[name]).max() / max(1, abs(one[name]).max()), tolerance, name)

    def test_units_that_are_powers_of_two_change_no_digit(self):
        """d = 2^-10, rho = 2^12, P = 2^14, time unit 2^-11: every product rounds alike, in thousands of steps of grains, too. The
        continuum's solver stops at its tolerance."""
        for command, tolerance in (("discrete", 1e-12), ("continuum", 1e-6)):
            self.expect_same(self.run_in(command, 1, 1, 1), self.run_in(command, 2.0**-10, 2.0**12, 2.0**14), tolerance)

    def test_si_units(self):
        """si_units.prm: d = 1 mm, 2600 kg/m2, 10 kPa, and the same scene with d = rho = P = 1. On the outline of other grains the
        continuum gives another curve, so that it is asked on a rectangle: its curve is the dimensionless one. Grains part at the
        last digit while they are prepared, and give a curve of the same kind: mean t/s after 0.2 % within a tenth (samples of 150
        grains scatter by 5 %)."""
        si = os.path.join(os.path.dirname(os.path.abspath(__file__)), "si_units.prm")
        time_unit = 1e-3 * (2600 / 1e4) ** 0.5
        runs = {}
        for command, d, unit, words in (
                ("continuum", 1e-3, time_unit, []), ("discrete", 1e-3, time_unit, []),
                ("continuum", 1, 1, setting(sample_mean_diameter=1, sample_density=1, loading_pressure=1, discrete_step=0.1)),
                ("discrete", 1, 1, setting(sample_mean_diameter=1, sample_density=1, loading_pressure=1, discrete_step=0.1))):
            if command == "continuum":
                words = words + setting(continuum_mesh="rectangle", continuum_rectangle_width=40 * d,
                                        continuum_rectangle_height=60 * d)
            with tempfile.TemporaryDirectory() as folder:
                result = diptych(command, si, *words, "--output", folder, "--quiet")
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertNotIn("warning", result.stderr)
                rows, pressure = history(folder, command + ".csv"), 1 if d == 1 else 1e4
            units = {"-": 1, "stress": pressure, "force": pressure * d, "time": unit}
            runs[command, d] = {name: rows[name] / units[kind] for name, kind in self.COLUMNS}
        self.expect_same(runs["continuum", 1], runs["continuum", 1e-3], 1e-6)
        one, other = runs["discrete", 1], runs["discrete", 1e-3]
        ratios = [rows["stress_ratio"][rows["axial_strain"] > 0.002].mean() for rows in (one, other)]
        self.assertLess(abs(ratios[1] / ratios[0] - 1), 0.1)
        self.assertLess(abs(one["syy"].mean() / other["syy"].mean() - 1), 0.1)


if __name__ == "__main__":
    main()
