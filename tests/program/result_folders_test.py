# diptych: result folders: refused, gone on from, overwritten, and never emptied of what others put there
# SPDX-License-Identifier: LGPL-2.1-or-later
import json
import os
import shutil
import signal

import faults_test
from faults_test import BOTH
from running import content, contents, diptych, history, listing, member_of, QUICK, setting, SOURCE, write

OTHER = setting(continuum_friction_angle_peak=30)
STUDY = {
    "scene": os.path.join(SOURCE, "benchmarks", "dense_biaxial", "scene.prm"), "command": "discrete", "seeds": "1-2",
    "set": {"sample/grains": 100, "loading/axial_strain": 0.005, "loading/stage_strain": 0.005},
    "reference": {"discrete/step": 0.1, "discrete/tolerance": 1e-4},
    "axes": [{"key": "discrete/step", "values": [0.4]}], "quantities": [{"column": "volumetric_strain", "at": 0.005}]}


class Folders(faults_test.Folder):
    def setUp(self):
        super().setUp()
        shutil.copytree(self.whole, self.folder)

    def words(self, command, *more):
        return [command, QUICK, *BOTH, *more, "--quiet", "--output", self.folder]

    def curve(self, folder):
        return list(history(folder, "continuum.csv")["stress_ratio"])

    def truth(self):
        """What OTHER gives in a folder of its own."""
        truth = os.path.join(self.keep.name, "truth")
        if not os.path.isdir(truth):
            self.assertEqual(diptych("run", QUICK, *BOTH, *OTHER, "--quiet", "--output", truth).returncode, 0)
        return truth


class Refused(Folders):
    def test_results_are_replaced_only_on_request(self):
        for command in ("run", "discrete"):
            self.expect(2, self.words(command, *setting(discrete_friction=0.3)), self.folder, "discrete/friction",
                        "--output", "--overwrite")
        self.expect(2, self.words("run", *OTHER), "--resume", "--overwrite")

    def test_results_of_another_sample_are_not_gone_on_from(self):
        for words in (["run", "--resume"], ["discrete", "--resume"], ["continuum"], ["continuum", "--resume"],
                      ["material-point"]):
            self.expect(2, self.words(*words, *setting(discrete_friction=0.3)), "discrete/friction", self.folder)

    def test_a_folder_with_other_files_is_refused(self):
        shutil.rmtree(self.folder)
        os.mkdir(self.folder)
        write(self.path("thesis.tex"), "n\n")
        for words in (["run"], ["run", "--resume"], ["run", "--overwrite"], ["run", "--seeds", "1-2"],
                      ["run", "--seeds", "1-2", "--overwrite"]):
            self.expect(2, self.words(*words), self.folder)

    def test_a_second_writer_is_refused(self):
        shutil.rmtree(self.folder)
        process = self.started_until(lambda: os.path.exists(self.path("provenance.json")),
                                     *self.words("discrete", *setting(sample_grains=400)), cwd=self.work)
        result = diptych(*self.words("discrete", "--overwrite", *setting(sample_grains=400)), cwd=self.work)
        self.assertIsNone(process.poll(), "it ended before the second writer came")
        self.assertEqual(process.wait(), 0)
        self.assertEqual(result.returncode, 4, result.stderr)
        self.assertIn(f"process {process.pid}", result.stderr)
        self.assertFalse(os.path.exists(self.folder + ".1"))

    def test_a_changed_byte_is_noticed(self):
        for name, commands in (("discrete.csv", ("compare", "report", "resume")),
                               ("continuum.csv", ("compare", "report", "resume")),
                               ("discrete.h5", ("compare", "report", "resume")),
                               ("continuum.h5", ("compare", "report")), ("comparison.json", ("report",))):
            path = self.path(name)
            whole = content(path)
            with open(path, "wb") as file:
                file.write(whole[:-20] + bytes([whole[-20] ^ 1]) + whole[-19:])
            for command in commands:
                with self.subTest(name=name, command=command):
                    words = self.words("run", "--resume") if command == "resume" else [command, self.folder, "--quiet"]
                    self.expect(2, words, path)
            with open(path, "wb") as file:
                file.write(whole)


class Overwritten(Folders):
    def test_the_old_results_are_renamed_whole(self):
        write(self.path("notes.txt"), "mine\n")
        before = contents(self.folder)
        for seed in (3, 4):  # one generation is kept
            self.expect(0, self.words("discrete", "--overwrite", *setting(sample_seed=seed)))
            if seed == 3:
                self.assertEqual(contents(self.folder + ".1"), before)
        self.assertNotIn("notes.txt", listing(self.folder))
        self.assertIn(b"set seed = 3", content(self.folder + ".1", "scene.prm"))
        self.assertIn(b"set seed = 4", content(self.path("scene.prm")))

    def test_an_input_is_never_moved(self):
        sample = self.path("discrete.h5")
        for command in ("discrete", "run"):
            self.expect(2, self.words(command, "--overwrite", *setting(sample_file=sample)), sample)
        old = os.path.join(self.folder + ".1", "discrete.h5")
        shutil.copytree(self.folder, self.folder + ".1")
        self.expect(2, self.words("discrete", "--overwrite", *setting(sample_file=old)), old)

    def test_a_folder_of_the_new_name_with_other_files_is_kept(self):
        os.mkdir(self.folder + ".1")
        write(os.path.join(self.folder + ".1", "thesis.tex"), "n\n")
        self.expect(2, self.words("discrete", "--overwrite"), self.folder + ".1")

    def test_what_is_refused_leaves_the_results_in_their_place(self):
        self.expect(2, self.words("discrete", "--overwrite", *setting(discrete_friction=-1)), "discrete/friction")
        self.expect(2, self.words("run", "--overwrite", *setting(sample_target_solid_fraction=0.99)),
                    "target_solid_fraction")

    def test_ensembles_and_studies(self):
        study = [write(os.path.join(self.work, "study.json"), json.dumps(STUDY)), "--jobs", "2", "--quiet"]
        for words in (["run", QUICK, *BOTH, "--seeds", "1-2", "--jobs", "2", "--quiet"], ["study", *study]):
            with self.subTest(command=words[0]):
                shutil.rmtree(self.folder)
                shutil.rmtree(self.folder + ".1", ignore_errors=True)
                words += ["--output", self.folder]
                self.expect(0, words)
                before = listing(self.folder)
                self.expect(2, words, "--overwrite")
                self.expect(0, [*words, "--overwrite"])
                self.assertEqual(listing(self.folder + ".1"), before)


