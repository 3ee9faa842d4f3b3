#!/usr/bin/env python3
# diptych: loading that reverses, predicted by a law fitted to the path before it
# SPDX-License-Identifier: LGPL-2.1-or-later
"""check.py PROGRAM [--seeds 1,2,3,4] [--output DIR] [--reuse] [--set section/key=value] [--fit] [--figure figure.png]

Runs scene.prm with a dense and a loose packing of every seed, and its continuum with two kinds of hardening. Compares
the mean of the grains with the continuum after the first reversal, to which nothing was fitted. --fit: also runs the
monotonic path and prints the parameters that fit it (PYTHONPATH with diptych; scipy). Exit code 1: a number is outside
its interval; 2: a run failed."""
import argparse
import os
import sys
import tempfile

import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))
import claims  # noqa: E402

SCENE = os.path.join(HERE, "scene.prm")
WINDOW = 2.  # time over which the grains are averaged: 0.1 % of strain
REVERSAL = 41.  # time of the first reversal, the end of the fitted part
MONOTONIC = ("loading/duration=201", "loading/stages=201",
             "discrete/drive_upper_y=velocity " + os.path.join(HERE, "monotonic.csv"))
# Settings of the grains, and their solid fraction prepared (mean of the seeds).
PACKINGS = {"dense": ((), 0.8327), "loose": (("sample/box_solid_fraction=0.75", "sample/preparation_friction=0.3"),
                                             0.8040)}
# Fitted to the monotonic path of both packings (--fit). `dense` and `loose` are t/s at the start of each.
KEYS = ("critical_stress_ratio", "critical_solid_fraction", "strength_by_density", "dilatancy_ratio",
        "mobilisation_strain", "youngs_modulus", "dense", "loose")
LAWS = {"kinematic": (0.2964, 0.8042, 3.933, 0.3773, 0.03569, 2107, 0.3664, 0.0116),
        "critical_state": (0.2658, 0.8024, 4.905, 0.5796, 0.02541, 2190, 0.3869, 0.01647)}
# name: lowest, highest.
CLAIMS = {"dense, kinematic: rms difference of t/s": (0, 0.08), "loose, kinematic: rms difference of t/s": (0, 0.07),
          "dense, kinematic: rms difference of volume": (0, 0.006),
          "loose, kinematic: rms difference of volume": (0, 0.006),
          "dense, critical_state: rms difference of t/s": (0.16, 1),
          "loose, critical_state: rms difference of t/s": (0.12, 1)}


def signed_ratio(history):
    """(syy - sxx)/(syy + sxx): t/s, negative where the horizontal stress is the larger one."""
    return (history["syy"] - history["sxx"]) / (history["syy"] + history["sxx"])


def windows(history):
    """Means over WINDOW of time of one run of the grains: time, axial strain, t/s (of the mean stress), volumetric
    strain."""
    number = numpy.floor(history["time"] / WINDOW).astype(int)
    mean = {name: numpy.bincount(number, history[name])[:-1] / numpy.bincount(number)[:-1]
            for name in ("time", "axial_strain", "volumetric_strain", "sxx", "syy")}
    return numpy.array([mean["time"], mean["axial_strain"], signed_ratio(mean), mean["volumetric_strain"]])


def grains(options, packing, path, settings=()):
    """(seeds, 4, windows) of one path, and the mean solid fraction prepared."""
    runs = []
    for seed in options.seeds:
        one = claims.Runs(options, seed, os.path.join(options.output, f"seed_{seed}"))
        runs.append(one.run(f"{packing}_{path}", "discrete", SCENE, *PACKINGS[packing][0], *settings).grains)
    n = min(len(windows(history)[0]) for history in runs)
    return numpy.array([windows(history)[:, :n] for history in runs]), numpy.mean([h["solid_fraction"][0]
                                                                                   for h in runs])


def continuum(options, packing, law):
    keys = {"hardening": law, "solid_fraction_start": PACKINGS[packing][1], **law_keys(LAWS[law], packing)}
    runs = claims.Runs(options, 1, options.output)
    settings = (f"continuum/{key}={value}" for key, value in keys.items())
    return runs.run(f"{packing}_{law}", "continuum", SCENE, *settings).continuum


def law_keys(values, packing):
    keys = dict(zip(KEYS, values))
    starts = {name: keys.pop(name) for name in PACKINGS}
    return {"stress_ratio_start": starts[packing], **keys}


def on_windows(history, time):
    """(t/s, volumetric strain) of the continuum at given times."""
    columns = signed_ratio(history), history["volumetric_strain"]
    return numpy.array([numpy.interp(time, history["time"], column) for column in columns])


