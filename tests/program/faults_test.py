# diptych: wrong input, failures of the system and signals: the message and the exit code, and nothing is lost
# SPDX-License-Identifier: LGPL-2.1-or-later
"""tests/robustness has random cases of the same rules."""

import json
import os
import re
import resource
import shutil
import signal
import subprocess
import tempfile
import time

import h5py

import running
from running import (content, contents, diptych, ENVIRONMENT, facts, finished, listing, member_of, PROBLEMS, PROGRAM,
                     QUICK, setting, SMALL, start, write)

FEW = SMALL + setting(sample_grains=60, output_report="false")
BOTH = FEW + setting(continuum_element_size=2.5, continuum_initial_step=0.0025, continuum_max_step=0.0025,
                     comparison_coarse_element_size=0, comparison_band_resamples=0, comparison_probe_resamples=0)
RECTANGLE = setting(continuum_mesh="rectangle", continuum_rectangle_width=40, continuum_rectangle_height=60,
                    continuum_initial_step=1e-3, continuum_max_step=1e-3)


class Folder(running.Folder):
    @classmethod
    def setUpClass(cls):
        cls.keep = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.keep.cleanup)
        cls.whole = os.path.join(cls.keep.name, "whole")
        finished("run", QUICK, *BOTH, "--output", cls.whole, "--quiet")

    def discrete(self, *words):
        return ["discrete", QUICK, *FEW, *words, "--output", self.folder, "--quiet"]

    def run_both(self, *words):
        return ["run", QUICK, *BOTH, *words, "--output", self.folder, "--quiet"]


