#!/usr/bin/env python3
# diptych: cost against the number of grains at a fixed accuracy, contact dynamics and springs
# SPDX-License-Identifier: LGPL-2.1-or-later
"""size.py [PROGRAM --output DIR] [--figure FILE]

Loads dense samples of 1000 to 64000 discs at two speeds, with NSCD at discrete/accuracy = 0.02 and with springs of kn/P
= 1e4, which are right to 1 %. Both methods load the same prepared sample. Draws the times stored in size.csv. With
PROGRAM it first makes the runs (those in DIR are kept) and stores them again. Needs h5py, numpy and pandas, the figure
matplotlib."""
import argparse
import os
import subprocess

import numpy
import pandas

import rigid_limit
import samples

HERE = os.path.dirname(os.path.abspath(__file__))
STORED = os.path.join(HERE, "size.csv")
GRAINS = {1.13e-3: (1000, 2000, 4000, 8000, 16000, 32000, 64000), 1.13e-4: (1000, 2000, 4000, 8000, 16000)}
STRAIN = {1.13e-3: 0.01, 1.13e-4: 0.002}
# larger samples are not in equilibrium at this speed, or had too little strain
LARGEST = {1.13e-3: 8000, 1.13e-4: 8000}
METHODS = {"NSCD": (), "springs": ("discrete/method=penalty", "discrete/penalty_stiffness=1e4",
                                   "discrete/penalty_step_fraction=0.5")}
SPEEDS = {1.13e-3: "#0072B2", 1.13e-4: "#D55E00"}


def run(program, folder, *settings):
    """Result of the dense scene with these settings."""
    if not rigid_limit.claims.is_finished(folder, "discrete"):
        words = [word for setting in settings for word in ("--set", setting)]
        subprocess.run([program, "discrete", rigid_limit.SCENE, "--output", folder, "--overwrite", "--quiet", *words],
                       check=True, env=rigid_limit.claims.ENVIRONMENT)
    return rigid_limit.claims.Result(folder)


def measured(options):
    """Table: grains, inertial number, method, CPU seconds per per cent of strain, T/S of the second half; and the
    preparation."""
    rows = []
    for n in GRAINS[1.13e-3]:
        prepared = run(options.program, f"{options.output}/{n}/prepared", f"sample/grains={n}",
                       "loading/axial_strain=1e-4", "loading/stage_strain=1e-4", "comparison/window_edges=0,1e-4")
        sample = f"{options.output}/{n}/sample.h5"
        samples.keep(prepared, sample)
        rows.append({"grains": n, "method": "preparation", "cpu_s": prepared.seconds("preparation")})
        for inertial in (i for i in GRAINS if n in GRAINS[i]):
            for method, settings in METHODS.items():
                strain = STRAIN[inertial]
                result = run(options.program, f"{options.output}/{n}/{method}_{inertial:g}", f"sample/file={sample}",
                             f"loading/inertial_number={inertial:g}", f"loading/axial_strain={strain}",
                             f"loading/stage_strain={strain}", f"comparison/window_edges=0,{strain}", *settings)
                history = result.grains
                late = history["axial_strain"] > strain / 2
                t, s = (history["syy"] - history["sxx"])[late].mean(), (history["syy"] + history["sxx"])[late].mean()
                rows.append({"grains": n, "method": method, "inertial_number": inertial,
                             "cpu_s": result.seconds("discrete") / (100 * strain), "strength": t / s})
                print(rows[-1], flush=True)
    return pandas.DataFrame(rows)


def power(table):
    """Exponent of the cost over the number of grains, from 4000 on."""
    large = table[table.grains >= 4000]
    return numpy.polyfit(numpy.log(large.grains), numpy.log(large.cpu_s), 1)[0]


def draw(table, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axis = pyplot.subplots(figsize=(6.4, 4.4), constrained_layout=True)
    for inertial, colour in SPEEDS.items():
        for method, mark in (("NSCD", "o-"), ("springs", "s--")):
            part = table[(table.method == method) & (table.inertial_number == inertial)]
            axis.loglog(part.grains, part.cpu_s, mark, color=colour,
                        label=f"{method}, I = {inertial:g}: n^{power(part):.1f} from 4000 on")
            fast = part[(part.grains > LARGEST[inertial])]
            axis.loglog(fast.grains, fast.cpu_s, mark[0], color="white", markeredgecolor=colour)
    part = table[table.method == "preparation"]
    axis.loglog(part.grains, part.cpu_s, "^:", color="#777777", label=f"preparation (whole): n^{power(part):.2f}")
    axis.set(xlabel="number of grains", ylabel="CPU seconds per per cent of strain",
             title="NSCD at accuracy 0.02, springs of kn/P = 1e4; one sample a point. Hollow: not quasi-static")
    axis.title.set_fontsize(9)
    axis.grid(alpha=0.3, which="both")
    axis.legend(fontsize=8)
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=os.path.abspath, nargs="?")
    parser.add_argument("--output", type=os.path.abspath)
    parser.add_argument("--figure")
    options = parser.parse_args()
    if options.program:
        measured(options).to_csv(STORED, index=False, float_format="%.5g")
    table = pandas.read_csv(STORED)
    print(table.to_string(index=False))
    if options.figure:
        draw(table, options.figure)


if __name__ == "__main__":
    main()
