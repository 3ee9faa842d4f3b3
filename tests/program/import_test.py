# diptych: another code's files from the command line to the report
# SPDX-License-Identifier: LGPL-2.1-or-later
import glob
import json
import os

import h5py
import numpy

from running import bits, content, diptych, Folder, history, member_of, QUICK, read_json, setting, SMALL, SOURCE, write

FOREIGN = os.path.join(SOURCE, "tests", "foreign")
COARSE = setting(continuum_element_size=3, comparison_coarse_element_size=0, output_report="false")


def files(pattern):
    return sorted(glob.glob(os.path.join(FOREIGN, pattern)))


LAMMPS = files("lammps/*.dump") + files("lammps/walls.txt")
MERCURY = [f for f in files("mercurydpm/Biaxial2D.*") if not f.endswith((".cpp", ".walls.txt"))]
YADE = files("yade/spheres_*.txt") + files("yade/contacts_*.txt") + files("yade/walls_*.txt")
CSV = files("plain_csv/*.csv")


class Case(Folder):
    def setUp(self):
        super().setUp()
        self.folder = self.work

    def done(self, *words):
        return self.expect(0, words).stdout

    def refused(self, *words, says):
        self.expect(2, words, says)


class Import(Case):
    def test_a_sample_of_lammps_beside_the_continuum(self):
        told = self.done("import", "lammps", *LAMMPS, "--output", self.path("mine"))
        self.assertIn("not in the files: rotations", told)
        self.done("run", self.path("mine", "scene.prm"), "--output", self.path("both"), "--quiet", *COARSE,
                  *setting(output_report="true"))
        self.assertEqual(bits(self.path("mine", "discrete.h5")), bits(self.path("both", "discrete.h5")))
        self.assertEqual(len(read_json(self.path("both"), "comparison.json")["stages"]), 3)
        # The mapped stress of the last stage: its mean over the mesh is that of the contacts, which truth.json has.
        frame = read_json(FOREIGN, "lammps", "truth.json")["frames"]["480000"]
        truth = -numpy.array(frame["mean_stress_from_contacts"])
        grains = history(self.path("both"))
        self.assertAlmostEqual(grains["sxx"][-1] / truth[0, 0], 1, delta=1e-6)
        self.assertAlmostEqual(grains["syy"][-1] / truth[1, 1], 1, delta=1e-6)
        page = content(self.path("both", "report.html")).decode()
        self.assertIn("Grains imported from lammps", page)
        self.assertIn("Not in the files, and left out below: rotations", page)
        told = self.done("compare", self.path("both"))
        self.assertRegex(told, r"grains [\d.]+, continuum [\d.]+ \(sides [\d.]+, platens")
        self.done("report", self.path("both"), "--quiet")

    def test_frictions_are_measured_and_guesses_are_told(self):
        """Walls of in.biaxial have friction 0.3, grains 0.5; without forces of walls their friction is unknown."""
        told = self.done("import", "lammps", *LAMMPS, "--output", self.path("mine"))
        for text in ("T/N up to 0.3; the scene takes continuum/platens = frictional", "not fitted to these grains",
                     "loading/pressure = 999.998, from the force on the right wall / height in frame step 120000",
                     "T/N up to 0.5; the scene takes it as discrete/friction"):
            self.assertIn(text, told)
        scene = content(self.path("mine", "scene.prm")).decode()
        for text in ("platens = frictional", "platen_friction = 0.3", "platen_slip_length = 0", "set friction = 0.5"):
            self.assertIn(text, scene)
        self.assertNotIn("not used", self.expect(0, ["run", self.path("mine", "scene.prm"), "--check"]).stderr)
        told = self.done("import", "lammps", *files("lammps/[cg]*.dump"), "--walls-touch", "--output",
                         self.path("guess"))
        for text in ("no side walls are in the files: the scene takes discrete/lateral = end_grains",
                     "no forces on walls are in the files: the scene takes continuum/platens = rough",
                     "from the mean horizontal stress of the contacts in frame step 120000"):
            self.assertIn(text, told)

    def test_the_continuum_is_loaded_as_the_walls_moved(self):
        self.done("import", "lammps", *LAMMPS, "--output", self.path("mine"), "--quiet")
        scene = self.path("mine", "scene.prm")
        self.done("continuum", scene, "--output", self.path("pressed"), "--quiet", *COARSE)
        self.done("continuum", scene, "--output", self.path("moved"), "--quiet", *COARSE, "--set",
                  "discrete/side_motion=velocity")
        grains = history(self.path("mine"))
        moved = history(self.path("moved"), "continuum.csv")
        # Side walls moved as the imported ones: the same volume; the walls' height and width are given.
        at = [numpy.argmin(abs(moved["axial_strain"] - strain)) for strain in grains["axial_strain"]]
        numpy.testing.assert_allclose(moved["volumetric_strain"][at], grains["volumetric_strain"], atol=2e-6)
        # Under the imported pressure: horizontal equilibrium, mean of the continuum's sxx over the height is the
        # pressure of the right wall.
        pressed = history(self.path("pressed"), "continuum.csv")
        numpy.testing.assert_allclose(pressed["axial_strain"][-1], grains["axial_strain"][-1], rtol=1e-9)
        self.assertNotAlmostEqual(pressed["volumetric_strain"][-1], grains["volumetric_strain"][-1], places=5)

    def test_several_samples_are_an_ensemble(self):
        self.done("import", "lammps", *LAMMPS, "--output", self.path("sample_1"), "--quiet")
        self.done("import", "mercurydpm", *MERCURY, "--output", self.path("sample_2"), "--quiet")
        self.done("import", "yade", *YADE, "--thickness", "1", "--output", self.path("sample_3"), "--quiet")
        with open(self.path("sample_1", "scene.prm")) as file:
            text = file.read()
        write(self.path("all.prm"), text.replace("set file = discrete.h5", "set file = sample_{seed}/discrete.h5"))
        self.done("run", self.path("all.prm"), "--seeds", "1-3", "--output", self.path("ensemble"), "--quiet", *COARSE)
        with open(self.path("ensemble", "ensemble.json")) as file:
            self.assertEqual(json.load(file)["seeds"], [1, 2, 3])
        self.assertNotEqual(content(os.path.join(member_of(self.path("ensemble"), 1), "discrete.csv")),
                            content(os.path.join(member_of(self.path("ensemble"), 2), "discrete.csv")))
        self.refused("run", self.path("all.prm"), "--seeds", "1-4", "--output", self.path("more"),
                     says="sample_4/discrete.h5")
        self.refused("run", self.path("sample_1", "scene.prm"), "--seeds", "1-2", "--output", self.path("more"),
                     says="{seed}")

    def test_calibration_and_study_take_imported_samples(self):
        self.done("import", "lammps", *LAMMPS, "--output", self.path("mine"), "--quiet")
        calibration = {"targets": [{"name": "lammps", "scene": "mine/scene.prm", "seeds": "1-1",
                                    "set": {"continuum/element_size": 4}}],
                       "quantities": ["stress_ratio"], "bins": [0.0101, 0.0201, 0.03001],
                       "noise": {"stress_level": 0.02, "stress_shape": 0.02},
                       "set": {"continuum/hardening": "exponential"}, "coarse_element_size": 5,
                       "parameters": [{"key": "friction_angle_peak", "start": 30, "low": 12, "high": 50}]}
        write(self.path("calibration.json"), json.dumps(calibration))
        self.done("calibrate", self.path("calibration.json"), "--output", self.path("fit"), "--quiet")
        self.assertIn(b"friction_angle_peak", content(self.path("fit", "calibrated.prm")))
        study = {"scene": "mine/scene.prm", "command": "run", "set": {"comparison/coarse_element_size": 0},
                 "reference": {"continuum/element_size": 2}, "axes": [{"key": "continuum/element_size", "values": [4]}],
                 "quantities": [{"name": "peak", "of": "continuum", "column": "stress_ratio", "largest": True,
                                 "limit": {"relative": 0.1}}]}
        write(self.path("study.json"), json.dumps(study))
        self.done("study", self.path("study.json"), "--output", self.path("study"), "--quiet")

    def test_what_a_file_lacks_stays_unknown(self):
        told = self.done("import", "csv", *CSV, "--output", self.path("mine"))
        self.assertIn("not in the files: masses", told)
        with h5py.File(self.path("mine", "discrete.h5")) as file:
            self.assertNotIn("mass", file["stage_0001/grains"])
            self.assertIn("grains/mass", file["stage_0001"].attrs["not_told"].decode())
        self.assertTrue(numpy.isnan(history(self.path("mine"))["kinetic_energy"]).all())
        self.done("run", self.path("mine", "scene.prm"), "--output", self.path("both"), "--quiet", *COARSE)
        self.assertNotIn(b"NaN", content(self.path("both", "comparison.json")))


