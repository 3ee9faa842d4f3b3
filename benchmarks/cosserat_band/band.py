#!/usr/bin/env python3
# diptych: effect of the internal length on thickness and angle of shear bands of Cosserat laws
# SPDX-License-Identifier: LGPL-2.1-or-later
"""band.py PROGRAM [--output DIR] [--reuse] [--figure figure.png]

Runs `PROGRAM continuum` on oblique.prm, vertical.prm and smooth.prm with several internal lengths l, elements h, sizes
and laws. Prints thickness and angle of the bands, measured as in width.py. --reuse: does not repeat finished runs in
DIR. Exit code 1: mesh convergence, the angle or the strain reached is outside its interval; 2: a run failed. Needs h5py
and numpy, the figure matplotlib."""
import argparse
import sys
import tempfile

import numpy

from runs import (LENGTHS, LOCAL_ELEMENTS, SIZES, STRAINS, Runs, bands, facts, history, length_runs, power, size_runs,
                  thicknesses)

# Another program, element 1, W = H = 60: internal length -> thickness at STRAINS. Its authors state the oblique
# loading.
PROTOTYPE = {1: (6.3, 7.8, 9.0), 2: (11.7, 11.7, 13.1)}
ROUGH_CONVERGENCE, SMOOTH_CONVERGENCE = 0.03, 0.05  # Largest relative difference between h = l and l/2.
DILATANCY_ANGLE, FRICTION_ANGLE, ANGLE_BAND = 5, 30, 2  # Values of smooth.prm [degrees].


class Table:
    """Prints rows one by one and keeps the runs that ended early."""

    def __init__(self):
        self.n_failed, self.n_cut_backs = 0, 0

    def header(self, text):
        print(f"\n{text}\n{'':44}" + "".join(f"{100 * e:5g} %" for e in STRAINS) + "  scatter  angle  cuts  CPU s",
              flush=True)

    def row(self, label, folder, scene, reached=0.08):
        """`reached`: strain that the run must reach; 0: the run is expected to fail."""
        measured, cost, last = bands(folder, scene), facts(folder), history(folder)[-1]
        print(f"{label:44}" + "".join(f"{b.thickness if b else numpy.nan:7.2f}" for b in measured)
              + (f"{measured[-1].scatter:9.2f}{measured[-1].angle:7.1f}" if measured[-1] else "")
              + f"{last['cut_backs']:6.0f}{cost['seconds']:7.1f}"
              + ("" if cost["finished"] else f"  {cost['message']}"), flush=True)
        self.n_cut_backs += int(last["cut_backs"]) if reached else 0
        self.expect(cost["reached_axial_strain"] > reached - 1e-9, f"{label} reaches {100 * reached:g} % strain")
        return numpy.array([b.thickness if b else numpy.nan for b in measured])

    def expect(self, met, what):
        if not met:
            self.n_failed += 1
            print(f"    FAILED: {what}", flush=True)


def percent(ratios):
    return " ".join(f"{100 * (r - 1):+6.1f}" for r in numpy.atleast_1d(ratios))


def beside_prototype(length, found):
    prototype = PROTOTYPE[length]
    print(f"  l = {length}, h = 1 against the prototype's {prototype} [%]: {percent(found / prototype)}")


def show_oblique(table, runs):
    table.header("oblique: thickness [d] at axial strain, internal length l, element h")
    for length in LENGTHS:
        coarse, same, fine = (table.row(f"l = {length}, h = {h:g}",
                                        runs("oblique", internal_length=length, element_size=h),
                                        "oblique") for h in (2 * length, length, length / 2))
        print(f"  h = 2 l and h = l against h = l/2 [%]: {percent(coarse / fine)} and {percent(same / fine)}")
        table.expect(numpy.all(abs(same / fine - 1) < ROUGH_CONVERGENCE), f"l = {length}: h = l within 3 % of h = l/2")
        if length in PROTOTYPE:
            beside_prototype(length, same if length == 1 else fine)
    for change in ({"law": "cosserat_mohr_coulomb"}, {"viscosity": 0}, {"geometry": "updated"}):
        text = ", ".join(f"{key} = {value}" for key, value in change.items())
        table.row(f"l = 2, h = 1, {text}", runs("oblique", internal_length=2, element_size=1, **change), "oblique")


