#!/usr/bin/env python3
# diptych: faults that were once found, each by itself: what would lose results or go wrong in silence is told
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: faults_test.py PROGRAM SOURCE_DIR [unittest arguments]. Random relatives of these: tests/robustness."""

import os
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

import h5py

from running import ENVIRONMENT, PROBLEMS, PROGRAM, QUICK, SMALL, content, diptych, listing, main, setting, write

FEW = SMALL + setting(sample_grains=60, output_report="false")
BOTH = FEW + setting(continuum_element_size=2.5, continuum_initial_step=0.0025, continuum_max_step=0.0025,
                     comparison_coarse_element_size=0, comparison_band_resamples=0, comparison_probe_resamples=0)


class Folder(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.keep = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.keep.cleanup)
        cls.whole = os.path.join(cls.keep.name, "whole")
        result = diptych("run", QUICK, *BOTH, "--output", cls.whole, "--quiet")
        if result.returncode != 0:
            raise RuntimeError(result.stderr)

    def setUp(self):
        keep = tempfile.TemporaryDirectory()
        self.addCleanup(keep.cleanup)
        self.work, self.folder = keep.name, os.path.join(keep.name, "out")

    def contents(self):
        return {name: content(os.path.join(self.folder, name)) for name in listing(self.folder) if name != "provenance.json"}

    def expect(self, code, words, *texts, **options):
        """Ends with that code and a message that holds those texts, and for 2 leaves every file as it was."""
        before = {name: content(os.path.join(self.work, name)) for name in listing(self.work)}
        result = diptych(*words, cwd=self.work, **options)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        for text in texts:
            self.assertIn(text, result.stderr)
        self.assertNotIn("Traceback", result.stderr)
        after = {name: content(os.path.join(self.work, name)) for name in listing(self.work)}
        if code == 2:
            self.assertEqual(after, before)
        self.assertEqual([name for name in after if name.endswith((".part", ".lock"))], [])
        return result


class Inputs(Folder):
    def test_a_run_does_not_remove_its_own_input(self):
        shutil.copytree(self.whole, self.folder)
        sample = os.path.join(self.folder, "discrete.h5")
        for command in ("discrete", "run", "continuum"):
            self.expect(2, [command, QUICK, *BOTH, *setting(sample_file=sample), "--output", self.folder, "--quiet"], sample)

    def test_values_that_no_machine_could_compute(self):
        for words, text in ((setting(sample_width=1e12), "sample/width"), (setting(discrete_step=1e-12), "discrete/step"),
                            (setting(loading_inertial_number=1e-12), "loading/inertial_number"), (["--threads", "100000"], "--threads")):
            self.expect(2, ["discrete", QUICK, *FEW, *words, "--output", self.folder, "--quiet"], text)
        result = self.expect(4, ["discrete", QUICK, *FEW, *setting(loading_inertial_number=1e-9, discrete_step=0.011), "--output", self.folder, "--quiet"],
                             "rows of discrete.csv", "discrete/history_interval", "nothing was written")
        self.assertFalse(os.path.exists(self.folder), result.stderr)

    def test_a_scene_says_nothing_that_its_echo_could_not(self):
        for name, text, said in (("a.json", '{"sampel": {}}', "'sampel'"), ("a.prm", "subsection sampel\nend\n", "'sampel'"),
                                 ("a.json", '{"continuum": {"parameters_from": " x"}}', "begins or ends with a blank"),
                                 ("a.json", '{"continuum": {"parameters_from": "x\\t"}}', "begins or ends with a blank")):
            self.expect(2, ["discrete", write(os.path.join(self.work, name), text), "--output", self.folder, "--quiet"], name, said)

    def test_a_study_tells_what_each_of_its_runs_will_take(self):
        result = self.expect(0, ["discrete", QUICK, *FEW, *setting(discrete_step=0.1), "--study", "step", "--output", self.folder])
        first, half, quarter = [int(n) for n in re.findall(r"(\d+) steps", result.stdout)[:3]]
        self.assertAlmostEqual(half / first, 2, delta=0.02)
        self.assertAlmostEqual(quarter / first, 4, delta=0.04)

    def test_grains_that_carry_nothing_are_pointed_out(self):
        """Sixty diameters apart: what t/s there is comes of single impacts."""
        rows = "".join(f"{60 * i + 0.1 * j},{60 * j + 0.2 * i},0.5\n" for i in range(8) for j in range(8))
        words = ["discrete", QUICK, *FEW, *setting(sample_file=write(os.path.join(self.work, "cloud.csv"), "x,y,r\n" + rows), loading_axial_strain=0.001,
                                                   loading_stage_strain=0.0005, comparison_window_edges="0,0.001"), "--output", self.folder, "--quiet"]
        self.expect(0, words, "nothing is pressed together")
        self.assertIn(b"nothing is pressed together", content(os.path.join(self.folder, "provenance.json")))
        self.assertNotIn(b"nothing is pressed together", content(os.path.join(self.whole, "provenance.json")))
        self.expect(3, [*words, *setting(sample_prepare_file="true", sample_preparation_steps=1)], "nothing carries loading/pressure")

    def test_a_scene_of_which_nothing_is_read_is_not_the_scene_of_defaults(self):
        """An empty file of keys, a scene whose lines end as on no system of today, a key that stands twice, an output without a name."""
        empty = write(os.path.join(self.work, "empty.prm"), "")
        self.expect(2, ["discrete", QUICK, *FEW, "--set-file", empty, "--output", self.folder, "--quiet"], empty, "is empty")
        old = os.path.join(self.work, "old.prm")
        with open(old, "wb") as file:
            file.write(content(QUICK).replace(b"\n", b"\r"))
        self.expect(2, ["discrete", old, *FEW, "--output", self.folder, "--quiet"], old + ", line 1", "carriage return")
        twice = write(os.path.join(self.work, "twice.prm"), "subsection sample\n  set grains = 100\n  set grains = 60\nend\n")
        self.expect(2, ["discrete", twice, "--output", self.folder, "--quiet"], twice + ", line 3", "sample/grains stands twice", "line 2")
        self.expect(2, ["discrete", QUICK, *FEW, "--output", "", "--quiet"], "--output", "a name is needed")

    def test_an_empty_scene_is_not_the_scene_of_defaults(self):
        for name, text in (("a.prm", ""), ("a.prm", "\n \t\r\n"), ("a.json", "")):
            self.expect(2, ["discrete", write(os.path.join(self.work, name), text), *FEW, "--output", self.folder, "--quiet"], name, "is empty")
        self.expect(0, ["discrete", write(os.path.join(self.work, "a.prm"), "# defaults\n"), *setting(loading_stage_strain=0.0005), *FEW,
                        "--output", self.folder, "--quiet"])

    def test_solutions_replace_solutions_alone(self):
        scene = write(os.path.join(self.work, "scene.prm"), "# mine\n")
        problem = os.path.join(PROBLEMS, "small.h5")
        self.expect(2, ["solve", problem, "--output", scene], scene)
        solution = os.path.join(self.work, "solved.h5")
        for _ in range(2):
            self.assertEqual(diptych("solve", problem, "--output", solution).returncode, 0)
        for other in (solution, shutil.copy(os.path.join(PROBLEMS, "medium.h5"), self.work)):
            self.expect(2, ["solve", os.path.join(PROBLEMS, "medium.h5" if other == solution else "small.h5"), "--output", other], other)

    def test_a_comparison_goes_where_its_folder_is(self):
        self.expect(2, ["compare", self.whole, "--output", os.path.join(self.work, "other")], "--output")
        self.expect(2, ["compare", self.whole, *setting(output_directory="zz")], "output/directory=zz")

    def test_platens_that_rest_are_told_before_anything_is_computed(self):
        words = setting(loading_mode="time", loading_duration=1, loading_stage_time=0.5, comparison_window_edges="0,1",
                        discrete_lateral="rigid_walls")
        self.expect(2, ["run", QUICK, *BOTH, *words, "--output", self.folder, "--quiet"], "discrete/drive_upper_y")


class Folders(Folder):
    def test_damaged_records_and_tables_are_named(self):
        text = content(os.path.join(self.whole, "provenance.json"))
        header = content(os.path.join(self.whole, "discrete.csv"))
        echo = content(os.path.join(self.whole, "scene.prm"))
        for name, damaged in (("provenance.json", b""), ("provenance.json", text[:len(text) // 2]), ("provenance.json", b'{"phases": 1}'),
                              ("provenance.json", b'{"a": [1, 2]}'), ("provenance.json", text.replace(b'"diptych"', b'"another"')),
                              ("scene.prm", b""), ("scene.prm", b"subsection sample\nend\n"), ("scene.prm", echo.split(b"\n")[0] + b"\n"),
                              ("discrete.csv", header.replace(b"stress_ratio", b"strength", 1))):
            with self.subTest(name=name, length=len(damaged)):
                shutil.rmtree(self.folder, ignore_errors=True)
                shutil.copytree(self.whole, self.folder)
                with open(os.path.join(self.folder, name), "wb") as file:
                    file.write(damaged)
                self.expect(2, ["compare", self.folder, "--quiet"], os.path.join(self.folder, name))

    def test_a_table_is_that_of_its_snapshots(self):
        for name in ("discrete.csv", "continuum.csv"):
            header, *rows = content(os.path.join(self.whole, name)).splitlines(keepends=True)
            time_column = header.strip().split(b",").index(b"time")
            unknown = rows[1].split(b",")
            unknown[time_column] = b"nan"
            for what, table in (("cut", rows[:-1]), ("half", rows[:len(rows) // 2]), ("reversed", rows[::-1]),
                                ("time", [rows[0], b",".join(unknown), *rows[2:]])):
                with self.subTest(name=name, what=what):
                    shutil.rmtree(self.folder, ignore_errors=True)
                    shutil.copytree(self.whole, self.folder)
                    with open(os.path.join(self.folder, name), "wb") as file:
                        file.write(b"".join([header, *table]))
                    self.expect(2, ["compare", self.folder, "--quiet"], os.path.join(self.folder, name))

    def test_what_somebody_put_beside_the_stages_is_not_removed(self):
        for name in ("discrete", "continuum", "coarse"):
            shutil.rmtree(self.folder, ignore_errors=True)
            shutil.copytree(self.whole, self.folder)
            os.makedirs(os.path.join(self.folder, name), exist_ok=True)
            mine = write(os.path.join(self.folder, name, "mine.txt"), "mine")
            self.expect(2, ["run", QUICK, *BOTH, "--output", self.folder, "--quiet"], mine)

    def test_files_that_are_not_what_the_run_left_are_named(self):
        """One number of a table, rows from its middle, snapshots of another run: whatever reads the folder says so."""
        other = os.path.join(self.work, "other")
        self.expect(0, ["discrete", QUICK, *BOTH, "--set", "sample/seed=2", "--output", other, "--quiet"])
        rows = content(os.path.join(self.whole, "discrete.csv")).splitlines(keepends=True)
        column = rows[0].split(b",").index(b"stress_ratio")
        fields = rows[20].split(b",")
        fields[column] = b"0.9"
        for name, damaged in (("discrete.csv", b"".join([*rows[:20], b",".join(fields), *rows[21:]])), ("discrete.csv", b"".join(rows[:20] + rows[23:])),
                              ("discrete.h5", content(os.path.join(other, "discrete.h5")))):
            shutil.rmtree(self.folder, ignore_errors=True)
            shutil.copytree(self.whole, self.folder)
            with open(os.path.join(self.folder, name), "wb") as file:
                file.write(damaged)
            for line in (["compare", self.folder], ["report", self.folder], ["export", self.folder, "--format", "csv", "--output", other + "_exported"],
                         ["run", QUICK, *BOTH, "--output", self.folder, "--resume"]):
                with self.subTest(name=name, length=len(damaged), line=line[0]):
                    self.expect(2, [*line, "--quiet"], os.path.join(self.folder, name), "not what the run left")

    def test_numbers_that_no_panel_writes_are_named(self):
        def attribute(group):
            group.attrs["step"] = float("nan")

        def outline(group):
            group["outline/right"][0, 0] = 2.0**30

        def node(group):
            group["nodes/position"][0, 0] = -7.0

        for panel, change, told in (("discrete", attribute, "step"), ("discrete", outline, "outline/right"),
                                    ("continuum", node, "inside out")):
            with self.subTest(told=told):
                shutil.rmtree(self.folder, ignore_errors=True)
                shutil.copytree(self.whole, self.folder)
                path = os.path.join(self.folder, panel + ".h5")
                with h5py.File(path, "r+") as file:
                    change(file["stage_0001"])
                self.expect(2, ["compare", self.folder, "--quiet"], path, "stage_0001", told)

    def forget_sums_of_the_comparison(self):
        """As of an earlier version: then the report's own checks must see what is wrong."""
        record = content(os.path.join(self.folder, "provenance.json")).decode()
        write(os.path.join(self.folder, "provenance.json"), record.replace("comparison_files", "no_files"))

    def test_damaged_comparisons_are_named_by_the_report(self):
        for name in ("comparison.h5", "comparison.json"):
            whole = content(os.path.join(self.whole, name))
            turned = bytearray(whole)
            turned[whole.rfind(b"OHDR") + 10] ^= 4  # in the header of one of the last objects, at which h5py throws another error
            for damaged in (b"", whole[:700], b"foreign", b'{"a": 1}', content(os.path.join(self.whole, "discrete.h5")),
                            *([bytes(turned)] if name.endswith(".h5") else [])):
                with self.subTest(name=name, length=len(damaged)):
                    shutil.rmtree(self.folder, ignore_errors=True)
                    shutil.copytree(self.whole, self.folder)
                    with open(os.path.join(self.folder, name), "wb") as file:
                        file.write(damaged)
                    self.expect(2, ["report", self.folder, "--quiet"], name, "not what the run left")
                    self.forget_sums_of_the_comparison()
                    self.expect(2, ["report", self.folder, "--quiet"], name)

    def test_a_foreign_provenance_is_named_by_the_report(self):
        shutil.copytree(self.whole, self.folder)
        write(os.path.join(self.folder, "provenance.json"), '{"a": [1, 2]}')
        self.expect(2, ["report", self.folder, "--quiet"], os.path.join(self.folder, "provenance.json"))

    def test_an_array_cut_short_does_not_change_the_comparison(self):
        shutil.copytree(self.whole, self.folder)
        stage = os.path.join(self.folder, "discrete", "stage_0001.h5")
        path = stage if os.path.exists(stage) else os.path.join(self.folder, "discrete.h5")
        with h5py.File(path, "r+") as file:
            group = file[sorted(name for name in file if name.startswith("stage_"))[1]]
            force = group["contacts/force"][:5]
            del group["contacts/force"]
            group["contacts/force"] = force
        self.expect(2, ["compare", self.folder, "--quiet"], "contacts/force", path)

    def test_one_flipped_bit_is_told(self):
        shutil.copytree(self.whole, self.folder)
        path = os.path.join(self.folder, "discrete.h5")
        damaged = bytearray(content(path))
        with h5py.File(path, "r") as file:
            stages = sorted(name for name in file if name.startswith("stage_"))
            pieces = file[stages[-1] + "/contacts/force"].id
            place = pieces.get_chunk_info(0).byte_offset if pieces.get_num_chunks() else pieces.get_offset()
        damaged[place + 11] ^= 16
        with open(path, "wb") as file:
            file.write(damaged)
        self.expect(2, ["compare", self.folder, "--quiet"], path)

    def table_of(self, folder):
        with h5py.File(os.path.join(folder, "discrete.h5"), "r") as file:
            grains = file["stage_0000/grains"]
            rows = [f"{x!r},{y!r},{r!r}" for (x, y, _), r in zip(grains["position"][()].tolist(), grains["radius"][()].tolist())]
        return write(os.path.join(self.work, "grains.csv"), "\n".join(["x,y,r", *rows]) + "\n")

    def test_what_the_sample_shows_is_told_before_results_are_touched(self):
        for words, text in ((setting(comparison_probe_circle="100,100,5"), "comparison/probe_circle"),
                            (setting(comparison_probe_rectangles="100,100,5,5,0"), "comparison/probe_rectangles"),
                            (setting(sample_grains=12), "sample/grains"),
                            (setting(sample_target_solid_fraction=0.91), "sample/target_solid_fraction")):
            for seeds in ([], ["--seeds", "1-2", "--jobs", "1"]):
                with self.subTest(text=text, seeds=seeds):
                    shutil.rmtree(self.folder, ignore_errors=True)
                    if not seeds:
                        shutil.copytree(self.whole, self.folder)
                    self.expect(2, ["run", QUICK, *BOTH, *words, *seeds, "--output", self.folder, "--quiet"], text)

    def test_a_study_of_the_step_leaves_the_results_of_a_sample_that_can_be_made(self):
        words = ["discrete", QUICK, *FEW, *setting(discrete_step=0.1), "--output", self.folder, "--quiet"]
        self.expect(0, words)
        self.expect(2, [*words, "--study", "step", *setting(sample_target_solid_fraction=0.91)], "sample/target_solid_fraction")

    def test_a_comparison_that_cannot_be_made_leaves_both_panels(self):
        """A probe in what the platen takes away: 0.03 d below it at first, which comes down by 1 % of ten diameters and more."""
        with h5py.File(os.path.join(self.whole, "discrete.h5"), "r") as file:
            height = file["stage_0000"].attrs["upper_y"] - file["stage_0000"].attrs["lower_y"]
        words = setting(comparison_probe_rectangles=f"0,{height / 2 + 0.485},5,1.03,0")
        self.expect(3, ["run", QUICK, *BOTH, *words, "--output", self.folder, "--quiet"], "comparison/probe_rectangles", "kept in " + self.folder)
        self.assertIn("continuum.h5", listing(self.folder))

    def test_a_link_in_the_place_of_the_lock_is_not_followed(self):
        os.mkdir(self.folder)
        mine = write(os.path.join(self.work, "mine.txt"), "mine\n")
        os.symlink(mine, os.path.join(self.folder, ".diptych.lock"))
        result = diptych("discrete", QUICK, *FEW, "--output", self.folder, "--quiet")
        self.assertEqual(result.returncode, 4, result.stderr)
        self.assertEqual(content(mine), b"mine\n")

    def test_a_pipe_in_the_place_of_the_echo_is_no_result(self):
        os.mkdir(self.folder)
        os.mkfifo(os.path.join(self.folder, "scene.prm"))
        for command in ("discrete", "continuum", "run"):
            for words in ([], ["--resume"]):
                result = diptych(command, QUICK, *BOTH, "--output", self.folder, *words, "--quiet", timeout=60)
                self.assertEqual(result.returncode, 2, result.stderr)
                self.assertIn(self.folder, result.stderr)

    def test_an_export_goes_beside_its_folder(self):
        shutil.copytree(self.whole, self.folder)
        self.expect(2, ["export", self.folder, "--format", "csv", "--output", self.folder, "--quiet"], "--output")

    @staticmethod
    def compared(contents):  # without the CPU seconds of the comparison itself
        return [line for line in contents["comparison.csv"].splitlines() if b",cost," not in line]

    def test_a_folder_made_of_a_table_needs_the_table_no_more(self):
        prepared = os.path.join(self.work, "prepared")
        self.expect(0, ["discrete", QUICK, *BOTH, *setting(sample_grains=120), "--output", prepared, "--quiet"])
        table = self.table_of(prepared)
        self.expect(0, ["run", QUICK, *BOTH, *setting(sample_file=table), "--output", self.folder, "--quiet"])
        before = self.contents()
        os.remove(table)
        self.expect(0, ["compare", self.folder, "--quiet"])
        self.assertEqual(self.compared(self.contents()), self.compared(before))
        self.expect(0, ["report", self.folder, "--quiet"])
        sample = os.path.join(self.work, "start")
        self.expect(0, ["export", self.folder, "--format", "csv", "--output", sample, "--quiet"])

    def refused_while(self, held, words):
        """A run that writes to the folder `held` is stopped half way, as by Ctrl-Z; `words` are told who it is, and change nothing."""
        first = subprocess.Popen([PROGRAM, "discrete", QUICK, *FEW, *setting(loading_axial_strain=0.2, comparison_window_edges="0,0.2"),
                                  "--output", held, "--quiet"], env=ENVIRONMENT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            lock = os.path.join(held, ".diptych.lock")
            while first.poll() is None and not (os.path.exists(lock) and os.path.getsize(lock)):  # its name comes once it holds
                time.sleep(0.002)
            self.assertIsNone(first.poll())
            os.kill(first.pid, signal.SIGSTOP)
            before = self.contents()
            second = diptych(*words)
            self.assertEqual(second.returncode, 4, second.stderr)
            for text in (held, str(first.pid), os.uname().nodename):
                self.assertIn(text, second.stderr)
            self.assertEqual(self.contents(), before)
        finally:
            first.kill()
            first.wait()

    def test_a_second_run_is_told_who_writes(self):
        words = ["discrete", QUICK, *FEW, "--output", self.folder, "--quiet"]
        self.refused_while(self.folder, words)
        self.assertEqual(diptych(*words).returncode, 0)  # the dead one's lock holds nobody

    def test_an_ensemble_leaves_a_member_that_another_run_writes(self):
        words = ["run", QUICK, *BOTH, "--seeds", "1-2", "--jobs", "1", "--output", self.folder, "--quiet"]
        self.expect(0, words)
        self.refused_while(os.path.join(self.folder, "seed_2"), words)

    def test_an_ensemble_is_not_resumed_over_a_damaged_member(self):
        words = ["run", QUICK, *BOTH, "--seeds", "1-2", "--jobs", "1", "--output", self.folder, "--quiet"]
        self.expect(0, words)
        table = os.path.join(self.folder, "seed_2", "discrete.csv")
        for text in (content(table).replace(b",", b";"), content(table).splitlines(keepends=True)[0]):
            write(table, text.decode())
            for again in ([*words, "--resume"], ["compare", self.folder, "--quiet"]):
                self.expect(2, again, table)

    def test_a_report_is_drawn_of_its_own_folder_alone(self):
        """A link in comparison.h5 to a pipe, which would never end, numbers that stand in another file, and numbers of an odd type."""
        def link(file):
            file["stage_0000/grains/stress"] = h5py.ExternalLink("pipe.h5", "/x")

        def outside(file):
            file.create_dataset("stage_0000/more", shape=(3,), dtype="f8", external=[("/dev/zero", 0, h5py.h5f.UNLIMITED)])

        def array_of_odd_bits(file):
            kind = h5py.h5t.STD_I32LE.copy()
            kind.set_precision(13)
            h5py.h5d.create(file.require_group("stage_0000").id, b"more", kind, h5py.h5s.create_simple((3,)))

        def attribute_of_odd_bits(file):
            kind = h5py.h5t.STD_I32LE.copy()
            kind.set_precision(13)
            h5py.h5a.create(file.require_group("stage_0000").id, b"more", kind, h5py.h5s.create(h5py.h5s.SCALAR))
        for change, why in ((link, "other file"), (outside, "other file"), (array_of_odd_bits, "no usual type"), (attribute_of_odd_bits, "no usual type")):
            shutil.rmtree(self.folder, ignore_errors=True)
            shutil.copytree(self.whole, self.folder)
            os.mkfifo(os.path.join(self.folder, "pipe.h5"))
            with h5py.File(os.path.join(self.folder, "comparison.h5"), "r+") as file:
                change(file)
            self.forget_sums_of_the_comparison()
            result = diptych("report", self.folder, "--quiet", timeout=60)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertRegex(result.stderr, rf"comparison[.]h5: /stage_0000.*{why}")


if __name__ == "__main__":
    main()
