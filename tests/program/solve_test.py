# diptych: stored contact problems
# SPDX-License-Identifier: LGPL-2.1-or-later
import os
import shutil

import h5py
import numpy
import scipy.sparse

from running import bits, diptych, Folder, listing, PROBLEMS, write


def solve(problem, *words):
    """The result, and the lines that it printed by their names."""
    result = diptych("solve", os.path.join(PROBLEMS, problem), *words)
    return result, dict(line.split(": ", 1) for line in result.stdout.splitlines())


class Solve(Folder):
    """`diptych solve` on stored problems; what it writes is judged from W, q and mu of the file alone."""

    def judge(self, path, tolerance):
        """|r - P(r)| / |r| with u = W r + q, and the worst of each condition relative to |r| or |u|."""
        with h5py.File(path, "r") as file:
            r = file["solution/r"][()]
            stored, q, mu = file["fclib_local/W"], file["fclib_local/vectors/q"][()], file["fclib_local/vectors/mu"][()]
            self.assertEqual(int(stored["nz"][()].item()), -2, "stored by rows")
            w = scipy.sparse.csr_array((stored["x"][()], stored["i"][()], stored["p"][()]), shape=(r.size, r.size))
            u, diagonal, written = q + w @ r, w.diagonal(), file["solution/u"][()]
        self.assertLess(numpy.abs(u - written).max(), 1e-10 * max(1, numpy.abs(u).max()))
        rn, rt, un, ut = r[0::2], r[1::2], u[0::2], u[1::2]
        normal = numpy.maximum(0, rn - un / diagonal[0::2])
        tangential = numpy.clip(rt - ut / diagonal[1::2], -mu * normal, mu * normal)
        residual = numpy.hypot(rn - normal, rt - tangential)
        self.assertLessEqual(numpy.linalg.norm(residual) / numpy.linalg.norm(r), 1.01 * tolerance)
        self.assertGreaterEqual(rn.min(), 0)
        self.assertTrue((numpy.abs(rt) <= mu * rn * (1 + 1e-12)).all())
        scale = numpy.abs(r).max() * (diagonal[0::2] * rn.size**0.5)
        self.assertTrue((un >= -10 * tolerance * scale).all(), "closing velocity left")
        self.assertTrue((numpy.minimum(rn * diagonal[0::2], numpy.abs(un)) <= 10 * tolerance * scale).all(),
                        "complementarity")

    def test_what_is_called_solved_is(self):
        """With each solver and form, and the same bits with two threads."""
        found = {}
        for problem, solver, form, tolerance, threads in [
                ("small", "psor", "body", 1e-8, 1), ("small", "psor", "body", 1e-8, 2),
                ("small", "psor", "local", 1e-8, 1),
                ("small", "nsgs", "body", 1e-8, 1), ("small", "nsgs", "local", 1e-8, 1),
                ("medium", "psor", "body", 1e-6, 1)]:
            with self.subTest(problem=problem, solver=solver, form=form, threads=threads):
                path = os.path.join(self.work, "solved.h5")
                result, printed = solve(problem + ".h5", "--solver", solver, "--form", form, "--tolerance",
                                        str(tolerance), "--threads", str(threads), "--output", path)
                self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
                self.assertEqual((printed["status"], printed["solver"], printed["form"]), ("converged", solver, form))
                self.assertLessEqual(float(printed["residual"]), tolerance)
                self.judge(path, tolerance)
                self.assertEqual(listing(self.work), ["solved.h5"])
                self.assertEqual(bits(path)["solution/r"], found.setdefault((problem, solver, form),
                                                                            bits(path)["solution/r"]))
                os.remove(path)

    def test_a_disc_between_closing_plates_has_no_solution(self):
        """The free velocities of both contacts are -1, and no impulses change their sum."""
        path = os.path.join(self.work, "closing.h5")
        w = numpy.array([[1, 0, -1, 0], [0, 3, 0, 1], [-1, 0, 1, 0], [0, 1, 0, 3.]])
        with h5py.File(path, "w") as file:
            matrix = {"m": [4], "n": [4], "nz": [-2], "nzmax": [16], "p": range(0, 17, 4), "i": [0, 1, 2, 3] * 4,
                      "x": w.ravel()}
            for name, values in matrix.items():
                file["fclib_local/W/" + name] = values
            file["fclib_local/spacedim"] = [2]
            file["fclib_local/vectors/q"] = [-1., 0, -1, 0]
            file["fclib_local/vectors/mu"] = [0.5, 0.5]
        for solver in "psor", "nsgs":
            result, printed = solve(path, "--solver", solver, "--tolerance", "1e-3", "--max-sweeps", "10000")
            self.assertEqual((result.returncode, printed["status"]), (3, "max_sweeps_reached"), result.stderr)
            self.assertGreater(float(printed["velocity_error"]), 0.9)
            self.assertIn("no impulses solve the problem", result.stderr)

    def test_too_few_sweeps_are_exit_code_three_and_what_was_reached_is_kept(self):
        path = os.path.join(self.work, "reached.h5")
        result, printed = solve("small.h5", "--max-sweeps", "5", "--output", path)
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertEqual((printed["status"], printed["sweeps"]), ("max_sweeps_reached", "5"))
        self.assertGreater(float(printed["residual"]), 1e-8)
        with h5py.File(path, "r") as file:
            self.assertEqual(len(file["solution/r"]), 2 * int(printed["contacts"]))

    def test_files_that_hold_no_problem(self):
        half = shutil.copy(os.path.join(PROBLEMS, "small.h5"), self.work)
        os.truncate(half, os.path.getsize(half) // 2)
        other = os.path.join(self.work, "other.h5")
        with h5py.File(other, "w") as file:
            file["numbers"] = [1, 2, 3]
        for wrong in [half, other, write(os.path.join(self.work, "text.h5"), "no HDF5\n"),
                      os.path.join(self.work, "none.h5")]:
            self.expect(2, ["solve", wrong], wrong)

    def test_words_that_are_wrong(self):
        for words in [["--solver", "lemke"], ["--form", "global"], ["--tolerance", "0"], ["--tolerance", "2"],
                      ["--max-sweeps", "0"]]:
            self.expect(2, ["solve", os.path.join(PROBLEMS, "small.h5"), *words], words[1])
