# diptych: scenes of the grains alone and the physics in their histories
# SPDX-License-Identifier: LGPL-2.1-or-later
import math
import os

import h5py
import numpy

from running import facts, finished, Folder, half_files, history, LOOSE, QUICK, setting, SMALL, temporary, write


class Scenes(Folder):
    """One small run of every kind, and one physical statement about each."""

    def run_small(self, *words):
        folder = temporary(self)
        finished("discrete", QUICK, *SMALL, *words, "--output", folder, "--quiet")
        rows = history(folder)
        self.assertLess(numpy.abs(rows["energy_residual"]).max(), 1e-10)
        self.assertLess(rows["momentum_residual"].max(), 1e-11)
        self.assertEqual(half_files(folder), [])
        return folder, rows

    def stage(self, folder, number, name):
        with h5py.File(os.path.join(folder, "discrete.h5"), "r") as file:
            group = file["stage_%04d" % number if number >= 0 else sorted(file)[number]]
            return group[name][()] if name in group else group.attrs[name]

    def test_rigid_walls_carry_the_pressure(self):
        """The right wall, M v' = P H - contacts: the sum over all steps of h (right_fx + P H) is -M v at the end, and
        its kinetic energy M v^2 / 2 cannot exceed that of all bodies. H is the height at mid-step."""
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
        """Smooth platens: every vertical section carries P x height, so s_xx = P but for the inertia of cell and
        grains. Rough ones push inwards, too, and the mean lies above P."""
        slow = dict(discrete_lateral="periodic", loading_inertial_number=3e-4, discrete_step=0.3)
        folder, rows = self.run_small(*setting(**slow, discrete_platen_friction=0, loading_horizontal_over_vertical=0))
        _, rough = self.run_small(*setting(**slow, loading_horizontal_over_vertical=0))
        self.assertLess(abs(rows["sxx"].mean() - 1), 0.03)
        self.assertGreater(rough["sxx"].mean(), rows["sxx"].mean())
        width, first = self.stage(folder, -1, "cell_width"), self.stage(folder, 0, "cell_width")
        self.assertAlmostEqual(rows["volumetric_strain"][-1], 1 - 0.99 * width / first, places=9)

    def test_plane_shear_carries_the_normal_pressure(self):
        """s_yy = 2 on the platen that is free to rise; its travel is the stage's; the dense sample dilates."""
        folder, rows = self.run_small(*setting(discrete_lateral="periodic", discrete_side_motion="velocity",
                                               loading_mode="plane_shear", loading_normal_pressure=2,
                                               loading_pressure=2))
        width = self.stage(folder, -1, "cell_width")
        self.assertLess(abs(rows["upper_fy"].mean() / width + 2), 0.02)
        self.assertLess(abs(rows["syy"].mean() - 2), 0.05)
        self.assertAlmostEqual(rows["shear_strain"][-1], 0.01, places=9)
        self.assertGreater(rows["upper_fx"].mean(), 0)
        self.assertLess(rows["axial_strain"][-1], 0)

    def test_a_shaken_box_comes_to_rest_and_its_floor_carries_the_weight(self):
        """Twenty discs of mass pi/4 under g = 1 weigh 5 pi; one more is fixed where nothing rests on it. The floor
        rises by 0.5 and sinks by 0.5: it ends where it began."""
        grains = ["1,7.5,0.3,1"] + ["%g,%g,0.5,0" % (1.1 + 1.2 * (k % 5), 1 + 1.1 * (k // 5)) for k in range(20)]
        sample = write(os.path.join(self.work, "grains.csv"), "x,y,r,fixed\n" + "".join(g + "\n" for g in grains))
        shaking = write(os.path.join(self.work, "shaking.csv"), "time,velocity\n0,0\n1,0.5\n2,0\n3,-0.5\n4,0\n")
        folder, rows = self.run_small(*setting(
            sample_file=sample, sample_lower_platen=0, sample_upper_platen=9, loading_mode="time", loading_duration=24,
            loading_stage_time=4, discrete_gravity_y=-1, discrete_lateral="rigid_walls",
            discrete_side_motion="velocity", discrete_step=0.04, discrete_drive_lower_y="velocity " + shaking))
        self.assertAlmostEqual(rows["time"][-1], 24, places=9)
        self.assertAlmostEqual(self.stage(folder, 1, "lower_y"), 0, places=9)
        self.assertAlmostEqual(self.stage(folder, -1, "lower_y"), 0, places=9)
        self.assertAlmostEqual(rows["lower_fy"][-10:].mean(), 5 * math.pi, delta=0.02)
        self.assertLess(rows["kinetic_energy"][-1], 1e-3 * rows["kinetic_energy"].max())
        fixed = self.stage(folder, -1, "grains/fixed") == 1
        self.assertEqual(self.stage(folder, -1, "grains/position")[fixed].tolist(), [[1, 7.5, 0]])
        self.assertEqual(numpy.abs(self.stage(folder, -1, "grains/velocity")[fixed]).max(), 0)

    def test_grains_in_free_fall_have_snapshots_although_nothing_touches(self):
        """Stages at t = 0.5, 1, ...: y falls by g t^2 / 2 = 2 at the end (exactly, but for h t / 2 of the scheme's
        first step)."""
        path = write(os.path.join(self.work, "grains.csv"), "x,y,r\n"
                     + "".join("%g,50,0.5\n" % (2 * k) for k in range(12)))
        folder, _ = self.run_small(*setting(
            sample_file=path, sample_lower_platen=0, sample_upper_platen=60, discrete_lateral="none",
            loading_mode="time", loading_duration=2, loading_stage_time=0.5, discrete_gravity_y=-1))
        with h5py.File(os.path.join(folder, "discrete.h5"), "r") as file:
            self.assertEqual(len(file), 5, "the sample as it was read and four stages")
        self.assertTrue(numpy.allclose(self.stage(folder, -1, "grains/position")[:, 1], 48, atol=0.11))

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
