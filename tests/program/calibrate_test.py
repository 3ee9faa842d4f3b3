# diptych: calibrations: what is found, kept, resumed, taken by a scene and refused
# SPDX-License-Identifier: LGPL-2.1-or-later
import csv
import json
import math
import os
import re
import signal
import statistics
import subprocess

import browser
from diptych._diptych import key_quantities
from running import content, diptych, ENVIRONMENT, Folder, listing, PROGRAM, QUICK, read_json, setting, start, write

TINY = {"sample/grains": 150, "loading/axial_strain": 0.02, "loading/stage_strain": 0.01,
        "loading/inertial_number": 1e-3, "comparison/window_edges": "0, 0.01, 0.02"}


def calibration(**changes):
    """A file that a test can afford: two parameters, two samples, one start."""
    asked = {
        "targets": [{"name": "fitted", "scene": QUICK, "set": TINY, "seeds": "1-2"},
                    {"name": "unseen", "scene": QUICK, "set": TINY, "seeds": "3-3", "use": "predict"}],
        "quantities": ["stress_ratio", "volumetric_strain"], "bins": [0.002, 0.005, 0.01, 0.015, 0.02],
        "parameters": [{"key": "friction_angle_peak", "start": 21, "low": 14, "high": 40},
                       {"key": "dilatancy_angle_peak", "start": 0.4, "low": 0, "high": 1}],
        "starts": 1, "load_step": 0.002, "check_samples": 1}
    return {**asked, **changes}


def keywords(**keys):
    return [word for key, value in keys.items() for word in ("--set", f"{key}={value}")]


class Calibrate(Folder):
    def file(self, asked):
        return write(os.path.join(self.work, "one.json"), json.dumps(asked, indent=1))

    def calibrate(self, asked, *words, code=0, told=()):
        self.expect(code, ["calibrate", self.file(asked), "--output", self.folder, "--quiet", *words], *told)

    def tiny(self, folder, *words, command="discrete", **keys):
        """A tiny run in a folder of `work`."""
        folder = os.path.join(self.work, folder)
        self.expect(0, [command, QUICK, *keywords(**{**TINY, **keys}), *words, "--output", folder, "--quiet"])
        return folder

    def record(self):
        return read_json(self.folder, "calibration.json")


