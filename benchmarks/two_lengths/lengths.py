#!/usr/bin/env python3
# diptych: two internal lengths beside each other: Cosserat rotations and the gradient of the hardening variable
# SPDX-License-Identifier: LGPL-2.1-or-later
"""lengths.py bands PROGRAM [--output DIR] [--reuse]: thickness of the band of oblique.prm for both kinds of law, by element, internal
length, sample size and strain. Exit code 1: elements of l and l/2 differ by more than 3 %, the two exponents of
l and W do not add up to 1, or a run ends early.
lengths.py grains [cosserat|gradient...]: calibrates each law on the same samples and predicts others (PYTHONPATH:
build/release/python). Results in results/two_lengths; --resume is implied."""
import argparse
import os
import sys
import tempfile

import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "cosserat_band"))
from runs import STRAINS, Runs, facts, power, thicknesses  # noqa: E402

LAWS = {"gradient": {"law": "gradient_drucker_prager"}, "cosserat": {"law": "cosserat_drucker_prager"}}
PAIRS = ((2, 2), (2, 1), (4, 4), (4, 2))  # (internal length, element), each length first with h = l, then with h = l/2
SIZES = (40, 60, 90)
CONVERGENCE, SUM_OF_POWERS = 0.03, 0.02
RESULTS = "results/two_lengths"


def row(label, folder):
    """Prints and returns the thickness [d] at STRAINS."""
    found, cost = thicknesses(folder, "oblique"), facts(folder)
    print(f"{label:40}" + "".join(f"{v:8.2f}" for v in found) + f"{cost['seconds']:8.1f} s"
          + ("" if cost["finished"] else f"  {cost['message']}"), flush=True)
    return found


def bands(options):
    failed = []
    with tempfile.TemporaryDirectory() as scratch:
        runs = Runs(options, options.output or scratch, HERE)
        for name, law in LAWS.items():
            print(f"\n{name}: thickness [d] at " + ", ".join(f"{100 * e:g} %" for e in STRAINS))
            found = {(l, h): row(f"W = 60, l = {l}, h = {h}", runs("oblique", **law, internal_length=l, element_size=h))
                     for l, h in PAIRS}
            for l in (2, 4):
                change = found[l, l] / found[l, l / 2] - 1
                print(f"  l = {l}: h = l against l/2 [%]: " + " ".join(f"{100 * c:+.1f}" for c in change))
                failed += [f"{name}, l = {l}: h = l within 3 % of l/2"] if not numpy.all(abs(change) < CONVERGENCE) else []
            size = {60: found[2, 1]}
            for w in SIZES:
                if w not in size:
                    size[w] = row(f"W = {w}, l = 2, h = 1", runs("oblique", **law, internal_length=2, element_size=1,
                                                                 rectangle_width=w, rectangle_height=w))
            for k, strain in enumerate(STRAINS):
                by_size = power(SIZES, [size[w][k] for w in SIZES])
                by_length = power((2, 4), (found[2, 1][k], found[4, 2][k]))
                print(f"  {100 * strain:g} %: l^{by_length[1]:.2f} W^{by_size[1]:.2f} (misfit {100 * by_size[2]:.1f} %)")
    for one in failed:
        print("FAILED:", one)
    return 1 if failed else 0


def calibration(kind):
    """Six parameters from eight samples sheared obliquely; predicted: other samples, and another loading path."""
    scenes = os.path.join(HERE, "..", "calibration", "defaults")

    def target(loading, seeds, **use):
        return {"name": f"{loading}, seeds {seeds}", "scene": f"{scenes}/{loading}.prm", "seeds": seeds,
                "set": {"discrete/friction": 0.5, "continuum/element_size": 2}, **use}
    return {
        "title": f"oblique samples, {kind} law",
        "targets": [target("oblique", "17-24"), target("oblique", "25-32", use="predict"), target("vertical", "25-32", use="predict")],
        "quantities": ["stress_ratio", "volumetric_strain", "ln_width"],
        "bins": [0.001, 0.002, 0.003, 0.004, 0.006, 0.008, 0.01, 0.0125, 0.015, 0.0175, 0.02, 0.0225, 0.025, 0.0275, 0.03, 0.035,
                 0.04],
        "set": {"continuum/law": f"{kind}_mohr_coulomb", "continuum/hardening": "mobilisation",
                "continuum/softening_strain": 0.3, "continuum/cohesion": 0.01, "continuum/mobilisation_strain": 0.007},
        "load_step": 0.0012, "coarse_element_size": 3.5,
        "parameters": [
            {"key": "friction_angle_peak", "start": 25, "low": 12, "high": 45},
            {"key": "friction_angle_residual", "start": 0.5, "low": 0.05, "high": 0.9},
            {"key": "friction_angle_start", "start": 0.7, "low": 0.2, "high": 1},
            {"key": "dilatancy_angle_peak", "of": "friction_angle_start", "start": 0.5, "low": 0.05, "high": 1},
            {"key": "internal_length", "start": 2, "low": 0.6, "high": 8},
            {"key": "youngs_modulus", "start": 2000, "low": 200, "high": 100000}]}


def grains(kinds):
    import diptych
    for kind in kinds or ("cosserat", "gradient"):
        found = diptych.calibrate(calibration(kind), os.path.join(RESULTS, kind), resume=True)
        print(f"\n{kind}\n{found.parameters.to_string()}\n{found.predictions.to_string()}", flush=True)
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    of_bands = commands.add_parser("bands")
    of_bands.add_argument("program")
    of_bands.add_argument("--output", help="folder for the result folders; default: thrown away")
    of_bands.add_argument("--reuse", action="store_true")
    commands.add_parser("grains").add_argument("kinds", nargs="*")
    options = parser.parse_args()
    return bands(options) if options.command == "bands" else grains(options.kinds)


if __name__ == "__main__":
    sys.exit(main())
