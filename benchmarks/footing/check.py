#!/usr/bin/env python3
# diptych: bearing capacity of a strip footing against Prandtl's closed form
# SPDX-License-Identifier: LGPL-2.1-or-later
"""check.py PROGRAM [--levels 5] [--output DIR] [--figure figure.png]

Runs `PROGRAM continuum` on phi0.prm and phi20.prm and compares N_c = force / (c B) at the end with the closed form.
--levels: list of refinement levels of elements of 0.5, for a convergence table. The scenes have 5 levels, and only
these are judged. Exit code 1: N_c is off by more than 3 %; 2: a run failed. The figure needs h5py, matplotlib and
numpy."""
import argparse
import csv
import math
import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
FRICTION_ANGLES = (0, 20)
WIDTH, COHESION, COARSE_ELEMENT, SCENE_LEVELS = 2, 1, 0.5, 5  # As in the scenes.
ALLOWED = 0.03


def closed_form(friction_angle):
    """Prandtl (1920), weightless: N_c = (Kp exp(pi tan phi) - 1) cot phi, Kp = tan^2(45 + phi/2); pi + 2 at phi = 0."""
    if friction_angle == 0:
        return math.pi + 2
    phi = math.radians(friction_angle)
    return (math.tan(math.pi / 4 + phi / 2)**2 * math.exp(math.pi * math.tan(phi)) - 1) / math.tan(phi)


def run(program, friction_angle, levels, folder):
    """Last row of the history, and CPU seconds."""
    settings = [f"continuum/refinement_levels={levels}", f"continuum/element_size={COARSE_ELEMENT / 2**levels}"]
    words = [word for setting in settings for word in ("--set", setting)]
    before = os.times()
    done = subprocess.run([program, "continuum", os.path.join(HERE, f"phi{friction_angle}.prm"), "--output", folder,
                           "--overwrite", "--quiet", *words], capture_output=True, text=True)
    after = os.times()
    if done.returncode != 0:
        sys.stderr.write(f"check.py: {folder} ended with exit code {done.returncode}: {done.stderr.strip()}\n")
        sys.exit(2)
    with open(os.path.join(folder, "continuum.csv")) as file:
        rows = [{key: float(value) for key, value in row.items() if key != "walk"} for row in csv.DictReader(file)]
    return rows[-1], after.children_user + after.children_system - before.children_user - before.children_system


def bearing_factor(row):
    return -row["upper_fy"] / (COHESION * WIDTH)


def prandtl_outline(friction_angle):
    """Right half of the rigid-plastic mechanism in widths B from the strip's middle: wedge, logarithmic spiral, passive
    block."""
    import numpy
    phi, steep = math.radians(friction_angle), math.radians(45 + friction_angle / 2)
    theta = numpy.linspace(0, math.pi / 2, 60)
    radius = 0.5 / math.cos(steep) * numpy.exp(theta * math.tan(phi))
    x, y = 0.5 + radius * numpy.cos(math.pi + steep + theta), radius * numpy.sin(math.pi + steep + theta)
    exit_x = 0.5 + 2 * (x[-1] - 0.5)
    return numpy.concatenate(([0.5], x, [exit_x])), numpy.concatenate(([0], y, [0]))


def plastic_increment(folder):
    """Corners of the cells relative to the strip's middle [B], and the hardening variable's increment over the last
    stage."""
    import h5py
    with h5py.File(os.path.join(folder, "continuum.h5"), "r") as file:
        before, after = (file[name] for name in sorted(file)[-2:])
        increment = after["cells/equivalent_plastic_strain"][()] - before["cells/equivalent_plastic_strain"][()]
        corners = after["nodes/position"][()][:, :2][after["cells/nodes"][()][:, :4]]
    middle, height = 0.5 * (corners[..., 0].min() + corners[..., 0].max()), corners[..., 1].max()
    return (corners - (middle, height)) / WIDTH, increment, height


