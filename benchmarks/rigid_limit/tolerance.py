#!/usr/bin/env python3
# diptych: loss by the solver's tolerance, and sweeps, against the number of grains
# SPDX-License-Identifier: LGPL-2.1-or-later
"""tolerance.py [PROGRAM --output DIR [--cases N]]

Loads the same samples with three tolerances: the rule's for 1000 grains, and smaller ones by a factor. Prints T/S,
dilation and sweeps against those of the smallest tolerance, with standard errors over the samples. Reads the stored
runs, tolerance.csv. With PROGRAM it first makes the runs (those in DIR are kept) and stores them again; --cases: only
the first N, not stored. Needs h5py, numpy and pandas."""
import argparse
import os
import subprocess

import numpy
import pandas

import rigid_limit
import samples

STORED = os.path.join(rigid_limit.HERE, "tolerance.csv")
STEP = 1 / 9  # [d sqrt(rho/P)], that of discrete/accuracy = 0.02
# Scene, grains, inertial number, strain, seeds, factors of the tolerance.
CASES = (("dense_biaxial", 1000, 1.13e-3, 0.015, range(1, 13), (1, 2.83, 8)),
         ("dense_biaxial", 4000, 1.13e-3, 0.015, range(1, 7), (1, 2.83, 8)),
         ("dense_biaxial", 8000, 1.13e-3, 0.015, range(1, 5), (1, 2.83, 4.76, 8)),
         ("dense_biaxial", 8000, 2.83e-4, 0.01, range(1, 5), (1, 2.83, 8)),
         ("dense_biaxial", 16000, 5.65e-4, 0.012, range(1, 4), (1, 2.83, 4.76, 8)),
         ("moreau_1997", 4000, 2e-4, 0.01, range(1, 5), (1, 2.83, 8)),
         ("moreau_1997", 16000, 2e-4, 0.01, range(1, 2), (1, 2.83, 8)))
KEYS = ["scene", "grains", "inertial_number"]


def tolerance(inertial, factor):
    """That of discrete/accuracy = 0.02 for 1000 grains, divided by the factor."""
    return 1.25 * 0.02 * inertial / (STEP * (0.2 + 0.8 * STEP)) / factor


def run(program, scene, folder, strain, *settings):
    if not rigid_limit.claims.is_finished(folder, "discrete"):
        words = [word for one in ("output/report=false", f"loading/axial_strain={strain}",
                                  f"loading/stage_strain={strain}",
                                  f"comparison/window_edges=0,{strain}", *settings) for word in ("--set", one)]
        file = os.path.join(rigid_limit.HERE, "..", scene, "scene.prm")
        subprocess.run([program, "discrete", file, "--output", folder, "--overwrite", "--quiet", *words], check=True,
                       env=rigid_limit.claims.ENVIRONMENT)
    return rigid_limit.claims.Result(folder)


def row(result, strain):
    """Numbers of a run: T/S over the last two thirds, dilation at the end, mean sweeps of a step, CPU s of the
    loading."""
    h = result.grains
    late = h["axial_strain"] > strain / 3
    t = numpy.hypot(0.5 * (h["syy"] - h["sxx"]), 0.5 * (h["sxy"] + h["syx"]))[late].mean()
    return {"strength": t / (0.5 * (h["syy"] + h["sxx"]))[late].mean(), "dilation": -h["volumetric_strain"][-1],
            "sweeps": h["sweeps"].mean(), "cpu_s": result.seconds("discrete")}


def measured(program, output, cases):
    rows = []
    for scene, grains, inertial, strain, seeds, factors in cases:
        for seed in seeds:
            folder = os.path.join(output, f"{scene}_{grains}")
            sample = os.path.join(folder, f"sample_{seed}.h5")
            if not os.path.exists(sample):
                samples.keep(run(program, scene, os.path.join(folder, f"prepared_{seed}"), 1e-6,
                                 f"sample/grains={grains}",
                                 f"sample/seed={seed}", "discrete/step=0.005", "discrete/tolerance=0.1"), sample)
            for factor in factors:
                end = os.path.join(folder, f"{inertial:g}_{seed}_{factor}")
                result = run(program, scene, end, strain, f"sample/file={sample}",
                             f"loading/inertial_number={inertial:g}",
                             f"discrete/step={STEP}", f"discrete/tolerance={tolerance(inertial, factor):.5g}")
                rows.append({"scene": scene, "grains": grains, "inertial_number": inertial, "seed": seed,
                             "factor": factor, **row(result, strain)})
                print(rows[-1], flush=True)
    return pandas.DataFrame(rows)


def show(table):
    for case, runs in table.groupby(KEYS, sort=False):
        tightest = runs[runs.factor == runs.factor.max()].set_index("seed")
        print(*case, f"{len(tightest)} samples")
        for factor, part in runs.groupby("factor"):
            part = part.set_index("seed")
            texts = []
            for name in ("strength", "dilation"):
                change = 100 * (part[name] - tightest[name]) / tightest[name].mean()
                texts.append(f"{name} {part[name].mean():.4f} ({change.mean():+.2f} +- {change.sem():.2f} %)")
            print(f"  factor {factor:<5} {'  '.join(texts)}  sweeps {part.sweeps.mean():.0f}  CPU s "
                  f"{part.cpu_s.mean():.3g}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=os.path.abspath, nargs="?")
    parser.add_argument("--output", type=os.path.abspath)
    parser.add_argument("--cases", type=int, default=len(CASES))
    options = parser.parse_args()
    table = measured(options.program, options.output,
                     CASES[:options.cases]) if options.program else pandas.read_csv(STORED)
    if options.program and options.cases == len(CASES):
        table.to_csv(STORED, index=False, float_format="%.6g")
    show(table)


if __name__ == "__main__":
    main()
