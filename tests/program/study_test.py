# diptych: studies: points, errors and classes; workers, processes, growth; what is refused; the page
# SPDX-License-Identifier: LGPL-2.1-or-later
import json
import os
import re
import resource
import shutil
import signal
import time
import unittest

import pandas

import browser
from running import (bits, content, diptych, finished, Folder, listing, read_json, setting, SOURCE, start, temporary,
                     write)

# 150 grains between smooth rigid walls: a run takes a fifth of a second.
STUDY = {
    "title": "Steps of a small sample",
    "scene": os.path.join(SOURCE, "benchmarks", "dense_biaxial", "scene.prm"),
    "command": "discrete",
    "set": {"sample/grains": 150, "loading/axial_strain": 0.01, "loading/stage_strain": 0.01},
    "seeds": "1-2",
    "reference": {"discrete/step": 0.05, "discrete/tolerance": 1e-4},
    "axes": [{"key": "discrete/step", "values": [0.8, 0.2, 0.1], "converges": True},
             {"key": "discrete/tolerance", "values": [0.5, 1e-4]}],
    "quantities": [{"name": "strength", "strength": [0.002, 0.01], "limit": {"relative": 0.05}},
                   {"column": "volumetric_strain", "at": 0.01}],
}
N_RUNS = 14
ROOM = 60000  # bytes that a file may have: what a full disk does
# Long enough to be interrupted in.
LONG = {**STUDY, "seeds": "1-1", "set": {**STUDY["set"], "sample/grains": 400, "loading/axial_strain": 0.05},
        "axes": [{"key": "discrete/step", "values": [0.1, 0.07]}]}


class Study(Folder):
    def study_file(self, study):
        return write(os.path.join(self.work, "steps.json"), json.dumps(study, indent=1))

    def record(self):
        return read_json(self.folder, "study.json")

    def classes(self):
        return {point["class"] for point in self.record()["points"]}

    def run_study(self, study, *words, code=0, told=()):
        return self.expect(code, ["study", self.study_file(study), "--output", self.folder, *words], *told)

    def times(self):
        """When each run's table was written."""
        return {name: os.stat(self.path(name)).st_mtime_ns for name in listing(self.folder)
                if name.endswith("discrete.csv")}

    def worker_at_work(self, process):
        """Process number of a study's worker, once a run of it has a sample."""
        while process.poll() is None:
            for number in filter(str.isdigit, os.listdir("/proc")):
                try:
                    words = content(f"/proc/{number}/cmdline").split(b"\0")
                    parent = content(f"/proc/{number}/stat").rsplit(b")", 1)[1].split()[1]
                except OSError:
                    continue
                begun = [name for name in listing(self.folder) if name.endswith("stage_0000.h5")]
                if b"diptych.campaigns.runs.worker" in words and int(parent) == process.pid and begun:
                    return int(number)
            time.sleep(0.002)
        return self.fail("it ended before its worker was found")