def draw(folders, path):
    """Curves of the strip's force, and the mechanism: plastic shear increment of the last stage on the mesh."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as pyplot
    import numpy
    from matplotlib.collections import PolyCollection
    figure = pyplot.figure(figsize=(10, 4.9), constrained_layout=True)
    grid = figure.add_gridspec(2, 2, width_ratios=(1, 2.2), height_ratios=(1.16, 1))
    curves, mechanisms = figure.add_subplot(grid[:, 0]), []
    for axis, colour, (angle, folder) in zip(range(2), ("#0072b2", "#d55e00"), folders.items()):
        corners, increment, height = plastic_increment(folder)
        with open(os.path.join(folder, "continuum.csv")) as file:
            rows = list(csv.DictReader(file))
        settlement = [1000 * float(row["axial_strain"]) * height / WIDTH for row in rows]
        curves.plot(settlement, [-float(row["upper_fy"]) / (COHESION * WIDTH) for row in rows], color=colour,
                    label=f"$\\varphi = \\psi$ = {angle}°")
        curves.axhline(closed_form(angle), color=colour, linestyle="--", linewidth=1)
        mechanism = figure.add_subplot(grid[axis, 1])
        share = numpy.log10(numpy.maximum(increment / increment.max(), 1e-4))
        cells = PolyCollection(corners, array=share, cmap="cividis", edgecolors="white", linewidths=0.12)
        cells.set_clim(-4, 0)
        mechanism.add_collection(cells)
        x, y = prandtl_outline(angle)
        for side in (-1, 1):
            mechanism.plot(side * x, y, color="#ff8c1a", linestyle="--", linewidth=1.4)
        mechanism.plot((-0.5, 0.5), (0.04 * half(angle) / 2, ) * 2, color="black", linewidth=4, solid_capstyle="butt")
        mechanism.set(xlim=(-half(angle), half(angle)), ylim=(-0.4 * half(angle), 0.05 * half(angle)), aspect="equal",
                      ylabel="y / B", title=f"$\\varphi$ = {angle}°, {len(corners)} elements")
        mechanisms.append(mechanism)
    bar = figure.colorbar(cells, ax=mechanisms, ticks=range(-4, 1), shrink=0.9)
    bar.ax.set_yticklabels(["$\\leq 10^{-4}$", "$10^{-3}$", "$10^{-2}$", "$10^{-1}$", "1"])
    bar.set_label("plastic shear increment / its largest value")
    mechanisms[-1].set_xlabel("x / B")
    curves.set(xlabel="settlement / B  [$10^{-3}$]", ylabel="force / (c B)", xlim=(0, None), ylim=(0, None))
    curves.plot([], [], color="black", linestyle="--", linewidth=1, label="closed form")
    curves.plot([], [], color="#ff8c1a", linestyle="--", linewidth=1.4, label="Prandtl's mechanism")
    curves.grid(alpha=0.3)
    curves.legend(loc="center right")
    figure.savefig(path, dpi=120)


def half(friction_angle):
    """Half the width of the figure [B]."""
    return 4.2 if friction_angle else 2.4


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--levels", default=str(SCENE_LEVELS))
    parser.add_argument("--output", help="folder for the result folders; default: thrown away")
    parser.add_argument("--figure")
    options = parser.parse_args()
    n_outside, folders = 0, {}
    print("phi  levels  element     N_c  closed form  error  elements  unknowns  cut-backs  CPU s")
    with tempfile.TemporaryDirectory() as scratch:
        for angle in FRICTION_ANGLES:
            for levels in (int(word) for word in options.levels.split(",")):
                folders[angle] = os.path.join(options.output or scratch, f"phi{angle}_levels{levels}")
                row, seconds = run(options.program, angle, levels, folders[angle])
                error = bearing_factor(row) / closed_form(angle) - 1
                outside = levels >= SCENE_LEVELS and abs(error) > ALLOWED
                n_outside += outside
                print(f"{angle:3}  {levels:6}  {COARSE_ELEMENT / 2**levels:7.4f}  {bearing_factor(row):6.3f}"
                      f"  {closed_form(angle):11.3f}  {100 * error:+4.1f} %  {row['n_cells']:8.0f}  "
                      f"{row['n_unknowns']:8.0f}"
                      f"  {row['cut_backs']:9.0f}  {seconds:5.1f}" + ("  OUTSIDE" if outside else ""), flush=True)
        if options.figure:
            draw(folders, options.figure)
    return 1 if n_outside else 0


if __name__ == "__main__":
    sys.exit(main())
