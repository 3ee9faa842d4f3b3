# diptych: a program that breaks a rule of the robustness tests is found, and no other program
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shell scripts take the place of the program."""

import os
import random
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "program"))

import cases  # noqa: E402 (the path above)
import damage  # noqa: E402
import input_kinds  # noqa: E402
import robustness  # noqa: E402
import same  # noqa: E402


class Judged(unittest.TestCase):
    def setUp(self):
        self.keep = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.keep)
        self.addCleanup(setattr, cases, "PROGRAM", cases.PROGRAM)
        self.addCleanup(setattr, cases, "HANG", cases.HANG)

    def judged(self, script, *, old=False, patience=cases.PATIENCE, **expected):
        """The violations of a shell script with the output folder $1. `old`: the folder holds a discrete.csv."""
        cases.PROGRAM = os.path.join(self.keep, "program")
        with open(cases.PROGRAM, "w", encoding="utf-8") as file:
            file.write("#!/bin/sh\n" + script + "\n")
        os.chmod(cases.PROGRAM, 0o700)
        case = cases.Case("made_up", 1, self.keep)
        if old:
            os.mkdir(case.path("out"))
            case.write("out/discrete.csv", "old")
        case.run(case.path("out"), output=case.path("out"), patience=patience, **expected)
        return "\n".join(case.violations)

    def test_right_programs(self):
        for script in ('mkdir $1; printf "axial_strain,stress_ratio\\n0,0.1\\n" > $1/discrete.csv; printf "{}" > '
                       '$1/a.json',
                       'mkdir $1; touch $1/blocks', 'echo "sample/grains = 5" >&2; exit 2',
                       'mkdir $1; echo "stopped; kept in $1: scene.prm" >&2; exit 3',
                       'echo "/x cannot be made" >&2; exit 4', 'echo "scene.prm: stod" >&2; exit 2',
                       'mv $1 $1.1; mkdir $1'):
            keeps = ("out/discrete.csv",) if "mv" in script else ()
            said = self.judged(script, old="mv" in script, names=("sample/grains", "scene.prm"), keeps=keeps,
                               may_change=("out.1", "out.1/discrete.csv"))
            self.assertEqual(said, "")
        self.assertEqual(self.judged('trap "echo nothing was kept >&2; exit 3" TERM; while :; do sleep 0.1; done',
                                     patience=0.5, codes=(0,)), "")

    def test_every_rule(self):
        for sentence, script, expected in (
                ("died of a signal: SIGSEGV", "kill -SEGV $$", {}), ("died of a signal", "exit 139", {}),
                ("exit code 1, not one of", "exit 1", {"codes": (0, 1)}),
                ("exit code 0, not one of [2]", "exit 0", {"codes": (2,)}),
                ("standard error holds", 'echo "/x: std::bad_alloc" >&2', {}),
                ("standard error holds", 'echo "stod" >&2', {"names": ("scene.prm",)}),
                ("standard error holds", 'echo Traceback "(most recent call last)" >&2', {}),
                ("names none of", 'echo "wrong" >&2; exit 2', {"names": ("sample/grains",)}),
                ("without a message", "exit 2", {}),
                ("exit code 2, but changed: out", 'mkdir $1; echo "key" >&2; exit 2', {}),
                ("does not say what is kept", 'mkdir $1; echo "/x failed" >&2; exit 3', {}),
                ("exit code 2, but changed: out", 'echo new > $1/discrete.csv; echo "key" >&2; exit 2', {"old": True}),
                ("names nothing", 'echo failed >&2; exit 4', {}), ("changed beside the output: mine", "touch mine", {}),
                ("left behind: out/a.h5.part", "mkdir $1; touch $1/a.h5.part", {}),
                ("left behind: out/.diptych.lock", "mkdir $1; touch $1/.diptych.lock", {}),
                ("lost: out/discrete.csv", "rm $1/discrete.csv", {"old": True, "keeps": ("out/discrete.csv",)}),
                ("no numbers in out/a.csv: x", 'mkdir $1; printf "x\\nnan\\n" > $1/a.csv', {}),
                ("no numbers in out/a.json", 'mkdir $1; printf "[1e999]" > $1/a.json', {}),
                ("no numbers in out/a.json", 'mkdir $1; printf "{" > $1/a.json', {}),
                ("no numbers in out/a.h5", "mkdir $1; echo no > $1/a.h5", {}),
                ("out/a.h5: g/x", f"mkdir $1; {sys.executable} -c \"import h5py; h5py.File('$1/a.h5', 'w')['g/x'] = "
                 "float('inf')\"", {})):
            with self.subTest(script=script):
                self.assertIn(sentence, self.judged(script, **expected))

    def test_a_hang(self):
        cases.HANG = 1
        self.assertIn("it hung after SIGTERM", self.judged('trap "" TERM; while :; do sleep 0.1; done', patience=0.2))


class Harness(unittest.TestCase):
    def test_a_seed_repeats_a_case(self):
        with tempfile.TemporaryDirectory() as keep:
            one, same_one, other = (cases.Case("scenes", seed, keep).dice.random() for seed in (12, 12, 13))
        self.assertEqual(one, same_one)
        self.assertNotEqual(one, other)
        self.assertEqual(robustness.schedule(300, 1, list(robustness.KINDS)),
                         robustness.schedule(300, 1, list(robustness.KINDS)))

    def test_every_key_is_tried_at_its_bounds(self):
        self.assertGreater(len(input_kinds.explained_keys()), 100)
        values = {(value, must_fail) for name, value, must_fail in input_kinds.all_values() if name == "sample/grains"}
        self.assertLessEqual({("10", False), ("11", False), ("9", True), ("10000001", True), ("nan", True)}, values)

    def test_every_damage_suits_every_text(self):
        for k, change in enumerate({*damage.TEXT, *damage.BYTES}):
            for content in (b"", b"a", b"x,y\n0,1\n", "ä = 1\n".encode()):
                self.assertIsInstance(change(random.Random(k), content), bytes, change.__name__)

    def test_other_results_are_seen_and_other_times_are_not(self):
        one = {"a.csv": same.without_clocks([{"x": "1", "solve_cpu_s": "2"}]), "b.h5": {"x": ("f8", (1,), b"1")}}
        other = {"a.csv": same.without_clocks([{"x": "1", "solve_cpu_s": "3"}]), "b.h5": {"x": ("f8", (1,), b"2")}}
        self.assertEqual(same.differences(one, one), [])
        self.assertEqual(same.differences(one, other), ["b.h5: x"])
        self.assertEqual(same.differences(one, {"a.csv": other["a.csv"]}), ["b.h5 is missing"])