class Points(Study):
    """A study of seven points on two samples, run once."""

    @classmethod
    def setUpClass(cls):
        work = temporary(cls)
        cls.done, file = os.path.join(work, "done"), write(os.path.join(work, "steps.json"), json.dumps(STUDY))
        finished("study", file, "--output", cls.done, "--jobs", "1")

    def test_every_point_is_there_with_its_errors(self):
        record = read_json(self.done, "study.json")
        self.assertEqual([p["labels"] for p in record["points"]],
                         [[]] + [[step, tolerance] for step in ("0.8", "0.2", "0.1")
                                 for tolerance in ("0.5", "0.0001")])
        self.assertEqual(record["points"][0]["quantities"][0]["error"], {"value": 0, "low": 0, "high": 0})
        by_labels = {tuple(p["labels"]): p for p in record["points"]}
        # Unsolved contacts carry nothing: half the strength is gone, and the program had warned of the tolerance.
        loose = by_labels["0.8", "0.5"]
        self.assertLess(loose["quantities"][0]["error"]["value"], -0.3)
        self.assertEqual(loose["class"], "wrong, warned")
        # A means over pairs: what the table holds of both samples.
        rows = pandas.read_csv(os.path.join(self.done, "study.csv"))
        self.assertEqual(len(rows), N_RUNS)
        fine, here = (rows[rows.point == point]["strength"].mean() for point in (0, 5))
        self.assertAlmostEqual(record["points"][5]["quantities"][0]["error"]["value"], here / fine - 1, places=12)
        self.assertTrue((rows["exit_code"] == 0).all() and (rows["cpu_s of discrete"] > 0).all())

    def test_a_point_gives_the_numbers_of_a_run_of_its_own(self):
        record = read_json(self.done, "study.json")
        folder = os.path.join(self.done, record["points"][4]["folders"][1])
        self.expect(0, ["discrete", folder + ".prm", "--output", self.folder, "--quiet"])
        self.expect_same_files(folder, "discrete.csv")

    def test_the_number_of_workers_does_not_change_a_bit(self):
        self.run_study(STUDY, "--jobs", "2")
        self.expect_same_files(self.done, "study.json")
        self.assertEqual(bits(self.path("study.h5")), bits(os.path.join(self.done, "study.h5")))

    def test_a_study_that_grows_runs_only_what_is_new(self):
        shutil.copytree(self.done, self.folder)
        before = self.times()
        axes = [{**STUDY["axes"][0], "values": [0.8, 0.4, 0.2, 0.1]}, STUDY["axes"][1]]
        result = self.run_study({**STUDY, "axes": axes}, "--resume")
        self.assertIn(f"{N_RUNS} of {N_RUNS + 4} runs are finished", result.stdout)
        after = self.times()
        self.assertEqual(len(after), N_RUNS + 4)
        self.assertEqual({name: after[name] for name in before}, before)
        self.assertEqual(self.record()["points"][5]["quantities"],
                         read_json(self.done, "study.json")["points"][3]["quantities"])

    def test_runs_of_another_revision_are_run_again(self):
        shutil.copytree(self.done, self.folder)
        name = self.record()["points"][1]["folders"][0]
        end = read_json(self.folder, name + ".json")
        write(self.path(name + ".json"), json.dumps({**end, "revision": "another"}))
        write(self.path(name + "/notes.txt"), "of the user")
        result = self.run_study(STUDY, "--resume", told=["repeated runs (of revision another): 1"])
        self.assertIn(f"{N_RUNS - 1} of {N_RUNS} runs are finished", result.stdout)
        self.assertEqual(content(self.path(name + ".1/notes.txt")), b"of the user")
        self.expect_same_files(self.done, "study.json")

    def test_other_limits_need_no_run(self):
        shutil.copytree(self.done, self.folder)
        before = self.times()
        self.run_study({**STUDY, "quantities": [{**STUDY["quantities"][0], "limit": {"relative": 10}}]}, "--resume")
        self.assertEqual(self.times(), before)
        self.assertEqual(self.classes(), {"right"})

    def test_costs_stand_apart(self):
        bill = read_json(self.done, "study_cost.json")
        self.assertEqual(bill["phases"], ["discrete", "preparation"])
        self.assertEqual(bill["runs"], N_RUNS)
        everything = [c for c in bill["cheapest"] if c["quantity"] == "" and c["accuracy"] == 1]
        self.assertEqual(len(everything), 1)
        self.assertNotIn("cpu_s", content(self.done, "study.json").decode())

    def test_the_page_draws_itself_again(self):
        shutil.copytree(self.done, self.folder)
        page = content(self.path("report.html"))
        self.expect(0, ["report", self.folder])
        self.assertEqual(content(self.path("report.html")), page)
        links = re.findall(r'(?:href|src)="([^"]+)"', page.decode())
        self.assertEqual([link for link in links if not link.startswith(("data:", "runs/", "#"))], [])

    @unittest.skipUnless(browser.program(), "no chromium on the PATH: test.sh installs it")
    def test_curves_appear_when_points_are_ticked(self):
        with browser.Page(1200, 900) as page:
            page.open(os.path.join(self.done, "report.html"))
            shown = "[...document.querySelectorAll('#curves path')].map((p) => p.dataset.curve)"
            self.assertEqual(page.run(shown), ["0"])
            page.run("document.querySelector('input[data-point=\"3\"]').click()")
            self.assertEqual(page.run(shown), ["0", "3"])
            first = page.run("document.querySelector('#curves path').getAttribute('d')")
            page.run("(() => { const s = document.querySelector('#which'); s.selectedIndex = 1;"
                     "s.dispatchEvent(new Event('change')); })()")
            self.assertNotEqual(page.run("document.querySelector('#curves path').getAttribute('d')"), first)
            page.size(390, 844)  # a phone: nothing but tables in frames of their own is wider
            self.assertLessEqual(page.run("document.documentElement.scrollWidth"), 390)
            self.assertEqual(page.messages, [])


