# diptych: laws of the user from shared libraries
# SPDX-License-Identifier: LGPL-2.1-or-later
import os
import re
import signal
import subprocess

import h5py
import numpy

from running import (bits, content, ENVIRONMENT, finished, Folder, history, PROGRAM, read_json, setting, SOURCE,
                     temporary, write)

HEADER, EXAMPLES = os.path.join(SOURCE, "continuum", "laws"), os.path.join(SOURCE, "benchmarks", "own_law")
FAULTY = os.path.join(SOURCE, "tests", "program", "faulty_law.c")
SHIPPED = os.path.join(SOURCE, "benchmarks", "moreau_quick", "scene.prm")  # with the default law
SCENE = """# a small rectangle whose law is a library
subsection continuum
  set law = library
  set law_library = {library}.so
  set mesh = rectangle
  set rectangle_width = 8
  set rectangle_height = 12
  set element_size = 2
  set checkpoint_minutes = 0
{keys}
end
subsection loading
  set axial_strain = 0.01
  set horizontal_over_vertical = 0
end
subsection comparison
  set coarse_element_size = 0
end
"""


class Libraries(Folder):
    @classmethod
    def setUpClass(cls):
        cls.libraries = temporary(cls)
        for name, source, words in (("mohr_coulomb", os.path.join(EXAMPLES, "mohr_coulomb.cc"), ["c++", "-std=c++17"]),
                                    ("von_mises", os.path.join(EXAMPLES, "von_mises.c"),
                                     ["cc", "-std=c99", "-pedantic"]),
                                    ("faulty", FAULTY, ["cc"]), ("old", FAULTY, ["cc", "-DVERSION=0"]),
                                    ("empty", FAULTY, ["cc", "-DNO_UPDATE"]),
                                    ("bent", FAULTY, ["cc", "-DTANGENT=0.999"]),
                                    ("turned", FAULTY, ["cc", "-DTANGENT=-1"]), ("zz", FAULTY, ["cc", "-DZZ=-1"]),
                                    ("maxwell", FAULTY, ["cc", "-DDECAY=2"])):
            subprocess.run([*words, "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC", "-O2", "-I" + HEADER, "-o",
                            os.path.join(cls.libraries, name + ".so"), source, "-lm"], check=True)

    def scene(self, library, *keys):
        """Beside the libraries, which it names without a folder."""
        lines = "\n".join("  set " + key for key in keys)
        return write(os.path.join(self.libraries, "scene.prm"), SCENE.format(library=library, keys=lines))

    def faulty_run(self, fault, *words, command="continuum"):
        return self.with_fault(fault, command, self.scene("faulty"), "--output", self.folder, "--quiet", *words)

    def with_fault(self, fault, *words):
        return subprocess.run([PROGRAM, *words], env={**ENVIRONMENT, "FAULT": fault}, capture_output=True, text=True)

    def test_the_examples_and_the_default_law_pass_the_checks(self):
        for law in (SHIPPED, *(os.path.join(self.libraries, name + ".so") for name in ("mohr_coulomb", "von_mises"))):
            told = finished("check-law", law).stdout
            self.assertEqual(told.count(": holds\n"), 5, told)
            self.assertNotIn("strain increment", told)  # no place without a fault
        self.assertIn("law.hardening_modulus = 10 [loading/pressure]", told)

    def test_a_wrong_tangent_is_found(self):
        result = self.expect(2, ["check-law", os.path.join(self.libraries, "bent.so")])
        self.assertRegex(result.stdout, r"tangent: FAILS, largest deviation 0.001 .*; path \d+, step \d+, strain .*; "
                                        r"d s_.. / d \w+ = \S+, but differences give")
        self.assertEqual(result.stdout.count(": holds"), 4, result.stdout)

    def test_a_turned_sign_is_named(self):
        turned = os.path.join(self.work, "turned")
        for name, words in (("turned", ["no positive stiffness", "d s_xx / d e_xx = -"]),
                            ("zz", ["turns the sign of s_zz, from -1 to 1"])):
            self.expect(2, ["check-law", os.path.join(self.libraries, name + ".so")], *words, "tension is positive")
        text = content(os.path.join(EXAMPLES, "von_mises.c")).decode()
        for right, wrong, words in (("*e = step->strain;", "*o = step->strain, e[3] = {-o[0], -o[1], -o[2]};",
                                     "tangent: FAILS.* = 5.*, but differences give -5.*: a sign is turned"),
                                    ("plastic_strain[i] = flow", "plastic_strain[i] = -flow",
                                     "dissipation: FAILS.*; plastic_strain has a turned sign")):
            self.assertIn(right, text)
            write(turned + ".c", text.replace(right, wrong))
            subprocess.run(["cc", "-shared", "-fPIC", "-I" + HEADER, "-o", turned + ".so", turned + ".c", "-lm"],
                           check=True)
            result = self.expect(2, ["check-law", turned + ".so"])
            self.assertRegex(result.stdout, words)
            os.remove(turned + ".so")

    def test_a_creeping_law_relaxes_over_a_hold(self):
        """Maxwell: s_xy decays by exp(-2 t); the implicit steps of a hold leave at most 0.27/1024 of its start."""
        table = write(os.path.join(self.work, "hold.csv"), "progress, exx, eyy, exy\n0, 0, 0, 0\n1e-9, 0, 0, 0.001\n"
                      "0.5, 0, 0, 0.001\n1.5, 0, 0, 0.001\n")
        finished("material-point", self.scene("maxwell"), "--path", table, "--output", self.folder)
        rows = history(self.folder, "material_point.csv")
        found = rows["sxy"][rows["progress"].searchsorted([1e-9, 0.5, 1.5])]
        numpy.testing.assert_allclose(found / found[0], numpy.exp([0, -1, -3]), atol=3e-4)

    def test_an_answer_that_is_not_finite_is_found(self):
        result = self.with_fault("nan", "check-law", os.path.join(self.libraries, "faulty.so"))
        self.expect_message(result, 2)
        self.assertRegex(result.stdout, "answers: FAILS, .* returned a number that is not finite")

    def test_the_mohr_coulomb_example_is_the_built_in_law(self):
        """At a point and in a boundary problem, where some points reach edges, to the tolerance of the equilibrium."""
        scene = self.scene("mohr_coulomb", "law.friction_angle = 25", "tolerance = 1e-10")
        built_in = setting(continuum_law="mohr_coulomb", continuum_hardening="constant",
                           continuum_friction_angle_peak=25, continuum_dilatancy_angle_peak=12,
                           continuum_youngs_modulus=500, continuum_cohesion=0.01)
        plain = write(os.path.join(self.libraries, "built_in.prm"),
                      "\n".join(line for line in SCENE.format(library="", keys="  set tolerance = 1e-10").split("\n")
                                if "law" not in line or line.startswith("#")))
        for command, table in (("material-point", "material_point.csv"), ("continuum", "continuum.csv")):
            own, theirs = os.path.join(self.work, command), os.path.join(self.work, command + "_built_in")
            finished(command, scene, "--output", own, "--quiet")
            finished(command, plain, *built_in, "--output", theirs, "--quiet")
            a, b = history(own, table), history(theirs, table)
            for column in ("stress_ratio", "dissipation"):
                numpy.testing.assert_allclose(a[column], b[column], rtol=1e-9, atol=1e-12)
        self.assertGreater(a["plastic_share"][-1], 0.8)
        self.assertRegex(read_json(own, "provenance.json")["hashes"]["law_library"], "^[0-9a-f]{16}$")

    def test_state_variables_are_results_and_survive_refinement_and_restart(self):
        words = setting(continuum_refinement="adaptive", continuum_element_size=1, continuum_weak_spot_strain=0.01)
        scene = self.scene("von_mises", "law.strength = 0.5", "law.hardening_modulus = 20")
        finished("continuum", scene, *words, "--output", self.folder, "--quiet")
        with h5py.File(self.path("continuum.h5"), "r") as file:
            stage = file[sorted(file)[-1]]["cells"]
            strength = stage["law.strength"][()]
            self.assertEqual(stage["law.strength"].attrs["unit"], b"pressure")
            self.assertGreater(len(strength), 24)  # the mesh was refined
        self.assertTrue(0.5 < strength.min() < strength.max() < 0.5 + 20 * 0.1, strength)
        self.assertIn(b'"law.strength"', content(self.path("continuum", "stage_0001.vtu")))
        point = os.path.join(self.work, "point")
        finished("material-point", scene, "--output", point, "--quiet")
        self.assertGreater(history(point, "material_point.csv")["lawstrength"][-1], 0.5)

    def test_a_crash_loses_nothing(self):
        """It names the library; the next run goes on from the last checkpoint to the bits of an undisturbed one."""
        for fault, number in (("crash", signal.SIGSEGV), ("divide", signal.SIGFPE), ("abort", signal.SIGABRT)):
            result = self.faulty_run(fault, "--overwrite")
            self.assertEqual(result.returncode, -number, result.stderr)
            self.assertRegex(result.stderr, "a crash ends this program, .* law library .*/faulty.so; a run keeps")
            self.assertGreater(history(self.folder, "continuum.csv")["axial_strain"][-1], 0.003)
        self.assertEqual(self.faulty_run("none", "--resume").returncode, 0)
        whole, resumed = os.path.join(self.work, "whole"), bits(self.path("continuum.h5"))
        finished("continuum", self.scene("faulty"), "--output", whole, "--quiet")
        self.assertEqual(bits(os.path.join(whole, "continuum.h5")), resumed)

    def test_an_answer_that_is_none_halves_the_step(self):
        for fault, reason in (("nan", "not finite"), ("fail", "DIPTYCH_FAILED")):
            for command in ("continuum", "material-point"):
                result = self.faulty_run(fault, "--overwrite", command=command)
                self.expect_message(result, 3, reason, "travel 0.00")
                for text in ("min_step", r"in element \d+, point \d \(x = "):
                    self.assertEqual(bool(re.search(text, result.stderr)), command == "continuum", result.stderr)

    def test_wrong_libraries_and_parameters_are_refused(self):
        write(os.path.join(self.libraries, "text.so"), "no library")
        for library, keys, *words in (
                ("missing", (), "line 4", "law_library", "missing.so is not a file", "cc -shared"),
                ("text", (), "line 4", "cannot be opened"), ("old", (), "line 4", "interface version 0", "needs 1"),
                ("empty", (), "has no function diptych_law_update"),
                ("von_mises", ("law.strenght = 2",), "line 10", "law.strenght", "it has law.youngs_modulus"),
                ("von_mises", ("law.strength = -2",), "line 10", "must lie in [1e-09, 1e+12]"),
                ("von_mises", ("law.strength = strong",), "line 10", "law.strength = 'strong'")):
            self.expect(2, ["continuum", self.scene(library, *keys), "--output", self.folder], *words)
