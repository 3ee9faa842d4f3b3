#!/usr/bin/env python3
# diptych: what begins again over results: its own input, somebody's files and runs of another scene are not lost, nor taken for its own
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: begun_again_test.py PROGRAM SOURCE_DIR [unittest arguments]."""

import copy
import json
import os
import shutil
import time

import faults_test
from faults_test import BOTH, FEW
from running import QUICK, SOURCE, bound_by_permissions, content, diptych, history, listing, main, setting, start, write

STUDY = {
    "scene": os.path.join(SOURCE, "benchmarks", "dense_biaxial", "scene.prm"), "command": "discrete", "seeds": "1-2",
    "set": {"sample/grains": 100, "loading/axial_strain": 0.005, "loading/stage_strain": 0.005},
    "reference": {"discrete/step": 0.1, "discrete/tolerance": 1e-4}, "axes": [{"key": "discrete/step", "values": [0.4]}],
    "quantities": [{"column": "volumetric_strain", "at": 0.005}]}
CALIBRATION = {
    "targets": [{"name": "fitted", "scene": QUICK, "seeds": "1-2",
                 "set": {"sample/grains": 100, "loading/axial_strain": 0.01, "loading/stage_strain": 0.005,
                         "loading/inertial_number": 1e-3, "comparison/window_edges": "0, 0.01"}}],
    "quantities": ["stress_ratio"], "bins": [0.002, 0.005, 0.01], "starts": 1, "load_step": 0.005, "check_samples": 0,
    "parameters": [{"key": "friction_angle_peak", "start": 20, "low": 14, "high": 40}]}
SEEDS = ["run", QUICK, *BOTH, "--jobs", "1", "--quiet"]


def changed(original, **entries):
    return {**copy.deepcopy(original), **entries}


class Begun(faults_test.Folder):
    @classmethod
    def made(cls, name):
        """Results that no test changes, made when they are first wanted."""
        folder = os.path.join(cls.keep.name, name)
        if not os.path.isdir(folder):
            if name in ("study", "fit"):
                command, document = {"study": ("study", STUDY), "fit": ("calibrate", CALIBRATION)}[name]
                words = [command, write(os.path.join(cls.keep.name, "asked.json"), json.dumps(document)), "--jobs", "1", "--quiet"]
            else:
                words = {"plan": ["plan", QUICK, *FEW, "--accuracy", "0.5", "--for", "discrete.strength", "--jobs", "1", "--quiet"],
                         "ensemble": [*SEEDS, "--seeds", "1-2"]}[name]
            cls.done(*words, "--output", folder)
        return folder

    @staticmethod
    def done(*words):
        result = diptych(*words)
        if result.returncode != 0:
            raise RuntimeError(result.stderr)

    def take(self, name):
        """Results in the test's own folder; their runs, those of grains first."""
        shutil.rmtree(self.folder, ignore_errors=True)
        shutil.copytree(self.made(name), self.folder)
        runs = os.path.join(self.folder, "runs")
        folders = [os.path.join(runs, one) for one in sorted(os.listdir(runs)) if os.path.isdir(os.path.join(runs, one))] if os.path.isdir(runs) else []
        return sorted(folders, key=lambda one: not os.path.exists(os.path.join(one, "discrete.h5")))

    def file(self, name, document):
        return write(os.path.join(self.work, name), json.dumps(document))

    def again(self, command, document, *words):
        return [command, self.file("asked.json", document), "--output", self.folder, "--jobs", "1", "--quiet", *words]