class Failures(Study):
    def test_points_that_fail_are_kept_with_their_words(self):
        """One that does not converge, one whose settings contradict each other; the third is right."""
        study = {**STUDY, "seeds": "1-1", "axes": [{"name": "case", "points": [
            {"label": "plain", "set": {}},
            {"label": "no sweeps", "set": {"discrete/tolerance": 1e-13, "discrete/max_sweeps": 20}},
            {"label": "half a stage", "set": {"loading/stage_strain": 0.004}}]}]}
        self.run_study(study, told=["failed with exit code 3"])
        points = self.record()["points"][1:]
        self.assertEqual([p["class"] for p in points], ["right", "stopped", "refused"])
        self.assertIn("did not converge", points[1]["words"])
        self.assertNotIn(self.folder, points[1]["words"])
        self.assertIn("loading/stage_strain = 0.004", points[2]["words"])
        before = self.times()
        self.run_study(study, "--resume")  # how a point failed is a result
        self.assertEqual(self.times(), before)

    def expect_few_lost_and_run_again(self, process, most, words):
        _, errors = process.communicate()
        self.assertEqual(process.returncode, 3, errors)
        self.assertIn(words, errors)
        self.assertIn(sum(p["class"] == "not run" for p in self.record()["points"]), range(1, most + 1))
        self.run_study(LONG, "--resume")
        self.assertNotIn("not run", self.classes())

    def test_a_killed_worker_loses_its_run_alone(self):
        process = start("study", self.study_file(LONG), "--output", self.folder, "--jobs", "1")
        os.kill(self.worker_at_work(process), signal.SIGKILL)
        self.expect_few_lost_and_run_again(process, 1, "failed with exit code 137")

    def test_a_full_disk_under_a_worker_loses_what_it_ran_alone(self):
        process = start("study", self.study_file(LONG), "--output", self.folder, "--jobs", "1")
        worker = self.worker_at_work(process)
        resource.prlimit(worker, resource.RLIMIT_FSIZE, (ROOM, resource.RLIM_INFINITY))
        while process.poll() is None and len([n for n in listing(self.folder) if n.endswith(".log")]) < 2:
            time.sleep(0.002)
        # somebody made room
        resource.prlimit(worker, resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
        # the next may begin before there is room
        self.expect_few_lost_and_run_again(process, 2, "failed with exit code 4")

    def test_a_window_beyond_the_loading_is_pointed_out_and_not_judged(self):
        study = {**STUDY, "seeds": "1-1", "axes": [{"key": "discrete/step", "values": [0.2]}],
                 "quantities": [{"name": "far", "strength": [0.5, 0.9], "limit": {"relative": 0.05}}]}
        self.run_study(study, told=["no value of 'far'"])
        self.assertEqual(self.classes(), {"unjudged"})

    def test_a_folder_that_is_no_study_is_left_alone(self):
        os.mkdir(self.folder)
        write(self.path("mine.txt"), "mine")
        self.run_study(STUDY, code=2, told=["holds other files"])

    def test_wrong_studies_are_refused_before_anything_is_written(self):
        for study, words in [({**STUDY, "seedz": 3}, ["seedz", "'seeds'"]),
                             ({**STUDY, "axes": [{"key": "output/directory", "values": ["x", "y"]}]},
                              ["output/directory cannot be set"]),
                             ({**STUDY, "seeds": "1-2", "axes": [{"key": "sample/seed", "values": [1, 2]}]},
                              ["seeds", "sample/seed = 1"]),
                             ({**STUDY, "set": {"sample/grains": 0}}, ["sample/grains = '0'", "whole number"])]:
            with self.subTest(words=words):
                self.run_study(study, code=2, told=[*words, "steps.json, line "])
        self.assertIn("with scene and axes", diptych("study", write(os.path.join(self.work, "empty.json"), "")).stderr)
        self.assertIn("not valid JSON", diptych("study", write(os.path.join(self.work, "broken.json"), "{")).stderr)
        self.assertIn("--resume", diptych("study", self.study_file(STUDY), "--step").stderr)
        self.assertFalse(os.path.exists(self.folder))


class Effects(Folder):
    """Two frictions on two samples, both panels."""

    SCENE = ("subsection sample\n  set grains = 300\nend\nsubsection loading\n  set inertial_number = 1e-3\n  set "
             "axial_strain = 0.01\nend\nsubsection comparison\n  set window_edges = 0, 0.01\nend\n")

    @classmethod
    def setUpClass(cls):
        work = temporary(cls)
        cls.scene, cls.done = write(os.path.join(work, "tiny.prm"), cls.SCENE), os.path.join(work, "done")
        cls.process = finished("study", cls.scene, "--vary", "discrete/friction=0.1,0.6", "--seeds", "1-2",
                               *setting(sample_grains=150), "--output", cls.done)

    def test_means_follow_from_the_summaries_of_the_runs(self):
        table, record = pandas.read_csv(os.path.join(self.done, "effects.csv")), read_json(self.done, "study.json")
        self.assertEqual(len(table), 2 * 11 * 3)  # points, key numbers, panels
        peaks = table[(table["discrete/friction"] == 0.6) & (table.quantity == "peak t/s")].set_index("panel")["mean"]
        summaries = [pandas.read_csv(os.path.join(self.done, folder, "summary.csv"))
                     for folder in record["points"][1]["folders"]]
        for panel in ("grains", "continuum", "difference"):
            self.assertAlmostEqual(peaks[panel], sum(s[panel][0] for s in summaries) / 2, places=8)

    def test_terminal_and_page_judge_nothing(self):
        page = content(self.done, "report.html").decode()
        for text in (self.process.stdout, page):
            for word in ("unjudged", "heapest", "reference"):
                self.assertNotIn(word, text)
            self.assertIn("peak t/s", text)
            self.assertIn("not fitted to these grains", text)  # 150 of them
        self.assertIn("<h1>tiny: effect of discrete/friction</h1>", page)
        self.assertRegex(self.process.stdout, "discrete/friction, changes (beyond|within) the scatter: ")

    def test_the_kept_study_file_gives_the_same_and_keeps_the_runs(self):
        shutil.copytree(self.done, self.folder)
        file = shutil.copy(self.path("study_input.json"), os.path.join(self.work, "tiny.json"))
        result = self.expect(0, ["study", file, "--output", self.folder, "--resume"])
        self.assertIn("4 of 4 runs are finished", result.stdout)
        self.expect_same_files(self.done, "study.json")
        other = shutil.copy(file, os.path.join(self.work, "other.json"))
        self.expect(2, ["study", other, "--output", self.folder, "--resume"], "is of the study 'tiny', not 'other'")
        self.expect_same_files(self.done, "study.json")

    def test_wrong_words_are_refused_with_key_value_and_range(self):
        file = write(os.path.join(self.work, "file.json"), json.dumps(STUDY))
        for words, expected in [([self.scene], "is a scene; give --vary"),
                                ([file, "--vary", "discrete/friction=1"], "is a study file"),
                                ([self.scene, "--vary", "discrete/friction"], "section/key=value,value"),
                                ([self.scene, "--vary", "discrete/friktion=1,2"], "the nearest is 'discrete/friction'"),
                                ([self.scene, "--vary", "discrete/friction=1,-2"],
                                 "discrete/friction = '-2' is not allowed; give a number from 0"),
                                ([self.scene, "--vary", "discrete/friction=1,1.0"],
                                 "values of discrete/friction: '1' is listed twice"),
                                ([self.scene, "--vary", "sample/seed=1,2", "--seeds", "1-2"], "sample/seed = 1"),
                                ([self.scene, "--vary", "loading/axial_strain=0.013"], "every point is refused")]:
            with self.subTest(words=words[1:]):
                self.expect(2, ["study", *words, "--output", self.folder], expected)


class Comparisons(Study):
    def test_both_panels_and_numbers_of_their_comparison(self):
        study = {"scene": os.path.join(SOURCE, "benchmarks", "moreau_quick", "scene.prm"), "command": "run",
                 "set": {"sample/grains": 150, "loading/inertial_number": 1e-3, "loading/axial_strain": 0.01,
                         "comparison/window_edges": [0, 0.01], "discrete/step": 0.1, "discrete/tolerance": 1e-4,
                         "continuum/element_size": 2.5, "comparison/coarse_element_size": 3},
                 "reference": {}, "axes": [{"key": "continuum/friction_angle_peak", "values": [21]}],
                 "quantities": [{"number": "continuum_summary peak_stress_ratio", "limit": {"relative": 0.01}},
                                {"number": "discrete_summary peak_stress_ratio", "limit": {"absolute": 1e-9}}]}
        self.run_study(study)
        point = self.record()["points"][1]
        self.assertEqual([q["verdict"] for q in point["quantities"]], ["beyond", "within"])
        self.assertEqual(point["class"], "silently wrong")
        self.assertNotIn("report.html", [os.path.basename(name) for name in listing(self.path("runs"))])
