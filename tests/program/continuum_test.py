#!/usr/bin/env python3
# diptych: the continuum alone: loadings with closed forms, meshes, interruption, several processes
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: continuum_test.py PROGRAM SOURCE_DIR [unittest arguments]."""

import csv
import json
import os
import shutil
import signal
import socket
import subprocess
import tempfile
import time
import unittest

import h5py
import numpy

from running import content, diptych, ENVIRONMENT, listing, main, PROGRAM, QUICK, setting, SMALL, start, write

WIDTH, HEIGHT = 12, 18
RECTANGLE = setting(continuum_mesh="rectangle", continuum_rectangle_width=WIDTH, continuum_rectangle_height=HEIGHT,
                    loading_axial_strain=0.01, comparison_coarse_element_size=6)
# Closed forms: E = 500, nu = 0.2 in plane strain, geometry that does not change.
E, NU = 500, 0.2
SHEAR_MODULUS, CONSTRAINED = E / (2 * (1 + NU)), E * (1 - NU) / ((1 + NU) * (1 - 2 * NU))
ELASTIC = RECTANGLE + setting(continuum_law="linear_elastic", continuum_geometry="small_strain", continuum_youngs_modulus=E,
                              continuum_poisson_ratio=NU, loading_horizontal_over_vertical=0)
FIXED_WIDTH = setting(discrete_lateral="periodic", discrete_side_motion="velocity")
# A Cosserat band on 40 steps of some 30 ms: long enough to be interrupted.
LONG = setting(continuum_mesh="rectangle", continuum_rectangle_width=30, continuum_rectangle_height=40,
               continuum_law="cosserat_mohr_coulomb", comparison_coarse_element_size=4, loading_axial_strain=0.02,
               continuum_initial_step=5e-4, continuum_max_step=5e-4)
CURVES = ["axial_strain", "shear_strain", "time", "stress_ratio", "volumetric_strain", "lower_fy", "upper_fx", "upper_fy"]


def table(path):
    with open(path) as file:
        rows = list(csv.DictReader(file))
    return {name: numpy.array([float(row[name]) for row in rows]) for name in CURVES + ["sxx", "sxy", "n_cells"]}


class Folder(unittest.TestCase):
    def setUp(self):
        keep = tempfile.TemporaryDirectory()
        self.addCleanup(keep.cleanup)
        self.work, self.folder = keep.name, os.path.join(keep.name, "out")

    def continuum(self, *words, code=0, command="continuum"):
        result = diptych(command, QUICK, *words, "--output", self.folder, "--quiet")
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        if code == 0:
            self.assertEqual([name for name in listing(self.folder) if name.endswith(".part")], [])
        return result

    def rows(self, name="continuum.csv"):
        return table(os.path.join(self.folder, name))

    def stage(self, number, name):
        with h5py.File(os.path.join(self.folder, "continuum.h5"), "r") as file:
            group = file[sorted(file)[number]]
            return group[name][()] if name in group else group.attrs[name]


class Loadings(Folder):
    """One elastic element of every kind of loading against its closed form."""

    def expect_pressure_on_the_current_height(self):
        """The force pressure x current height on the height that small strain does not change: s_xx = 1 - eps. In plane
        strain syy grows by E / (1 - nu^2) eps at constant s_xx, and by nu / (1 - nu) of what s_xx does."""
        rows = self.rows()
        strain = rows["axial_strain"]
        numpy.testing.assert_allclose(rows["sxx"], 1 - strain, rtol=1e-5)
        numpy.testing.assert_allclose(-rows["upper_fy"] / WIDTH, 1 + (E / (1 - NU**2) - NU / (1 - NU)) * strain, rtol=1e-5)

    def test_descent_between_smooth_platens(self):
        """Nothing is made of grains."""
        result = self.continuum(*ELASTIC, *setting(continuum_platens="smooth"))
        self.expect_pressure_on_the_current_height()
        self.assertEqual(self.rows()["axial_strain"][-1], 0.01)
        self.assertNotIn("preparing", result.stderr)
        self.assertNotIn("discrete.h5", listing(self.folder))
        self.assertIn("coarse/continuum.h5", listing(self.folder))

    def test_shear_at_constant_height(self):
        """Simple shear between periodic sides: s_xy = G gamma everywhere, on the width of the platen."""
        self.continuum(*ELASTIC, *FIXED_WIDTH, *setting(loading_mode="shear"))
        rows = self.rows()
        numpy.testing.assert_allclose(rows["upper_fx"], SHEAR_MODULUS * rows["shear_strain"] * WIDTH, rtol=1e-5, atol=1e-6)
        self.assertLess(abs(rows["volumetric_strain"]).max(), 1e-9)

    def test_plane_shear_carries_pressure_times_width(self):
        """Normal pressure 3 on a sample that is under 1: it shortens by 2 / constrained modulus at once."""
        self.continuum(*ELASTIC, *FIXED_WIDTH, *setting(loading_mode="plane_shear", loading_normal_pressure=3))
        rows = self.rows()
        numpy.testing.assert_allclose(rows["upper_fy"], -3 * WIDTH, rtol=1e-5)
        numpy.testing.assert_allclose(rows["volumetric_strain"][1:], 2 / CONSTRAINED, rtol=1e-4)
        self.assertAlmostEqual(rows["upper_fx"][-1] / (SHEAR_MODULUS * 0.01 * WIDTH), 1, places=4)

    def test_rigid_walls_carry_the_pressure(self):
        self.continuum(*ELASTIC, *setting(continuum_platens="smooth", discrete_lateral="rigid_walls"))
        self.expect_pressure_on_the_current_height()

    def test_a_wall_that_moves(self):
        """Width + 0.001 x 18 x 10 / 12 at the strain rate 1e-3: eps_v = axial - 0.015 at the end (small strain)."""
        self.continuum(*ELASTIC, *setting(continuum_platens="smooth", discrete_lateral="rigid_walls", loading_strain_rate=1e-3,
                                          discrete_side_motion="velocity", discrete_side_velocity=0.018))
        self.assertAlmostEqual(self.rows()["volumetric_strain"][-1], 1 - (1 - 0.01) * (1 + 0.015), places=4)

    def test_a_free_period_keeps_the_lateral_stress_at_the_pressure(self):
        self.continuum(*ELASTIC, *setting(continuum_platens="smooth", discrete_lateral="periodic"))
        self.expect_pressure_on_the_current_height()

    def test_gravity_loads_the_lower_platen_with_the_weight(self):
        """density x solid fraction x g x area more than the upper one carries."""
        self.continuum(*ELASTIC, *setting(discrete_gravity_y=-0.02, sample_density=2, sample_solid_fraction=0.84))
        rows = self.rows()
        numpy.testing.assert_allclose(rows["lower_fy"] + rows["upper_fy"], 2 * 0.84 * 0.02 * WIDTH * HEIGHT, rtol=1e-4)

    def test_walls_that_move_as_a_table_says(self):
        """v from 0 to -0.1 in 2 units of time: 0.1 down after 2, 0.2 after 3; the walls stand still, so that eps_v = u / H."""
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
        whole, mesh = self.rows(), os.path.join(self.work, "mine.msh")
        shutil.copy(os.path.join(self.folder, "sample.msh"), mesh)
        self.continuum(*words, *setting(continuum_mesh=mesh))
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
        self.continuum(*SMALL, *setting(sample_seed=2), "--overwrite")  # of a smooth outline: a wavy one is not stress-free under a uniform stress
        self.assertLess(self.stage(0, "cells/stress").reshape(-1, 3, 3)[:, 1, 1].std(), 0.05)

    def test_both_panels_are_compared_on_a_mesh_that_is_refined_on_the_way(self):
        self.continuum(*SMALL, *setting(continuum_refinement="adaptive", continuum_law="cosserat_mohr_coulomb",
                                        output_report="false"), command="run")
        rows = self.rows()
        self.assertGreater(rows["n_cells"][-1], rows["n_cells"][0])
        self.assertNotEqual(len(self.stage(0, "nodes/position")), len(self.stage(-1, "nodes/position")))
        with open(os.path.join(self.folder, "comparison.json")) as file:
            comparison = json.load(file)
        for stage in comparison["stages"]:
            self.assertLess(stage["mapping"]["total_relative_error"], 1e-12)
        self.assertEqual(comparison["continuum_summary"]["internal_length_d"], 1.922)
        self.assertEqual(comparison["continuum_summary"]["viscous_share"], 0)
        self.assertIn("localisation_strain", comparison["continuum_summary"])
        with h5py.File(os.path.join(self.folder, "comparison.h5"), "r") as file:
            travel = file["window_0/nodes/displacement_increment"][()]
            self.assertEqual(len(travel), len(file["window_0/nodes/position"]))
        # the window holds the whole descent of the upper platen, with which the nodes on it move (one at a free corner may sink deeper)
        with_platen = numpy.isclose(travel[:, 1], -0.01 * initial_height(self.folder), rtol=0, atol=1e-6)
        self.assertGreater(with_platen.sum(), 3)

    def test_both_panels_of_a_sheared_periodic_sample_are_compared_by_their_travel(self):
        self.continuum(*SMALL, *FIXED_WIDTH, *setting(loading_mode="plane_shear", output_report="false"), command="run")
        with open(os.path.join(self.folder, "comparison.json")) as file:
            stages = json.load(file)["stages"]
        self.assertEqual([round(stage["progress"], 9) for stage in stages], [0.005, 0.01])
        for stage in stages:
            self.assertLess(stage["mapping"]["total_relative_error"], 1e-12)
            self.assertLess(stage["mapping"]["outside_share"], 0.02)
            for panel in ["discrete", "continuum"]:
                self.assertAlmostEqual(stage[panel]["platen_resultants"]["upper"][1] / -period(self.folder), 1, delta=0.1)


def initial_height(folder):
    with open(os.path.join(folder, "provenance.json")) as file:
        return json.load(file)["discrete"]["initial_height"]


def period(folder):
    with h5py.File(os.path.join(folder, "discrete.h5"), "r") as file:
        return file["stage_0000"].attrs["cell_width"]


class Resume(Folder):
    """An interrupted run gives the curve of an uninterrupted one, up to the tolerance of the equilibrium (1e-5)."""

    @classmethod
    def setUpClass(cls):
        cls.keep = tempfile.TemporaryDirectory()
        cls.alone = os.path.join(cls.keep.name, "alone")
        result = diptych("continuum", QUICK, *LONG, "--output", cls.alone, "--quiet")
        assert result.returncode == 0, result.stderr

    @classmethod
    def tearDownClass(cls):
        cls.keep.cleanup()

    def interrupt(self, signal_number, name, size, *words):
        """Starts a run and sends a signal when a file of its folder has grown to a size."""
        process, path = start("continuum", QUICK, *LONG, *words, "--output", self.folder), os.path.join(self.folder, name)
        while process.poll() is None and not (os.path.exists(path) and os.path.getsize(path) > size):
            time.sleep(0.002)
        self.assertIsNone(process.poll(), "it ended before the signal")
        process.send_signal(signal_number)
        _, errors = process.communicate()
        return process.returncode, errors

    def expect_same_curves(self):
        for name in ["continuum.csv", "coarse/continuum.csv"]:
            expected, found = table(os.path.join(self.alone, name)), self.rows(name)
            for column in CURVES:
                scale = abs(expected[column]).max()
                numpy.testing.assert_allclose(found[column], expected[column], rtol=1e-4, atol=1e-4 * scale, err_msg=name + column)
        with h5py.File(os.path.join(self.folder, "continuum.h5"), "r") as file:
            self.assertEqual(len(file), 5)
        self.assertEqual([name for name in listing(self.folder) if "checkpoint" in name or name.endswith(".part")], [])

    def test_sigterm(self):
        code, errors = self.interrupt(signal.SIGTERM, "continuum.csv", 5000)
        self.assertEqual(code, 3, errors)
        self.assertIn("stopped on request", errors)
        self.assertIn("diptych continuum " + QUICK + " --output " + self.folder + " --resume", errors)
        self.assertIn("continuum_checkpoint.h5", listing(self.folder))
        steps = len(self.rows()["axial_strain"])
        self.assertLess(steps, 41)
        resumed = diptych("continuum", QUICK, *LONG, "--output", self.folder, "--resume")
        self.assertEqual(resumed.returncode, 0, resumed.stderr)
        self.assertNotIn("continuum panel: no checkpoint", resumed.stdout)
        self.expect_same_curves()

    def test_killed_after_a_checkpoint_and_in_the_coarse_run(self):
        every = setting(continuum_checkpoint_minutes=0)
        self.interrupt(signal.SIGKILL, "continuum.csv", 5000, *every)
        code, errors = self.interrupt(signal.SIGTERM, "coarse/continuum.csv", 3000, *every, "--resume")
        self.assertEqual(code, 3, errors)
        self.assertIn("coarse/continuum_checkpoint.h5", listing(self.folder))
        before = os.stat(os.path.join(self.folder, "continuum.h5")).st_mtime_ns
        self.continuum(*LONG, "--resume")
        self.assertEqual(os.stat(os.path.join(self.folder, "continuum.h5")).st_mtime_ns, before)  # the fine one was finished
        self.expect_same_curves()

    def test_killed_in_the_first_steps(self):
        """The stages of the rest are those of the loading, not of a loading that knows none."""
        self.interrupt(signal.SIGKILL, "continuum_checkpoint.h5", 0, *setting(continuum_checkpoint_minutes=0))
        self.assertLess(len(self.rows()["axial_strain"]), 20)
        self.continuum(*LONG, "--resume")
        self.expect_same_curves()
        stages = []
        for folder in (self.alone, self.folder):
            with h5py.File(os.path.join(folder, "continuum.h5"), "r") as file:
                stages.append([float(group.attrs["axial_strain"]) for group in file.values()])
        self.assertEqual(*stages)
        self.assertEqual(sorted(set(stages[1])), stages[1])

    def test_a_finished_run_is_not_run_again_but_one_with_other_keys_is(self):
        shutil.copytree(self.alone, self.folder)
        path = os.path.join(self.folder, "continuum.csv")
        again = diptych("continuum", QUICK, *LONG, "--output", self.folder, "--resume")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertIn("not run again", again.stdout)
        self.assertEqual(content(path), content(os.path.join(self.alone, "continuum.csv")))
        self.continuum(*LONG, *setting(continuum_friction_angle_peak=30), "--resume")
        self.assertGreater(self.rows()["stress_ratio"].max(), table(os.path.join(self.alone, "continuum.csv"))["stress_ratio"].max())

    def test_an_interrupted_one_of_another_sample_is_refused_and_nothing_changes(self):
        code, errors = self.interrupt(signal.SIGTERM, "continuum.csv", 3000)
        self.assertEqual(code, 3, errors)
        before = {name: content(os.path.join(self.folder, name)) for name in listing(self.folder)}
        self.assertIn("sample/seed", self.continuum(*LONG, *setting(sample_seed=7), "--resume", code=2).stderr)
        path = os.path.join(self.folder, "continuum_checkpoint.h5")
        self.assertEqual({name: content(os.path.join(self.folder, name)) for name in listing(self.folder)}, before)
        with open(path, "r+b") as file:
            file.truncate(os.path.getsize(path) // 2)
        self.assertIn(path, self.continuum(*LONG, "--resume", code=2).stderr)

    def test_the_continuum_of_a_run_of_both_panels(self):
        words = SMALL + setting(continuum_initial_step=1e-4, continuum_max_step=1e-4, output_report="false")
        process = start("run", QUICK, *words, "--output", self.folder)
        path = os.path.join(self.folder, "continuum.csv")
        while process.poll() is None and not (os.path.exists(path) and os.path.getsize(path) > 3000):
            time.sleep(0.002)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate()
        self.assertEqual(process.returncode, 3, errors)
        self.assertIn("diptych run " + QUICK, errors)
        resumed = diptych("run", QUICK, *words, "--output", self.folder, "--resume")
        self.assertEqual(resumed.returncode, 0, resumed.stderr)
        self.assertIn("the grains are finished", resumed.stdout)
        self.assertEqual(self.rows()["axial_strain"][-1], 0.01)
        self.assertIn("comparison.json", listing(self.folder))


@unittest.skipUnless(shutil.which("mpirun"), "mpirun is not installed (openmpi-bin)")
class Processes(Folder):
    def on_two(self, *words):
        return subprocess.run(["mpirun", "-np", "2", "--oversubscribe", PROGRAM, *words, "--output", self.folder], env=ENVIRONMENT,
                              capture_output=True, text=True, timeout=1500)  # processes that wait for each other are slow beside a third

    def expect_same_curve(self, words):
        together = self.on_two("continuum", QUICK, *words, "--quiet")
        self.assertEqual(together.returncode, 0, together.stderr)
        two = self.rows()
        self.continuum(*words)
        for name in CURVES:
            one = self.rows()[name]
            numpy.testing.assert_allclose(two[name], one, rtol=1e-3, atol=1e-3 * abs(one).max(), err_msg=name)
        return together

    def test_a_rectangle(self):
        self.expect_same_curve(RECTANGLE + setting(continuum_law="cosserat_mohr_coulomb"))

    def test_a_grain_sample_with_its_own_stress(self):
        """Only the first process prepares grains and maps their stress."""
        together = self.expect_same_curve(SMALL + setting(continuum_initial_stress="mapped"))
        self.assertEqual(together.stdout, "")

    def test_one_by_itself_shares_no_session_folder(self):
        """With one, those that start at once fail: the first that ends removes the folder of all."""
        with tempfile.TemporaryDirectory() as temporary:
            taken = write(os.path.join(temporary, f"ompi.{socket.gethostname()}.{os.geteuid()}"), "not a folder")
            result = subprocess.run([PROGRAM, "material-point", QUICK, "--output", self.folder, "--quiet"], capture_output=True, text=True,
                                    env=dict(ENVIRONMENT, TMPDIR=temporary))
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(content(taken), b"not a folder")

    def test_wrong_input_is_told_once_and_nothing_is_written(self):
        result = self.on_two("continuum", QUICK, "--set", "sample/grians=3")
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(result.stderr.count("sample/grians"), 2)  # both in the one message
        self.assertFalse(os.path.exists(self.folder))
        os.mkdir(self.folder)
        write(os.path.join(self.folder, "mine.txt"), "mine")
        result = self.on_two("continuum", QUICK, *RECTANGLE)  # only the first process sees that
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(result.stderr.count("holds other files"), 1)


    def test_what_the_first_cannot_write_ends_all(self):
        """Only the first process writes rows, while the others are on their way into the next step."""
        words = ["continuum", QUICK, *RECTANGLE, *setting(continuum_initial_step=1e-4, continuum_max_step=1e-4), "--output", self.folder, "--quiet"]
        process = subprocess.Popen(["mpirun", "-np", "2", "--oversubscribe", PROGRAM, *words], env=ENVIRONMENT, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        while process.poll() is None and not os.path.exists(os.path.join(self.folder, "continuum.csv")):
            time.sleep(0.01)
        os.rename(self.folder, self.folder + "_moved")
        _, errors = process.communicate(timeout=1500)
        self.assertEqual(process.returncode, 4, errors)
        self.assertIn(self.folder, errors)

    def test_other_commands_run_on_one_process(self):
        result = self.on_two("run", QUICK)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn("mpirun", result.stderr)
        self.assertFalse(os.path.exists(self.folder))


if __name__ == "__main__":
    main()
