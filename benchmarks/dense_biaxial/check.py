#!/usr/bin/env python3
# diptych: the dense biaxial sample over several seeds, against a stiff explicit code
# SPDX-License-Identifier: LGPL-2.1-or-later
"""check.py SCENE PROGRAM [--seeds 1,2,3] [--relax SCENE] [--output DIR] [--set section/key=value]...

Runs `PROGRAM discrete SCENE` for every seed and compares the means over the seeds with the reference bands. --relax:
runs that scene first; SCENE loads its last snapshot. Exit code 1: a number is outside its band; 2: a run failed."""
import argparse
import csv
import os
import statistics
import subprocess
import sys
import tempfile

PEAK_WINDOW = 0.005  # Axial strain over which the running mean is taken.

# Name, reference, half width of its band. Stress ratios: scatter over three seeds of the reference. The reference gives
# no scatter for porosities and dilation; 0.006 is our choice, twice the difference between seeds.
BANDS = [("peak t/s", 0.40, 0.02), ("mean t/s, 1.5-4 %", 0.37, 0.02), ("mean t/s, 7-10 %", 0.29, 0.03),
         ("porosity, start", 0.169, 0.006), ("porosity, 10 %", 0.194, 0.006), ("dilation, 10 %", 0.03, 0.006)]
BESIDE = ["strain at the peak", "largest penetration [d]", "median K/(M V^2/4)", "CPU seconds"]


def mean_between(strain, value, low, high):
    return statistics.fmean(v for e, v in zip(strain, value) if low < e <= high)


def peak_of_running_mean(strain, ratio):
    """(largest mean of `ratio` over the last PEAK_WINDOW of strain, strain at which it occurs)."""
    best, begin = (0, 0), 0
    for end, now in enumerate(strain):
        while strain[begin] <= now - PEAK_WINDOW:
            begin += 1
        if now >= PEAK_WINDOW:
            best = max(best, (statistics.fmean(ratio[begin:end + 1]), now))
    return best


def measure(folder):
    with open(os.path.join(folder, "discrete.csv")) as file:
        rows = list(csv.DictReader(file))
    strain, ratio, solid, dilation, penetration, kinetic = (
        [float(row[name]) for row in rows]
        for name in ("axial_strain", "stress_ratio", "solid_fraction", "volumetric_strain", "max_penetration",
                     "kinetic_energy_ratio"))
    peak, at = peak_of_running_mean(strain, ratio)
    return {"peak t/s": peak, "mean t/s, 1.5-4 %": mean_between(strain, ratio, 0.015, 0.04),
            "mean t/s, 7-10 %": mean_between(strain, ratio, 0.07, 0.1), "porosity, start": 1 - solid[0],
            "porosity, 10 %": 1 - solid[-1], "dilation, 10 %": -dilation[-1], "strain at the peak": at,
            "largest penetration [d]": max(penetration), "median K/(M V^2/4)": statistics.median(kinetic)}


def discrete(options, scene, folder, settings):
    words = [word for setting in settings for word in ("--set", setting)]
    done = subprocess.run([options.program, "discrete", scene, "--output", folder, "--overwrite", "--quiet", *words],
                          capture_output=True, text=True)
    if done.returncode != 0:
        sys.stderr.write(f"check.py: {folder} ended with exit code {done.returncode}: {done.stderr.strip()}\n")
        sys.exit(2)


def run(options, seed, folder):
    settings = [f"sample/seed={seed}"]
    before = os.times()
    if options.relax:
        discrete(options, options.relax, folder + "_relaxed", settings)
        settings.append(f"sample/file={folder}_relaxed/discrete.h5")
    discrete(options, options.scene, folder, settings + options.set)
    after = os.times()
    figures = measure(folder)
    figures["CPU seconds"] = after.children_user + after.children_system - before.children_user - before.children_system
    return figures


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene")
    parser.add_argument("program")
    parser.add_argument("--seeds", default="1,2,3")
    parser.add_argument("--relax", help="scene that makes the sample")
    parser.add_argument("--output", help="folder for the result folders; default: thrown away")
    parser.add_argument("--set", action="append", default=[], help="section/key=value, handed on")
    options = parser.parse_args()
    seeds = [int(s) for s in options.seeds.split(",")]
    with tempfile.TemporaryDirectory() as scratch:
        runs = [run(options, seed, os.path.join(options.output or scratch, f"seed_{seed}")) for seed in seeds]

    print(f"{'seed':26}" + "".join(f"{s:9}" for s in seeds) + "     mean   reference")
    n_outside = 0
    for name, reference, half in BANDS:
        mean = statistics.fmean(r[name] for r in runs)
        outside = abs(mean - reference) > half
        n_outside += outside
        print(f"{name:26}" + "".join(f"{r[name]:9.4f}" for r in runs)
              + f"{mean:9.4f}   {reference:g} +- {half:g}" + ("   OUTSIDE" if outside else ""))
    for name in BESIDE:
        print(f"{name:26}" + "".join(f"{r[name]:9.4f}" for r in runs))
    return 1 if n_outside else 0


if __name__ == "__main__":
    sys.exit(main())
