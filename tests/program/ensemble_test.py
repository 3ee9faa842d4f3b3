# diptych: one scene on many samples: members, statistics, failures, interruption, several processes, the page
# SPDX-License-Identifier: LGPL-2.1-or-later
import json
import os
import re
import shutil
import signal
import subprocess
import tempfile
import time

import pandas

from running import (content, diptych, ENVIRONMENT, Folder, listing, member_of, PROGRAM, QUICK, read_json, setting,
                     start, write)

# 150 grains and a coarse continuum: a member takes less than a second.
TINY = setting(sample_grains=150, loading_inertial_number=1e-3, loading_axial_strain=0.01, discrete_step=0.1,
               discrete_tolerance=1e-4, discrete_snapshot_max_sweeps=100, discrete_reference_sweeps=0,
               comparison_window_edges="0,0.01", continuum_element_size=2.5, comparison_coarse_element_size=3)
PLAIN = TINY + setting(output_report="false")
# The grains' part long enough to be interrupted in.
LONG = PLAIN + setting(sample_grains=200, loading_inertial_number=5e-4, loading_axial_strain=0.04,
                       loading_stage_strain=0.01, comparison_window_edges="0,0.04")


def read(folder, name="ensemble.json"):
    return read_json(folder, name)


def quantity(folder, name):
    return next(q for q in read(folder)["quantities"] if q["name"] == name)


class Ensemble(Folder):
    def run_seeds(self, seeds, *words, scene=PLAIN, code=0, folder=None):
        folder = folder or self.folder
        result = diptych("run", QUICK, *scene, "--seeds", seeds, "--output", folder, *words)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        if code != 2:
            self.assertEqual([name for name in listing(folder) if name.endswith(".part")], [])
        return result