class Results(Calibrate):
    def test_parameters_are_found_and_taken_by_a_scene(self):
        write(os.path.join(self.work, "before.prm"), "subsection continuum\n  set friction_angle_peak = 35\nend\n")
        asked = calibration()
        asked["targets"][0]["before"] = "before.prm"
        self.calibrate(asked)
        record = self.record()
        before = [[o["before"] for o in path["observables"] if o["kind"] == "stress_ratio"] for path in record["paths"]]
        self.assertGreater(before[0][-1], 1.05 * before[1][-1])  # of the fragment, of the scene
        self.assertEqual(record["status"], "finished")
        self.assertLess(record["chi2"], record["chi2_before"])
        friction, dilatancy = record["parameters"]
        self.assertTrue(friction["number_low"] < friction["number_median"] < friction["number_high"], friction["key"])
        self.assertAlmostEqual(dilatancy["value"], dilatancy["number"] * friction["value"], places=6)
        fitted, unseen = record["paths"]
        self.assertEqual((fitted["use"], unseen["use"]), ("fit", "predict"))
        self.assertTrue(any(o["counts"] for o in fitted["observables"]))
        self.assertFalse(any(o["counts"] for o in unseen["observables"]))
        for path in record["paths"]:  # halving the load step moves less than the samples scatter
            for o in path["observables"]:
                self.assertLess(abs(o["half_step"]), o["deviation"], o)
            self.assertEqual([p["quantity"] for p in path["predictions"]],
                             [one["key"] for one in key_quantities() if "peak_stress" in one["margin"]]
                             + ["volumetric_strain"])
        self.assertEqual([{p["use"] for p in path["predictions"]} for path in record["paths"]],
                         [{"fitted"}, {"predicted"}])
        with open(self.path("calibration.csv"), encoding="utf-8") as file:
            self.assertEqual(len(list(csv.DictReader(file))), 16)
        # The fragment is what a scene takes, before what --set says.
        fragment = self.path("calibrated.prm")
        mesh = setting(continuum_mesh="rectangle", continuum_rectangle_width=15, continuum_rectangle_height=20,
                       comparison_coarse_element_size=0, continuum_internal_length=2.5)
        again = self.tiny("again", *mesh, "--set-file", fragment, command="continuum")
        for text in (f"= {friction['value']!r}", "= 2.5", "= calibrated on fitted, seeds 1-2"):
            self.assertIn(text, content(again, "scene.prm").decode())
        page = content(self.path("report.html")).decode()
        for text in ("friction_angle_peak", "cannot tell", "Findings", "<img"):
            self.assertIn(text, page)
        head = start("calibrate", self.file(asked), "--output", self.folder, "--resume")
        head.stdout.close()  # as `| head` does
        self.assertEqual((head.communicate(), head.returncode)[1], 0)
        self.look_at_the_page(len(record["paths"]))

    def look_at_the_page(self, paths):
        """It opens without an error and fits a telephone; two curves and the residuals of every path, discrepancy,
        posterior."""
        if browser.program() is None:
            self.skipTest("chromium is not installed (test.sh installs it)")
        for width in (1400, 390):
            with browser.Page(width, 900) as page:
                page.open(self.path("report.html"))
                self.assertEqual(page.messages, [])
                self.assertLessEqual(page.run("document.documentElement.scrollWidth"), width)
                self.assertGreaterEqual(page.run("document.querySelectorAll('svg, img').length"), 3 * paths + 2)
                self.assertTrue(page.run("[...document.images].every(image => image.naturalWidth > 0)"))

    def test_result_folders_stand_in_the_place_of_runs(self):
        folders = [self.tiny(f"grains_{seed}", **{"sample/seed": seed}) for seed in (1, 2)]
        self.calibrate(calibration(targets=[{"name": "read", "results": folders}], check_samples=0))
        record = self.record()
        self.assertEqual(record["paths"][0]["seeds"], [1, 2])
        self.assertTrue(any("was not checked" in words for words in record["words"]), record["words"])
        # A result that stopped early.
        table = os.path.join(folders[1], "discrete.csv")
        lines = content(table).decode().splitlines(keepends=True)
        write(table, "".join(lines[:len(lines) // 2]))
        read, other = calibration(targets=[{"name": "read", "results": folders}]), os.path.join(self.work, "b")
        words = ("calibrate", self.file(read), "--output", other, "--quiet")
        self.expect_message(diptych(*words), 2, "grains_2/discrete.csv")
        record = os.path.join(folders[1], "provenance.json")
        write(record, content(record).decode().replace("discrete_files", "no_files"))  # as of an earlier version
        self.expect_message(diptych(*words), 2, "target 'read'", "grains_2", "before the end of its loading")

    def test_a_scene_with_seeds_stands_for_a_file(self):
        scene = write(os.path.join(self.work, "mine.prm"), content(QUICK).decode())
        words = keywords(**TINY, **{"continuum/law": "linear_elastic", "continuum/platens": "auto"})
        self.expect(0, ["calibrate", scene, "--seeds", "1-2", *words, "--output", self.folder, "--quiet"])
        asked = read_json(self.folder, "calibration_input.json")
        self.assertEqual([p["key"] for p in asked["parameters"]], ["youngs_modulus"])  # all that this law reads
        self.assertEqual(asked["quantities"], ["stress_ratio", "volumetric_strain"])
        found = content(self.path("calibrated.prm"))
        self.assertIn("parameters_from = calibrated on cells of mine, seeds 1-2", found.decode())
        names = [name for name in listing(self.path("runs")) if name.endswith(".prm")]
        runs = [content(self.path("runs", name)).decode() for name in names]
        meshed = [run for run in runs if re.search("set mesh += .*(rect|msh)", run)]
        platens = {re.search("set platens += (.+)", run)[1] for run in meshed}
        self.assertEqual(platens, {"frictional", "smooth"})  # as beside the grains
        self.calibrate(asked, "--resume")  # the file beside the scene finds the same from the same runs
        self.assertEqual(content(self.path("calibrated.prm")), found)

    def test_friction_of_grains_is_fitted_to_a_curve(self):
        self.tiny("lab", **{"discrete/friction": 0.5})
        friction = {"key": "discrete/friction", "start": 0.3, "low": 0.1, "high": 0.9}
        target = {"name": "test", "scene": QUICK, "set": TINY, "curve": "lab/discrete.csv", "seeds": "1-4"}
        asked = calibration(targets=[target], parameters=[friction])
        self.calibrate(asked)
        record = self.record()
        # An interval of 95 % misses the truth once in 20 times, three deviations once in 370 times.
        draws = [math.log(number / 0.5) for number in record["parameters"][0]["draws"]]
        self.assertLess(abs(statistics.mean(draws)), 3 * statistics.stdev(draws))
        self.assertLess(record["chi2"], record["chi2_before"])
        fragment = content(self.path("calibrated.prm")).decode()
        self.assertIn("subsection discrete\n  set friction = ", fragment)
        self.assertIn("calibrated on test, discrete.csv, seeds 1-4", fragment)
        self.assertIn(b">Measured curve and grains</h2>", content(self.path("report.html")))


class Curves(Calibrate):
    def asked(self, rows, **target):
        """An element test whose law is fitted to a curve of t/s."""
        write(os.path.join(self.work, "curve.csv"), "progress,stress_ratio,stress_ratio_deviation\n" + rows)
        scene = write(os.path.join(self.work, "cell.prm"), content(QUICK).decode())
        keys = {"loading/mode": "path", "loading/axial_strain": 0.02, "discrete/lateral": "cell",
                "continuum/law": "mohr_coulomb", "continuum/hardening": "exponential"}
        lab = {"name": "lab", "scene": scene, "set": keys, "curve": "curve.csv", **target}
        return calibration(targets=[lab], quantities=["stress_ratio"])

    def test_a_curve_that_starts_elsewhere_than_its_model_is_refused(self):
        rows = "0,0.3333,0.01\n0.01,0.45,0.01\n0.02,0.45,0.01\n"
        self.calibrate(self.asked(rows), code=2, told=["curve.csv", "stress_ratio = 0.3333", '"k0": 0.5'])
        self.calibrate(self.asked("0,0,0.01\n0.02,0.45,0.01\n", k0=0.5), code=2, told=["starts at 0.333", '"k0": 1'])
        asked = self.asked(rows, k0=0.5)  # starts; no run of the law follows
        asked["set"] = {"continuum/softening_strain": 1e-6, "continuum/friction_angle_residual": 1}
        self.calibrate(asked, code=3, told=["the continuum did not finish at any start", "most often", "snap-back"])


class Interruption(Calibrate):
    def finished_runs(self):
        """Names of the runs that came to their end."""
        names = [name for name in listing(self.path("runs")) if os.path.dirname(name) == "" and name.endswith(".json")]
        return [name for name in names if b"exit_code" in content(self.path("runs", name))]

    def stop_after(self, runs, with_signal):
        return self.signalled(with_signal, lambda: len(self.finished_runs()) >= runs, "calibrate",
                              self.file(calibration()), "--output", self.folder, "--resume", "--quiet")

    def test_killed_and_stopped_ones_go_on_to_the_same_bits(self):
        code, _ = self.stop_after(1, signal.SIGKILL)
        self.assertEqual(code, -signal.SIGKILL)
        kept = {name: content(self.path("runs", name)) for name in self.finished_runs()}
        code, errors = self.stop_after(len(kept) + 5, signal.SIGINT)
        self.assertEqual(code, 3, errors)
        for text in ("stopped on request", "--resume", self.folder):
            self.assertIn(text, errors)
        self.assertEqual(self.record()["status"], "stopped on request")
        self.assertIn(b"stopped on request", content(self.path("calibrated.prm")))
        self.calibrate(calibration(), "--resume")
        for name, bit in kept.items():
            self.assertEqual(content(self.path("runs", name)), bit, "run again")
        alone = os.path.join(self.work, "alone")
        words = ["mpirun", "--oversubscribe", "-np", "2", PROGRAM, "calibrate", self.file(calibration()), "--output",
                 alone, "--quiet"]
        result = subprocess.run(words, env=ENVIRONMENT, capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.expect_same_files(alone, "calibration.json", "calibration.csv", "posterior.csv", "calibrated.prm")


class Refused(Calibrate):
    def test_a_wrong_file_is_told_where_it_is_wrong(self):
        parameter = {"key": "friction_angle_peak", "start": 21, "low": 14, "high": 40}
        target = {"name": "fitted", "scene": QUICK, "seeds": "1-2"}
        for changes, words in [
                ({"taget": 1}, ["taget"]),
                ({"targets": [{**target, "use": "predict"}]}, ["targets", "fitted"]),
                ({"targets": [target, target]}, ["'fitted'"]),
                ({"targets": [{"name": "read", "results": ["nowhere"]}]}, ["nowhere", "discrete.csv"]),
                ({"bins": [0.01, 0.005]}, ["bins", "0.005"]),
                ({"bins": [0.5, 0.6]}, ["no bin"]),
                ({"parameters": [{**parameter, "key": "friction"}]}, ["continuum/friction", "nearest"]),
                ({"parameters": [{**parameter, "low": 0}]}, ["low", "logarithm"]),
                ({"parameters": [{"key": "dilatancy_angle_peak", "start": 0.5, "low": 0, "high": 2}]},
                 ["between 0 and 1"]),
                ({"parameters": [{**parameter, "targets": ["loose"]}]}, ["targets", "'loose'"]),
                ({"targets": [target, {**target, "name": "b", "use": "predict"}],
                  "parameters": [{**parameter, "targets": ["b"]}]}, ["targets", "fitted"]),
                ({"targets": [{**target, "before": QUICK}]}, ["before", "sample/grains"]),
                ({"parameters": [{**parameter, "of": "cohesion"}]}, ["of", "share_of"]),
                ({"set": {"discrete/friction": 0.5}}, ["discrete/friction"]),
                ({"set": {"continuum/friction_angle_peak": 20}}, ["friction_angle_peak", "parameters"]),
                ({"set": {"continuum/element_size": 3}}, ["continuum/element_size", "coarse_element_size"]),
                ({"parameters": [{**parameter, "key": "discrete/friction"}]}, ["needs scene, curve and seeds"]),
                ({"parameters": [parameter, {**parameter, "key": "discrete/friction"}]}, ["parameters", "two files"]),
                ({"starts": 0}, ["starts"])]:
            with self.subTest(changes=changes):
                self.calibrate(calibration(**changes), code=2, told=[*words, "one.json"])
        for words, text in [((QUICK,), "--seeds 1-4"),
                            ((self.file(calibration()), "--seeds", "1-2"), "--seeds, --set")]:
            self.expect(2, ["calibrate", *words, "--output", self.folder], text)

    def test_a_fragment_is_checked(self):
        fragment = write(os.path.join(self.work, "f.prm"), "subsection continuum\n  set friction_angle_pek = 20\nend\n")
        self.expect(2, ["continuum", QUICK, "--set-file", fragment, "--output", self.folder], "friction_angle_pek",
                    "f.prm", "line 2")