class Inputs(Folder):
    def test_values_that_no_machine_could_compute(self):
        for words, text in ((setting(sample_width=1e12), "sample/width"),
                            (setting(discrete_step=1e-12), "discrete/step"),
                            (setting(loading_inertial_number=1e-12), "loading/inertial_number"),
                            (["--threads", "100000"], "--threads")):
            self.expect(2, self.discrete(*words), text)
        self.expect(4, self.discrete(*setting(loading_inertial_number=1e-9, discrete_step=0.011)),
                    "discrete/history_interval")
        self.assertFalse(os.path.exists(self.folder))

    def test_scenes_that_are_refused(self):
        carriage_returns = content(QUICK).decode().replace("\n", "\r")
        for name, text, *said in (("a.json", '{"sampel": {}}', "sampel"),
                                  ("a.prm", "subsection sampel\nend\n", "sampel"), ("a.prm", "", "empty"),
                                  ("a.json", "", "empty"), ("a.prm", "\n \t\r\n", "empty"),
                                  ("a.prm", carriage_returns, "a.prm, line 1", "carriage return"),
                                  ("a.prm", "subsection sample\n  set grains = 100\n  set grains = 60\nend\n",
                                   "a.prm, line 3", "sample/grains", "line 2")):
            with self.subTest(name=name, text=text[:20]):
                with open(os.path.join(self.work, name), "w", newline="") as file:
                    file.write(text)
                self.expect(2, ["discrete", name, *FEW, "--output", self.folder, "--quiet"], name, *said)
        self.expect(2, ["discrete", QUICK, *FEW, "--output", "", "--quiet"], "--output")
        self.expect(0, ["discrete", write(os.path.join(self.work, "a.prm"), "# defaults\n"), *FEW, "--output",
                        self.folder, "--quiet"])

    def test_a_pipe_as_an_input_is_refused_before_it_is_opened(self):
        """A program that opens it waits for a writer."""
        for name in ("p.prm", "p.csv", "p.h5", "p.json"):
            os.mkfifo(os.path.join(self.work, name))
        for words in (["discrete", "p.prm"], ["discrete", QUICK, *FEW, *setting(sample_file="p.csv")],
                      ["discrete", QUICK, *FEW, *setting(sample_file="p.h5")],
                      ["solve", "p.h5"], ["study", "p.json"], ["calibrate", "p.json"], ["import", "csv", "p.csv"]):
            with self.subTest(words=words):
                self.expect(2, [*words, *([] if words[0] == "solve" else ["--output", self.folder])],
                            words[-1].split("=")[-1], timeout=60)

    def test_an_input_is_never_moved_or_removed(self):
        """An input in the folder that --overwrite would rename, or in the earlier one that it would remove."""
        study = {"scene": QUICK, "command": "discrete", "reference": {"discrete/step": 0.1},
                 "axes": [{"key": "discrete/step", "values": [0.4]}],
                 "quantities": [{"column": "volumetric_strain", "at": 0.005}]}
        calibration = {"targets": [{"name": "a", "scene": QUICK, "seeds": "1-1"}], "quantities": ["stress_ratio"],
                       "bins": [0.005],
                       "parameters": [{"key": "friction_angle_peak", "start": 21, "low": 14, "high": 40}]}
        inputs = {"mine.prm": content(QUICK).decode(), "study.json": json.dumps(study),
                  "fit.json": json.dumps(calibration),
                  "grains.csv": "x,y,r\n" + "".join(f"{x},{y},0.5\n" for x in range(12) for y in (0.5, 1.5))}
        lines = (["run", "mine.prm", *BOTH], ["run", QUICK, *BOTH, *setting(sample_file="grains.csv")],
                 ["study", "study.json"],
                 ["discrete", "mine.prm", *BOTH], ["continuum", "mine.prm", *BOTH],
                 ["material-point", "mine.prm", *BOTH],
                 ["discrete", QUICK, *BOTH, "--set-file", "mine.prm"], ["run", "mine.prm", *BOTH, "--seeds", "1-2"],
                 ["calibrate", "fit.json"], ["plan", "mine.prm", *BOTH, "--accuracy", "0.5"],
                 ["import", "csv", "grains.csv", "--walls-touch"])
        for place, tried in ((self.folder, lines), (self.folder + ".1", lines[:3])):
            shutil.copytree(self.whole, place)
            for name, text in inputs.items():
                write(os.path.join(place, name), text)
            for line in tried:
                words = [re.sub(r"(^|sample/file=)(mine.prm|study.json|fit.json|grains.csv)$", rf"\1{place}/\2", word)
                         for word in line]
                with self.subTest(command=line[0], words=line[-1], place=os.path.basename(place)):
                    self.expect(2, [*words, "--overwrite", "--output", self.folder], place)
            for name in inputs:
                os.remove(os.path.join(place, name))

    def test_grains_that_carry_nothing_are_pointed_out(self):
        """Sixty diameters apart: t/s comes from single impacts."""
        rows = "".join(f"{60 * i + 0.1 * j},{60 * j + 0.2 * i},0.5\n" for i in range(8) for j in range(8))
        words = self.discrete(*setting(sample_file=write(os.path.join(self.work, "cloud.csv"), "x,y,r\n" + rows),
                                       loading_axial_strain=0.001,
                                       loading_stage_strain=0.0005, comparison_window_edges="0,0.001"))
        self.expect(0, words, "nothing is pressed together")
        self.assertIn(b"nothing is pressed together", content(self.path("provenance.json")))
        self.assertNotIn(b"nothing is pressed together", content(self.whole, "provenance.json"))
        self.expect(3, [*words, "--overwrite", *setting(sample_prepare_file="true", sample_preparation_steps=1)],
                    "nothing carries loading/pressure")

    def test_the_remedy_of_a_warning_helps(self):
        """The warning is there, and with the remedy that it names it is gone."""
        springs = {"discrete_method": "compliant", "discrete_penalty_stiffness": 20}
        explicit = {"discrete_method": "penalty", "discrete_penalty_step_fraction": 0.9}
        uncorrected = {"discrete_tolerance": 0.5, "discrete_penetration_correction": "none"}
        long = {"discrete_step": 1, "discrete_tolerance": 1e-3}
        for warning, doubtful, remedy in [
                ("discrete/step = auto keeps", {"discrete_step": 0.4}, {"discrete_step": "auto"}),
                ("discrete/tolerance = auto keeps", {"discrete_tolerance": 0.1}, {"discrete_tolerance": "auto"}),
                ("a smaller discrete/step or", long, {"discrete_step": 0.1}),
                ("a smaller discrete/step or", uncorrected, {"discrete_tolerance": 1e-4}),
                ("a larger discrete/penalty_stiffness", springs, {"discrete_penalty_stiffness": 1e4}),
                ("a smaller discrete/penalty_step_fraction", explicit, {"discrete_penalty_step_fraction": 0.2})]:
            with self.subTest(warning=warning, doubtful=doubtful):
                words = self.discrete(*setting(**doubtful), "--overwrite")
                self.expect(0, words, warning)
                self.assertNotIn(warning, finished(*words, *setting(**remedy)).stderr)
        still = self.discrete(*setting(loading_mode="time", loading_duration=5, loading_stage_time=5,
                                       discrete_method="penalty", discrete_lateral="rigid_walls",
                                       discrete_side_motion="velocity", comparison_window_edges="0,5"), "--overwrite")
        self.assertNotIn("of energy", finished(*still).stderr)

    def test_solutions_replace_solutions_only(self):
        scene = write(os.path.join(self.work, "scene.prm"), "# mine\n")
        small, medium = (os.path.join(PROBLEMS, name) for name in ("small.h5", "medium.h5"))
        self.expect(2, ["solve", small, "--output", scene], scene)
        solution = os.path.join(self.work, "solved.h5")
        for _ in range(2):
            self.assertEqual(diptych("solve", small, "--output", solution).returncode, 0)
        self.expect(2, ["solve", medium, "--output", solution], solution)
        problem = shutil.copy(medium, self.work)
        self.expect(2, ["solve", small, "--output", problem], problem)

    def test_platens_at_rest_and_probes_outside_the_sample_are_refused(self):
        rest = setting(loading_mode="time", loading_duration=1, loading_stage_time=0.5, comparison_window_edges="0,1",
                       discrete_lateral="rigid_walls")
        self.expect(2, self.run_both(*rest), "discrete/drive_upper_y")
        for words, text in ((setting(comparison_probe_circle="100,100,5"), "comparison/probe_circle"),
                            (setting(sample_grains=12), "sample/grains"),
                            ([*setting(comparison_probe_rectangles="100,100,5,5,0"), "--seeds", "1-2", "--jobs", "1"],
                             "comparison/probe_rectangles")):
            with self.subTest(text=text):
                self.expect(2, self.run_both(*words), text)