class Fields(Case):
    """PIVlab's text: 10 x 12 points 16 px apart, 2 % shorter and 1 % wider in the second frame, half of it before."""

    def files(self):
        x, y = (grid.ravel() for grid in numpy.meshgrid(16.0 * numpy.arange(10), 16.0 * numpy.arange(12)))
        head = "x [px],y [px],u [px/frame],v [px/frame],Vector type [-]\r\n"
        return [write(self.path(f"piv_{k}.txt"), head + "".join(f"{a},{b},{k * 0.005 * a!r},{k * -0.01 * b!r},1\r\n"
                                                                for a, b in zip(x, y))) for k in (1, 2)]

    def test_a_measurement_from_the_command_line(self):
        words = ["import", "field", "pivlab", *self.files(), "--mean-diameter", "5", "--scale", "0.5", "--subset", "32"]
        self.refused(*words, "--output", self.path("dic"), says="--reference is required for 2 frames")
        self.refused(*words[:-2], "--reference", "first", "--output", self.path("dic"), says="--subset is required")
        told = self.done(*words, "--reference", "first", "--output", self.path("dic"))
        self.assertRegex(told, r"piv_2.txt +120 +0 +0 +2\.0000 +1\.0200 +3\.0000 +-\n")
        for text in ("note: y points down in the files", "note: --centre = 72,88"):
            self.assertIn(text, told)
        record = read_json(self.path("dic"), "measured.json")
        self.assertEqual((record["subset"], record["spacing"], record["centre"]), (16, 8, [36, -44]))
        self.assertEqual([len(one) for one in record["sha256"]], [64, 64])
        numpy.testing.assert_allclose(history(self.path("dic"), "measured.csv")["axial_strain"], [0, 0.01, 0.02])
        self.assertEqual(read_json(self.path("dic"), "provenance.json")["phases"][0]["name"], "import")
        self.refused(*words, "--reference", "first", "--output", self.path("dic"), says="--overwrite")
        self.done(*words, "--reference", "first", "--output", self.path("dic"), "--overwrite", "--quiet")

    def test_a_reader_in_a_file(self):
        reader = write(self.path("reader.py"), """
from diptych.importers import fields
@fields.register("mine")
def read(options):
    return [fields.FieldFrame(path, (t := fields.table_of(path, options)).vectors("x", "y"), t.vectors("u", "w"))
            for path in options.files]
""")
        words = ["--mean-diameter", "5", "--subset", "32", "--output", self.path("mine"),
                 "--columns", "field=x,y,u,w,kind"]
        self.assertIn("y points up in the files", self.done("import", "field", reader, self.files()[0], *words,
                                                            "--progress", "0,0.01"))
        write(reader, "registered = False\n")
        self.refused("import", "field", reader, self.files()[0], *words, "--overwrite", says="@fields.register('NAME')")


