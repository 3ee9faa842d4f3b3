# diptych: files beside a scene are found from anywhere, and results do not depend on the units
# SPDX-License-Identifier: LGPL-2.1-or-later
import json
import os

from running import finished, Folder, history, QUICK, setting, SMALL, temporary, write

FEW = SMALL + setting(sample_grains=150, output_report="false")


class Places(Folder):
    """Files that a scene names are found from the scene's own folder, wherever the program is started."""

    def test_files_beside_the_scene(self):
        os.mkdir(os.path.join(self.work, "data"))
        rows = "".join(f"{x},{y},0.5\n" for x in range(12) for y in (0.5, 1.5))
        write(os.path.join(self.work, "data", "grains.csv"), "x,y,r\n" + rows)
        write(os.path.join(self.work, "data", "speed.csv"), "time,velocity\n0,0\n5,-0.001\n")
        scene = write(os.path.join(self.work, "mine.json"), json.dumps({
            "sample": {"file": "data/grains.csv"}, "loading": {"mode": "time", "duration": 1, "stage_time": 1},
            "discrete": {"drive_upper_y": "velocity data/speed.csv", "step": 0.1}}))
        again = self.folder + "_again"
        for path, folder in ((scene, self.folder), (self.path("scene.prm"), again)):  # the echo holds whole paths
            self.expect(0, ["discrete", path, "--output", folder, "--quiet"], cwd="/")
            self.assertAlmostEqual(history(folder)["time"][-1], 1, places=9)
        # an override's from the working directory
        self.expect(2, ["discrete", scene, "--set", "sample/file=data/grains.csv", "--output", self.folder + "2"],
                    "/data/grains.csv", cwd="/")


class Units(Folder):
    """Stresses count in P, lengths in d, times in d sqrt(rho/P)."""

    COLUMNS = (("axial_strain", "-"), ("stress_ratio", "-"), ("volumetric_strain", "-"), ("syy", "stress"),
               ("upper_fy", "force"), ("time", "time"))

    def columns(self, command, scene, words, units):
        """Columns of a run, in units of its own d, rho and P."""
        diameter, density, pressure = units
        sizes = {"-": 1, "stress": pressure, "force": pressure * diameter,
                 "time": diameter * (density / pressure) ** 0.5}
        folder = temporary(self)
        result = finished(command, scene, *words, "--output", folder, "--quiet")
        self.assertNotIn("warning", result.stderr)
        rows = history(folder, command + ".csv")
        self.assertGreater(len(rows["time"]), 5)
        return {name: rows[name] / sizes[kind] for name, kind in self.COLUMNS}

    def expect_same(self, one, other, tolerance):
        for name, _ in self.COLUMNS:
            self.assertEqual(len(one[name]), len(other[name]))
            self.assertLess(abs(one[name] - other[name]).max() / max(1, abs(one[name]).max()), tolerance, name)

    def test_grains_in_units_that_are_powers_of_two_change_no_digit(self):
        """d = 2^-10, rho = 2^12, P = 2^14, time unit 2^-11: every product rounds alike in thousands of steps."""
        runs = []
        for units, time in (((1, 1, 1), 1), ((2.0**-10, 2.0**12, 2.0**14), 2.0**-11)):
            words = setting(sample_mean_diameter=units[0], sample_density=units[1], loading_pressure=units[2],
                            discrete_step=0.1 * time)
            runs.append(self.columns("discrete", QUICK, FEW + words, units))
        self.expect_same(*runs, 1e-12)

    def test_a_continuum_in_si_units(self):
        """d = 1 mm, 2600 kg/m2, 10 kPa, and the same scene with d = rho = P = 1. The solver stops at its tolerance."""
        scene = os.path.join(os.path.dirname(os.path.abspath(__file__)), "si_units.prm")
        plain = setting(sample_mean_diameter=1, sample_density=1, loading_pressure=1, discrete_step=0.1)
        runs = []
        for words, units in (([], (1e-3, 2600, 1e4)), (plain, (1, 1, 1))):
            rectangle = setting(continuum_mesh="rectangle", continuum_rectangle_width=40 * units[0],
                                continuum_rectangle_height=60 * units[0])
            runs.append(self.columns("continuum", scene, words + rectangle, units))
        self.expect_same(*runs, 1e-6)
