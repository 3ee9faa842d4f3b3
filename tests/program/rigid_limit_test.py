# diptych: grains against stored runs of LAMMPS, and against their own limits of step and tolerance
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Samples, stored curves and how a run is read: benchmarks/rigid_limit. All runs have the same bits on every machine:
bounds allow for changes of the code, not for chance. Differences are sample by sample."""
import argparse
import os
import sys

import numpy as np

from running import Folder, PROGRAM, SOURCE

sys.path.insert(0, os.path.join(SOURCE, "benchmarks", "rigid_limit"))
import rigid_limit  # noqa: E402

STRENGTH = "T/S 0.50%-4.00%"
DILATION = "volume at 1.5%"


def nscd(folder, inertial, seeds, *settings):
    """[{name: number}] of every seed."""
    options = argparse.Namespace(output=folder, program=PROGRAM, reuse=False)
    method = rigid_limit.Method("NSCD", "_".join(s.split("/")[1] for s in settings) or "auto", list(settings))
    return [rigid_limit.quantities(method.load(options, inertial, seed)[0]) for seed in seeds]


def relative(rows, base, name):
    """(mean, standard error) of row / base - 1."""
    values = np.array([row[name] / other[name] - 1 for row, other in zip(rows, base)])
    return values.mean(), values.std(ddof=1) / np.sqrt(len(values))


class StoredLammps(Folder):
    """Springs of kn/P = 1e4, six samples, I = 1.13e-3. The samples' scatter leaves 0.9 % of standard error."""

    seeds = range(11, 17)

    def test_strength_and_volume_agree(self):
        springs = [rigid_limit.quantities(rigid_limit.stored(1.13e-3, 1e4, seed)[0]) for seed in self.seeds]
        by_default = nscd(self.work, 1.13e-3, self.seeds)
        fine = nscd(self.work, 1.13e-3, self.seeds, "discrete/step=0.05", rigid_limit.FINE)
        for name, rows, promised in (("as set by itself", by_default, 0.02), ("a step of 0.05", fine, 0.01)):
            difference, _ = relative(rows, springs, STRENGTH)
            self.assertLess(abs(difference), promised + 0.027, name)
            dilation, _ = relative(rows, springs, DILATION)
            self.assertLess(abs(dilation), 0.03 + 0.06, name)


class StepAndTolerance(Folder):
    """Twelve samples: the bias of the step is what the rule says, the default loses no dilation. Slow."""

    seeds = range(11, 23)

    def test_the_bias_of_the_step_is_the_rule_s(self):
        limit = nscd(self.work, 1.13e-3, self.seeds, "discrete/step=0.025", rigid_limit.FINE)
        for step in (0.1, 0.2, 0.4):
            rows = nscd(self.work, 1.13e-3, self.seeds, f"discrete/step={step}", rigid_limit.FINE)
            bias, error = relative(rows, limit, STRENGTH)
            expected = 100 * 1.13e-3 * step
            self.assertGreater(bias, 0, step)
            self.assertLess(bias, expected + 3 * error, step)

    def test_tolerance_auto_keeps_the_dilation(self):
        inertial, step = 1.13e-3, "discrete/step=0.1"
        right = nscd(self.work, inertial, self.seeds, step, rigid_limit.FINE)
        rows = nscd(self.work, inertial, self.seeds, step)
        loss, error = relative(rows, right, DILATION)
        self.assertLess(abs(loss), 0.03 + 2 * error)
        loose = nscd(self.work, inertial, self.seeds, step, f"discrete/tolerance={0.3 * inertial / 0.1:g}")
        lost, _ = relative(loose, right, DILATION)
        self.assertLess(lost, -0.05, "what lies outside the rule loses dilation: else the rule is too strict")
