#!/usr/bin/env python3
# diptych: files beside a scene are found from anywhere, and results do not depend on the units
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: units_test.py PROGRAM SOURCE_DIR [unittest arguments]."""

import os
import tempfile
import unittest

from running import QUICK, SMALL, diptych, history, main, setting, write

FEW = SMALL + setting(sample_grains=150, output_report="false")


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
