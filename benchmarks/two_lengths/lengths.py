#!/usr/bin/env python3
# diptych: two internal lengths beside each other: Cosserat rotations and the gradient of the hardening variable
# SPDX-License-Identifier: LGPL-2.1-or-later
"""lengths.py PROGRAM [--output DIR] [--reuse] [--figure figure.png]

Runs `PROGRAM continuum` on oblique.prm with a Cosserat and a gradient law, several internal lengths l, elements h and
sizes W. Prints thicknesses of the band, measured as in ../cosserat_band/width.py. --reuse: does not repeat finished
runs in DIR. Exit code 1: elements of l and l/2 differ by more than 3 %, or a run ends early; 2: a run failed. Needs
h5py and numpy, the figure matplotlib."""
import argparse
import os
import sys
import tempfile

import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "cosserat_band"))
from runs import Runs, facts, power, thicknesses  # noqa: E402

LAWS = {"Cosserat": "cosserat_drucker_prager", "gradient": "gradient_drucker_prager"}
MESHES = ((2, 2), (2, 1), (4, 4), (4, 2))  # l, h
SIZES = (40, 60, 90)  # with l = 2, h = 1
STRAINS = (0.02, 0.04, 0.06, 0.08)
CONVERGENCE = 0.03  # largest relative difference between h = l and l/2


def measured(runs, law):
    """{(W, l, h): thickness [d] at STRAINS} of one law; prints a row for each."""
    found = {}
    for size, length, h in [(60, *mesh) for mesh in MESHES] + [(size, 2, 1) for size in SIZES if size != 60]:
        folder = runs("oblique", law=law, internal_length=length, element_size=h, rectangle_width=size,
                      rectangle_height=size)
        found[size, length, h] = thicknesses(folder, "oblique", STRAINS)
        cost = facts(folder)
        print(f"  W = {size}, l = {length}, h = {h}" + "".join(f"{v:8.2f}" for v in found[size, length, h])
              + f"{cost['seconds']:8.1f} s  {cost['message']}", flush=True)
    return found


def judged(name, found):
    """Prints mesh convergence and powers of W and l. Returns whether the thickness converges."""
    good = True
    for length in (2, 4):
        change = found[60, length, length] / found[60, length, length / 2] - 1
        print(f"  l = {length}: h = l against l/2 [%]: " + " ".join(f"{100 * c:+.1f}" for c in change))
        good = good and bool(numpy.all(abs(change) < CONVERGENCE))  # False for NaN, a run that ended early
    for k, strain in enumerate(STRAINS):
        by_size = power(SIZES, [found[size, 2, 1][k] for size in SIZES])
        by_length = power((2, 4), (found[60, 2, 1][k], found[60, 4, 2][k]))
        print(f"  {100 * strain:g} %: like W^{by_size[1]:.2f}, l^{by_length[1]:.2f}; / l at W = 60: "
              + ", ".join(f"{found[60, length, length / 2][k] / length:.2f}" for length in (2, 4)))
    if not good:
        print(f"FAILED: {name}: elements of l and l/2 agree within 3 %")
    return good


def show_limits(runs, exhausted):
    """Gradient law, l = 4, W = 60: another weight m; a strength that stops falling (`exhausted`: runs of
    ../cosserat_band)."""
    for text, of_scene, weight, elements in (("oblique.prm, m = 2", runs, 2, (4, 2, 1)),
                                             ("strength constant from 0.1 on, m = 4", exhausted, 4, (4, 2)),
                                             ("strength constant from 0.1 on, m = 2", exhausted, 2, (4, 2))):
        print(f"\n{text}: thickness [d], gradient law, l = 4")
        for h in elements:
            folder = of_scene("oblique", law=LAWS["gradient"], internal_length=4, nonlocal_weight=weight,
                              element_size=h)
            print(f"  h = {h}" + "".join(f"{v:8.2f}" for v in thicknesses(folder, "oblique", STRAINS)), flush=True)


def draw(found, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as pyplot
    figure, (mesh, strain, size) = pyplot.subplots(1, 3, figsize=(11, 3.6), constrained_layout=True)
    for (name, values), colour, marker in zip(found.items(), ("#0072b2", "#d55e00"), "os"):
        for length, style in ((2, "-"), (4, "--")):
            by_element = [values[60, length, share * length][1] for share in (0.5, 1)]
            mesh.plot([0.5, 1], by_element, style, color=colour, marker=marker, label=f"{name}, l = {length} d")
            strain.plot([100 * e for e in STRAINS], values[60, length, length / 2], style, color=colour, marker=marker)
        for k, style in ((0, ":"), (3, "-")):
            size.plot(SIZES, [values[w, 2, 1][k] for w in SIZES], style, color=colour, marker=marker,
                      label=f"{name}, {100 * STRAINS[k]:g} %")
    mesh.set(xlabel="element size h / l", title="4 % strain, W = 60 d", xlim=(0.3, 1.2), ylabel="thickness / d")
    strain.set(xlabel="axial strain [%]", title="W = 60 d, h = l/2")
    size.set(xlabel="sample size W / d", title="l = 2 d, h = 1 d")
    for axes in (mesh, strain, size):
        axes.set_ylim(0, 28)
        axes.grid(alpha=0.3)
    mesh.legend(fontsize=7.5, ncol=2, loc="upper center")
    size.legend(fontsize=7.5, ncol=2, loc="upper center")
    figure.savefig(path, dpi=120)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--output", help="folder for the result folders; default: thrown away")
    parser.add_argument("--reuse", action="store_true")
    parser.add_argument("--figure")
    options = parser.parse_args()
    found, good = {}, True
    with tempfile.TemporaryDirectory() as scratch:
        runs = Runs(options, options.output or scratch, HERE)
        for name, law in LAWS.items():
            print(f"\n{name}: thickness [d] at " + ", ".join(f"{100 * e:g} %" for e in STRAINS), flush=True)
            found[name] = measured(runs, law)
            good = judged(name, found[name]) and good
        exhausted = os.path.join(runs.folder, "exhausted")
        os.makedirs(exhausted, exist_ok=True)
        show_limits(runs, Runs(options, exhausted))
    if options.figure:
        draw(found, options.figure)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