class Refused(Case):
    def test_wrong_input_writes_nothing(self):
        out = self.path("out")
        self.refused("import", "lammps", self.path("absent.dump"), "--output", out, says="absent.dump")
        self.refused("import", "nonsense", *LAMMPS, "--output", out, says="nonsense")
        cut = write(self.path("cut.dump"), content(LAMMPS[0])[:5000].decode())
        self.refused("import", "lammps", cut, *LAMMPS[1:], "--output", out, says="cut.dump, line")
        reader = write(self.path("reader.py"), "registered = False\n")
        self.refused("import", reader, *CSV, "--output", out, says="registers no reader")
        os.mkfifo(self.path("pipe.h5"))
        self.refused("import", "lmgc90", self.path("pipe.h5"), "--output", out, says="pipe.h5")
        os.mkdir(out)
        write(self.path("out", "mine.txt"), "")
        self.refused("import", "lammps", *LAMMPS, "--output", out, says="holds other files")
        self.refused("import", "csv", *CSV, "--output", os.path.dirname(CSV[0]), says="plain_csv")

    def test_an_earlier_import_is_replaced_only_on_request(self):
        self.done("import", "csv", *CSV, "--output", self.path("mine"), "--quiet")
        write(self.path("mine", "notes.txt"), "mine")
        self.refused("import", "csv", *CSV, "--output", self.path("mine"), says="--overwrite")
        self.done("import", "csv", *CSV, "--output", self.path("mine"), "--quiet", "--overwrite")
        self.assertEqual(content(self.path("mine.1", "notes.txt")), b"mine")
        os.mkdir(self.path("foreign"))
        write(self.path("foreign", "discrete.csv"), "precious")
        self.refused("import", "csv", *CSV, "--output", self.path("foreign"), "--overwrite", says="holds other files")
        self.assertEqual(content(self.path("foreign", "discrete.csv")), b"precious")

    def test_a_scene_that_would_not_run_is_not_announced(self):
        for words, key in ((("--density", "1e13"), "sample/density"), (("--pressure", "1e30"), "loading/pressure")):
            self.refused("import", "csv", *CSV, *words, "--output", self.path("out"), says=key)

    def test_names_that_no_file_can_have(self):
        for name in ("a" * 100000, os.path.join(CSV[0], "below")):
            self.refused("import", "csv", name, "--output", self.path("out"), says=name)

    def test_a_scene_of_an_import_is_checked(self):
        self.done("import", "lammps", *LAMMPS, "--output", self.path("mine"), "--quiet")
        scene = self.path("mine", "scene.prm")
        self.refused("compare", self.path("mine"), says="no continuum yet")
        record = content(self.path("mine", "import.json"))
        write(self.path("mine", "import.json"), record[:len(record) // 2].decode())
        self.refused("discrete", scene, "--output", self.path("out"), says="import.json")
        write(self.path("mine", "import.json"), record.decode())
        self.refused("run", scene, "--output", self.path("mine"), says="--overwrite")
        self.refused("run", scene, "--output", self.path("out"), "--set", "discrete/file=absent.h5", says="absent.h5")
        for stages, end, says in (("0.01,0.03", 0.03, "frames"), ("0.01,0.02,0.031", 0.031, "frame 3 is at")):
            words = setting(loading_stages=stages, loading_axial_strain=end, comparison_window_edges=f"0,{end}")
            self.refused("run", scene, "--output", self.path("out"), *words, says=says)


class Export(Case):
    def test_our_own_run_exported_and_imported_is_the_same_sample(self):
        """Free sides, platens that travel: stresses of the last step of every stage, volume of the outline,
        progress."""
        self.done("discrete", QUICK, *SMALL, *setting(loading_stage_strain=0.0025, comparison_window_edges="0,0.01"),
                  "--output", self.path("own"), "--quiet")
        for stage in range(5):
            self.done("export", self.path("own"), "--format", "csv", "--stage", str(stage), "--output",
                      self.path("tables"), "--quiet")
        self.done("import", "csv", *sorted(glob.glob(self.path("tables", "*.csv"))), "--output", self.path("back"),
                  "--pressure", "1", "--mean-diameter", "1", "--quiet")
        own, back = history(self.path("own")), history(self.path("back"))
        at = [numpy.argmin(abs(own["axial_strain"] - strain)) for strain in back["axial_strain"]]
        # our first row is that of the first step
        self.assertLess(abs(own["axial_strain"][at] - back["axial_strain"])[1:].max(), 1e-12)
        for name in ("sxx", "sxy", "syy", "stress_ratio", "volumetric_strain", "solid_fraction", "shear_strain"):
            numpy.testing.assert_allclose(back[name][1:], own[name][at][1:], rtol=1e-6, atol=1e-9, err_msg=name)
        for name in ("upper_fx", "upper_fy", "lower_fy"):
            numpy.testing.assert_allclose(back[name][1:], own[name][at][1:], rtol=1e-6, err_msg=name)
        self.done("run", self.path("back", "scene.prm"), "--output", self.path("both"), "--quiet", *COARSE)
        nodes = history(self.path("both"), "continuum.csv")
        self.assertAlmostEqual(nodes["shear_strain"][-1], back["shear_strain"][-1], places=9)

    def test_a_cell_goes_to_other_codes_and_back_and_starts_a_run(self):
        """Stresses, strains and areas of the cell's own history; the first row of the run is the start of the other."""
        cell = write(self.path("cell.prm"), "subsection discrete\n  set lateral = cell\nend\nsubsection loading\n  "
                     "set mode = path\n  set path = simple_shear\n  set axial_strain = 0.01\nend\n")
        words = setting(sample_grains=100, discrete_rolling_friction=0.1)
        self.done("discrete", cell, *words, "--output", self.path("own"), "--quiet")
        own = history(self.path("own"))
        with h5py.File(self.path("own", "discrete.h5")) as file:
            n = len(file)
            at = [numpy.argmin(abs(own["progress"] - file[f"stage_{k:04d}"].attrs["progress"])) for k in range(n)]
            couple = file[f"stage_{n - 1:04d}/contacts/couple"][()]
        for stage in range(n):
            self.done("export", self.path("own"), "--format", "csv", "--stage", str(stage), "--output",
                      self.path("tables"), "--quiet")
        self.done("import", "csv", *glob.glob(self.path("tables", "*.csv")), "--output", self.path("back"), "--quiet")
        back = history(self.path("back"))
        for name in ("sxx", "sxy", "syy", "solid_fraction", "exx", "eyy", "exy", "shear_strain"):
            numpy.testing.assert_allclose(back[name][1:], own[name][at][1:], rtol=1e-4, atol=2e-5, err_msg=name)
        with h5py.File(self.path("back", "discrete.h5")) as file:
            self.assertAlmostEqual(abs(file[f"stage_{n - 1:04d}/contacts/couple"][()]).sum(), abs(couple).sum())
        self.done("export", self.path("own"), "--format", "dump", "--output", self.path("dump"), "--quiet")
        self.done("import", "lammps", *glob.glob(self.path("dump", "*")), "--output", self.path("again"), "--quiet")
        numpy.testing.assert_allclose(history(self.path("again"))["syy"], back["syy"], rtol=1e-9)
        self.done("export", self.path("own"), "--format", "lammps", "--output", self.path("start"), "--quiet")
        self.assertIn(b"boundary p p p", content(self.path("start", "in.sample")))
        self.done("import", "lammps", self.path("start", "sample.data"), "--output", self.path("data"), "--quiet")
        self.assertAlmostEqual(history(self.path("data"))["solid_fraction"][0], back["solid_fraction"][0])
        for start in ("own", "back"):
            self.done("discrete", cell, "--set", "sample/file=" + self.path(start, "discrete.h5"), "--output",
                      self.path("from_" + start), "--quiet")
            first = history(self.path("from_" + start))
            self.assertAlmostEqual(first["solid_fraction"][0], own["solid_fraction"][-1], delta=1e-3)
        rows = "".join(f"{x},{y},0.5\n" for x in range(9) for y in range(6))
        table = write(self.path("grains.csv"), "x,y,r\n" + rows)
        words = ("discrete", cell, "--set", "sample/file=" + table, "--output", self.path("x"))
        self.refused(*words, says="give its periods with sample/width and sample/height")
        self.refused(*words, *setting(sample_width=8.5, sample_height=6), says="the grains overlap by 1 of")

    def test_what_is_exported_comes_back(self):
        self.done("import", "lammps", *LAMMPS, "--output", self.path("mine"), "--quiet")
        self.done("run", self.path("mine", "scene.prm"), "--output", self.path("both"), "--quiet", *COARSE)
        self.done("export", self.path("both"), "--format", "lammps", "--output", self.path("start"))
        self.done("import", "lammps", self.path("start", "sample.data"), "--walls-touch", "--output", self.path("back"),
                  "--quiet")
        with h5py.File(self.path("mine", "discrete.h5")) as mine, h5py.File(self.path("back", "discrete.h5")) as back:
            for name in ("stage_0000/grains/position", "stage_0000/grains/radius"):
                numpy.testing.assert_allclose(back[name][()], mine[name][()], rtol=1e-15, err_msg=name)
        self.refused("export", self.path("both"), "--format", "lammps", "--output", self.path("start"), says="exists")
        self.refused("export", self.path("both"), "--format", "csv", "--stage", "9", "--output", self.path("x"),
                     says="0 to 3")