def compare(options):
    """{packing: (windows of the seeds, {law: history})} and {name: number}."""
    curves, numbers = {}, {}
    for packing in PACKINGS:
        seeds, fraction = grains(options, packing, "cycle")
        mean, error = claims.mean_and_error(seeds)
        after = mean[0] > REVERSAL
        laws = {law: continuum(options, packing, law) for law in LAWS}
        curves[packing] = seeds, laws
        numbers[f"{packing}: solid fraction prepared"] = fraction
        for k, name in ((2, "t/s"), (3, "volume")):
            numbers[f"{packing}: standard error of {name}"] = numpy.sqrt((error[k, after] ** 2).mean())
            for law, history in laws.items():
                difference = (on_windows(history, mean[0]) - mean[2:])[k - 2, after]
                numbers[f"{packing}, {law}: rms difference of {name}"] = numpy.sqrt((difference ** 2).mean())
    return curves, numbers


def fit(options):
    """Prints the parameters of each law that fit t/s (to 0.02) and volume (to 0.1 %) of both packings on the monotonic
    path."""
    import diptych
    from scipy.optimize import least_squares
    strain = numpy.r_[0.0005, 0.001, 0.002, 0.003, 0.005, 0.0075, 0.01, 0.015, 0.02:0.0951:0.005]
    targets = {}
    for packing in PACKINGS:
        seeds, fraction = grains(options, packing, "monotonic", MONOTONIC)
        mean = seeds.mean(axis=0)
        targets[packing] = fraction, [numpy.interp(strain, mean[1], mean[k]) for k in (2, 3)]

    def residual(values, law):
        found = []
        for packing, (fraction, (ratio, volume)) in targets.items():
            keys = {"law": "cosserat_mohr_coulomb", "hardening": law, "cohesion": 0.001,
                    "solid_fraction_start": fraction}
            point = diptych.biaxial({**keys, **law_keys(values.tolist(), packing)}, axial_strain=0.1, step=5e-4)
            found.append((numpy.interp(strain, point["axial_strain"], point["stress_ratio"]) - ratio) / 0.02)
            found.append((numpy.interp(strain, point["axial_strain"], point["volumetric_strain"]) - volume) / 0.001)
        return numpy.concatenate(found)

    start = numpy.array([0.28, 0.815, 5, 0.5, 0.03, 1000, 0.36, 0.02])
    bounds = ([0.1, 0.78, 0.5, 0.2, 0.003, 100, 0.2, 0.001], [0.4, 0.84, 20, 3, 0.3, 20000, 0.5, 0.2])
    for law in LAWS:
        best = least_squares(residual, start, x_scale=start, bounds=bounds, diff_step=1e-3, args=(law,))
        print(f"{law}, fitted:", ", ".join(f"{key} = {value:.4g}" for key, value in zip(KEYS, best.x)))


def draw(curves, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as pyplot
    figure, axes = pyplot.subplots(2, 2, figsize=(10, 7.5), constrained_layout=True)
    for row, (packing, (seeds, laws)) in zip(axes, curves.items()):
        mean, error = claims.mean_and_error(seeds)
        fitted = mean[0] < REVERSAL
        for axis, k, scale in ((row[0], 2, 1), (row[1], 3, 100)):
            strain = 100 * mean[1]
            for line in seeds:
                axis.plot(100 * line[1], scale * line[k], color="0.75", linewidth=0.5)
            axis.plot(strain[fitted], scale * mean[k][fitted], color="#009e73", alpha=0.35, linewidth=9,
                      label="fitted part")
            axis.errorbar(strain, scale * mean[k], scale * error[k], color="k", linewidth=1.2, elinewidth=0.5,
                          label="grains")
            for law, colour in zip(laws, ("#d55e00", "#0072b2")):
                history = laws[law]
                values = signed_ratio(history) if k == 2 else history["volumetric_strain"]
                axis.plot(100 * history["axial_strain"], scale * values, "--", color=colour, label=law)
            axis.grid(alpha=0.3)
            axis.set(xlabel="axial strain [%]")
        row[0].set(ylabel="t/s", title=packing)
        row[1].set(ylabel="volumetric strain [%]")
    axes[0, 0].legend(fontsize=8, loc="lower right")
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=os.path.abspath)
    parser.add_argument("--seeds", type=lambda text: [int(word) for word in text.split(",")], default=[1, 2, 3, 4])
    parser.add_argument("--output", help="folder for the result folders; default: a temporary one")
    parser.add_argument("--reuse", action="store_true", help="keep runs that are already in --output")
    parser.add_argument("--set", action="append", default=[], help="section/key=value, passed to every run")
    parser.add_argument("--fit", action="store_true", help="also fit the law to the monotonic path")
    parser.add_argument("--figure")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        options.output = options.output or scratch
        try:
            if options.fit:
                fit(options)
            curves, numbers = compare(options)
        except claims.RunFailed as failure:
            sys.stderr.write(f"check.py: {failure}\n")
            return 2
        n_outside = 0
        for name, value in numbers.items():
            low, high = CLAIMS.get(name, (-numpy.inf, numpy.inf))
            outside = not low <= value <= high
            n_outside += outside
            claimed = f"   {low:g} to {high:g}" if name in CLAIMS else ""
            print(f"{name:52}{value:10.4g}{claimed}" + ("   OUTSIDE" if outside else ""))
        if options.figure:
            draw(curves, options.figure)
    return 1 if n_outside else 0


if __name__ == "__main__":
    sys.exit(main())
