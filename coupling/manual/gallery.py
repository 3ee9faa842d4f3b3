#!/usr/bin/env python3
# diptych: runs the tests of the manual's gallery and draws their pictures
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: gallery.py PROGRAM FOLDER [NAME ...]

Runs the templates (default: all of TESTS) with their results in FOLDER/NAME, prints their summaries and draws
gallery/NAME.png. A finished result is not computed again. Exit code 1: a run failed."""
import os
import subprocess
import sys

import h5py
import matplotlib
import numpy
from PIL import Image

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot  # noqa: E402
from matplotlib.collections import EllipseCollection, PolyCollection  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))
SOURCE = os.path.dirname(os.path.dirname(HERE))
sys.path[:0] = [os.path.join(SOURCE, "benchmarks"), os.path.join(SOURCE, "benchmarks", "footing")]
import check as footing  # noqa: E402
import maps  # noqa: E402


def draw_both(folder, path):
    """Shear strain of both panels over the last window."""
    with h5py.File(os.path.join(folder, "comparison.h5")) as file:
        last = sum(name.startswith("window_") for name in file) - 1
    maps.draw_window(folder, last, path)


def draw_flow(folder, path):
    """Grains coloured by their horizontal velocity, and its profile over the height, at the end of the run."""
    with h5py.File(os.path.join(folder, "discrete.h5")) as file:
        stage = file[max(name for name in file if name.startswith("stage_"))]
        position, radius = stage["grains/position"][:, :2], stage["grains/radius"][()]
        velocity, low, high = stage["grains/velocity"][:, 0], stage.attrs["lower_y"], stage.attrs["upper_y"]
        velocity = velocity / velocity[stage["grains/fixed"][()] == 3].mean()  # 3: part of the upper platen
        position[:, 0] %= stage.attrs["cell_width"]
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(8.4, 3.4), constrained_layout=True, sharey=True,
                                            width_ratios=(1.4, 1))
    discs = left.add_collection(EllipseCollection(2 * radius, 2 * radius, numpy.zeros_like(radius), units="xy",
                                                  offsets=position,
                                                  transOffset=left.transData, array=velocity, cmap="viridis",
                                                  clim=(0, 1)))
    left.set(xlim=(position[:, 0].min() - 1, position[:, 0].max() + 1), ylim=(low - 0.5, high + 0.5), aspect="equal",
             xlabel="x / d", ylabel="y / d", title="grains", facecolor="0.85")
    figure.colorbar(discs, ax=left, shrink=0.8, label="horizontal velocity / platen's")
    right.plot(velocity, position[:, 1], ".", ms=2, color="#0072B2")
    right.set(xlabel="horizontal velocity / platen's", title="profile", xlim=(-0.2, 1.2))
    right.grid(alpha=0.3)
    figure.savefig(path, dpi=100)


def draw_footing(folder, path):
    """Plastic shear of the last stage on the mesh, with Prandtl's mechanism."""
    corners, increment, _ = footing.plastic_increment(folder)
    figure, axis = pyplot.subplots(figsize=(8.4, 2.7), constrained_layout=True)
    share = numpy.log10(numpy.maximum(increment / increment.max(), 1e-4))
    cells = axis.add_collection(PolyCollection(corners, array=share, cmap="cividis", edgecolors="white",
                                               linewidths=0.12, clim=(-4, 0)))
    x, y = footing.prandtl_outline(20)
    for side in (-1, 1):
        axis.plot(side * x, y, color="#ff8c1a", linestyle="--", linewidth=1.4)
    axis.plot((-0.5, 0.5), (0.08, 0.08), color="black", linewidth=4, solid_capstyle="butt")
    axis.set(xlim=(-4.2, 4.2), ylim=(-1.7, 0.25), aspect="equal", xlabel="x / width of the strip", ylabel="y / width",
             title="continuum, dashed: Prandtl's mechanism")
    bar = figure.colorbar(cells, ax=axis, ticks=range(-4, 1), shrink=0.9, label="plastic shear / its largest value")
    bar.ax.set_yticklabels(["$\\leq 10^{-4}$", "$10^{-3}$", "$10^{-2}$", "$10^{-1}$", "1"])
    figure.savefig(path, dpi=100)


# template -> (command, picture)
TESTS = {"biaxial": ("run", draw_both), "oblique": ("run", draw_both), "rigid_walls": ("run", draw_both),
         "periodic": ("run", draw_both), "loose": ("run", draw_both), "shear": ("run", draw_both),
         "plane_shear": ("discrete", draw_flow), "footing": ("continuum", draw_footing)}


def main(program, folder, *names):
    for name in names or TESTS:
        command, draw = TESTS[name]
        result = os.path.join(folder, name)
        scene = os.path.join(SOURCE, "coupling", "templates", name + ".prm")
        print(f"{name}:", flush=True)
        if subprocess.run([program, command, scene, "--output", result], check=False).returncode:
            return 1
        path = os.path.join(HERE, "gallery", name + ".png")
        draw(result, path)
        # a third of the size
        Image.open(path).convert("RGB").quantize(256, Image.Quantize.MAXCOVERAGE).save(path, optimize=True)
    return 0


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
