#!/usr/bin/env python3
# diptych: study of the step and stored contact problems
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: solve_test.py PROGRAM SOURCE_DIR [unittest arguments]."""

import csv
import json
import math
import os
import shutil
import tempfile
import unittest

import h5py
import numpy

from running import bits, diptych, listing, main, PROBLEMS, QUICK, setting, SMALL, write


class Study(unittest.TestCase):
    def test_three_steps_and_a_verdict(self):
        words = SMALL + setting(sample_grains=200, loading_axial_strain=0.005, comparison_window_edges="0,0.005")
        with tempfile.TemporaryDirectory() as folder:
            result = diptych("discrete", QUICK, *words, "--study", "step", "--output", folder)
            self.assertEqual(result.returncode, 0, result.stderr)
            for name in ["study_step.csv", "study_step.json", "study_step.png"]:
                self.assertGreater(os.path.getsize(os.path.join(folder, name)), 100, name)
            with open(os.path.join(folder, "study_step.json")) as file:
                study = json.load(file)
            self.assertEqual(study["steps"], [0.1, 0.05, 0.025])
            self.assertRegex(study["verdict"], "^step 0.1 against 0.025: the step (matters|does not matter), largest difference")
            self.assertIn(study["verdict"], result.stdout)
            self.assertEqual([q["name"] for q in study["quantities"]],
                             ["stress_ratio", "external_work", "friction_dissipation", "impact_dissipation"])
            for quantity in study["quantities"]:
                self.assertEqual(quantity["largest_difference"][2], 0)
            with open(os.path.join(folder, "study_step.csv")) as file:
                rows = list(csv.DictReader(file))
            self.assertEqual([sum(float(row["step"]) == step for row in rows) for step in study["steps"]], [50, 100, 200])
            # One and the same prepared sample for all three.
            prepared = [bits(os.path.join(folder, name, "discrete.h5"))["stage_0000/grains/position"]
                        for name in ["step_1", "step_2", "step_4"]]
            self.assertEqual(prepared[0], prepared[1])
            self.assertEqual(prepared[0], prepared[2])


class Solve(unittest.TestCase):
    """`diptych solve` on stored problems; what it writes is judged from W, q and mu of the file alone."""

    def solve(self, problem, *words):
        return diptych("solve", os.path.join(PROBLEMS, problem), *words)

    def printed(self, result):
        return dict(line.split(": ", 1) for line in result.stdout.splitlines())

    def judge(self, path, tolerance):
        """|r - P(r)| / |r| with u = W r + q, and the worst of each condition relative to |r| or |u|."""
        with h5py.File(path, "r") as file:
            r = file["solution/r"][()]
            w, q, mu = file["fclib_local/W"], file["fclib_local/vectors/q"][()], file["fclib_local/vectors/mu"][()]
            self.assertEqual(int(w["nz"][()].item()), -2, "stored by rows")
            rows, columns, values = w["p"][()], w["i"][()], w["x"][()]
            u = q + numpy.array([values[a:b] @ r[columns[a:b]] for a, b in zip(rows[:-1], rows[1:])])
            diagonal = numpy.array([values[a:b][columns[a:b] == k].sum() for k, (a, b) in enumerate(zip(rows[:-1], rows[1:]))])
            written = file["solution/u"][()]
        self.assertLess(numpy.abs(u - written).max(), 1e-10 * max(1, numpy.abs(u).max()))
        rn, rt, un, ut = r[0::2], r[1::2], u[0::2], u[1::2]
        normal = numpy.maximum(0, rn - un / diagonal[0::2])
        tangential = numpy.clip(rt - ut / diagonal[1::2], -mu * normal, mu * normal)
        residual = math.sqrt(((rn - normal)**2 + (rt - tangential)**2).sum() / (r**2).sum())
        self.assertLessEqual(residual, 1.01 * tolerance)
        self.assertGreaterEqual(rn.min(), 0)
        self.assertTrue((numpy.abs(rt) <= mu * rn * (1 + 1e-12)).all())
        scale = numpy.abs(r).max() * (diagonal[0::2] * rn.size**0.5)
        self.assertTrue((un >= -10 * tolerance * scale).all(), "closing velocity left")
        self.assertTrue((numpy.minimum(rn * diagonal[0::2], numpy.abs(un)) <= 10 * tolerance * scale).all(), "complementarity")

    def expect_solved(self, problem, solver, form, tolerance, *words):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "solved.h5")
            result = self.solve(problem, "--solver", solver, "--form", form, "--tolerance", str(tolerance), "--output", path, *words)
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
            printed = self.printed(result)
            self.assertEqual((printed["status"], printed["solver"], printed["form"]), ("converged", solver, form))
            self.assertLessEqual(float(printed["residual"]), tolerance)
            self.judge(path, tolerance)
            self.assertEqual(listing(folder), ["solved.h5"])
            return bits(path)["solution/r"]

    def test_small_with_each_solver_and_form(self):
        for solver in ["psor", "nsgs"]:
            for form in ["body", "local"]:
                with self.subTest(solver=solver, form=form):
                    self.expect_solved("small.h5", solver, form, 1e-8)

    def test_medium_with_each_solver_and_form(self):
        for solver, tolerance in [("psor", 1e-6), ("nsgs", 1e-5)]:
            for form in ["body", "local"]:
                with self.subTest(solver=solver, form=form):
                    self.expect_solved("medium.h5", solver, form, tolerance)

    def test_two_threads_give_the_same_bits(self):
        alone = self.expect_solved("small.h5", "psor", "body", 1e-8)
        self.assertEqual(alone, self.expect_solved("small.h5", "psor", "body", 1e-8, "--threads", "2"))

    def test_too_few_sweeps_are_exit_code_three_and_what_was_reached_is_kept(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "reached.h5")
            result = self.solve("small.h5", "--max-sweeps", "5", "--output", path)
            self.assertEqual(result.returncode, 3, result.stderr)
            printed = self.printed(result)
            self.assertEqual((printed["status"], printed["sweeps"]), ("max_sweeps_reached", "5"))
            self.assertGreater(float(printed["residual"]), 1e-8)
            with h5py.File(path, "r") as file:
                self.assertEqual(len(file["solution/r"]), 2 * int(printed["contacts"]))

    def test_files_that_hold_no_problem(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "problem.h5")
            shutil.copy(os.path.join(PROBLEMS, "small.h5"), path)
            with open(path, "r+b") as file:
                file.truncate(os.path.getsize(path) // 2)
            other = os.path.join(folder, "other.h5")
            with h5py.File(other, "w") as file:
                file["numbers"] = [1, 2, 3]
            text = write(os.path.join(folder, "text.h5"), "no HDF5\n")
            for wrong in [path, other, text, os.path.join(folder, "none.h5")]:
                result = diptych("solve", wrong)
                self.assertEqual(result.returncode, 2, result.stderr)
                self.assertIn(wrong, result.stderr)

    def test_words_that_are_wrong(self):
        for words in [["--solver", "lemke"], ["--form", "global"], ["--tolerance", "0"], ["--tolerance", "2"], ["--max-sweeps", "0"]]:
            result = self.solve("small.h5", *words)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertIn(words[1], result.stderr)


if __name__ == "__main__":
    main()
