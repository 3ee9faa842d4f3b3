#!/usr/bin/env python3
# diptych: every rule of the robustness tests' judge fires on a program that breaks it, and on no other
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: judge_test.py PROGRAM SOURCE_DIR [unittest arguments]. PROGRAM is asked for its keys alone; what is judged are scripts."""

import os
import random
import shutil
import signal
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "program"))

import bases  # noqa: E402 (the path above)
import cases  # noqa: E402
import damage  # noqa: E402
import judge  # noqa: E402
import keys  # noqa: E402
import pair_kind  # noqa: E402
import robustness  # noqa: E402
import same  # noqa: E402
import special_files  # noqa: E402
from running import main  # noqa: E402

GOOD_TABLE = "axial_strain,stress_ratio\\n0,0.1\\n"


class Judged(unittest.TestCase):
    """A script that poses as the program; it is called with the output folder as its one argument."""

    def setUp(self):
        self.keep = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.keep)
        self.addCleanup(setattr, cases, "PROGRAM", cases.PROGRAM)
        self.addCleanup(setattr, cases, "HANG", cases.HANG)

    def judged(self, script, *, before="", patience=cases.PATIENCE, **expected):
        """What the judge says of a shell script. `before`: what the output folder holds before; none: it is not there."""
        cases.PROGRAM = os.path.join(self.keep, "program")
        with open(cases.PROGRAM, "w", encoding="utf-8") as file:
            file.write("#!/bin/sh\nout=\"$1\"\n" + script + "\n")
        os.chmod(cases.PROGRAM, 0o700)
        case = cases.Case("made_up", 1, self.keep)
        out = case.path("out")
        if before:
            os.mkdir(out)
            with open(os.path.join(out, "discrete.csv"), "w", encoding="utf-8") as file:
                file.write(before)
        case.run(out, output=out, patience=patience, **expected)
        return "\n".join(case.violations)

    def expect(self, sentence, script, **expected):
        self.assertIn(sentence, self.judged(script, **expected))

    def expect_nothing(self, script, **expected):
        self.assertEqual(self.judged(script, **expected), "")


class Ends(Judged):
    def test_good_programs(self):
        self.expect_nothing(f'mkdir "$out"; printf "{GOOD_TABLE}" > "$out/discrete.csv"')
        self.expect_nothing('echo "scene.prm, line 3: sample/grains = 5" >&2; exit 2', names=["sample/grains"], before="old")
        self.expect_nothing('mkdir "$out"; echo "stopped on request; kept in $out: scene.prm" >&2; exit 3')
        self.expect_nothing('echo "the folder /x cannot be made; nothing was written" >&2; exit 4')

    def test_death_by_a_signal(self):
        for number in (signal.SIGSEGV, signal.SIGABRT, signal.SIGFPE):
            self.expect("died of a signal: " + number.name, f"kill -{number.value} $$")
        self.expect("died of a signal", "exit 139")  # of a child, as a shell tells it

    def test_a_hang(self):
        cases.HANG = 1
        self.expect("it hung after SIGTERM", 'trap "" TERM; while :; do sleep 0.1; done', patience=0.2)

    def test_waiting_where_it_had_to_refuse(self):
        script = 'trap "echo stopped, nothing was kept >&2; exit 3" TERM; while :; do sleep 0.1; done'
        self.expect("it waited until it was told to stop", script, patience=0.5, by_itself=True)
        self.expect_nothing('echo "scene.prm is a pipe" >&2; exit 2', names=["scene.prm"], by_itself=True)

    def test_a_long_run_that_ends_when_asked_to_is_none(self):
        self.expect_nothing('trap "echo stopped, nothing was kept >&2; exit 3" TERM; while :; do sleep 0.1; done', patience=0.5, codes=(0,))

    def test_codes(self):
        self.expect("exit code 1, not one of", 'echo "broken: /x" >&2; exit 1')
        self.expect("exit code 1, not one of", 'echo "broken: /x" >&2; exit 1', codes=(0, 1))
        self.expect("exit code 77, not one of", "exit 77")
        self.expect("exit code 0, not one of [2]", "exit 0", codes=(2,))


class Words(Judged):
    def test_texts_of_libraries(self):
        for text in ("Traceback (most recent call last):", "terminate called after throwing", "  what():  vector", "HDF5-DIAG: Error",
                     "==1==ERROR: AddressSanitizer: heap-buffer-overflow", "table.cc:3:1: runtime error: signed integer overflow",
                     "std::bad_alloc", "basic_filebuf::underflow error reading the file", "basic_ios::clear: iostream error",
                     "cannot create std::vector larger than max_size()", "vector::_M_default_append", "basic_string::_M_create"):
            self.expect("standard error holds", f'echo "{text} in /x; nothing was written" >&2; exit 4')
            self.expect("standard error holds", f'echo "sample/file = \'/x\': {text}" >&2; exit 2', names=["sample/file"])
        for text in ("[json.exception.parse_error.101]", "regex_error", "stod"):
            self.expect("standard error holds", f'echo "scene.json" >&2; echo "{text}" >&2; exit 2', names=["scene.json"])
            self.expect_nothing(f'echo "scene.json: {text}" >&2; exit 2', names=["scene.json"])

    def test_wrong_input_without_its_name(self):
        self.expect("names none of", 'echo "wrong" >&2; exit 2', names=["sample/grains", "scene.prm"])
        self.expect("does not name --threads", 'echo "wrong: --jobs" >&2; exit 2', all_names=["--jobs", "--threads"])
        self.expect("without a word", "exit 2")

    def test_what_is_kept_is_not_said(self):
        for code in (3, 4):
            self.expect("says neither what is kept", f'echo "it failed at /x" >&2; exit {code}')
        self.expect("names nothing", 'echo "the system failed; nothing was written" >&2; exit 4')


class Folders(Judged):
    def test_wrong_input_that_changes_the_folder(self):
        for script in ('mkdir "$out"', ):
            self.expect("exit code 2, but changed: out", script + '; echo "key" >&2; exit 2')
        for script in ('echo new > "$out/scene.prm"', 'rm "$out/discrete.csv"', 'echo other > "$out/discrete.csv"', 'rm -r "$out"'):
            self.expect("exit code 2, but changed: out", script + '; echo "key" >&2; exit 2', before="old")

    def test_what_lies_beside_the_output(self):
        self.expect("changed beside the output: touched", "touch touched")
        self.expect("changed beside the output: out2", 'touch "${out}2"')
        self.expect_nothing("touch allowed", may_change=["allowed"])

    def test_what_is_half_done(self):
        self.expect("left behind: out/discrete.h5.part", 'mkdir "$out"; touch "$out/discrete.h5.part"')
        self.expect("left behind: out/.diptych.lock", 'mkdir "$out"; touch "$out/.diptych.lock"; echo "kept in $out" >&2; exit 3')
        self.expect_nothing('mkdir "$out"; touch "$out/blocks"')


class Numbers(Judged):
    def test_tables(self):
        for word in ("nan", "-inf", "1e400"):
            self.expect("no numbers in out/discrete.csv: solid_fraction",
                        f'mkdir "$out"; printf "axial_strain,solid_fraction\\n0,{word}\\n" > "$out/discrete.csv"')
        self.expect_nothing('mkdir "$out"; printf "walk,solid_fraction\\ninfinite,\\n" > "$out/discrete.csv"')
        self.expect_nothing('mkdir "$out"; printf "a\\nnan\\n" > "$out/discrete.csv"; echo "kept in $out" >&2; exit 3')

    def test_records(self):
        for text in ('{\\"a\\": NaN}', '{\\"a\\": [-Infinity]}', '{\\"a\\": 1e999}', '{\\"a\\": '):
            self.expect("no numbers in out/comparison.json", f'mkdir "$out"; printf "{text}" > "$out/comparison.json"')
        self.expect_nothing('mkdir "$out"; printf "{\\"a\\": null, \\"b\\": \\"nan\\"}" > "$out/comparison.json"')

    def write_arrays(self, code):
        return f'mkdir "$out"; {sys.executable} -c "import h5py, numpy; f = h5py.File(\'$out/discrete.h5\', \'w\'); {code}"'

    def test_arrays(self):
        self.expect("no numbers in out/discrete.h5: stage_0000/x", self.write_arrays("f['stage_0000/x'] = numpy.array([0, numpy.nan])"))
        self.expect("stage_0000/time", self.write_arrays("f.create_group('stage_0000').attrs['time'] = numpy.inf"))
        self.expect_nothing(self.write_arrays("f['stage_0000/x'] = numpy.array([0, 1.5])"))

    def test_what_is_documented_as_no_number(self):
        for name in ("left_x", "stress_error", "error_over_residual"):
            self.expect_nothing(self.write_arrays(f"f.create_group('stage_0000').attrs['{name}'] = numpy.nan"))
        self.expect("cannot be read", 'mkdir "$out"; echo no > "$out/discrete.h5"')


class Harness(Judged):
    def test_a_case_is_made_again_from_its_seed(self):
        one, other = (cases.Case("scenes", 12, os.path.join(self.keep, name)).dice.random() for name in "ab")
        self.assertEqual(one, other)
        self.assertNotEqual(one, cases.Case("scenes", 13, self.keep).dice.random())
        self.assertEqual(robustness.schedule(300, 1, list(robustness.KINDS)), robustness.schedule(300, 1, list(robustness.KINDS)))

    def test_every_key_is_asked_at_its_bounds(self):
        found = {key.name for key, *_ in keys.all_values()}
        self.assertEqual(found, set(keys.names()))
        self.assertIn("sample/grains", found)
        lowest = [beside for key, value, _, beside in keys.all_values() if key.name == "loading/inertial_number" and value == "1e-09"]
        self.assertEqual(sorted(lowest), [(), ("--set", "discrete/step=auto")])
        grains = next(key for key in keys.all_keys() if key.name == "sample/grains")
        self.assertEqual((keys.next_outside(grains)[:2], keys.next_inside(grains)[:3]), (["9", "10000001"], ["10", "11", "10000000"]))

    def test_every_pair_stands_in_a_row(self):
        factors = {"a": ("1", "2", "3"), "b": ("x", "y"), "c": ("p", "q", "r", "s")}
        rows = keys.covering_rows(factors, random.Random(1))
        seen = {tuple(sorted([one, other])) for row in rows for one in row.items() for other in row.items() if one < other}
        self.assertEqual(seen, keys.pairs_of(factors))
        self.assertLess(len(rows), 24)  # all combinations

    def test_every_pair_stands_in_one_bundle(self):
        every = [pair for _, members in pair_kind.bundles() for pair in members]
        self.assertEqual((set(every), len(every)), (keys.pairs_of(pair_kind.factors()), len(set(every))))
        self.assertEqual([row for row, members in pair_kind.bundles() if any(row[name] != value for pair in members for name, value in pair)], [])

    def test_a_refusal_demands_what_it_says_and_never_of_the_pair(self):
        pair = (("continuum/platens", "smooth"), ("loading/mode", "plane_shear"))
        refusal = "loading/mode = plane_shear: discrete/lateral must be periodic, not none"
        self.assertEqual(pair_kind.named(refusal), ["loading/mode", "discrete/lateral"])
        self.assertEqual(pair_kind.demanded(refusal, dict(pair), pair, set()), ("discrete/lateral", "periodic"))
        self.assertIsNone(pair_kind.demanded("loading/mode = plane_shear: continuum/platens must be rough", dict(pair), pair, set()))

    def test_every_special_file_is_made_and_kept(self):
        case = cases.Case("made_up", 2, self.keep)
        for kind in special_files.KINDS:
            self.addCleanup(setattr, case.dice, "choice", case.dice.choice)
            case.dice.choice = lambda _, kind=kind: kind
            special_files.put(case, "x")
        special_files.put(case, "y")
        shutil.copytree(case.work, os.path.join(self.keep, "copy"), symlinks=True, copy_function=special_files.copy)
        self.assertEqual(judge.digest(case.work), judge.digest(os.path.join(self.keep, "copy")))

    def test_every_damage_can_be_done_to_every_text(self):
        for k, change in enumerate({*damage.TEXT, *damage.BYTES}):
            for content in (b"", b"a", b"x,y\n0,1\n", "ä = 1\n".encode()):
                self.assertIsInstance(change(random.Random(k), content), bytes, change.__name__)

    def test_differences_are_seen_and_clocks_are_not(self):
        one = {"a.csv": same.without_clocks([{"x": "1", "solve_cpu_s": "2"}]), "b.h5": {"x": ("f8", (1,), b"1")}}
        other = {"a.csv": same.without_clocks([{"x": "1", "solve_cpu_s": "3"}]), "b.h5": {"x": ("f8", (1,), b"2")}}
        self.assertEqual(same.differences(one, one), [])
        self.assertEqual(same.differences(one, other), ["b.h5: x"])
        self.assertEqual(same.differences(one, {"a.csv": other["a.csv"]}), ["b.h5 is missing"])

    def test_documentation_is_read(self):
        self.assertIn(("discrete.h5", "left_x"), bases.documented(""))
        self.assertNotIn(("discrete.h5", "axial_strain"), bases.documented(""))


if __name__ == "__main__":
    main()
