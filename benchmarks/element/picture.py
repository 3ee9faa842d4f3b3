#!/usr/bin/env python3
# diptych: picture of a cell of grains
# SPDX-License-Identifier: LGPL-2.1-or-later
"""picture.py FOLDER/discrete.h5 FIGURE: the first and the last stage of a cell: grains, coloured by their rotation
since the first stage, and contact forces as lines between the centres, whose width is proportional to the force."""
import sys

import h5py
import matplotlib
import numpy

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot  # noqa: E402
from matplotlib.collections import EllipseCollection, LineCollection  # noqa: E402
from matplotlib.patches import Polygon  # noqa: E402

IMAGES = [(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1)]
TURN = 45  # degrees at the ends of the colour scale


def draw(axis, stage, rotation):
    """The cell with its lower left corner at the origin."""
    vectors = numpy.array([[stage.attrs[f"cell_{a}_{c}"] for a in ("a1", "a2")] for c in ("x", "y")])
    share = numpy.linalg.solve(vectors, stage["grains/position"][:, :2].T)
    position, radius = (vectors @ (share % 1)).T, stage["grains/radius"][:]
    corners = numpy.array([[0, 0], vectors[:, 0], vectors.sum(axis=1), vectors[:, 1]])
    clip = axis.add_patch(Polygon(corners, closed=True, facecolor="none", edgecolor="0.3", linewidth=1))
    body, force = stage["window/body"][:], numpy.linalg.norm(stage["window/force"][:], axis=1)
    branch = -(radius[body].sum(axis=1))[:, None] * stage["window/normal"][:, :2]
    start = position[body[:, 0]]
    for i, j in IMAGES:
        shift = vectors @ (i, j)
        grains = EllipseCollection(2 * radius, 2 * radius, 0 * radius, units="xy", offsets=position + shift,
                                   transOffset=axis.transData, array=rotation, cmap="RdBu", edgecolors="0.6",
                                   linewidths=0.3)
        grains.set_clim(-TURN, TURN)
        lines = LineCollection(numpy.stack([start + shift, start + shift + branch], axis=1), colors="k",
                               linewidths=1.2 * force / force.mean(), capstyle="round")
        for artist in (grains, lines):
            axis.add_collection(artist)
            artist.set_clip_path(clip)
    low, high = corners.min(axis=0), corners.max(axis=0)
    axis.set(xlim=(low[0] - 1, high[0] + 1), ylim=(low[1] - 1, high[1] + 1), aspect="equal")
    axis.axis("off")
    return grains


def main(path, figure_file):
    with h5py.File(path) as file:
        names = sorted(name for name in file if name.startswith("stage_"))
        first, last = file[names[1]], file[names[-1]]
        figure, axes = pyplot.subplots(1, 2, figsize=(13, 6.6), constrained_layout=True)
        before = file[names[0]]["grains/rotation"][:]
        for axis, stage in zip(axes, (first, last)):
            colours = draw(axis, stage, numpy.degrees(stage["grains/rotation"][:] - before))
            axis.set_title(f"2 exy = {100 * stage.attrs['progress']:.3g} %")
        figure.colorbar(colours, ax=axes, label="rotation since the start [degrees], counter-clockwise positive",
                        shrink=0.6)
        figure.savefig(figure_file, dpi=72)


if __name__ == "__main__":
    main(*sys.argv[1:])
