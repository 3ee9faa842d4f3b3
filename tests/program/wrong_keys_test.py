#!/usr/bin/env python3
# diptych: every wrong key of a scene is refused by name, and nothing is written
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: wrong_keys_test.py PROGRAM SOURCE_DIR [unittest arguments]."""

import concurrent.futures
import os
import re
import tempfile
import unittest

from running import content, diptych, listing, main, QUICK, setting, SMALL, write


NUMBER = r"[-+0-9.e]+"
FREE = ("any text", "the name of a file", "outline, rectangle or a .msh or .geo file")  # what is checked only where it is used


def explained_keys(section):
    """(key, what is allowed) of every key of a section, as `diptych explain` prints them."""
    text = diptych("explain", section).stdout
    return re.findall(r"^  (\w+) = .*?  \[[^\]]*\]  (.+)$", text, re.MULTILINE)


def wrong_value(allowed, above):
    """A value that a key must refuse, from the text that says what it allows; None for keys that take any text."""
    bounds = re.search("number(?:s)? from (" + NUMBER + ") to (" + NUMBER + ")", allowed)
    if bounds:
        low, high = float(bounds.group(1)), float(bounds.group(2))
        if "whole" in allowed:
            return str(int(high) + 1) if above else str(int(low) - 1)
        return repr(2 * high + 1) if above else repr(low - 0.01 * abs(low) - (0.1 if low == 0 else 0))
    return None if allowed in FREE else "perhaps"


class WrongKeys(unittest.TestCase):
    """Exit code 2, key, value and place in the message, and no output folder."""

    def setUp(self):
        keep = tempfile.TemporaryDirectory()
        self.addCleanup(keep.cleanup)
        self.work, self.out = keep.name, os.path.join(keep.name, "out")

    def path(self, name):
        return os.path.join(self.work, name)

    def expect_wrong(self, words, *texts, command="discrete"):
        result = diptych(command, QUICK, *SMALL, *words, "--output", self.out, "--quiet")
        self.assertEqual(result.returncode, 2, result.stderr)
        for text in texts:
            self.assertIn(text, result.stderr)
        self.assertEqual(os.path.exists(self.out) and listing(self.out), False, result.stderr)

    def expect_refused(self, section):
        keys = explained_keys(section)
        self.assertGreater(len(keys), 10)
        cases = [(key, wrong_value(allowed, k % 2 == 1), allowed) for k, (key, allowed) in enumerate(keys)]
        cases += [(key, "rough", allowed) for key, _, allowed in cases if "number" in allowed][:1]

        def run(case):
            folder = self.path("out_" + case[0] + "_" + case[1])
            return diptych("discrete", QUICK, "--set", section + "/" + case[0] + "=" + case[1], "--output", folder), folder

        cases = [case for case in cases if case[1] is not None]
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            for (key, value, allowed), (result, folder) in zip(cases, pool.map(run, cases)):
                with self.subTest(key=key, value=value):
                    self.assertEqual(result.returncode, 2, result.stderr)
                    for text in ["--set " + section + "/" + key + "=" + value, section + "/" + key + " = '" + value + "'", allowed]:
                        self.assertIn(text, result.stderr)
                    self.assertFalse(os.path.exists(folder))
        return {key for key, allowed in keys if allowed in FREE}

    def test_every_key_of_sample(self):
        self.assertEqual(self.expect_refused("sample"), {"file", "radius_table"})

    def test_every_key_of_loading(self):
        self.assertEqual(self.expect_refused("loading"), set())

    def test_every_key_of_discrete(self):
        self.assertEqual(self.expect_refused("discrete"), {"file"})

    def test_every_key_of_continuum(self):
        self.assertEqual(self.expect_refused("continuum"), {"mesh"})

    def test_files_that_are_not_there(self):
        self.expect_wrong(setting(continuum_mesh="no_such.msh"), "continuum/mesh", "no_such.msh", command="continuum")
        self.expect_wrong(setting(sample_file="no_such.csv"), "no_such.csv", "sample/file")
        self.expect_wrong(setting(discrete_method="imported", discrete_file="no_such.h5"), "no_such.h5", "discrete/file")
        self.expect_wrong(setting(sample_radius_distribution="table", sample_radius_table="no_such.csv"), "no_such.csv",
                          "sample/radius_table")
        self.expect_wrong(setting(discrete_drive_lower_x="velocity no_such.csv"), "no_such.csv", "discrete/drive_lower_x")

    def test_texts_of_drives(self):
        for name in ["lower_x", "upper_y", "left_x", "right_y"]:
            self.expect_wrong(["--set", "discrete/drive_" + name + "=sideways 3"], "discrete/drive_" + name, "'sideways 3'",
                              "auto, velocity V or force F")
        for text in ["velocity", "velocity 1 2", ""]:
            self.expect_wrong(["--set", "discrete/drive_upper_x=" + text], text.replace("velocity ", ""), "discrete/drive_upper_x")

    def test_a_drive_with_a_blank_in_the_place_of_its_number(self):
        self.expect_wrong(["--set", "discrete/drive_upper_x=force "], "discrete/drive_upper_x", "'force'")

    def test_a_drive_of_a_wall_that_is_not_there(self):
        self.expect_wrong(["--set", "discrete/drive_left_x=velocity 1"], "discrete/drive_left_x", "rigid_walls")

    def test_tables_that_are_not_ascending(self):
        times = write(self.path("times.csv"), "time,velocity\n0,0\n2,1\n1,0\n")
        self.expect_wrong(["--set", "discrete/drive_lower_x=velocity " + times], "times.csv, line 4", "'time' = '1'")
        self.expect_wrong(["--set", "discrete/drive_lower_x=force " + times], "times.csv, line 1", "'force'")
        curve = write(self.path("curve.csv"), "radius,passing\n0.3,0\n0.5,0.6\n0.4,1\n")
        self.expect_wrong(setting(sample_radius_distribution="table", sample_radius_table=curve), "curve.csv, line 4", "0.4")
        falling = write(self.path("falling.csv"), "radius,passing\n0.3,0\n0.4,0.6\n0.5,0.5\n0.7,1\n")
        self.expect_wrong(setting(sample_radius_distribution="table", sample_radius_table=falling), "falling.csv, line 4", "0.5")

    def grains(self, *rows):
        return setting(sample_file=write(self.path("grains.csv"), "x,y,r\n" + "".join(row + "\n" for row in rows)))

    def test_grains_of_a_csv_that_overlap(self):
        rows = [str(x) + ",0.5,0.5" for x in range(12)]
        self.expect_wrong(self.grains(*rows, "2.5,1.2,0.5"), "grains.csv, line", "line 14", "overlap")

    def test_grains_of_a_csv_outside_the_platens(self):
        rows = [str(x) + ",0.5,0.5" for x in range(12)]
        self.expect_wrong(self.grains(*rows) + setting(sample_lower_platen=0.2), "grains.csv, line 2", "lower platen", "0.2")
        self.expect_wrong(self.grains(*rows) + setting(sample_upper_platen=0.9), "grains.csv, line 2", "upper platen", "0.9")

    def test_columns_of_a_csv(self):
        path = write(self.path("short.csv"), "x,y\n0,0\n1,0\n")
        self.expect_wrong(setting(sample_file=path), "short.csv, line 1", "'r' is missing")
        self.expect_wrong(self.grains("0,0,0.5", "1,0,-0.5"), "grains.csv, line 3", "'r' = '-0.5'")
        self.expect_wrong(self.grains("0,0,0.5", "1,0"), "grains.csv, line 3", "2 fields")
        self.expect_wrong(self.grains("0,0,0.5", "1,zero,0.5"), "grains.csv, line 3", "'y' = 'zero'")

    def test_a_truncated_snapshot_file(self):
        folder = self.path("earlier")
        self.assertEqual(diptych("discrete", QUICK, *SMALL, "--output", folder, "--quiet").returncode, 0)
        path = os.path.join(folder, "discrete.h5")
        with open(path, "r+b") as file:
            file.truncate(os.path.getsize(path) // 2)
        self.expect_wrong(setting(sample_file=path), path)

    def test_keys_that_contradict_each_other(self):
        for words, texts in [
                (setting(loading_mode="plane_shear"), ["plane_shear", "periodic or rigid_walls", "end_grains"]),
                (setting(sample_radius_max=0.8), ["sample/radius_min", "sample/radius_max", "1.1"]),
                (setting(sample_box_solid_fraction=0.88), ["sample/box_solid_fraction", "sample/solid_fraction", "0.88"]),
                (setting(sample_lower_platen=2, sample_upper_platen=1), ["sample/lower_platen", "sample/upper_platen"]),
                (setting(sample_radius_distribution="table"), ["sample/radius_distribution", "sample/radius_table"]),
                (setting(loading_axial_strain=0.012), ["loading/axial_strain", "loading/stage_strain"]),
                (setting(loading_mode="time", loading_stage_time=3), ["loading/duration", "loading/stage_time"])]:
            with self.subTest(words=words):
                self.expect_wrong(words, *texts)

    def test_a_periodic_sample_from_a_file_needs_its_width(self):
        rows = [str(x) + ",0.5,0.5" for x in range(12)]
        self.expect_wrong(self.grains(*rows) + setting(discrete_lateral="periodic"), "sample/width")

    def test_a_solid_fraction_out_of_reach_is_named_with_what_can_be_reached(self):
        """Only the preparation can tell, so the folder with the scene is there by then."""
        result = diptych("discrete", QUICK, *SMALL, *setting(sample_target_solid_fraction=0.7, sample_seed=2), "--output", self.out, "--quiet")
        self.assertEqual(result.returncode, 2, result.stderr)
        reach = re.search("sample/target_solid_fraction = 0.700 is out of reach: (0.8[0-9]+) to (0.8[0-9]+)", result.stderr)
        self.assertTrue(reach, result.stderr)
        self.assertLess(float(reach.group(1)) + 0.02, float(reach.group(2)))
        self.assertEqual([name for name in listing(self.out) if name.endswith(".part")], [])

    def test_what_the_continuum_does_not_have(self):
        sides = setting(discrete_lateral="rigid_walls")
        for words, key in [(setting(discrete_lateral="periodic"), "continuum/platens"),
                           (setting(loading_mode="shear", continuum_platens="smooth"), "loading/mode"),
                           (setting(sample_rough_platens="true"), "sample/rough_platens"),
                           (["--set", "discrete/drive_upper_y=velocity -1"], "discrete/drive_upper_y"),
                           (sides + ["--set", "discrete/drive_right_x=force -1"], "discrete/drive_right_x"),
                           (sides + ["--set", "discrete/drive_left_y=velocity 1"], "discrete/drive_left_y")]:
            for command in ["run", "continuum"]:
                self.expect_wrong(words, key, "diptych discrete", command=command)

    def test_meshes_that_do_not_fit_the_command(self):
        rectangle = setting(continuum_mesh="rectangle", continuum_rectangle_width=9, continuum_rectangle_height=9)
        self.expect_wrong(rectangle, "continuum/mesh", "outline", "diptych continuum", command="run")
        self.expect_wrong(rectangle + setting(continuum_initial_stress="mapped"), "continuum/initial_stress", "outline",
                          command="continuum")
        self.expect_wrong(setting(continuum_mesh="rectangle"), "rectangle_width = 0", command="continuum")
        triangles = write(self.path("broken.msh"), "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n")
        self.expect_wrong(setting(continuum_mesh=triangles), "continuum/mesh", "broken.msh", command="continuum")
        self.expect_wrong(setting(continuum_mesh=write(self.path("mesh.txt"), "")), "continuum/mesh", ".msh or .geo", command="continuum")

    def test_keys_of_the_law_that_contradict_each_other_are_named_with_their_place(self):
        scene = write(self.path("mine.prm"), "subsection continuum\n  set friction_angle_residual = 40\nend\n")
        result = diptych("continuum", scene, "--output", self.out)
        self.assertEqual(result.returncode, 2, result.stderr)
        for text in ["mine.prm, line 2: continuum/friction_angle_residual = '40'", "friction_angle_peak"]:
            self.assertIn(text, result.stderr)
        self.assertFalse(os.path.exists(self.out))

    def test_studies_that_cannot_be(self):
        self.expect_wrong(["--study", "grid"], "--study", "'grid'", "step")
        self.expect_wrong(setting(discrete_step="auto") + ["--study", "step"], "--study step", "discrete/step")

    def test_an_earlier_result_survives_wrong_input(self):
        """Nothing written over: also not where the mistake lies in a file of grains."""
        self.assertEqual(diptych("discrete", QUICK, *SMALL, "--output", self.out, "--quiet").returncode, 0)
        before = {name: content(os.path.join(self.out, name)) for name in listing(self.out)}
        rows = [str(x) + ",0.5,0.5" for x in range(12)]
        result = diptych("discrete", QUICK, *SMALL, *self.grains(*rows, "2.5,1.2,0.5"), "--output", self.out, "--quiet")
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual({name: content(os.path.join(self.out, name)) for name in listing(self.out)}, before)


if __name__ == "__main__":
    main()
