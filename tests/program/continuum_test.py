# diptych: the continuum alone: loadings with closed forms, meshes, interruption, several processes
# SPDX-License-Identifier: LGPL-2.1-or-later
import os
import shutil
import signal
import socket
import subprocess
import time
import unittest

import h5py
import numpy

import running
from running import (content, ENVIRONMENT, facts, finished, half_files, history, listing, PROGRAM, QUICK, read_json,
                     setting, SMALL, temporary, write)

WIDTH, HEIGHT = 12, 18
RECTANGLE = setting(continuum_mesh="rectangle", continuum_rectangle_width=WIDTH, continuum_rectangle_height=HEIGHT,
                    loading_axial_strain=0.01, comparison_coarse_element_size=6)
# Closed forms: E = 500, nu = 0.2 in plane strain, geometry that does not change.
E, NU = 500, 0.2
SHEAR_MODULUS, CONSTRAINED = E / (2 * (1 + NU)), E * (1 - NU) / ((1 + NU) * (1 - 2 * NU))
ELASTIC = RECTANGLE + setting(continuum_law="linear_elastic", continuum_geometry="small_strain",
                              continuum_youngs_modulus=E, continuum_poisson_ratio=NU,
                              loading_horizontal_over_vertical=0)
FIXED_WIDTH = setting(discrete_lateral="periodic", discrete_side_motion="velocity")
# A Cosserat band on 40 steps of some 30 ms: long enough to be interrupted.
LONG = setting(continuum_mesh="rectangle", continuum_rectangle_width=30, continuum_rectangle_height=40,
               continuum_law="cosserat_mohr_coulomb", comparison_coarse_element_size=4, loading_axial_strain=0.02,
               continuum_initial_step=5e-4, continuum_max_step=5e-4)
CURVES = ["axial_strain", "shear_strain", "time", "stress_ratio", "volumetric_strain", "lower_fy", "upper_fx",
          "upper_fy"]


class Folder(running.Folder):
    def continuum(self, *words, command="continuum"):
        finished(command, QUICK, *words, "--output", self.folder, "--quiet")
        self.assertEqual(half_files(self.folder), [])

    def rows(self, name="continuum.csv"):
        return history(self.folder, name)

    def stage(self, number, name, file="continuum.h5"):
        with h5py.File(self.path(file), "r") as stages:
            group = stages[sorted(stages)[number]]
            return group[name][()] if name in group else group.attrs[name]

    def has(self, name, size):
        """Whether a file of the folder has grown to a size."""
        return os.path.exists(self.path(name)) and os.path.getsize(self.path(name)) > size