class Statistics(Ensemble):
    """Three seeds without their pages."""

    @classmethod
    def setUpClass(cls):
        cls.three = os.path.join(cls.enterClassContext(tempfile.TemporaryDirectory()), "three")
        cls.process = diptych("run", QUICK, *PLAIN, "--seeds", "1-3", "--jobs", "1", "--output", cls.three)
        assert cls.process.returncode == 0, cls.process.stderr

    def test_every_member_is_a_result_folder_of_its_own(self):
        for seed in (1, 2, 3):
            record = read(member_of(self.three, seed), "comparison.json")
            self.assertEqual((record["seed"], record["scene"]), (seed, "moreau_quick"))
            self.assertTrue(os.path.exists(member_of(self.three, seed) + ".log"))
        record = read(self.three)
        self.assertEqual((record["seeds"], record["done"], record["failed"]), ([1, 2, 3], [1, 2, 3], []))

    def test_a_single_run_of_a_seed_gives_the_same_numbers(self):
        diptych("run", QUICK, *PLAIN, *setting(sample_seed=2), "--output", self.folder, "--quiet")
        member = read(member_of(self.three, 2), "comparison.json")
        self.assertEqual(read(self.folder, "comparison.json")["stages"], member["stages"])

    def test_means_are_those_of_the_members(self):
        peaks = [read(member_of(self.three, k), "comparison.json")["discrete_summary"]["peak_stress_ratio"]
                 for k in (1, 2, 3)]
        found = quantity(self.three, "discrete_summary peak_stress_ratio")
        self.assertEqual(found["values"], peaks)
        mean = sum(peaks) / 3
        self.assertAlmostEqual(found["mean"], mean, places=12)
        # t of 2 degrees of freedom, 0.975: 4.30265; the interval is t s / sqrt(3) to each side.
        half = 4.30265 * (sum((p - mean) ** 2 for p in peaks) / 2) ** 0.5 / 3 ** 0.5
        self.assertAlmostEqual(found["high"] - found["low"], 2 * half, delta=1e-5 * half)
        row = pandas.read_csv(os.path.join(self.three, "ensemble.csv")).set_index("quantity").loc[found["name"]]
        self.assertAlmostEqual(row["mean"], mean, places=8)
        self.assertAlmostEqual(row["seed_3"], peaks[2], places=8)

    def test_the_summary_has_the_rows_of_a_single_run_with_intervals_and_verdicts(self):
        """The terminal ends with it. Its peak is the mean over the seeds; its difference is that of the means."""
        first, single = read(self.three)["summary"], read(member_of(self.three, 1), "comparison.json")["summary"]
        self.assertEqual([(row["quantity"], row["unit"]) for row in first],
                         [(row["quantity"], row["unit"]) for row in single])
        peak = quantity(self.three, "discrete_summary peak_stress_ratio")
        self.assertEqual(first[0]["grains"], {"value": peak["mean"], "low": peak["low"], "high": peak["high"]})
        self.assertAlmostEqual(first[0]["difference"]["value"], first[0]["continuum"]["value"] - peak["mean"],
                               places=12)
        self.assertRegex(first[0]["verdict"], r"^(equivalent within|different by more than|cannot tell \(margin) 3 %")
        self.assertRegex(self.process.stdout, r"(?m)^peak t/s +0\.\d+ \[.*3 %")

    def test_the_first_numbers_and_the_count_of_the_checks_are_in_summary_csv(self):
        record, table = read(self.three), pandas.read_csv(os.path.join(self.three, "summary.csv"), index_col="quantity")
        self.assertEqual(list(table.index), [*(row["quantity"] for row in record["summary"]), "checks"])
        self.assertAlmostEqual(table.grains["peak t/s"], record["summary"][0]["grains"]["value"], places=8)
        members = [read(member_of(self.three, k), "comparison.json")["checks"] for k in (1, 2, 3)]
        broken = {one["key"] for checks in members for one in checks if not one["kept"]}
        self.assertEqual({one["key"] for one in record["checks"] if one["broken"]}, broken)
        count = f"{len(broken)} of {len(members[0])} checks fail" if broken else f"all {len(members[0])} checks hold"
        self.assertEqual(table.verdict["checks"], count)
        self.assertIn(count, self.process.stdout)

    def test_the_number_at_once_does_not_change_a_bit(self):
        self.run_seeds("3,1-2", "--jobs", "2")
        for name in ("ensemble.json", "ensemble.csv"):
            self.assertEqual(content(self.path(name)), content(os.path.join(self.three, name)), name)

    def test_several_processes_share_the_seeds(self):
        words = ["mpirun", "--oversubscribe", "-np", "2", PROGRAM, "run", QUICK, *PLAIN, "--seeds", "1-3", "--output",
                 self.folder]
        result = subprocess.run(words, env=ENVIRONMENT, capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(content(self.path("ensemble.json")), content(os.path.join(self.three, "ensemble.json")))
        self.assertEqual(result.stdout.count("volumetric strain at the end"), 1)  # only the first process speaks
        self.assertEqual(read(member_of(self.folder, 2), "comparison.json")["continuum_summary"]["processes"], 1)

    def test_other_margins_need_no_run(self):
        """Any two positive stress ratios are equivalent within 10 times their mean, and nothing within a millionth."""
        shutil.copytree(self.three, self.folder)
        comparison = os.path.join(member_of(self.folder, 1), "comparison.json")
        before = os.stat(comparison).st_mtime_ns
        verdicts = {}
        for margin in ("10", "1e-6"):
            again = diptych("compare", self.folder, "--set", "comparison/margin_peak_stress_ratio=" + margin)
            self.assertEqual(again.returncode, 0, again.stderr)
            verdicts[margin] = next(v for v in read(self.folder)["verdicts"] if v["quantity"] == "peak_stress_ratio")
        self.assertEqual(verdicts["10"]["verdict"], "equivalent")
        self.assertNotEqual(verdicts["1e-6"]["verdict"], "equivalent")
        self.assertEqual(os.stat(comparison).st_mtime_ns, before)
        refused = diptych("compare", self.folder, "--set", "comparison/window_edges=0,0.005")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("margin_", refused.stderr)

    def test_a_comparison_that_is_not_the_members_is_named(self):
        """Another member in its place counts one sample twice; a number changed by hand counts as measured."""
        record = read_json(member_of(self.three, 2), "comparison.json")
        record["discrete_summary"]["peak_stress_ratio"] = 5.0
        first, second = (self.path(folder) for folder in read(self.three)["folders"][:2])
        comparison = os.path.join(second, "comparison.json")
        for put, told in ((lambda: shutil.copytree(first, second, dirs_exist_ok=True), "sample/seed"),
                          (lambda: shutil.copy(os.path.join(first, "comparison.json"), second), "comparison.json"),
                          (lambda: write(comparison, json.dumps(record)), "comparison.json")):
            with self.subTest(told=told):
                shutil.rmtree(self.folder, ignore_errors=True)
                shutil.copytree(self.three, self.folder)
                put()
                refused = diptych("compare", self.folder)
                self.assertEqual(refused.returncode, 2, refused.stderr)
                self.assertIn(second, refused.stderr)
                self.assertIn(told, refused.stderr)
                self.assertEqual(content(self.path("ensemble.json")),
                                 content(os.path.join(self.three, "ensemble.json")))

    def test_more_seeds_are_added_by_resuming(self):
        shutil.copytree(self.three, self.folder)
        files = [self.path(folder, "discrete.h5") for folder in read(self.three)["folders"]]
        before = [os.stat(file).st_mtime_ns for file in files]
        result = self.run_seeds("1-4", "--resume")
        self.assertIn("3 of 4 runs are finished", result.stdout)
        self.assertEqual(read(self.folder)["done"], [1, 2, 3, 4])
        self.assertEqual([os.stat(file).st_mtime_ns for file in files], before)
        self.assertEqual(quantity(self.folder, "discrete_summary peak_stress_ratio")["values"][:3],
                         quantity(self.three, "discrete_summary peak_stress_ratio")["values"])

    def test_an_ensemble_of_an_earlier_version_is_read_and_not_continued(self):
        """Its members are in seed_K, and ensemble.json names no folders, keys and windows."""
        shutil.copytree(self.three, self.folder)
        record = read(self.folder)
        for seed, folder in zip(record["seeds"], record.pop("folders")):
            os.rename(self.path(folder), self.path(f"seed_{seed}"))
            os.rename(self.path(folder + ".log"), self.path(f"seed_{seed}.log"))
        shutil.rmtree(self.path("runs"))
        bare = [{key: one[key] for key in one if key not in ("key", "window")} for one in record["verdicts"]]
        write(self.path("ensemble.json"), json.dumps({**record, "verdicts": bare}))
        facts = read(self.folder, "provenance.json")
        write(self.path("provenance.json"), json.dumps({key: facts[key] for key in facts if key != "ensemble_files"}))
        for words in (["report", self.folder], ["compare", self.folder, *setting(output_report="true")]):
            self.assertEqual(diptych(*words, "--quiet").returncode, 0)
            self.assertIn(b'href="seed_3.log"', content(self.path("report.html")))
        self.assertEqual(read(self.folder), {**record, "folders": ["seed_1", "seed_2", "seed_3"]})
        self.assertIn("an earlier version wrote", self.run_seeds("1-4", "--resume", code=2).stderr)


class Failures(Ensemble):
    def test_a_failed_seed_is_named_and_the_rest_kept(self):
        """The folder of seed 2 cannot be locked, which its own run finds out."""
        self.run_seeds("1-2", "--quiet")
        lost = member_of(self.folder, 2)
        shutil.rmtree(lost)
        os.makedirs(os.path.join(lost, ".diptych.lock"))
        write(lost + ".json", json.dumps({"begun": read(self.folder, "provenance.json")["git_revision"]}))
        result = self.run_seeds("1-3", "--resume", scene=TINY, code=3)
        for text in ["seed 2 failed with exit code 4", "cannot be locked", lost + ".log", "failed: seed 2",
                     "2 of 3 seeds are done"]:
            self.assertIn(text, result.stderr)
        record = read(self.folder)
        self.assertEqual(record["done"], [1, 3])
        self.assertEqual([(m["seed"], m["exit_code"]) for m in record["failed"]], [(2, 4)])
        self.assertEqual(quantity(self.folder, "discrete_summary peak_stress_ratio")["n"], 2)
        self.assertEqual(listing(lost), [])
        self.assertIn(b"Failed: seed 2", content(self.path("report.html")))

    def test_a_seed_that_does_not_converge_fails(self):
        """Its panels' reason stands in the record, and there is nothing to average."""
        self.run_seeds("5-6", scene=PLAIN + setting(discrete_tolerance=1e-13, discrete_max_sweeps=20), code=3)
        record = read(self.folder)
        self.assertEqual((record["done"], record["quantities"]), ([], []))
        self.assertEqual([m["exit_code"] for m in record["failed"]], [3, 3])
        self.assertIn("did not converge", record["failed"][0]["message"])


class Interruption(Ensemble):
    """An ensemble that is stopped goes on to the same bits. Two seeds at once."""

    @classmethod
    def setUpClass(cls):
        cls.alone = os.path.join(cls.enterClassContext(tempfile.TemporaryDirectory()), "alone")
        result = diptych("run", QUICK, *LONG, "--seeds", "1-3", "--jobs", "2", "--output", cls.alone, "--quiet")
        assert result.returncode == 0, result.stderr

    def test_a_stop_signal(self):
        """It arrives when the first member has its prepared sample, the first thing that a run keeps."""
        process = start("run", QUICK, *LONG, "--seeds", "1-3", "--jobs", "2", "--output", self.folder)
        while process.poll() is None and not any(name.endswith("discrete.h5") for name in listing(self.work)):
            time.sleep(0.002)
        process.send_signal(signal.SIGTERM)
        _, errors = process.communicate()
        self.assertEqual(process.returncode, 3, errors)
        for text in ["stopped on request", "--resume", "--seeds 1-3", self.folder]:
            self.assertIn(text, errors)
        self.assertIn(3, read(self.folder)["interrupted"])  # never begun
        self.assertEqual(read(self.folder)["failed"], [])
        self.assertTrue(any(name.endswith("/checkpoint.h5") for name in listing(self.folder)))
        self.run_seeds("1-3", "--jobs", "2", "--resume", scene=LONG)
        self.assertEqual(content(self.path("ensemble.json")), content(os.path.join(self.alone, "ensemble.json")))
        self.assertEqual([name for name in listing(self.folder) if "checkpoint" in name], [])

    def test_another_scene_is_refused_and_nothing_changes(self):
        shutil.copytree(self.alone, self.folder)
        before = {name: content(self.path(name)) for name in listing(self.folder)}
        result = self.run_seeds("1-3", "--resume", scene=LONG + setting(discrete_friction=0.3), code=2)
        self.assertIn("discrete/friction = '0.3'", result.stderr)
        self.assertIn("'0.4'", result.stderr)
        self.assertEqual({name: content(self.path(name)) for name in listing(self.folder)}, before)


class WrongInput(Ensemble):
    def expect_wrong(self, words, *texts):
        result = diptych(*words, "--output", self.folder)
        self.assertEqual(result.returncode, 2, result.stderr)
        for text in texts:
            self.assertIn(text, result.stderr)
        self.assertFalse(os.path.exists(self.folder))

    def test_lists_that_are_none(self):
        for seeds in ["", "3-1", "1-3,3", "0-10000"]:
            self.expect_wrong(["run", QUICK, *PLAIN, "--seeds", seeds], "--seeds")
        for words in (["run"], ["calibrate"], ["study", "--vary", "discrete/friction=0.3,0.4"]):
            self.expect_wrong([*words, QUICK, "--seeds", "4"], "one seed or a number", "1-4", "4-4")

    def test_words_that_do_not_fit_together(self):
        self.expect_wrong(["discrete", QUICK, "--seeds", "1-2"], "--seeds 1-2", "diptych run")
        self.expect_wrong(["run", QUICK, "--jobs", "2"], "unexpected argument '--jobs 2'", "--seeds")
        self.expect_wrong(["run", QUICK, "--seeds", "1-2", "--jobs", "0"], "--jobs", "from 1 to 4096")
        self.expect_wrong(["run", QUICK, "--seeds", "1-2", "--set", "sample/seed=3"], "sample/seed=3", "--seeds 1-2")

    def test_a_sample_of_a_file_has_no_seed(self):
        rows = "".join(f"{x},0.5,0.5\n" for x in range(12))
        grains = write(os.path.join(self.work, "grains.csv"), "x,y,r\n" + rows)
        self.expect_wrong(["run", QUICK, *setting(sample_file=grains), "--seeds", "1-2"], "sample/file", "grains.csv")

    def test_a_folder_that_is_no_ensemble_is_left_alone(self):
        os.mkdir(self.folder)
        write(self.path("scene.prm"), "# mine: every parameter, as it was used\n")
        for words in [[], ["--resume"]]:
            result = self.run_seeds("1-2", *words, code=2)
            self.assertIn("holds other files", result.stderr)
        self.assertEqual(listing(self.folder), ["scene.prm"])


class Page(Ensemble):
    def test_verdicts_figures_and_links(self):
        result = self.run_seeds("1-3", scene=TINY + setting(loading_horizontal_over_vertical=0))
        self.assertIn("report.html", result.stdout)
        text = content(self.path("report.html")).decode()
        for seed in (1, 2, 3):
            page = os.path.join(member_of(self.folder, seed), "report.html")
            self.assertIn(f'href="{os.path.relpath(page, self.folder)}"', text)
            self.assertTrue(os.path.getsize(page) > 0)
        links = re.findall(r'(?:href|src)="([^"]+)"', text)
        self.assertEqual([link for link in links if not link.startswith(("data:", "runs/", "#"))], [])
        # four peaks, strength, force, volume, angle and width of one window
        self.assertEqual(len(re.findall(r'<td class="verdict', text)), 11)
        self.assertIn("two one-sided tests", text)
        self.assertTrue(read(self.folder)["folded"])  # left and right by chance
        images = re.findall(r'<img src="data:[^"]+" alt="([^"]{20,})"', text)
        self.assertGreaterEqual(len(images), 5)  # differences, two of dots, two histories; no band, no dots
        diptych("report", self.folder)
        self.assertEqual(content(self.path("report.html")).decode(), text)
