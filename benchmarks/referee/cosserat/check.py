#!/usr/bin/env python3
# diptych: Cosserat laws, softening and viscosity against an independent finite element model
# SPDX-License-Identifier: LGPL-2.1-or-later
"""check.py PROGRAM [--cases NAMES] [--referee DIR] [--output DIR] [--set SECTION/KEY=VALUE] [--figure figure.png]

Runs `PROGRAM continuum` on scene.prm with the keys of each case and compares curves, band and fields with the stored
results of referee.py. --referee: folder of other such results; --set: a further key, for the program only. Exit code
1: a difference is above its limit; 2: a run failed. Needs h5py and numpy, the figure matplotlib."""
import argparse
import os
import subprocess
import sys
import tempfile

import h5py
import numpy

from cases import CASES, HERE, SCENE, keys, settings, stages

sys.path[:0] = [os.path.dirname(os.path.dirname(HERE)), os.path.join(os.path.dirname(os.path.dirname(HERE)),
                                                                     "cosserat_band")]

from claims import ENVIRONMENT, Result, RunFailed  # noqa: E402
from width import N_POINTS, Arm, Increment, measure, point_values, strip_profiles  # noqa: E402

ALLOWED = 1e-4  # Largest difference, relative to the largest value of the referee.
ARM = Arm(0.5, 0.5, -46, 0.35)  # First guess of the measured part of the band.
FIELDS = ("rotation", "skew", "m_x", "m_y")


class Plastic(Increment):
    """Increment of the hardening variable from its cell means [row, column], on the initial mesh."""

    def __init__(self, means, size):
        self.h, (self.width, self.height) = size / means.shape[1], (size, size / means.shape[1] * means.shape[0])
        self.values = (point_values(means.shape[0]) @ means @ point_values(means.shape[1]).T).ravel()
        self.shape = tuple(N_POINTS * n for n in means.shape)
        y, x = ((numpy.indices(self.shape) + 0.5) * self.h / N_POINTS).reshape(2, -1)
        self.points = numpy.stack((x, y), axis=1)


class Solution:
    """Results of one program for one case: curve (dictionary of columns), fields (name -> [row, column]) and the
    band."""

    def __init__(self, case, curve, fields):
        self.curve, self.fields = curve, fields
        self.increment = fields["kappa"] - fields["kappa_before"]
        self.plastic = Plastic(self.increment, float(keys(case)["rectangle_width"]))
        self.band = measure(self.plastic, ARM)

    def profile(self, band):
        """(abscissae, mean plastic shear increment) across the frame of a band."""
        reach = 0.3 * self.plastic.width
        across, strips = strip_profiles(self.plastic, band.centre, numpy.radians(band.angle), band.half_length, reach)
        return across, strips.mean(axis=0)


def referee_solution(folder, case):
    curve, table = (numpy.genfromtxt(os.path.join(folder, f"{case}_{part}.csv"), delimiter=",", names=True)
                    for part in ("curve", "cells"))
    shape = tuple(int(table[name].max()) + 1 for name in ("row", "column"))
    return Solution(case, curve, {name: table[name].reshape(shape) for name in table.dtype.names[2:]})


def stage_fields(group):
    """Cell means [row, column] of a stage, couple and skew stresses in the sign convention of mechanics."""
    nodes = group["cells/nodes"][()]
    x, y = (group["nodes/position"][()] - group["nodes/displacement"][()])[nodes[:, 8], :2].T
    order = numpy.lexsort((numpy.rint(1000 * x), numpy.rint(1000 * y)))
    shape = (len(numpy.unique(numpy.rint(1000 * y))), -1)
    fields = {"kappa": group["cells/equivalent_plastic_strain"][()]}
    if "nodes/rotation" in group:
        stress, couple = group["cells/stress"][()], group["cells/couple_stress"][()]
        fields |= {"rotation": group["nodes/rotation"][()][nodes[:, :4]].mean(axis=1),
                   "skew": (stress[:, 0, 1] - stress[:, 1, 0]) / 2, "m_x": couple[:, 0], "m_y": couple[:, 1]}
    return {name: values[order].reshape(shape) for name, values in fields.items()}


