# diptych: plans: what is found, kept, resumed, carried out and refused
# SPDX-License-Identifier: LGPL-2.1-or-later
import os
import signal

from running import content, Folder, history, listing, QUICK, read_json, setting, SMALL, SOURCE

GRAINS = os.path.join(SOURCE, "benchmarks", "dense_biaxial", "scene.prm")
OBLIQUE = os.path.join(SOURCE, "benchmarks", "cosserat_band", "oblique.prm")
TINY = setting(sample_grains=150, loading_axial_strain=0.01, loading_stage_strain=0.01)
COARSE = setting(continuum_rectangle_width=24, continuum_rectangle_height=24, loading_axial_strain=0.03)


def without_clocks(plan):
    """A plan without what a clock measured."""
    clocks = ("cpu_s", "total_cpu_s", "peak_memory_mb", "pilot_cpu_s", "outcome_cpu_s", "decisions")
    if isinstance(plan, dict):
        return {key: without_clocks(value) for key, value in plan.items() if key not in clocks}
    return [without_clocks(one) for one in plan] if isinstance(plan, list) else plan


class Plan(Folder):
    def plan(self, scene, accuracy, *words, code=0):
        return self.expect(code, ["plan", scene, "--accuracy", accuracy, "--output", self.folder, "--quiet", *words])

    def check_budget(self, panel, accuracy):
        for quantity in panel["quantities"]:
            self.assertTrue(all(part["error"] >= 0 for part in quantity["parts"]), quantity["parts"])
            self.assertLessEqual(quantity["total"], accuracy * (1 + 1e-9))
            self.assertGreater(quantity["mean"], 0)


class Panels(Plan):
    def test_grains_are_planned_and_carried_out(self):
        result = self.expect(0, ["plan", GRAINS, "--accuracy", "15", "%", *TINY, "--run", "--output", self.folder,
                             "--quiet"])
        plan = read_json(self.folder, "plan.json")
        (panel,) = plan["panels"]  # the scene sets nothing of a continuum
        self.assertEqual((panel["panel"], panel["command"], panel["reaches"]), ("discrete", "discrete", True))
        self.assertEqual([q["name"] for q in panel["quantities"]], ["discrete.peak_stress_ratio", "discrete.strength"])
        self.check_budget(panel, 0.15)
        for outcome, quantity in zip(panel["outcomes"], panel["quantities"]):
            method = sum(part["error"] for part in quantity["parts"] if part["cause"] != "samples")
            self.assertGreaterEqual(outcome["n"], len(panel["seeds"]))
            if outcome["n"] > 1:
                self.assertLessEqual(outcome["half_interval"] + method, 0.15 * (1 + 1e-9))
            self.assertLess(abs(outcome["mean"] / quantity["mean"] - 1), 0.3)
        for text in ("error at most about", "bias", "samples", "CPU s each", "planned.prm"):
            self.assertIn(text, result.stdout)
        # The planned scene is one that runs, as planned.
        again = os.path.join(self.work, "again")
        self.expect(0, ["discrete", self.path("planned.prm"), "--output", again, "--quiet"])
        accuracy = next(s for s in panel["settings"] if s.startswith("discrete/accuracy")).split(" = ")[1]
        self.assertIn(f"set accuracy = {accuracy}\n", content(again, "scene.prm").decode())
        keys = content(self.folder, "planned.prm").decode().count("  set ")
        self.assertLess(keys, 30, "it holds the keys of the scene and of the plan, not the defaults")

    def test_a_continuum_is_planned_by_itself(self):
        self.plan(OBLIQUE, "3%", *COARSE)
        plan = read_json(self.folder, "plan.json")
        (panel,) = plan["panels"]  # the scene sets nothing of grains
        self.assertEqual((panel["panel"], panel["command"], panel["seeds"]), ("continuum", "continuum", []))
        self.check_budget(panel, 0.03)
        reference = os.path.join(self.work, "fine")
        fine = setting(continuum_element_size=0.75, continuum_max_step=0.0005, continuum_initial_step=0.0005,
                       comparison_coarse_element_size=0)
        for scene, folder, words in ((OBLIQUE, reference, COARSE + fine),
                                     (self.path("planned.prm"), self.work + "/planned", [])):
            self.expect(0, ["continuum", scene, "--output", folder, "--quiet", *words])
        peaks = [max(history(folder, "continuum.csv")["stress_ratio"])
                 for folder in (reference, self.work + "/planned")]
        self.assertLess(abs(peaks[1] / peaks[0] - 1), 0.03)

    def test_both_panels_and_a_number_of_the_comparison(self):
        self.plan(QUICK, "50%", *SMALL, "--set", "discrete/step=auto", "--set", "discrete/tolerance=auto", "--for",
                  "final_volumetric_strain,discrete_summary peak_stress_ratio", "--jobs", "2")
        plan = read_json(self.folder, "plan.json")
        self.assertEqual([(p["panel"], p["command"]) for p in plan["panels"]],
                         [("discrete", "run"), ("continuum", "continuum")])
        self.assertIn("discrete/snapshot_max_sweeps = 0", plan["panels"][0]["settings"])
        self.assertIn("comparison/coarse_element_size = 0", plan["panels"][1]["settings"])
        self.assertEqual(len(plan["panels"][0]["quantities"]), 2)
        self.assertEqual(len(plan["panels"][1]["quantities"]), 1)


