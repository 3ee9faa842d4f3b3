#!/usr/bin/env python3
# diptych: cost against the number of grains at a fixed accuracy, contact dynamics and springs
# SPDX-License-Identifier: LGPL-2.1-or-later
"""size.py [PROGRAM --output DIR] [--figure FILE]

Loads dense samples of 1000 to 64000 discs at three speeds. Each method takes its cheapest setting whose strength is
right to 2 % at 1000 discs and I = 1.13e-3 (envelope.py); springs also one that is right to 1 %. All load the same
prepared sample in turn. Shows the times stored in size.csv. With PROGRAM it first makes the runs (those of diptych in
DIR are kept) and stores them again. Needs h5py, numpy, pandas and lmp, the figure matplotlib."""
import argparse
import os
import subprocess

import numpy
import pandas

import envelope
import lammps
import order
import rigid_limit
import samples

HERE = os.path.dirname(os.path.abspath(__file__))
STORED = os.path.join(HERE, "size.csv")
GRAINS = {1.13e-3: (1000, 2000, 4000, 8000, 16000, 32000, 64000), 1.13e-4: (1000, 2000, 4000, 8000, 16000),
          1.13e-5: (1000, 4000, 16000)}
STRAIN = {1.13e-3: 0.01, 1.13e-4: 0.002, 1.13e-5: 0.002}
LARGEST = 8000  # larger samples are not in equilibrium at the highest speed, and have too little strain at the others
POINTS = {"accuracy=0.02": "NSCD", "implicit=1e4/0.05": "implicit springs", "penalty=3.3e3/0.7": "penalty",
          "penalty=1e4/0.5": "penalty", "lammps=3.3e3/0.7": "LAMMPS", "lammps=1e4/0.5": "LAMMPS"}


def run(program, folder, *settings):
    """Result of the dense scene with these settings."""
    if not rigid_limit.claims.is_finished(folder, "discrete"):
        words = [word for setting in settings for word in ("--set", setting)]
        subprocess.run([program, "discrete", rigid_limit.SCENE, "--output", folder, "--overwrite", "--quiet", *words],
                       check=True, env=rigid_limit.claims.ENVIRONMENT)
    return rigid_limit.claims.Result(folder)


def loading(program, folder, sample, point, inertial):
    """CPU seconds per per cent of strain, without the preload of springs."""
    strain = STRAIN[inertial]
    if point.startswith("lammps"):
        stiffness, fraction = order.spring_knobs(point)
        seconds = lammps.run(sample, folder, stiffness, inertial, strain, fraction=fraction)[1]
    else:
        seconds = run(program, folder, f"sample/file={sample}", f"loading/inertial_number={inertial:g}",
                      f"loading/axial_strain={strain}", f"loading/stage_strain={strain}",
                      f"comparison/window_edges=0,{strain}", *order.settings(order.CASES["dense"], point)
                      ).seconds("discrete")
    return seconds / (100 * strain)


def measured(options):
    """Table: grains, point (a setting, or the preparation), inertial number, CPU seconds of `loading`."""
    rows = []
    for n in GRAINS[1.13e-3]:
        prepared = run(options.program, f"{options.output}/{n}/prepared", f"sample/grains={n}",
                       "loading/axial_strain=1e-4", "loading/stage_strain=1e-4", "comparison/window_edges=0,1e-4")
        sample = f"{options.output}/{n}/sample.h5"
        samples.keep(prepared, sample)
        rows.append({"grains": n, "point": "preparation", "cpu_s": prepared.seconds("preparation")})
        for inertial in (i for i in GRAINS if n in GRAINS[i]):
            for point in POINTS:
                folder = f"{options.output}/{n}/{inertial:g}/{point}"
                rows.append({"grains": n, "point": point, "inertial_number": inertial,
                             "cpu_s": loading(options.program, folder, sample, point, inertial)})
                print(rows[-1], flush=True)
    return pandas.DataFrame(rows)


def power(table):
    """Text of the exponent of the cost over the number of grains, from 4000 on; empty for fewer than three sizes."""
    large = table[table.grains >= 4000]
    return f": n^{numpy.polyfit(numpy.log(large.grains), numpy.log(large.cpu_s), 1)[0]:.1f}" if len(large) > 2 else ""


def draw(table, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, grid = pyplot.subplots(1, len(GRAINS), figsize=(12, 4.2), layout="constrained", sharex=True)
    for axes, inertial in zip(grid, GRAINS):
        for point, method in POINTS.items():
            part = table[(table.point == point) & (table.inertial_number == inertial)]
            colour, mark = envelope.LOOKS[method]
            axes.loglog(part.grains, part.cpu_s, mark + ("--" if "=1e4/0.5" in point else "-"), color=colour,
                        label=f"{method} {point.partition('=')[2]}{power(part)}")
            large = part[part.grains > LARGEST]
            axes.loglog(large.grains, large.cpu_s, mark, color="white", markeredgecolor=colour)
        if inertial == 1.13e-3:
            part = table[table.point == "preparation"]
            axes.loglog(part.grains, part.cpu_s, "x:", color="#777777", label="preparation")
        axes.set(xlabel="number of grains", title=f"I = {inertial:.2e}")
        axes.grid(alpha=0.3)
        axes.legend(fontsize=7)
    grid[0].set_ylabel("CPU s per per cent of strain; preparation: CPU s")
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
    print(table[table.point == "preparation"][["grains", "cpu_s"]].to_string(index=False))
    loadings = table.dropna().assign(I=lambda rows: rows.inertial_number.map("{:.2e}".format))
    print(loadings.pivot(index=["I", "grains"], columns="point", values="cpu_s").to_string())
    if options.figure:
        draw(table, options.figure)


if __name__ == "__main__":
    main()