def show_vertical_and_smooth(table, runs):
    for scene, allowed, length in (("vertical", ROUGH_CONVERGENCE, 2), ("smooth", SMOOTH_CONVERGENCE, 1)):
        table.header(f"{scene}: thickness [d]")
        same, fine = (table.row(f"l = {length}, h = {h:g}", runs(scene, internal_length=length, element_size=h), scene)
                      for h in (length, length / 2))
        print(f"  h = l against h = l/2 [%]: {percent(same / fine)}")
        table.expect(numpy.all(abs(same / fine - 1) < allowed), f"{scene}: h = l within {100 * allowed:g} % of h = l/2")
        if scene == "vertical":
            beside_prototype(2, fine)
            beside_prototype(1, table.row("l = 1, h = 1", runs(scene, internal_length=1, element_size=1), scene))


def show_powers(table, runs):
    """The law has no other length, so the thickness is W f(l/W) and both exponents must add up to 1."""
    table.header("oblique: thickness [d] at sample size W = H, l = 2, h = 1")
    by_size = numpy.array([table.row(f"W = {size}", folder, "oblique") for size, folder in size_runs(runs).items()])
    by_length = numpy.array([thicknesses(folder, "oblique") for folder in length_runs(runs).values()])
    for k, strain in enumerate(STRAINS):
        print(f"  {100 * strain:g} %:", end="")
        for name, x, y in (("W^", SIZES, by_size), ("l^", LENGTHS, by_length)):
            factor, exponent, misfit = power(x, y[:, k])
            print(f" thickness = {factor:.2f} {name}{exponent:.2f} (misfit {100 * misfit:.1f} %),", end="")
        factor, exponent, misfit = power(numpy.append(2 / numpy.array(SIZES), numpy.array(LENGTHS) / 60),
                                         numpy.append(by_size[:, k] / SIZES, by_length[:, k] / 60))
        print(f" all: {factor:.2f} l^{exponent:.2f} W^{1 - exponent:.2f} ({100 * misfit:.1f} %)", flush=True)


def show_failure(table, runs):
    for text, keys in (("", {}), (", viscosity = 0", {"viscosity": 0})):
        table.header(f"oblique, law mohr_coulomb (no internal length){text}: thickness [d]")
        found = [table.row(f"h = {h}", runs("oblique", law="mohr_coulomb", **keys, element_size=h), "oblique",
                           reached=0)
                 for h in LOCAL_ELEMENTS]
        for strain, column in zip(STRAINS, numpy.transpose(found)):
            print(f"  {100 * strain:g} %: thickness / h = "
                  + ", ".join(f"{v / h:.2f}" for v, h in zip(column, LOCAL_ELEMENTS)))


def show_angle(table, runs):
    low, high = 45 + DILATANCY_ANGLE / 2, 45 + FRICTION_ANGLE / 2
    print(f"\nsmooth, h = 0.5: angle of the band to the minor principal direction [degrees], {low} - {high} +- "
          f"{ANGLE_BAND}")
    for strain, band in zip(STRAINS, bands(runs("smooth", internal_length=1, element_size=0.5), "smooth")):
        print(f"  {100 * strain:g} %: {band.angle:.1f}")
        table.expect(low - ANGLE_BAND <= abs(band.angle) <= high + ANGLE_BAND, f"angle at {100 * strain:g} %")


def far_run(runs):
    return runs("oblique", internal_length=2, element_size=1, geometry="updated", axial_strain=0.3)


def show_far(table, runs):
    folder = far_run(runs)
    cost, strains = facts(folder), (0.02, 0.04, 0.08, 0.12, 0.16, 0.2, 0.25, 0.3)
    print(f"\noblique, geometry = updated, l = 2, h = 1: reached {100 * cost['reached_axial_strain']:g} % with"
          f" {history(folder)[-1]['cut_backs']:.0f} cut-backs, {cost['steps']} steps, {cost['seconds']:.0f} s: "
          f"{cost['message']}")
    found = thicknesses(folder, "oblique", strains)
    print("  thickness [d]: " + ", ".join(f"{100 * e:g} %: {v:.1f}" for e, v in zip(strains, found)))
    table.expect(cost["reached_axial_strain"] > 0.3 - 1e-9, "30 % strain reached")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--output", help="folder for the result folders; default: thrown away")
    parser.add_argument("--reuse", action="store_true")
    parser.add_argument("--figure")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        runs, table = Runs(options, options.output or scratch), Table()
        for show in (show_oblique, show_vertical_and_smooth, show_powers, show_failure, show_angle, show_far):
            show(table, runs)
        print(f"\n{table.n_cut_backs} cut-backs in the runs of Cosserat laws to 8 %; {table.n_failed} failed")
        if options.figure:
            from draw import draw
            draw(runs, options.figure)
    return 1 if table.n_failed else 0


if __name__ == "__main__":
    sys.exit(main())