class Interruption(Plan):
    def ended(self):
        """Runs that came to their end, and when."""
        runs, found = self.path("runs"), {}
        for name in os.listdir(runs) if os.path.isdir(runs) else []:
            if name.endswith(".json") and "exit_code" in read_json(runs, name):
                found[name] = os.stat(os.path.join(runs, name)).st_mtime_ns
        return found

    def test_what_was_run_is_kept(self):
        words = setting(sample_grains=300, loading_axial_strain=0.02, loading_stage_strain=0.02)
        self.expect_stopped(signal.SIGINT, self.ended, "plan", GRAINS, "--accuracy", "30%", "--output", self.folder,
                            "--jobs", "1", *words)
        self.assertNotIn("plan.json", listing(self.folder))
        ended = self.ended()
        self.plan(GRAINS, "30%", *words, "--resume")
        for name, time_ns in ended.items():
            self.assertEqual(os.stat(self.path("runs", name)).st_mtime_ns, time_ns, "run again")
        # The cost of what is kept is the recorded one: the same runs make the same plan.
        first = without_clocks(read_json(self.folder, "plan.json"))
        self.plan(GRAINS, "30%", *words, "--resume", "--jobs", "2")
        self.assertEqual(without_clocks(read_json(self.folder, "plan.json")), first)


class Refused(Plan):
    def test_wrong_words_name_what_is_wrong(self):
        for scene, words, texts in [
                (GRAINS, ["--accuracy", "2%", "--for", "peak"], ["'peak'", "peak_stress_ratio, peak_friction"]),
                (GRAINS, ["--accuracy", "2%", "--set", "sample/grians=3"], ["sample/grians", "sample/grains"]),
                (GRAINS, ["--accuracy", "2%", "--set", "discrete/method=penalty"],
                 ["discrete/method = penalty", "nscd"]),
                (GRAINS, ["--accuracy", "2%", "--set", "loading/mode=time"], ["loading/mode = time"]),
                (OBLIQUE, ["--accuracy", "2%", "--for", "continuum.band_angle_deg"],
                 ["continuum/mesh = rectangle", "comparison"]),
                (OBLIQUE, ["--accuracy", "2%", "--for", "discrete.strength"], ["sets no key of sample or discrete"]),
                (GRAINS, [], ["--accuracy is required"])]:
            with self.subTest(words=words):
                self.expect(2, ["plan", scene, *words, "--output", self.folder], *texts)

    def test_an_accuracy_out_of_reach_is_said(self):
        result = self.plan(GRAINS, "0.1%", *setting(sample_grains=40, loading_axial_strain=0.01,
                                                    loading_stage_strain=0.01), code=3)
        self.assertIn("not reached", result.stderr)
        self.assertIn("NOT reached", result.stdout)
        (panel,) = read_json(self.folder, "plan.json")["panels"]
        self.assertFalse(panel["reaches"])
        self.assertEqual(len(panel["quantities"]), 2)  # the budget of what comes next
        self.assertIn("planned.prm", listing(self.folder))