def program_solution(options, case, folder):
    """Runs the program. Throws RunFailed."""
    words = [word for setting in settings(case) + options.set for word in ("--set", setting)]
    done = subprocess.run([options.program, "continuum", SCENE, "--output", folder, "--overwrite", "--quiet", *words],
                          env=ENVIRONMENT, capture_output=True, text=True)
    if done.returncode != 0:
        raise RunFailed(f"{case} ended with exit code {done.returncode}: {done.stderr.strip()}")
    with h5py.File(os.path.join(folder, "continuum.h5"), "r") as file:
        groups = {round(float(file[name].attrs["axial_strain"]), 6): file[name] for name in sorted(file)}
        before, after = (stage_fields(groups[round(strain, 6)]) for strain in stages(case))
    return Solution(case, Result(folder).continuum, {"kappa_before": before["kappa"], **after})


def relative(found, expected):
    """Largest difference / largest value of the referee."""
    return abs(found - expected).max() / abs(expected).max()


def differences(ours, referee):
    """{quantity: relative difference} of two solutions on the same mesh and the same load steps."""
    found = {name: relative(ours.curve[name], referee.curve[name])
             for name in ("upper_fy", "upper_fx", "volumetric_strain")}
    found["peak force"] = relative(ours.curve["upper_fy"].min(), referee.curve["upper_fy"].min())
    found["plastic shear"] = relative(ours.increment, referee.increment)
    if not numpy.isnan(referee.band.thickness):
        found["band profile"] = relative(*(solution.profile(referee.band)[1] for solution in (ours, referee)))
        found["thickness"] = relative(ours.band.thickness, referee.band.thickness)
    return found | {name: relative(ours.fields[name], referee.fields[name]) for name in FIELDS
                    if name in referee.fields}


def judge(case, ours, referee):
    """Prints the differences of a case. Returns how many are too large."""
    strains = [numpy.round(solution.curve["axial_strain"], 9) for solution in (ours, referee)]
    if not numpy.array_equal(*strains):
        print(f"{case}: OUTSIDE, the load steps differ")
        return 1
    print(f"{case}: peak force {-ours.curve['upper_fy'].min():.5f} / {-referee.curve['upper_fy'].min():.5f}, "
          f"at the end {-ours.curve['upper_fy'][-1]:.5f} / {-referee.curve['upper_fy'][-1]:.5f}, "
          + ("no band" if numpy.isnan(referee.band.thickness) else
             f"thickness {ours.band.thickness:.4f} / {referee.band.thickness:.4f}"))
    found = differences(ours, referee)
    outside = [name for name, value in found.items() if not value < ALLOWED]
    print("    " + ", ".join(f"{name} {value:.1e}" + (" OUTSIDE" if name in outside else "") for name,
                             value in found.items()),
          flush=True)
    return len(outside)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--cases", default=",".join(CASES))
    parser.add_argument("--referee", default=os.path.join(HERE, "results"))
    parser.add_argument("--output", help="folder for the result folders; default: thrown away")
    parser.add_argument("--set", action="append", default=[], help="section/key=value")
    parser.add_argument("--figure")
    options = parser.parse_args()
    options.program = os.path.abspath(options.program)
    n_outside, pairs = 0, {}
    print("continuum panel / referee; then differences relative to the referee's largest value")
    with tempfile.TemporaryDirectory() as scratch:
        for case in options.cases.split(","):
            try:
                ours = program_solution(options, case, os.path.join(options.output or scratch, case))
            except RunFailed as failure:
                sys.stderr.write(f"check.py: {failure}\n")
                return 2
            pairs[case] = ours, referee_solution(options.referee, case)
            n_outside += judge(case, *pairs[case])
    if options.figure:
        from picture import draw
        draw(pairs, options.figure)
    return 1 if n_outside else 0


if __name__ == "__main__":
    sys.exit(main())
