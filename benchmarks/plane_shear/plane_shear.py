#!/usr/bin/env python3
# diptych: friction and solid fraction of sheared discs over the inertial number
# SPDX-License-Identifier: LGPL-2.1-or-later
"""plane_shear.py PROGRAM [--seeds 1,2,3,4] [--numbers 0.005,0.016,...] [--friction 0.4,0] [--jobs 2] [--output DIR]
[--reuse]
                [--set section/key=value] [--figure figure.png]

Loads scene.prm for every seed, friction and inertial number and averages over shear strains of 2 to 6. mu* is the mean
shear force on the upper platen over its mean normal force. Rate and solid fraction are those of the middle half of the
height, from the snapshots. Then fits the straight lines mu* = a + b I and phi = a - b I as da Cruz et al. (2005). Needs
h5py and numpy, the figure matplotlib."""
import argparse
import concurrent.futures
import os
import sys
import tempfile

import h5py
import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))
import claims  # noqa: E402

SCENE = os.path.join(HERE, "scene.prm")
DISC = numpy.sqrt(numpy.pi / 4)  # sqrt(m/P) with the mass of the mean disc, over d sqrt(rho/P).
FIRST_STRAIN = 2.
SLICES = 40  # Slices of the height, for the areas of the discs.
# mu* and phi over I = rate sqrt(m/P) with friction 0.4 (da Cruz et al. 2005, Phys. Rev. E 72, 021309): mu* = 0.25 + 1.1
# I and phi = 0.81 - 0.3 I.
LITERATURE = {"mu*": (0.25, 1.1), "phi": (0.81, -0.3)}


def covered_share(y, r, height, width):
    """Share of the period that the discs cover at the given height."""
    half = numpy.sqrt(numpy.maximum(0, r ** 2 - (y - height) ** 2))
    return 2 * half.sum() / width


def middle(stage):
    """(shear rate, solid fraction) of the middle half between the platens at one instant."""
    attributes, grains = stage.attrs, stage["grains"]
    low, high = attributes["lower_y"], attributes["upper_y"]
    position, radius = grains["position"][:, :2], grains["radius"][:]
    bottom, top = low + 0.25 * (high - low), high - 0.25 * (high - low)
    inside = (position[:, 1] > bottom) & (position[:, 1] < top) & (grains["fixed"][:] == 0)
    rate = numpy.polyfit(position[inside, 1], grains["velocity"][:, 0][inside], 1)[0]
    heights = bottom + (numpy.arange(SLICES) + 0.5) / SLICES * (top - bottom)
    fraction = numpy.mean([covered_share(position[:, 1], radius, y, attributes["cell_width"]) for y in heights])
    return rate, fraction


def figures(result):
    """{name: number} of one run."""
    history = result.grains
    late = history["shear_strain"] > FIRST_STRAIN
    pressure = -history["upper_fy"][late].mean()
    stages = []
    with h5py.File(os.path.join(result.folder, "discrete.h5"), "r") as file:
        for name in sorted(name for name in file if name.startswith("stage_")):
            if file[name].attrs["shear_strain"] > FIRST_STRAIN:
                stages.append(middle(file[name]))
        width = file["stage_0000"].attrs["cell_width"]
    rate, fraction = numpy.mean(stages, axis=0)
    return {"I": rate * DISC / numpy.sqrt(pressure / width), "mu*": history["upper_fx"][late].mean() / pressure,
            "phi": fraction}


def run(options, case):
    seed, friction, number = case
    runs = claims.Runs(options, seed, os.path.join(options.output, f"seed_{seed}"))
    return figures(runs.run(f"mu_{friction:g}_I_{number:g}", "discrete", SCENE,
                            f"loading/inertial_number={number / DISC:.6g}", f"discrete/friction={friction:g}"))


def measure(options):
    """{(friction, inertial number): [numbers of each seed]}."""
    cases = [(seed, friction, number) for friction in options.friction for number in options.numbers
             for seed in options.seeds]
    found = {}
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for (_, friction, number), result in zip(cases, pool.map(lambda case: run(options, case), cases)):
            found.setdefault((friction, number), []).append(result)
    return found


def straight_line(found, friction, name, seeds):
    """((a, error), (b, error)) of name = a + b I, fitted seed by seed."""
    lines = []
    for k in range(seeds):
        points = [results[k] for (mu, _), results in found.items() if mu == friction]
        slope, start = numpy.polyfit([p["I"] for p in points], [p[name] for p in points], 1)
        lines.append((start, slope))
    return [claims.mean_and_error(column) for column in zip(*lines)]


def show(found, options):
    print("friction   I in the middle    mu*                 phi")
    for (friction, _), results in found.items():
        columns = {name: claims.mean_and_error([r[name] for r in results]) for name in ("I", "mu*", "phi")}
        print(f"{friction:8g}   {columns['I'][0]:15.4f}" + "".join(f"    {columns[n][0]:.4f} +- {columns[n][1]:.4f}"
                                                                   for n in ("mu*", "phi")))
    for friction in options.friction if len(options.numbers) > 2 else ():
        for name in ("mu*", "phi"):
            (a, a_error), (b, b_error) = straight_line(found, friction, name, len(options.seeds))
            print(f"friction {friction:g}: {name} = {a:.4f} (+- {a_error:.4f}) {b:+.3f} (+- {b_error:.3f}) I")


def draw(found, options, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as pyplot
    figure, axes = pyplot.subplots(1, 2, figsize=(9, 3.8), constrained_layout=True)
    for axis, name, label in zip(axes, ("mu*", "phi"), ("shear force / normal force", "solid fraction of the middle")):
        for friction, colour, marker in zip(options.friction, ("tab:blue", "tab:red", "tab:green"), "osd"):
            points = [(results, key) for key, results in found.items() if key[0] == friction]
            x = [numpy.mean([r["I"] for r in results]) for results, _ in points]
            y = [claims.mean_and_error([r[name] for r in results]) for results, _ in points]
            axis.errorbar(x, [v[0] for v in y], [v[1] for v in y], fmt=marker, color=colour, capsize=3,
                          label=f"friction {friction:g}")
        a, b = LITERATURE[name]
        span = numpy.array([0.005, 0.14])
        axis.plot(span, a + b * span, "k--", linewidth=1, label="da Cruz et al. 2005, friction 0.4")
        axis.set(xlabel="I = shear rate sqrt(m/P)", ylabel=label)
        axis.grid(alpha=0.3)
    axes[0].legend()
    figure.savefig(path, dpi=120)


def main():
    numbers = lambda text: [float(word) for word in text.split(",")]  # noqa: E731
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=os.path.abspath)
    parser.add_argument("--seeds", type=lambda text: [int(word) for word in text.split(",")], default=[1, 2, 3, 4])
    parser.add_argument("--numbers", type=numbers, default=[0.005, 0.016, 0.05, 0.1, 0.14],
                        help="I from the platens' speed and distance")
    parser.add_argument("--friction", type=numbers, default=[0.4, 0.])
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--output", help="folder for the result folders; default: thrown away")
    parser.add_argument("--reuse", action="store_true", help="keep runs that are already in --output")
    parser.add_argument("--set", action="append", default=[], help="section/key=value, handed on to every run")
    parser.add_argument("--figure")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        options.output = options.output or scratch
        try:
            found = measure(options)
        except claims.RunFailed as failure:
            sys.exit(f"plane_shear.py: {failure}")
        show(found, options)
        if options.figure:
            draw(found, options, options.figure)


if __name__ == "__main__":
    main()