class Inputs(Begun):
    def test_what_is_read_is_not_among_what_is_replaced(self):
        runs = self.take("study")
        sample = os.path.join(runs[0], "discrete.h5")
        of_a_run = changed(STUDY, set={**STUDY["set"], "sample/file": sample})
        del of_a_run["seeds"]
        for resume in ([], ["--resume"]):
            self.expect(2, self.again("study", of_a_run, *resume), "sample/file", sample)
            self.take("plan")
            planned = os.path.join(self.folder, "planned.prm")
            self.expect(2, ["plan", planned, "--accuracy", "0.3", "--for", "discrete.strength", "--jobs", "1", "--output", self.folder, *resume], planned)
            runs = self.take("fit")
            own = changed(CALIBRATION, targets=[{"name": "fitted", "results": runs[:2]}])
            self.expect(2, self.again("calibrate", own, *resume), runs[0])
            self.take("study")
        inside = write(os.path.join(self.folder, "runs", "mine.json"), json.dumps(STUDY))
        self.expect(2, ["study", inside, "--output", self.folder], inside)

    def test_an_ensemble_does_not_replace_what_its_members_read(self):
        self.take("ensemble")
        echo = os.path.join(self.folder, "seed_1", "scene.prm")
        table = write(os.path.join(self.folder, "seed_2", "radii.csv"), "radius,passing\n0.3,0\n0.5,0.6\n0.7,1\n")
        for words in (["run", echo, *setting(discrete_friction=0.3)], ["run", QUICK, *BOTH, *setting(sample_radius_distribution="table", sample_radius_table=table)]):
            self.expect(2, [*words, "--seeds", "1-2", "--jobs", "1", "--quiet", "--output", self.folder], "whose results are replaced")

    def test_a_linked_folder_of_runs_is_the_folders(self):
        self.take("study")
        os.rename(os.path.join(self.folder, "runs"), os.path.join(self.work, "elsewhere"))
        os.symlink(os.path.join(self.work, "elsewhere"), os.path.join(self.folder, "runs"))
        inside = write(os.path.join(self.folder, "runs", "0123456789abcdef.json"), json.dumps(STUDY))
        self.expect(2, ["study", inside, "--output", self.folder], "is among what this study replaces")

    def test_a_study_is_begun_again_by_its_own_copy(self):
        self.take("study")
        self.expect(0, ["study", os.path.join(self.folder, "study_input.json"), "--output", self.folder, "--jobs", "1", "--quiet", "--resume"])

    def test_what_is_known_to_be_missing_is_told_before_the_old_results_go(self):
        self.take("fit")
        one = copy.deepcopy(CALIBRATION["targets"])
        one[0]["seeds"] = "1"
        self.expect(2, self.again("calibrate", changed(CALIBRATION, targets=one)), "stress_level must be given")
        for key in ("starts", "check_samples", "seed"):
            self.expect(2, self.again("calibrate", changed(CALIBRATION, **{key: 1.5})), f"{key} = 1.5", "whole number")

    def test_a_plan_goes_where_its_option_says(self):
        self.expect(2, ["plan", QUICK, *FEW, "--accuracy", "0.5", "--set", "output/directory=elsewhere"], "output/directory")

    def test_data_that_were_changed_are_not_fitted(self):
        runs = self.take("fit")
        table = os.path.join(runs[0], "discrete.csv")
        rows = content(table).split(b"\n")
        rows[20] = rows[20].replace(b"0.", b"0.9", 1)
        with open(table, "wb") as file:
            file.write(b"\n".join(rows))
        fit = changed(CALIBRATION, targets=[{"name": "fitted", "results": runs[:2]}])
        self.expect(2, ["calibrate", self.file("asked.json", fit), "--output", os.path.join(self.work, "fit")], table, "not what the run left")


