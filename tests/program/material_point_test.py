# diptych: one point of the continuum along a loading
# SPDX-License-Identifier: LGPL-2.1-or-later
import math
import os

from running import finished, Folder, history, listing, QUICK, setting, write

PLASTIC = setting(continuum_law="mohr_coulomb", continuum_hardening="constant", continuum_friction_angle_peak=30,
                  continuum_cohesion=0.1)


class MaterialPoint(Folder):
    def test_perfectly_plastic_mohr_coulomb(self):
        """s1 = s3 Kp + 2 c sqrt(Kp) with Kp = (1 + sin phi)/(1 - sin phi) = 3: s1 = 3 + 0.2 sqrt 3, t/s =
        (s1-1)/(s1+1)."""
        words = PLASTIC + setting(continuum_law="cosserat_mohr_coulomb", loading_axial_strain=0.04)
        result = finished("material-point", QUICK, *words, "--output", self.folder)
        rows, s1 = history(self.folder, "material_point.csv"), 3 + 0.2 * math.sqrt(3)
        self.assertAlmostEqual(rows["stress_ratio"][-1], (s1 - 1) / (s1 + 1), places=6)
        self.assertEqual(rows["axial_strain"][-1], 0.04)
        self.assertIn("%.6g at 4 %% axial strain" % rows["stress_ratio"][-1], result.stdout)
        self.assertEqual(listing(self.folder), ["material_point.csv", "provenance.json", "scene.prm"])

    def test_an_undrained_test_is_one_line(self):
        """At constant volume and psi = 0 the mean stress stays 1, so t = sin 30 + 0.1 cos 30."""
        words = PLASTIC + setting(continuum_dilatancy_angle_peak=0, loading_axial_strain=0.04)
        finished("material-point", QUICK, *words, "--path", "constant_volume", "--output", self.folder)
        rows = history(self.folder, "material_point.csv")
        self.assertAlmostEqual(rows["stress_ratio"][-1], 0.5 + 0.1 * math.cos(math.pi / 6), places=6)
        self.assertLess(abs(rows["volumetric_strain"]).max(), 1e-15)

    def test_a_table_drives_the_point_and_a_stress_beyond_the_strength_keeps_what_was_reached(self):
        """Loading, unloading to half of it with E / (1 - nu^2) = 520.8, then a stress above s1 = 3 + 0.2 sqrt 3 =
        3.3464."""
        words = PLASTIC + setting(continuum_youngs_modulus=500)
        table = write(os.path.join(self.work, "path.csv"), "# an unloading\nprogress, syy, sxx, exy\n"
                      "0, 1, 1, 0\n1, 3, 1, 0\n2, 1.5, 1, 0\n3, 4, 1, 0\n")
        self.expect(3, ["material-point", QUICK, *words, "--path", table, "--output", self.folder],
                    "the strength is reached at stress ratio 0.5398", "prescribe a strain",
                    "reached sxx = 1, syy = 3.346")
        rows = history(self.folder, "material_point.csv")
        self.assertAlmostEqual(rows["syy"][-1], 3 + 0.2 * math.sqrt(3), places=4)
        unloading = rows["progress"].searchsorted([1, 2])
        (syy, again), (eyy, end) = rows["syy"][unloading], rows["eyy"][unloading]
        self.assertAlmostEqual((syy - again) / (eyy - end), 500 / 0.96, places=4)

    def test_the_point_starts_at_k0(self):
        """syy = P / K0 = 2, so t/s = 1/3; a table starts there too."""
        table = write(os.path.join(self.work, "path.csv"), "eyy, syy, exy\n0, 2, 0\n0.001, 2, 0\n")
        for path, row in (("drained", 0), (table, -1)):
            finished("material-point", QUICK, *PLASTIC, "--set", "continuum/k0=0.5", "--path", path, "--output",
                     self.folder, "--overwrite")
            self.assertAlmostEqual(history(self.folder, "material_point.csv")["syy"][row], 2, places=9)
        self.expect(2, ["continuum", QUICK, "--set", "continuum/k0=0.5", "--output", self.folder, "--overwrite"],
                    "continuum/k0 = 0.5", "law's point")

    def test_a_wrong_table_is_refused_with_file_line_and_column(self):
        for text, place, words in (
                ("eyy,sxx\n0,1\n1,1\n", "header", "2 of the columns prescribe strain or stress; give three of exx"),
                ("eyy,sxx,exy,volume\n0,1,0,0\n1,1,0,0\n", "header", "4 of the columns"),
                ("eyy,sxx,exz\n0,1,0\n", "line 1", "unknown column 'exz'; the nearest is 'exx'"),
                ("eyy,sxx,exy\n0,1,0\n", "path.csv", "the path has one row"),
                ("volume,mean_stress,exy\n0,1,0\n0,1,0\n", "header", "one follows from the others"),
                ("eyy,sxx,exy\n0,100,0\n1,100,0\n", "line 2", "column 'sxx' = 100 is not the stress of the start"),
                ("eyy,sxx,exy,progress\n0,1,0,0\n0.1,1,0,0\n", "line 3", "column 'progress'"),
                ("eyy,sxx,exy\n0,1,0\n0.1,many,0\n", "line 3", "column 'sxx' = 'many'")):
            table = write(os.path.join(self.work, "path.csv"), text)
            self.expect(2, ["material-point", QUICK, "--path", table, "--output", self.folder], table, place, words)
        self.expect(2, ["material-point", QUICK, "--path", "constant_volum", "--output", self.folder],
                    "nearest is 'constant_volume'")