class Loadings(Folder):
    """One elastic element of every kind of loading against its closed form."""

    def test_descent_between_smooth_platens(self):
        """Small strain: s_xx stays the pressure, and in plane strain syy grows by E / (1 - nu^2) eps. No grains are
        made."""
        self.continuum(*ELASTIC, *setting(continuum_platens="smooth"))
        rows = self.rows()
        strain = rows["axial_strain"]
        numpy.testing.assert_allclose(rows["sxx"], 1, rtol=1e-5)
        numpy.testing.assert_allclose(-rows["upper_fy"] / WIDTH, 1 + E / (1 - NU**2) * strain, rtol=1e-5)
        self.assertEqual(strain[-1], 0.01)
        self.assertNotIn("discrete.h5", listing(self.folder))
        self.assertIn("coarse/continuum.h5", listing(self.folder))

    def test_plane_shear_carries_pressure_times_width(self):
        """Normal pressure 3 on a sample that is under 1: it shortens by 2 / constrained modulus at once."""
        self.continuum(*ELASTIC, *FIXED_WIDTH, *setting(loading_mode="plane_shear", loading_normal_pressure=3))
        rows = self.rows()
        numpy.testing.assert_allclose(rows["upper_fy"], -3 * WIDTH, rtol=1e-5)
        numpy.testing.assert_allclose(rows["volumetric_strain"][1:], 2 / CONSTRAINED, rtol=1e-4)
        self.assertAlmostEqual(rows["upper_fx"][-1] / (SHEAR_MODULUS * 0.01 * WIDTH), 1, places=4)

    def test_walls_that_move_as_a_table_says(self):
        """v from 0 to -0.1 in 2 units of time: 0.1 down after 2, 0.2 after 3; the walls stand still, so that eps_v = u
        / H."""
        drive = write(os.path.join(self.work, "drive.csv"), "time,velocity\n0,0\n2,-0.1\n")
        words = setting(loading_mode="time", loading_duration=3, loading_stage_time=1, discrete_lateral="rigid_walls",
                        discrete_side_motion="velocity", continuum_initial_step=0.5, continuum_max_step=0.5)
        self.continuum(*ELASTIC, *words, "--set", "discrete/drive_upper_y=velocity " + drive)
        strain = dict(zip(self.rows()["time"], self.rows()["volumetric_strain"]))
        for instant, travel in [(1, 0.025), (2, 0.1), (3, 0.2)]:
            self.assertAlmostEqual(strain[instant], travel / HEIGHT, places=6)

    def test_a_mesh_of_the_users_own_gives_the_same_curve(self):
        words = RECTANGLE + setting(continuum_law="mohr_coulomb")
        self.continuum(*words)
        whole = self.rows()
        mine = shutil.copy(self.path("sample.msh"), os.path.join(self.work, "mine.msh"))
        self.continuum(*words, *setting(continuum_mesh=mine))
        for name in CURVES:
            numpy.testing.assert_allclose(self.rows()[name], whole[name], rtol=1e-6, atol=1e-6, err_msg=name)
        self.assertNotIn("coarse/continuum.h5", listing(self.folder))


class GrainSamples(Folder):
    """Runs on the outline of a prepared sample of grains."""

    def test_mapped_stress_is_that_of_the_grains(self):
        """Not uniform, and in the mean that of the prepared sample within 15 % of the pressure (300 grains)."""
        self.continuum(*SMALL, *setting(continuum_initial_stress="mapped"))
        stress, mean = self.stage(0, "cells/stress").reshape(-1, 3, 3), self.stage(0, "mean_stress").reshape(3, 3)
        self.assertGreater(stress[:, 1, 1].std(), 0.1)
        self.assertLess(abs(mean[1, 1] - 1), 0.15)
        self.assertLess(abs(mean[0, 0] - 1), 0.15)

    def test_both_panels_are_compared_on_a_mesh_that_is_refined_on_the_way(self):
        self.continuum(*SMALL, *setting(continuum_refinement="adaptive", continuum_law="cosserat_mohr_coulomb",
                                        output_report="false"), command="run")
        rows = self.rows()
        self.assertGreater(rows["n_cells"][-1], rows["n_cells"][0])
        self.assertNotEqual(len(self.stage(0, "nodes/position")), len(self.stage(-1, "nodes/position")))
        comparison = read_json(self.folder, "comparison.json")
        for stage in comparison["stages"]:
            self.assertLess(stage["mapping"]["total_relative_error"], 1e-12)
        self.assertEqual(comparison["continuum_summary"]["internal_length_d"], 2.286)
        self.assertEqual(comparison["continuum_summary"]["viscous_share"], 0)
        self.assertIn("localisation_strain", comparison["continuum_summary"])
        with h5py.File(self.path("comparison.h5"), "r") as file:
            travel = file["window_0/nodes/displacement_increment"][()]
            self.assertEqual(len(travel), len(file["window_0/nodes/position"]))
        # the window holds the whole descent of the upper platen, with which the nodes on it move (one at a free corner
        # may sink deeper)
        with_platen = numpy.isclose(travel[:, 1], -0.01 * facts(self.folder)["initial_height"], rtol=0, atol=1e-6)
        self.assertGreater(with_platen.sum(), 3)

    def test_both_panels_of_a_sheared_periodic_sample_are_compared_by_their_travel(self):
        self.continuum(*SMALL, *FIXED_WIDTH, *setting(loading_mode="plane_shear", output_report="false"), command="run")
        stages = read_json(self.folder, "comparison.json")["stages"]
        width = self.stage(0, "cell_width", "discrete.h5")
        self.assertEqual([round(stage["progress"], 9) for stage in stages], [0.005, 0.01])
        for stage in stages:
            self.assertLess(stage["mapping"]["total_relative_error"], 1e-12)
            self.assertLess(stage["mapping"]["outside_share"], 0.02)
            for panel in ["discrete", "continuum"]:
                self.assertAlmostEqual(stage[panel]["platen_resultants"]["upper"][1] / -width, 1, delta=0.1)