class Foreign(Begun):
    def expect_kept(self, name, words, *places):
        for place in places:
            with self.subTest(place=place):
                runs = self.take(name)
                path = os.path.join(self.folder, place.replace("RUN", os.path.basename(runs[0]) if runs else ""))
                if os.path.isfile(path):
                    os.remove(path)
                os.makedirs(os.path.dirname(path), exist_ok=True)
                os.mkdir(path) if place.endswith((".json", ".log")) else write(path, "n\n")
                self.expect(2, words, path)

    def test_somebodys_files_are_not_removed(self):
        self.expect_kept("study", self.again("study", STUDY), "runs/mine", "runs/mine.json", "runs/RUN/notes.txt", "runs/RUN/discrete/notes.txt",
                         "runs/RUN.json", "runs/RUN.log")
        self.expect_kept("study", self.again("study", STUDY, "--resume"), "runs/RUN/notes.txt")
        self.expect_kept("fit", self.again("calibrate", CALIBRATION), "meshes/my.geo", "runs/RUN/continuum/notes.txt")
        for resume in ([], ["--resume"]):
            self.expect_kept("ensemble", [*SEEDS, "--seeds", "1-2", "--output", self.folder, *resume], "seed_1.log", "seed_2/continuum/notes.txt")

    def test_a_study_of_the_step_keeps_somebodys_file(self):
        for place in ("step_1", "step_1/discrete"):
            os.makedirs(os.path.join(self.folder, place), exist_ok=True)
        shutil.copytree(self.whole, self.folder, dirs_exist_ok=True)
        note = write(os.path.join(self.folder, "step_1", "notes.txt"), "n\n")
        self.expect(2, ["discrete", QUICK, *FEW, *setting(sample_seed=3), "--quiet", "--output", self.folder], note)

    def test_another_ensemble_in_the_folder_is_not_hindered_by_what_the_first_left(self):
        self.take("ensemble")
        for name in ("problem_0001.h5", "notes.txt"):
            write(os.path.join(self.folder, "seed_1", name), "n\n")
        self.expect(0, ["run", QUICK, *BOTH, *setting(discrete_friction=0.3), "--seeds", "1-2", "--jobs", "1", "--quiet", "--output", self.folder])
        self.assertEqual([name for name in ("problem_0001.h5", "notes.txt") if os.path.exists(os.path.join(self.folder, "seed_1", name))], ["notes.txt"])

    def test_a_member_that_cannot_be_made_leaves_the_statistics_of_the_others(self):
        self.take("ensemble")
        write(os.path.join(self.folder, "notes"), "n\n")
        os.mkdir(os.path.join(self.folder, "seed_9"))
        write(os.path.join(self.folder, "seed_9", "notes"), "n\n")
        self.expect(2, [*SEEDS, "--seeds", "9", "--output", self.folder], os.path.join(self.folder, "seed_9"))


class Permissions(Begun):
    """What cannot be removed is told while everything stands."""

    def locked(self, *names):
        path = os.path.join(self.folder, *names)
        os.chmod(path, 0o555)
        self.addCleanup(os.chmod, path, 0o755)
        return path

    def refused(self, words, *texts):
        before = {name: content(os.path.join(self.folder, name)) for name in listing(self.folder)}
        self.expect(4, [*words, "--quiet"], *texts, "nothing was written", preexec_fn=bound_by_permissions)
        self.assertEqual({name: content(os.path.join(self.folder, name)) for name in listing(self.folder)}, before)

    def test_of_a_result(self):
        shutil.copytree(self.whole, self.folder)
        for name in ("continuum", "discrete"):
            os.makedirs(os.path.join(self.folder, name), exist_ok=True)
            write(os.path.join(self.folder, name, "stage_0000.vtu"), "")
            path = self.locked(name)
            for words in (["run", *setting(sample_seed=4)], ["run"], ["discrete"], ["continuum", "--resume"]):
                with self.subTest(name=name, words=words):
                    self.refused([words[0], QUICK, *BOTH, *words[1:], "--output", self.folder], path)
            os.chmod(path, 0o755)

    def test_of_studies(self):
        runs = self.take("study")
        for names, words in ((["runs"], ["--resume"]), (["runs"], []), (["runs", os.path.basename(runs[0])], [])):
            with self.subTest(names=names, words=words):
                path = self.locked(*names)
                self.refused(self.again("study", STUDY, *words), path)
                os.chmod(path, 0o755)


