# diptych: every wrong key of a scene is refused by name, and nothing is written
# SPDX-License-Identifier: LGPL-2.1-or-later
import os
import re

from running import diptych, finished, Folder, QUICK, setting, SMALL, write

ROW = [f"{x},0.5,0.5" for x in range(12)]  # grains beside each other
PERIODIC, WALLS = setting(discrete_lateral="periodic"), setting(discrete_lateral="rigid_walls")
BY_TABLE = setting(sample_radius_distribution="table")
RECTANGLE = setting(continuum_mesh="rectangle", continuum_rectangle_width=9, continuum_rectangle_height=9)


def drive(wall, text):
    return ["--set", f"discrete/drive_{wall}={text}"]


def grains(*rows, first="x,y,r"):
    """Words for a sample of the file grains.csv, and what stands in it."""
    return setting(sample_file="grains.csv"), "".join(row + "\n" for row in (first, *rows))


class WrongKeys(Folder):
    """Exit code 2, key, value and place in the message, no folder. Each key by itself: tests/python/scenes_test.py."""

    def expect_wrong(self, words, *texts, command="discrete"):
        with self.subTest(command=command, words=words):
            self.expect(2, [command, QUICK, *SMALL, *words, "--output", self.folder, "--quiet"], *texts)

    def test_values_files_and_drives(self):
        for words, *texts in (
                (setting(sample_grains=-4), "--set sample/grains=-4", "sample/grains = '-4'", "a whole number from 10"),
                (setting(sample_file="no_such.csv"), "no_such.csv", "sample/file"),
                (setting(discrete_method="imported", discrete_file="no_such.h5"), "no_such.h5", "discrete/file"),
                (BY_TABLE + setting(sample_radius_table="no_such.csv"), "no_such.csv", "sample/radius_table"),
                (drive("lower_x", "velocity no_such.csv"), "no_such.csv", "discrete/drive_lower_x"),
                (drive("upper_y", "sideways 3"), "discrete/drive_upper_y", "'sideways 3'",
                 "auto, velocity V or force F"),
                (drive("upper_x", "velocity 1 2"), "discrete/drive_upper_x", "1 2"),
                (drive("upper_x", ""), "discrete/drive_upper_x"),
                (drive("upper_x", "force "), "discrete/drive_upper_x", "'force'"),
                (drive("left_x", "velocity 1"), "discrete/drive_left_x", "rigid_walls")):
            self.expect_wrong(words, *texts)

    def test_tables(self):
        """Wrong rows and columns are named with file and line."""
        times, curve = drive("lower_x", "velocity times.csv"), BY_TABLE + setting(sample_radius_table="curve.csv")
        above = setting(sample_lower_platen=0.2)
        for (words, text), *texts in (
                ((times, "time,velocity\n0,0\n2,1\n1,0\n"), "times.csv, line 4", "'time' = '1'"),
                ((drive("lower_x", "force times.csv"), "time,velocity\n0,0\n"), "times.csv, line 1", "'force'"),
                ((curve, "radius,passing\n0.3,0\n0.5,0.6\n0.4,1\n"), "curve.csv, line 4", "0.4"),
                ((curve, "radius,passing\n0.3,0\n0.4,0.6\n0.5,0.5\n0.7,1\n"), "curve.csv, line 4", "0.5"),
                (grains("0,0", first="x,y"), "grains.csv, line 1", "'r' is missing"),
                (grains("0,0,0.5", "1,0,-0.5"), "grains.csv, line 3", "'r' = '-0.5'"),
                (grains("0,0,0.5", "1,0"), "grains.csv, line 3", "2 fields"),
                (grains("0,0,0.5", "1,zero,0.5"), "grains.csv, line 3", "'y' = 'zero'"),
                (grains(*ROW, "2.5,1.2,0.5"), "grains.csv, line", "line 14", "overlap")):
            name = re.search(r"\w+\.csv", " ".join(words))[0]
            write(os.path.join(self.work, name), text)
            self.expect_wrong(words, *texts)
        write(os.path.join(self.work, "grains.csv"), grains(*ROW)[1])
        for words, *texts in ((above, "grains.csv, line 2", "lower platen", "0.2"), (PERIODIC, "sample/width"),
                              (setting(sample_upper_platen=0.9), "grains.csv, line 2", "upper platen", "0.9")):
            self.expect_wrong(setting(sample_file="grains.csv") + words, *texts)

    def test_keys_that_contradict_each_other(self):
        for words, *texts in (
                (setting(loading_mode="plane_shear"), "plane_shear", "periodic or rigid_walls", "end_grains"),
                (setting(sample_radius_max=0.8), "sample/radius_min", "sample/radius_max", "1.1"),
                (setting(sample_box_solid_fraction=0.88), "sample/box_solid_fraction", "sample/solid_fraction", "0.88"),
                (setting(sample_lower_platen=2, sample_upper_platen=1), "sample/lower_platen", "sample/upper_platen"),
                (BY_TABLE, "sample/radius_distribution", "sample/radius_table"),
                (setting(loading_axial_strain=0.012), "loading/axial_strain", "loading/stage_strain"),
                (setting(loading_mode="time", loading_stage_time=3), "loading/duration", "loading/stage_time")):
            self.expect_wrong(words, *texts)

    def test_what_the_continuum_does_not_have(self):
        """Loading modes and platens: tests/coupling/panels."""
        for words, key in ((setting(sample_rough_platens="true"), "sample/rough_platens"),
                           (WALLS + drive("right_x", "force -1"), "discrete/drive_right_x"),
                           (WALLS + drive("left_y", "velocity 1"), "discrete/drive_left_y")):
            self.expect_wrong(words, key, "diptych discrete", command="continuum")
        self.expect_wrong(PERIODIC, "continuum/platens", "diptych discrete", command="run")

    def test_meshes_that_do_not_fit_the_command(self):
        write(os.path.join(self.work, "broken.msh"), "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n")
        self.expect_wrong(RECTANGLE, "continuum/mesh", "outline", "diptych continuum", command="run")
        for words, *texts in ((RECTANGLE + setting(continuum_initial_stress="mapped"), "continuum/initial_stress",
                               "outline"),
                              (setting(continuum_mesh="rectangle"), "rectangle_width = 0"),
                              (setting(continuum_mesh="no_such.msh"), "continuum/mesh", "no_such.msh"),
                              (setting(continuum_mesh="broken.msh"), "continuum/mesh", "broken.msh"),
                              (setting(continuum_mesh="mesh.txt"), "continuum/mesh", ".msh or .geo")):
            self.expect_wrong(words, *texts, command="continuum")

    def test_a_solid_fraction_out_of_reach_is_named_with_what_can_be_reached(self):
        """Only the preparation can tell, so the folder with the scene is there by then."""
        words = setting(sample_target_solid_fraction=0.7, sample_seed=2)
        result = diptych("discrete", QUICK, *SMALL, *words, "--output", self.folder)
        self.expect_message(result, 2)
        reach = re.search("sample/target_solid_fraction = 0.7 is out of reach: (0.8[0-9]*) to (0.8[0-9]*)",
                          result.stderr)
        self.assertTrue(reach, result.stderr)
        self.assertLess(float(reach.group(1)) + 0.02, float(reach.group(2)))

    def test_keys_of_the_law_that_contradict_each_other_are_named_with_their_place(self):
        scene = write(os.path.join(self.work, "mine.prm"), "subsection continuum\n  set friction_angle_residual = "
                      "40\nend\n")
        self.expect(2, ["continuum", scene, "--output", self.folder],
                    "mine.prm, line 2: continuum/friction_angle_residual = '40'", "friction_angle_peak")

    def test_an_earlier_result_survives_wrong_input(self):
        """Nothing written over: also not where the mistake lies in a file of grains."""
        finished("discrete", QUICK, *SMALL, "--output", self.folder, "--quiet")
        words, text = grains(*ROW, "2.5,1.2,0.5")
        write(os.path.join(self.work, "grains.csv"), text)
        self.expect(2, ["discrete", QUICK, *SMALL, *words, "--output", self.folder, "--quiet"])
