#!/usr/bin/env python3
# diptych: the cell of grains against a sample between walls and against LAMMPS
# SPDX-License-Identifier: LGPL-2.1-or-later
"""referees.py PROGRAM --output DIR [--seeds 1-8] [--reuse] walls|lammps

walls    the drained cell of scene.prm against the interior of ../dense_biaxial, at least INTERIOR d from the walls, to
         4 % of strain
lammps   a drained test and simple shear: NSCD and springs (method penalty) against LAMMPS' triclinic box, with the
         grains of the prepared cell of every seed, kn/P = STIFFNESS

Both are listed with the differences of T/S and of the volume, and their standard errors over the seeds."""
import argparse
import os
import sys

import h5py
import numpy
from scipy.integrate import trapezoid

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.dirname(HERE)]
import claims  # noqa: E402
import interior  # noqa: E402
import lammps  # noqa: E402

SCENE, WALLS = os.path.join(HERE, "scene.prm"), os.path.join(HERE, "../dense_biaxial/scene.prm")
BEGIN, END = 0.005, 0.04  # strain over which strengths are taken
INTERIOR = 4.  # mean diameters
STIFFNESS, RATE = 1e4, 1.13e-3  # kn/P and inertial number, that of scene.prm


def strength(columns):
    """T/S of a history over [BEGIN, END] of its progress, and the volumetric strain at the end."""
    x = columns["progress"]
    inside = (x > BEGIN) & (x <= END * (1 + 1e-9))
    if "t" not in columns:
        half, shear = 0.5 * (columns["sxx"] - columns["syy"]), 0.5 * (columns["sxy"] + columns["syx"])
        columns = {**columns, "t": numpy.hypot(half, shear), "s": 0.5 * (columns["sxx"] + columns["syy"])}
    t, s = (trapezoid(columns[name][inside], x[inside]) for name in ("t", "s"))
    return t / s, columns["volumetric_strain"][inside][-1]


def prepared(folder):
    """(positions, radii, lattice vectors as columns) of the prepared cell."""
    with h5py.File(os.path.join(folder, "discrete.h5")) as file:
        stage = file["stage_0000"]
        vectors = numpy.array([stage.attrs["cell_" + name] for name in ("a1_x", "a2_x", "a1_y", "a2_y")]).reshape(2, 2)
        return stage["grains/position"][:, :2], stage["grains/radius"][:], vectors


def shown(name, values, reference):
    """Mean of `values`, and the paired or unpaired difference from `reference` (seeds, 2) with its standard error."""
    values, reference = numpy.array(values), numpy.array(reference)
    n = len(values)
    difference, error = values - reference, (values - reference).std(axis=0, ddof=1) / numpy.sqrt(n)
    print(f"{name:36}T/S {values[:, 0].mean():.4f}, differs by "
          f"{100 * difference[:, 0].mean() / reference[:, 0].mean():+.1f} +- "
          f"{100 * error[0] / reference[:, 0].mean():.1f} %;  volume {100 * values[:, 1].mean():.3f} %, differs by "
          f"{100 * difference[:, 1].mean():+.3f} +- {100 * error[1]:.3f} %")
    return difference[:, 0].mean() / reference[:, 0].mean()


def walls(run):
    found, whole, inside = [], [], []
    for seed in run.seeds:
        found.append(strength(run.of(seed).run("drained", "discrete", SCENE).grains))
        one = run.of(seed).run("walls", "discrete", WALLS, f"loading/axial_strain={END}", "loading/stage_strain=0.0025")
        whole.append(strength(one.grains))
        inside.append((interior.strength(one.folder, BEGIN, END, INTERIOR), whole[-1][1]))
    shown("walls, whole sample", whole, whole)
    shown(f"walls, beyond {INTERIOR:g} d from them", inside, whole)
    shown("cell, against the whole sample", found, whole)
    return abs(shown("cell, against the interior", found, inside)) > 0.02


def against_lammps(run):
    outside = False
    for path in lammps.PATHS:
        springs = ("discrete/method=penalty", f"discrete/penalty_stiffness={STIFFNESS:g}")
        found = {"NSCD": [], "springs": [], "LAMMPS": []}
        for seed in run.seeds:
            rigid, soft = (run.of(seed).run(path + name, "discrete", SCENE, f"loading/path={path}", *more)
                           for name, more in (("", ()), ("_springs", springs)))
            folder = os.path.join(run.folder(seed), path + "_lammps")
            if run.options.reuse and os.path.exists(os.path.join(folder, "history.txt")):
                other = lammps.history(folder, path)
            else:
                other = lammps.run(prepared(rigid.folder), folder, path, STIFFNESS, RATE, strain=END)
            for name, history in zip(found, (rigid.grains, soft.grains, other)):
                found[name].append(strength(history))
        shown(f"{path}: LAMMPS", found["LAMMPS"], found["LAMMPS"])
        outside |= abs(shown(f"{path}: springs", found["springs"], found["LAMMPS"])) > 0.02
        shown(f"{path}: NSCD", found["NSCD"], found["LAMMPS"])
    return outside


class Campaign:
    def __init__(self, options):
        self.options, self.seeds = options, options.seeds

    def folder(self, seed):
        return os.path.join(self.options.output, f"seed_{seed}")

    def of(self, seed):
        return claims.Runs(self.options, seed, self.folder(seed))


def seeds_of(text):
    first, _, last = text.partition("-")
    return list(range(int(first), int(last or first) + 1))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=os.path.abspath)
    parser.add_argument("which", choices=["walls", "lammps"])
    parser.add_argument("--seeds", type=seeds_of, default="1-8")
    parser.add_argument("--output", required=True)
    parser.add_argument("--reuse", action="store_true", help="keep runs that are already in --output")
    parser.add_argument("--set", action="append", default=[], help="section/key=value, passed to every run")
    options = parser.parse_args()
    try:
        return int({"walls": walls, "lammps": against_lammps}[options.which](Campaign(options)))
    except claims.RunFailed as failure:
        sys.stderr.write(f"referees.py: {failure}\n")
        return 2


if __name__ == "__main__":
    sys.exit(main())