class OtherScenes(Begun):
    def test_a_run_of_another_scene_is_not_taken_for_a_studys(self):
        def another(runs):
            self.done("discrete", runs[0] + ".prm", "--set", "discrete/friction=0.05", "--quiet", "--output", runs[0])

        def exchanged(runs):
            for one, other in ((0, "kept"), (1, runs[0]), ("kept", runs[1])):
                os.rename(runs[one] if one != "kept" else runs[0] + ".away", other if other != "kept" else runs[0] + ".away")

        for name, words, change, result in (("study", ("study", STUDY), another, "study.json"), ("study", ("study", STUDY), exchanged, "study.json"),
                                            ("fit", ("calibrate", CALIBRATION), exchanged, "calibrated.prm")):
            with self.subTest(name=name, change=change.__name__):
                change(self.take(name))
                self.expect(0, self.again(*words, "--resume"))
                self.assertEqual(content(os.path.join(self.folder, result)), content(os.path.join(self.made(name), result)))

    def test_a_study_that_was_moved_is_not_run_again(self):
        """Its runs name a table by where it lay."""
        table = write(os.path.join(self.work, "radii.csv"), "radius,passing\n0.3,0\n0.5,0.6\n0.7,1\n")
        study = changed(STUDY, set={**STUDY["set"], "sample/radius_distribution": "table", "sample/radius_table": table})
        self.expect(0, self.again("study", study))
        moved = os.path.join(self.work, "moved")
        os.mkdir(moved)
        os.rename(table, os.path.join(moved, "radii.csv"))
        study["set"]["sample/radius_table"] = os.path.join(moved, "radii.csv")
        self.expect(0, self.again("study", study, "--resume"))
        ends = os.path.join(self.folder, "runs")
        self.assertTrue(all(os.stat(os.path.join(ends, name)).st_mtime_ns < os.stat(os.path.join(self.work, "asked.json")).st_mtime_ns
                            for name in os.listdir(ends) if name.endswith(".json")))

    def test_an_input_that_was_changed_since_is_another_scene(self):
        """Its name is the same, and what the echo names is read as it now is."""
        table = write(os.path.join(self.work, "radii.csv"), "radius,passing\n0.3,0\n0.5,0.6\n0.7,1\n")
        words = ["run", QUICK, *BOTH, *setting(sample_radius_distribution="table", sample_radius_table=table), "--quiet", "--output", self.folder]
        seeds, ensemble = ["--seeds", "1-2", "--jobs", "1"], os.path.join(self.work, "ensemble")
        self.expect(0, words)
        self.expect(0, [*words[:-1], ensemble, *seeds])
        self.expect(0, [*words, "--resume"])
        write(table, "radius,passing\n0.3,0\n0.4,0.6\n0.7,1\n")
        self.expect(2, [*words, "--resume"], "sample/radius_table", table, "is not what it was")
        self.expect(2, [*words[:-1], ensemble, *seeds, "--resume"], "sample/radius_table", table, "is not what it was")
        self.expect(0, ["discrete", *words[1:]])
        self.assertFalse(os.path.exists(os.path.join(self.folder, "continuum.h5")))
        self.expect(0, [*words, "--resume"])
        self.expect(0, [*words[:-1], ensemble, *seeds])

    def test_means_are_of_members_of_one_scene(self):
        self.take("ensemble")
        self.done("run", QUICK, *BOTH, *setting(discrete_friction=0.9), "--quiet", "--output", os.path.join(self.folder, "seed_1"))
        member = os.path.join(self.folder, "seed_1", "scene.prm")
        self.expect(2, ["compare", self.folder], member, "discrete/friction")
        self.expect(2, [*SEEDS, "--seeds", "1-2", "--output", self.folder, "--resume"], member, "discrete/friction")
        self.expect(0, [*SEEDS, "--seeds", "1-2", "--output", self.folder])
        self.assertEqual(content(os.path.join(self.folder, "ensemble.csv")), content(os.path.join(self.made("ensemble"), "ensemble.csv")))

    def test_statistics_that_were_changed_are_not_drawn(self):
        self.take("ensemble")
        self.expect(0, ["report", self.folder, "--quiet"])
        path = os.path.join(self.folder, "ensemble.json")
        write(path, content(path).decode().replace('"mean": 0', '"mean": 7', 1))
        for command in ("report", "compare"):
            self.expect(2, [command, self.folder, "--quiet"], path, "not what the run left")
        self.take("ensemble")
        table = os.path.join(self.folder, "seed_1", "continuum.csv")
        write(table, content(table).decode().replace("0.", "1.", 1))
        self.expect(2, ["compare", self.folder, "--quiet"], table, "not what the run left")

    def test_a_continuum_of_other_keys_does_not_outlive_its_echo(self):
        other = setting(continuum_friction_angle_peak=30)
        truth = os.path.join(self.work, "truth")
        self.done("run", QUICK, *BOTH, *other, "--quiet", "--output", truth)
        for resume in ([], ["--resume"]):
            with self.subTest(resume=resume):
                shutil.rmtree(self.folder, ignore_errors=True)
                shutil.copytree(self.whole, self.folder)
                self.expect(0, ["discrete", QUICK, *BOTH, *other, *resume, "--quiet", "--output", self.folder])
                self.assertEqual([name for name in listing(self.folder) if name.startswith(("continuum", "comparison", "fields"))], [])
                self.expect(0, ["run", QUICK, *BOTH, *other, "--resume", "--quiet", "--output", self.folder])
                self.assertEqual(list(history(self.folder, "continuum.csv")["stress_ratio"]), list(history(truth, "continuum.csv")["stress_ratio"]))

    def test_a_comparison_of_other_keys_does_not_outlive_its_echo(self):
        for change, is_kept in (([], True), (setting(comparison_max_bands=1), False), (setting(continuum_checkpoint_minutes=7), True)):
            with self.subTest(change=change):
                shutil.rmtree(self.folder, ignore_errors=True)
                shutil.copytree(self.whole, self.folder)
                self.expect(0, ["continuum", QUICK, *BOTH, *change, "--resume", "--quiet", "--output", self.folder])
                self.assertEqual(os.path.exists(os.path.join(self.folder, "comparison.json")), is_kept)

    def test_a_comparison_of_other_keys_is_what_its_echo_says(self):
        """And no member of an ensemble of the keys that it had."""
        self.take("ensemble")
        member = os.path.join(self.folder, "seed_1")
        table = os.path.join(self.work, "radii.csv")
        self.expect(0, ["compare", member, *setting(comparison_max_bands=1), "--quiet"])
        self.assertIn(b"set max_bands = 1\n", content(os.path.join(member, "scene.prm")))
        again = [*SEEDS, "--seeds", "1-2", "--output", self.folder]
        self.expect(2, [*again, "--resume"], member, "comparison/max_bands", f"diptych compare {member} --set")
        self.expect(0, again)
        self.assertEqual(content(os.path.join(self.folder, "ensemble.csv")), content(os.path.join(self.made("ensemble"), "ensemble.csv")))
        write(table, "radius,passing\n0.3,0\n0.5,0.6\n0.7,1\n")
        run = ["run", QUICK, *BOTH, *setting(sample_radius_distribution="table", sample_radius_table=table), "--quiet", "--output", os.path.join(self.work, "one")]
        self.expect(0, run)
        write(table, "radius,passing\n0.3,0\n0.4,0.6\n0.7,1\n")  # the grains are still those of the old table
        self.expect(0, ["compare", run[-1], *setting(comparison_max_bands=1), "--quiet"])
        self.expect(2, [*run, *setting(comparison_max_bands=1), "--resume"], "sample/radius_table", "is not what it was")

    def test_a_copy_of_an_echo_does_not_go_where_its_run_went(self):
        shutil.copytree(self.whole, self.folder)
        copied = os.path.join(self.work, "copied")
        shutil.copytree(self.folder, copied)
        mine = os.path.join(self.work, "mine.prm")
        echo = content(os.path.join(self.folder, "scene.prm")).decode()
        write(mine, echo.replace(f"directory = {self.whole}", f"directory = {self.folder}"))
        for scene in (mine, os.path.join(copied, "scene.prm")):
            for command in ("discrete", "run", "continuum", "material-point"):
                self.expect(2, [command, scene, "--quiet"], scene, "output/directory", "--output")
        write(os.path.join(self.work, "planned.prm"), content(mine).decode().replace(f"directory = {self.folder}", "directory ="))
        self.expect(0, ["discrete", "planned.prm", "--quiet"])
        self.expect(0, ["discrete", "planned.prm", "--quiet"])
        self.assertTrue(os.path.exists(os.path.join(self.work, "results", "planned", "discrete.h5")))
        self.expect(0, ["discrete", mine, "--quiet", "--output", os.path.join(self.work, "other")])
        self.expect(0, ["discrete", os.path.join(self.work, "other", "scene.prm"), "--quiet"])  # in its own folder

    def test_no_page_of_another_comparison_stays(self):
        shutil.copytree(self.whole, self.folder)
        page = os.path.join(self.folder, "report.html")
        self.expect(0, ["report", self.folder, "--quiet"])
        self.assertTrue(os.path.exists(page))
        self.expect(0, ["compare", self.folder, *setting(comparison_max_bands=1), "--quiet"])
        self.assertFalse(os.path.exists(page))
        self.take("ensemble")
        self.expect(0, ["report", self.folder, "--quiet"])
        self.expect(0, ["compare", self.folder, *setting(comparison_margin_angle=1), "--quiet"])
        self.assertFalse(os.path.exists(page))

    def test_an_echo_that_was_changed_is_not_believed(self):
        """It alone tells what the results are of: with another friction in it the old grains would be those of that friction."""
        def change(echo):
            text = content(echo).decode()
            self.assertEqual(text.count("set friction = "), 1)
            write(echo, text.replace("set friction = ", "set friction = 0.9 # "))

        shutil.copytree(self.whole, self.folder)
        echo = os.path.join(self.folder, "scene.prm")
        change(echo)
        for words in (["compare", self.folder], ["report", self.folder], ["run", echo, "--resume"], ["continuum", echo], ["discrete", echo, "--resume"],
                      ["discrete", QUICK, *BOTH], ["material-point", echo]):
            told = [] if words[1] == self.folder else ["--output", self.folder]
            self.expect(2, [*words, *told, "--quiet"], echo, "not what the run left")
        self.expect(2, ["export", self.folder, "--format", "lammps", "--output", os.path.join(self.work, "given")], echo, "not what the run left")
        fit = changed(CALIBRATION, targets=[{"name": "fitted", "results": [self.folder]}])
        self.expect(2, ["calibrate", self.file("fit.json", fit), "--output", os.path.join(self.work, "fit"), "--quiet"], echo, "not what the run left")
        self.expect(0, ["run", echo, "--quiet", "--output", os.path.join(self.work, "other")])
        self.take("ensemble")
        change(os.path.join(self.folder, "seed_1", "scene.prm"))
        self.expect(2, ["compare", self.folder], os.path.join(self.folder, "seed_1", "scene.prm"))
        self.expect(2, [*SEEDS, "--seeds", "1-2", "--resume", "--output", self.folder], os.path.join(self.folder, "seed_1", "scene.prm"))
        process = start("discrete", QUICK, *BOTH, *setting(sample_grains=400), "--quiet", "--output", self.folder + "_ran", cwd=self.work)
        echo = self.folder + "_ran/scene.prm"
        while process.poll() is None and not os.path.exists(os.path.join(os.path.dirname(echo), "discrete.csv")):
            time.sleep(0.002)
        self.assertIsNone(process.poll(), "it ended before its echo was changed")
        change(echo)
        process.communicate()
        self.expect(2, ["export", os.path.dirname(echo), "--format", "csv", "--output", os.path.join(self.work, "given")], echo, "not what the run left")
        for run in self.take("study")[:1]:
            write(run + "/scene.prm", content(run + "/scene.prm").decode() + "# mine\n")
        self.expect(0, self.again("study", STUDY, "--resume"))
        self.assertNotIn(b"# mine", content(run + "/scene.prm"))

    def test_a_point_of_another_sample_leaves_no_comparison(self):
        shutil.copytree(self.whole, self.folder)
        self.expect(0, ["material-point", QUICK, "--quiet", "--output", self.folder])
        self.assertEqual(listing(self.folder), ["material_point.csv", "provenance.json", "scene.prm"])


if __name__ == "__main__":
    main()
