# diptych: grains and the law's point on one path
# SPDX-License-Identifier: LGPL-2.1-or-later
import glob
import os
import signal

import numpy
from scipy.integrate import trapezoid

from running import content, finished, Folder, history, read_json, setting, SOURCE, write

SCENE = os.path.join(SOURCE, "benchmarks", "element", "scene.prm")
SMALL = setting(sample_grains=100, loading_axial_strain=0.01, discrete_step=0.1, discrete_tolerance=1e-3)


class Element(Folder):
    def histories(self, name):
        return [history(os.path.dirname(path), name) for path in sorted(glob.glob(self.path("runs", "*", name)))]

    def test_curves_are_means_of_the_runs_and_numbers_are_those_of_the_curves(self):
        printed = finished("element", SCENE, *SMALL, "--seeds", "1-2", "--output", self.folder).stdout
        curves, record = history(self.folder, "element.csv"), read_json(self.folder, "element.json")
        samples, [law] = self.histories("discrete.csv"), self.histories("material_point.csv")
        self.assertEqual((record["done"], record["failed"], len(samples)), ([1, 2], [], 2))
        # The parts of the path are equal, so that the mean of their means is the mean over the path. The grains begin
        # with a step.
        means = [(one["syy"][0] * one["progress"][0] + trapezoid(one["syy"], one["progress"])) / 0.01
                 for one in [*samples, law]]
        self.assertAlmostEqual(curves["grains_syy"].mean(), numpy.mean(means[:2]), places=8)
        self.assertAlmostEqual(curves["law_syy"].mean(), means[2], places=8)
        # both carry the lateral pressure, the grains on average
        numpy.testing.assert_allclose(curves["law_sxx"], 1, rtol=1e-9)
        self.assertAlmostEqual(curves["grains_sxx"].mean(), 1, delta=0.02)
        rms = {one["quantity"]: one["value"] for one in record["rms"]}
        difference = curves["law_stress_ratio"] - curves["grains_stress_ratio"]
        self.assertAlmostEqual(rms["stress_ratio"], numpy.sqrt((difference**2).mean()), places=8)
        numbers = {one["quantity"]: one for one in record["quantities"]}
        for name in ("volumetric_strain", "syy"):
            self.assertEqual(numbers[f"last {name}"]["law"], law[name][-1])
            mean = numpy.mean([one[name][-1] for one in samples])
            self.assertAlmostEqual(numbers[f"last {name}"]["grains"]["value"], mean)
        angle = numpy.degrees(numpy.arcsin(numbers["peak stress_ratio"]["law"]))
        self.assertAlmostEqual(numbers["friction angle of the peak"]["law"], angle)
        self.assertIn(f"{angle:.4g}", printed)
        self.assertIn("does not say to which grains they were fitted", printed)
        self.assertEqual(record["walk"], "axial_strain")
        self.assertTrue(os.path.exists(self.path("report.html")))
        os.remove(self.path("report.html"))
        finished("report", self.folder)
        self.assertTrue(os.path.exists(self.path("report.html")))

    def test_wrong_paths_are_refused_and_a_stress_beyond_the_strength_keeps_what_was_reached(self):
        table = os.path.join(self.work, "path.csv")
        words = ("element", SCENE, *SMALL, *setting(loading_path=table), "--output", self.folder)
        for text, message in (("volume,mean_stress,exy\n0,1,0\n0.1,1,0\n", "one follows from the others"),
                              ("eyy,sxx,exy\n0,2,0\n0.1,2,0\n", "not the stress of the start")):
            write(table, text)
            self.expect(2, words, table, message)
        write(table, "progress,syy,sxx,exy\n0,1,1,0\n0.01,9,1,0\n")  # t/s = 0.8
        self.expect(3, words, "the law ended before the end of the path")
        curves, record = history(self.folder, "element.csv"), read_json(self.folder, "element.json")
        self.assertGreater(curves["law_stress_ratio"][numpy.isfinite(curves["law_stress_ratio"])].max(), 0.2)
        self.assertIn("sxx = 1, syy", record["law"]["failure"])
        self.assertTrue(os.path.exists(self.path("report.html")))

    def test_parts_end_at_a_reversal_the_peak_counts_strain_and_a_law_that_cannot_reverse_is_warned_of(self):
        """eyy grows to 0.01 and falls to 0.004: progress counts rows, so 0.2 is 0.002, then 0.0012 of strain."""
        table = write(os.path.join(self.work, "path.csv"), "eyy,sxx,exy\n0,1,0\n0.01,1,0\n0.004,1,0\n")
        words = setting(loading_path=table, loading_axial_strain=2, loading_stage_strain=1, continuum_max_step=1e-3,
                        comparison_averaging_strain=2e-3, continuum_hardening="mobilisation")
        found = finished("element", SCENE, *SMALL, *words, "--output", self.folder)
        warning = "path.csv: the path turns back, which continuum/hardening = mobilisation cannot follow"
        self.assertIn(warning, found.stderr)
        middle = history(self.folder, "element.csv")["progress"]
        self.assertEqual((sum(middle < 1), sum(middle > 1)), (125, 75))
        numpy.testing.assert_allclose(middle[[124, 125]], [1 - 0.5 / 125, 1 + 0.5 / 75])
        numbers = {one["quantity"]: one["law"] for one in read_json(self.folder, "element.json")["quantities"]}
        self.assertAlmostEqual(numbers["last eyy"], 0.004, places=12)
        [law] = self.histories("material_point.csv")
        strain = numpy.interp(law["progress"], [0, 1, 2], [0, 0.01, 0.016])
        spans = [numpy.linspace(end - 2e-3, end, 2001) for end in strain if end >= 2e-3]
        means = [trapezoid(numpy.interp(x, strain, law["stress_ratio"]), x) / 2e-3 for x in spans]
        self.assertAlmostEqual(numbers["peak stress_ratio"], max(means), places=6)
        page = content(self.path("report.html")).decode()
        self.assertIn("over axial strain ε yy", page)
        self.assertIn("cannot follow", page)
        follows = finished("element", SCENE, *SMALL, *words, *setting(continuum_hardening="kinematic"), "--output",
                           self.path("kinematic"))
        self.assertNotIn("turns back", follows.stderr)

    def test_strains_of_a_table_count_from_its_first_row(self):
        table = write(os.path.join(self.work, "path.csv"), "eyy,sxx,exy\n0.2,1,0\n0.21,1,0\n")
        finished("element", SCENE, *SMALL, *setting(loading_path=table, loading_axial_strain=1,
                                                    loading_stage_strain=1), "--output", self.folder)
        for one in [*self.histories("discrete.csv"), *self.histories("material_point.csv")]:
            numpy.testing.assert_allclose(one["eyy"], 0.01 * one["progress"], atol=1e-12)

    def test_what_a_cell_cannot_do_is_refused_by_key_and_place(self):
        table = write(os.path.join(self.work, "path.csv"), "eyy,sxx,exy\n0,1,0\n")
        hold = write(os.path.join(self.work, "hold.csv"), "eyy,sxx,exy\n0,1,0\n0.01,1,0\n0.01,1,0\n")
        for keys, *texts in ((dict(discrete_gravity_y=-1), "discrete/gravity_y = -1", "no bottom"),
                             (dict(sample_grains=12), "sample/grains = 12", "give at least"),
                             (dict(loading_axial_strain=3, loading_stage_strain=1), "loading/axial_strain=3",
                              "axial_strain = 3 must lie in (0, 1)"),
                             (dict(loading_path=hold), "hold.csv", "row 3", "take no holds"),
                             (dict(loading_path=table), "path.csv", "one row")):
            self.expect(2, ["discrete", SCENE, *SMALL, *setting(**keys), "--output", self.folder], *texts)
        # a shear strain may be large, and a short run has no running mean
        words = setting(loading_path="simple_shear", loading_axial_strain=2, loading_stage_strain=1,
                        loading_inertial_number=0.1)
        finished("discrete", SCENE, *SMALL, *words, "--output", self.folder)
        words = setting(loading_axial_strain=1e-4, loading_stage_strain=1e-4)
        self.assertNotIn("inf", finished("discrete", SCENE, *SMALL, *words, "--output", self.path("short")).stdout)

    def test_after_a_stop_the_finished_samples_are_kept(self):
        words = ("element", SCENE, *SMALL, "--seeds", "1-3", "--jobs", "1", "--output", self.folder)
        errors = self.expect_stopped(signal.SIGINT, lambda: any(
            b"exit_code" in content(path) for path in glob.glob(self.path("runs", "*.json"))), *words)
        self.assertIn("to go on: diptych element", errors)
        self.assertIn("of 3 runs are finished", finished(*words, "--resume").stdout)
        self.assertEqual(read_json(self.folder, "element.json")["done"], [1, 2, 3])
