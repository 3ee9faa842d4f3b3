#!/usr/bin/env python3
# diptych: one point of the continuum along a loading
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: material_point_test.py PROGRAM SOURCE_DIR [unittest arguments]."""

import math

from running import diptych, finished, Folder, history, listing, main, QUICK, setting


class MaterialPoint(Folder):
    def test_perfectly_plastic_mohr_coulomb(self):
        """s1 = s3 Kp + 2 c sqrt(Kp) with Kp = (1 + sin phi)/(1 - sin phi) = 3: s1 = 3 + 0.2 sqrt 3, t/s = (s1-1)/(s1+1)."""
        words = setting(continuum_law="cosserat_mohr_coulomb", continuum_hardening="constant", continuum_friction_angle_peak=30,
                        continuum_cohesion=0.1, loading_axial_strain=0.04)
        result = finished("material-point", QUICK, *words, "--output", self.folder)
        rows, s1 = history(self.folder, "material_point.csv"), 3 + 0.2 * math.sqrt(3)
        self.assertAlmostEqual(rows["stress_ratio"][-1], (s1 - 1) / (s1 + 1), places=6)
        self.assertEqual(rows["axial_strain"][-1], 0.04)
        self.assertIn("%.6g at 4 %% axial strain" % rows["stress_ratio"][-1], result.stdout)
        self.assertEqual(listing(self.folder), ["material_point.csv", "provenance.json", "scene.prm"])

    def test_a_path_that_ends_early_keeps_what_was_reached(self):
        """Stresses of 1e10 P x 1e-3 round to 1e-9 P: no lateral strain holds the pressure to 1e-10 of it."""
        weak = setting(continuum_friction_angle_peak=22, continuum_friction_angle_residual=17, continuum_dilatancy_angle_peak=10,
                       continuum_softening_strain=0.8, continuum_hardening="exponential", continuum_initial_step=0.001)
        result = diptych("material-point", QUICK, *weak, *setting(continuum_youngs_modulus=1e10), "--output", self.folder)
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertIn("no lateral strain", result.stderr)
        rows = history(self.folder, "material_point.csv")
        self.assertEqual(len(rows["axial_strain"]), 2)  # the start and the step that still held


if __name__ == "__main__":
    main()