class Resume(Folder):
    """An interrupted run gives the curve of an uninterrupted one, up to the tolerance of the equilibrium (1e-5)."""

    @classmethod
    def setUpClass(cls):
        cls.alone = os.path.join(temporary(cls), "alone")
        finished("continuum", QUICK, *LONG, "--output", cls.alone, "--quiet")

    def interrupt(self, signal_number, name, size, *words):
        """Starts a run and sends a signal when a file of its folder has grown to a size."""
        return self.signalled(signal_number, lambda: self.has(name, size), "continuum", QUICK, *LONG, *words,
                              "--output", self.folder)

    def expect_same_curves(self):
        for name in ["continuum.csv", "coarse/continuum.csv"]:
            expected, found = history(self.alone, name), self.rows(name)
            for column in CURVES:
                scale = abs(expected[column]).max()
                numpy.testing.assert_allclose(found[column], expected[column], rtol=1e-4, atol=1e-4 * scale,
                                              err_msg=name + column)
        stages = []
        for folder in (self.alone, self.folder):
            with h5py.File(os.path.join(folder, "continuum.h5"), "r") as file:
                stages.append([float(group.attrs["axial_strain"]) for group in file.values()])
        self.assertEqual(*stages)
        self.assertEqual((len(stages[1]), sorted(set(stages[1]))), (5, stages[1]))
        self.assertEqual([name for name in listing(self.folder) if "checkpoint" in name or name.endswith(".part")], [])

    def test_sigterm(self):
        """Another sample is refused, and nothing changes."""
        code, errors = self.interrupt(signal.SIGTERM, "continuum.csv", 5000)
        self.assertEqual(code, 3, errors)
        self.assertIn("stopped on request", errors)
        self.assertIn("diptych continuum " + QUICK + " --output " + self.folder + " --resume", errors)
        self.assertIn("continuum_checkpoint.h5", listing(self.folder))
        self.assertLess(len(self.rows()["axial_strain"]), 41)
        self.expect(2, ["continuum", QUICK, *LONG, *setting(sample_seed=7), "--output", self.folder, "--resume"],
                    "sample/seed")
        resumed = finished("continuum", QUICK, *LONG, "--output", self.folder, "--resume")
        self.assertNotIn("continuum panel: no checkpoint", resumed.stdout)
        self.expect_same_curves()

    def test_killed_after_a_checkpoint_and_in_the_coarse_run(self):
        every = setting(continuum_checkpoint_minutes=0)
        self.interrupt(signal.SIGKILL, "continuum.csv", 5000, *every)
        code, errors = self.interrupt(signal.SIGTERM, "coarse/continuum.csv", 3000, *every, "--resume")
        self.assertEqual(code, 3, errors)
        self.assertIn("coarse/continuum_checkpoint.h5", listing(self.folder))
        before = os.stat(self.path("continuum.h5")).st_mtime_ns
        self.continuum(*LONG, "--resume")
        # the fine one was finished
        self.assertEqual(os.stat(self.path("continuum.h5")).st_mtime_ns, before)
        self.expect_same_curves()

    def test_killed_in_the_first_steps(self):
        """The stages of the rest are those of the loading, not of a loading that knows none."""
        self.interrupt(signal.SIGKILL, "continuum_checkpoint.h5", 0, *setting(continuum_checkpoint_minutes=0))
        self.assertLess(len(self.rows()["axial_strain"]), 20)
        self.continuum(*LONG, "--resume")
        self.expect_same_curves()

    def test_the_continuum_of_a_run_of_both_panels(self):
        words = SMALL + setting(continuum_initial_step=1e-4, continuum_max_step=1e-4, output_report="false")
        errors = self.expect_stopped(signal.SIGINT, lambda: self.has("continuum.csv", 3000), "run", QUICK, *words,
                                     "--output", self.folder)
        self.assertIn("diptych run " + QUICK, errors)
        resumed = finished("run", QUICK, *words, "--output", self.folder, "--resume")
        self.assertIn("the grains are finished", resumed.stdout)
        self.assertEqual(self.rows()["axial_strain"][-1], 0.01)
        self.assertIn("comparison.json", listing(self.folder))