class GoneOn(Folders):
    def test_a_finished_run_of_the_same_scene_is_recognised(self):
        before = contents(self.folder)
        words = [word for word in self.words("run") if word != "--quiet"]
        self.assertIn("finished run of this scene", self.expect(0, words).stdout)
        for command, answer in (("continuum", "not run again"), ("discrete", "finished grains of this scene")):
            self.assertIn(answer, self.expect(0, [word for word in self.words(command) if word != "--quiet"]).stdout)
        self.assertEqual(contents(self.folder), before)

    def test_another_continuum_takes_the_place_of_the_first(self):
        grains = content(self.path("discrete.h5"))
        for command in (["run", "--resume"], ["continuum"]):
            with self.subTest(command=command):
                shutil.rmtree(self.folder)
                shutil.copytree(self.whole, self.folder)
                self.expect(0, self.words(*command, *OTHER))
                self.assertEqual(self.curve(self.folder), self.curve(self.truth()))
                self.assertEqual(content(self.path("discrete.h5")), grains)
                self.assertIn(b"set friction_angle_peak = 30\n", content(self.path("scene.prm")))
                self.assertNotIn("next", os.listdir(self.folder))
                self.assertEqual(os.path.exists(self.path("comparison.json")), command[0] == "run")
                self.expect(0, ["compare", self.folder, "--quiet"])

    def test_until_it_is_complete_the_first_continuum_stays(self):
        """Killed at any moment, the folder is that of the first continuum, and --resume ends with the second one's
        bits."""
        first, second = self.curve(self.folder), self.curve(self.truth())
        comparison = content(self.path("comparison.json"))
        words = self.words("run", "--resume", *OTHER, *setting(continuum_checkpoint_minutes=0))
        for name in ("continuum_checkpoint.h5", "comparison.json"):
            self.signalled(signal.SIGKILL, lambda name=name: os.path.exists(self.path("next", name)), *words,
                           cwd=self.work)
            self.assertEqual((self.curve(self.folder), content(self.path("comparison.json"))),
                             (first, comparison))
        self.expect(0, words)
        self.assertEqual(self.curve(self.folder), second)
        self.assertNotEqual(content(self.path("comparison.json")), comparison)
        self.assertNotIn("next", os.listdir(self.folder))

    def test_a_changed_scene_file_is_noticed(self):
        scene = self.path("scene.prm")
        write(scene, content(scene).decode().replace("set max_bands = 2", "set max_bands = 1"))
        for command in ("compare", "report"):
            self.expect(2, [command, self.folder], scene, "was changed")

    def test_another_comparison_needs_no_panel_again(self):
        panels = {name: content(self.path(name)) for name in ("discrete.h5", "continuum.h5")}
        self.expect(0, self.words("run", "--resume", *setting(comparison_max_bands=1)))
        self.expect(0, ["compare", self.folder, *setting(comparison_max_bands=2), "--quiet"])
        self.expect(2, ["compare", self.folder, *setting(comparison_coarse_element_size=5)], "diptych run --resume")
        self.assertEqual({name: content(self.path(name)) for name in panels}, panels)
        self.assertIn(b"set max_bands = 2\n", content(self.path("scene.prm")))

    def test_a_changed_input_file_is_another_sample(self):
        shutil.rmtree(self.folder)
        table = write(os.path.join(self.work, "radii.csv"), "radius,passing\n0.3,0\n0.5,0.6\n0.7,1\n")
        words = self.words("run", *setting(sample_radius_distribution="table", sample_radius_table=table))
        self.expect(0, words)
        write(table, "radius,passing\n0.3,0\n0.4,0.6\n0.7,1\n")
        self.expect(2, [*words, "--resume"], "input file has changed")

    def test_members_of_an_ensemble_are_of_one_scene(self):
        shutil.rmtree(self.folder)
        words = self.words("run", "--seeds", "1-2", "--jobs", "2")
        self.expect(0, words)
        table = content(self.path("ensemble.csv"))
        member = member_of(self.folder, 1)
        self.expect(0, ["run", QUICK, *BOTH, *setting(discrete_friction=0.9), "--quiet", "--overwrite", "--output",
                        member])
        self.expect(2, ["compare", self.folder], member, "discrete/friction")
        self.expect(0, [*words, "--resume"])  # repeated, and the other scene is kept
        self.assertIn(b"set friction = 0.9\n", content(os.path.join(member + ".1", "scene.prm")))
        self.assertEqual(content(self.path("ensemble.csv")), table)