class Results(Folder):
    def test_a_failed_comparison_keeps_both_panels(self):
        """The platen moves down by 0.1 d and more, through a probe that begins 0.03 d below it."""
        with h5py.File(os.path.join(self.whole, "discrete.h5"), "r") as file:
            height = file["stage_0000"].attrs["upper_y"] - file["stage_0000"].attrs["lower_y"]
        words = setting(comparison_probe_rectangles=f"0,{height / 2 + 0.485},5,1.03,0")
        self.expect(3, self.run_both(*words), "comparison/probe_rectangles", "kept in " + self.folder)
        self.assertIn("continuum.h5", listing(self.folder))

    def test_results_do_not_need_the_table_of_their_sample(self):
        with h5py.File(os.path.join(self.whole, "discrete.h5"), "r") as file:
            grains = file["stage_0000/grains"]
            rows = [f"{x!r},{y!r},{r!r}\n" for (x, y, _), r in zip(grains["position"][()].tolist(),
                                                                   grains["radius"][()].tolist())]
        table = write(os.path.join(self.work, "grains.csv"), "x,y,r\n" + "".join(rows))
        self.expect(0, self.run_both(*setting(sample_file=table)))
        os.remove(table)
        for words in (["compare", self.folder], ["report", self.folder],
                      ["export", self.folder, "--format", "csv", "--output", "theirs"]):
            self.expect(0, [*words, "--quiet"])
        self.expect(2, ["export", self.folder, "--format", "csv", "--output", self.folder], "--output")
        self.expect(2, ["compare", self.folder, "--output", "other"], "--output")

    def test_an_ensemble_and_a_run_in_the_folder_of_a_member_do_not_mix(self):
        words = self.run_both("--seeds", "1-2", "--jobs", "1")
        self.expect(0, words)
        member = member_of(self.folder, 2)
        other = start("discrete", QUICK, *FEW, *setting(sample_grains=400), "--overwrite", "--output", member,
                      "--quiet")
        while other.poll() is None and not (os.path.exists(member + ".1")
                                            and os.path.exists(os.path.join(member, "scene.prm"))):
            time.sleep(0.002)
        os.kill(other.pid, signal.SIGSTOP)
        self.addCleanup(other.communicate)
        self.addCleanup(other.kill)
        self.assertIsNone(other.poll(), "it ended before the ensemble came")
        before = contents(member)
        for more in ("--resume", "--overwrite"):
            with self.subTest(more=more):
                result = diptych(*words, more)
                self.assertIn(result.returncode, (2, 3, 4), result.stderr)
                self.assertIn(member, result.stderr)
                self.assertEqual(contents(member), before)

    def test_a_report_script_that_fails(self):
        shutil.copytree(self.whole, self.folder)
        os.mkdir(self.path("report.html.part"))  # the script cannot write its page
        self.expect(4, ["report", self.folder, "--quiet"], "the report could not be drawn", "kept in",
                    "comparison.json")

    def test_a_run_that_ends_early_tells_why(self):
        self.expect(3, self.discrete(*setting(discrete_tolerance=1e-13, discrete_max_sweeps=20)), "did not converge")
        self.assertIn("discrete.h5", listing(self.folder))
        shutil.rmtree(self.folder)
        self.expect(3, self.discrete(*setting(sample_grains=100, discrete_method="penalty",
                                              discrete_penalty_step_fraction=1.5)), "blew up")
        for wrong in ("max_sweeps", "did not converge"):
            self.assertNotIn(wrong, facts(self.folder)["message"])