@unittest.skipUnless(shutil.which("mpirun"), "mpirun is not installed (openmpi-bin)")
class Processes(Folder):
    def on_two(self, *words):
        # processes that wait for each other are slow beside a third
        return subprocess.run(["mpirun", "-np", "2", "--oversubscribe", PROGRAM, *words, "--output", self.folder],
                              env=ENVIRONMENT, capture_output=True, text=True, timeout=1500)

    def test_a_grain_sample_with_its_own_stress(self):
        """Only the first process prepares grains and maps their stress."""
        words = SMALL + setting(continuum_initial_stress="mapped")
        together = self.on_two("continuum", QUICK, *words, "--quiet")
        self.assertEqual(together.returncode, 0, together.stderr)
        two = self.rows()
        self.continuum(*words)
        for name in CURVES:
            one = self.rows()[name]
            numpy.testing.assert_allclose(two[name], one, rtol=1e-3, atol=1e-3 * abs(one).max(), err_msg=name)
        self.assertEqual(together.stdout, "")

    def test_one_by_itself_shares_no_session_folder(self):
        """With one, those that start at once fail: the first that ends removes the folder of all."""
        version = subprocess.run(["mpirun", "--version"], capture_output=True, text=True, check=True).stdout
        if "(Open MPI) 4" not in version:
            self.skipTest("OpenMPI 5 always makes a session folder, but one for each process")
        taken = write(os.path.join(self.work, f"ompi.{socket.gethostname()}.{os.geteuid()}"), "not a folder")
        result = subprocess.run([PROGRAM, "material-point", QUICK, "--output", self.folder, "--quiet"],
                                capture_output=True, text=True, env=dict(ENVIRONMENT, TMPDIR=self.work))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(content(taken), b"not a folder")

    def test_wrong_input_is_told_once_and_nothing_is_written(self):
        result = self.on_two("continuum", QUICK, "--set", "sample/grians=3")
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(result.stderr.count("sample/grians"), 2)  # both in the one message
        self.assertFalse(os.path.exists(self.folder))
        os.mkdir(self.folder)
        write(self.path("mine.txt"), "mine")
        result = self.on_two("continuum", QUICK, *RECTANGLE)  # only the first process sees that
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(result.stderr.count("holds other files"), 1)

    def test_what_the_first_cannot_write_ends_all(self):
        """Only the first process writes rows, while the others are on their way into the next step."""
        words = ["continuum", QUICK, *RECTANGLE, *setting(continuum_initial_step=1e-4, continuum_max_step=1e-4),
                 "--output", self.folder, "--quiet"]
        process = subprocess.Popen(["mpirun", "-np", "2", "--oversubscribe", PROGRAM, *words], env=ENVIRONMENT,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        while process.poll() is None and not os.path.exists(self.path("continuum.csv")):
            time.sleep(0.01)
        os.rename(self.folder, self.folder + "_moved")
        _, errors = process.communicate(timeout=1500)
        self.assertEqual(process.returncode, 4, errors)
        self.assertIn(self.folder, errors)

    def test_other_commands_run_on_one_process(self):
        self.expect_message(self.on_two("material-point", QUICK), 2, "mpirun")
        self.assertFalse(os.path.exists(self.folder))
