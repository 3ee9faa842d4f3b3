#!/usr/bin/env python3
# diptych: one point of the continuum along a loading
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: material_point_test.py PROGRAM SOURCE_DIR [unittest arguments]."""

import csv
import math
import os
import tempfile
import unittest

from running import diptych, listing, main, QUICK, setting, write


class MaterialPoint(unittest.TestCase):
    def setUp(self):
        keep = tempfile.TemporaryDirectory()
        self.addCleanup(keep.cleanup)
        self.folder = os.path.join(keep.name, "out")

    def material_point(self, code, *words):
        result = diptych("material-point", QUICK, *words, "--output", self.folder, "--quiet")
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        return result

    def test_perfectly_plastic_mohr_coulomb(self):
        """s1 = s3 Kp + 2 c sqrt(Kp) with Kp = (1 + sin phi)/(1 - sin phi) = 3: s1 = 3 + 0.2 sqrt 3, t/s = (s1-1)/(s1+1)."""
        words = setting(continuum_law="cosserat_mohr_coulomb", continuum_hardening="constant", continuum_friction_angle_peak=30,
                        continuum_cohesion=0.1, loading_axial_strain=0.04)
        result = diptych("material-point", QUICK, *words, "--output", self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(os.path.join(self.folder, "material_point.csv")) as file:
            rows = list(csv.DictReader(file))
        s1 = 3 + 0.2 * math.sqrt(3)
        self.assertAlmostEqual(float(rows[-1]["stress_ratio"]), (s1 - 1) / (s1 + 1), places=6)
        self.assertEqual(float(rows[-1]["axial_strain"]), 0.04)
        self.assertIn("%.6g at 4 %% axial strain" % float(rows[-1]["stress_ratio"]), result.stdout)
        self.assertIn("peak stress ratio", result.stdout)
        self.assertEqual(listing(self.folder), ["material_point.csv", "provenance.json", "scene.prm"])

    def test_a_path_that_ends_early_keeps_what_was_reached(self):
        """Stresses of 1e10 P x 1e-3 round to 1e-9 P: no lateral strain holds the pressure to 1e-10 of it."""
        weak = setting(continuum_friction_angle_peak=22, continuum_friction_angle_residual=17, continuum_dilatancy_angle_peak=10,
                       continuum_softening_strain=0.8, continuum_hardening="exponential", continuum_initial_step=0.001)
        result = self.material_point(3, *weak, *setting(continuum_youngs_modulus=1e10))
        self.assertIn("no lateral strain", result.stderr)
        with open(os.path.join(self.folder, "material_point.csv")) as file:
            self.assertEqual(len(file.readlines()), 3)  # names, the start and the step that still held

    def test_a_path_that_cannot_be_is_wrong_input(self):
        result = diptych("material-point", QUICK, *setting(loading_axial_strain=1.5), "--output", self.folder)
        self.assertEqual(result.returncode, 2)
        self.assertIn("loading/axial_strain", result.stderr)
        self.assertFalse(os.path.exists(self.folder))

    def test_a_folder_that_is_no_result_is_left_alone(self):
        os.mkdir(self.folder)
        write(os.path.join(self.folder, "mine.txt"), "mine")
        self.material_point(2)
        self.assertEqual(listing(self.folder), ["mine.txt"])


if __name__ == "__main__":
    main()