def with_waiting_signal():
    """For preexec_fn: SIGTERM waits when the program starts, and arrives as soon as the program accepts it."""
    signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGTERM])
    os.kill(os.getpid(), signal.SIGTERM)


def with_limit(kind, value):
    return lambda: resource.setrlimit(kind, (value, value))


class Machine(Folder):
    def test_a_signal_at_the_start_ends_with_code_3_and_writes_nothing(self):
        for command in ("discrete", "run", "continuum"):
            self.expect(3, [command, QUICK, *BOTH, "--output", self.folder], "stopped on request",
                        preexec_fn=with_waiting_signal)
            self.assertFalse(os.path.exists(self.folder))

    def test_the_program_after_an_exec_accepts_the_signal_too(self):
        """`diptych` becomes diptych-panels, which accepts waiting signals again after the start of MPI."""
        panels = os.path.join(os.path.dirname(PROGRAM), "diptych-panels")
        if not os.path.exists(panels):
            self.skipTest("installed elsewhere, or a build without the continuum")
        result = subprocess.run([panels, "continuum", QUICK, *BOTH, "--output", self.folder], env=ENVIRONMENT,
                                capture_output=True, text=True, preexec_fn=with_waiting_signal, check=False)
        self.expect_message(result, 3, "stopped on request")
        self.assertFalse(os.path.exists(self.folder))

    def test_a_full_disk_during_a_run(self):
        """Once the first stage is there, no file grows any more."""
        for command, begun, words in (("discrete", "discrete/stage_0000.h5", FEW),
                                      ("continuum", "continuum/stage_0000.vtu", FEW + RECTANGLE)):
            with self.subTest(command=command):
                shutil.rmtree(self.folder, ignore_errors=True)
                more = setting(loading_axial_strain=0.2, comparison_window_edges="0,0.2")
                process = self.started_until(lambda begun=begun: os.path.exists(self.path(begun)), command, QUICK,
                                             *words, *more, "--output", self.folder, "--quiet")
                resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (60000, 60000))
                out, errors = process.communicate()
                self.expect_message(subprocess.CompletedProcess(command, process.returncode, out, errors), 4,
                                    "kept in " + self.folder, "scene.prm")

    def test_a_full_disk_under_a_comparison_with_other_keys(self):
        """The earlier comparison is either still that of scene.prm, or no report shows it."""
        shutil.copytree(self.whole, self.folder)
        scene = content(self.path("scene.prm"))
        self.expect(4, ["compare", self.folder, *setting(comparison_max_bands=1), "--quiet"], "comparison.h5",
                    "kept in", preexec_fn=with_limit(resource.RLIMIT_FSIZE, 50000))
        if scene != content(self.path("scene.prm")):
            self.expect(2, ["report", self.folder, "--quiet"], self.folder)
        self.expect(0, ["compare", self.folder, *setting(comparison_max_bands=1), "--quiet"])

    def test_a_folder_that_cannot_be_made(self):
        path = write(os.path.join(self.work, "file"), "mine")
        for command in ("run", "discrete", "continuum"):
            self.expect(2, [command, QUICK, *FEW, "--output", os.path.join(path, "out"), "--quiet"], path)

    def test_little_memory_is_no_wrong_input(self):
        table = write(os.path.join(self.work, "grains.csv"),
                      "x,y,r\n" + "".join(f"{k % 700},{k // 700},0.5\n" for k in range(490000)))
        for words in (self.discrete(*setting(sample_file=table)),
                      ["import", "csv", table, "--output", self.folder, "--quiet"]):
            self.expect(4, words, "not enough memory", table, preexec_fn=with_limit(resource.RLIMIT_AS, 200 << 20))
            self.assertFalse(os.path.exists(self.folder))

    def test_a_mesh_that_is_too_large_for_the_memory(self):
        words = setting(continuum_mesh="rectangle", continuum_rectangle_width=400, continuum_rectangle_height=600,
                        continuum_element_size=1.2, comparison_coarse_element_size=0)
        self.expect(4, ["continuum", QUICK, *FEW, *words, "--output", self.folder, "--quiet"], "GB of memory",
                    preexec_fn=with_limit(resource.RLIMIT_AS, 2 << 30))

    def test_a_closed_pipe_does_not_stop_a_run(self):
        """As in `diptych run ... 2>&1 | true`."""
        for words, name in ((["discrete", *FEW], "discrete.csv"),
                            (["run", *BOTH, "--seeds", "1-1", "--overwrite", "--jobs", "1"], "ensemble.json")):
            reader, writer = os.pipe()
            os.close(reader)
            with open(writer, "wb") as pipe:
                result = subprocess.run([PROGRAM, words[0], QUICK, *words[1:], "--output", self.folder],
                                        env=ENVIRONMENT, stdout=pipe, stderr=pipe, check=False)
            self.assertEqual(result.returncode, 0)
            self.assertIn(name, listing(self.folder))

    def test_output_that_cannot_be_printed_is_reported(self):
        for words in (["explain"], ["--version"], ["solve", os.path.join(PROBLEMS, "small.h5")]):
            with open("/dev/full", "wb") as full:
                result = subprocess.run([PROGRAM, *words], env=ENVIRONMENT, stdout=full, stderr=subprocess.PIPE,
                                        text=True, check=False)
            self.assertEqual(result.returncode, 4, words)
            self.assertIn("standard output cannot be written", result.stderr)
