#!/usr/bin/env python3
# diptych: figure of the bounds, the finite elements between them, and two mechanisms
# SPDX-License-Identifier: LGPL-2.1-or-later
"""draw.py results.json figure.png: draws the results that limit_analysis.py --output keeps. Two upper bounds are
computed again."""
import json
import sys

import matplotlib
import matplotlib.patches
import numpy

from bodies import Footing, Rectangle, grid_body, ray_body
from bounds import Soil, upper_bound
from finite_elements import limit

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot  # noqa: E402
from matplotlib.collections import PolyCollection  # noqa: E402

COLOURS = ("#0072b2", "#d55e00", "#009e73")


def mechanism(axis, shape, soil, level, title):
    """Left: mesh of the lower bound. Right: mesh of the upper bound, moved with its velocity, coloured by the rate of
    dissipation."""
    body = ray_body(shape, level)
    left = body.points[body.triangles] * (-1, 1)
    axis.add_collection(PolyCollection(left, facecolors="white", edgecolors="0.45", linewidths=0.3))
    body = grid_body(shape, level)
    bound = upper_bound(body, soil)
    moved = body.points + 0.12 * shape.platen_width * bound.velocity[:len(body.points)]
    rate = (bound.strain_rate[..., 0] + bound.strain_rate[..., 1]).mean(axis=1) * soil.apex
    shown = numpy.log10(numpy.maximum(rate / numpy.percentile(rate, 99.5), 1e-3))
    cells = PolyCollection(moved[body.triangles], array=shown, cmap="cividis", edgecolors="white", linewidths=0.12)
    cells.set_clim(-3, 0)
    axis.add_collection(cells)
    (right, top), step = shape.corner, 0.12 * shape.platen_width
    axis.plot((-right, 0, numpy.nan, 0, right), (top, top, numpy.nan, top - step, top - step), color="black",
              linewidth=3, solid_capstyle="butt")
    axis.set(title=title, aspect="equal", xlabel="x")
    return cells


def prandtl_outline(friction_angle):
    """Right half of Prandtl's mechanism (k, 2) for a strip of half width 1: wedge, logarithmic spiral, passive
    block."""
    phi, steep = numpy.radians(friction_angle), numpy.radians(45 + friction_angle / 2)
    turn = numpy.linspace(0, numpy.pi / 2, 60)
    radius = numpy.exp(turn * numpy.tan(phi)) / numpy.cos(steep)
    spiral = numpy.column_stack((1 + radius * numpy.cos(numpy.pi + steep + turn),
                                 radius * numpy.sin(numpy.pi + steep + turn)))
    return numpy.concatenate(([(1, 0)], spiral, [(2 * spiral[-1, 0] - 1, 0)]))


def convergence(axis, results, title, size):
    """Lower and upper bounds and finite elements of some cases over the mean element size, relative to the middle of
    the best bounds, up to an element size."""
    for colour, (name, rows) in zip(COLOURS, results.items()):
        middle = 0.5 * (rows["lower"][-1]["value"] + rows["upper"][-1]["value"])
        low, high = (100 * (rows[kind][-1]["value"] / middle - 1) for kind in ("lower", "upper"))
        axis.axhspan(low, high, color=colour, alpha=0.2, linewidth=0)
        for kind, style in (("lower", "^--"), ("upper", "v--"), ("elements", "o-")):
            errors = [100 * (row["value"] / middle - 1) for row in rows[kind]]
            axis.plot([row["size"] for row in rows[kind]], errors, style, color=colour, markersize=5, linewidth=1)
        if rows["closed_form"]:
            axis.axhline(100 * (rows["closed_form"] / middle - 1), color=colour, linestyle=":", linewidth=1.5)
        tends_to, doubt = limit([row["value"] for row in rows["elements"]])
        axis.errorbar(0, 100 * (tends_to / middle - 1), 100 * doubt / middle, color=colour, marker="o",
                      markerfacecolor="white", capsize=3, clip_on=False)
        axis.plot([], [], color=colour, linewidth=4, label=name.split(" ", 1)[1])
    axis.set(title=title, xlabel="mean element size / platen width", xlim=(0, size), ylim=(-6, 10))
    axis.grid(alpha=0.3)
    axis.legend(loc="lower right")


def draw(results, path):
    """Figure from {case: {kind: rows, "closed_form": number or None}}."""
    figure = pyplot.figure(figsize=(12.5, 8), constrained_layout=True)
    grid = figure.add_gridspec(3, 3, height_ratios=(1, 1.35, 0.2))
    left, right = figure.add_subplot(grid[0, 0]), figure.add_subplot(grid[0, 1:])
    mechanism(left, Rectangle(1.0), Soil(30, 0.5), 16, "rectangle, W/H = 1, φ = 30°")
    left.set(xlim=(-0.55, 0.75), ylim=(-0.02, 0.56), ylabel="y")
    cells = mechanism(right, Footing(12, 5), Soil(30, 1.0), 24, "strip footing, φ = 30°")
    right.plot(*prandtl_outline(30).T, color="#ff8c1a", linestyle="--", linewidth=1.6)
    right.set(xlim=(-12.2, 12.2), ylim=(-5.2, 0.9))
    bar = figure.colorbar(cells, ax=right, ticks=range(-3, 1), fraction=0.03, pad=0.01)
    bar.ax.set_yticklabels(["$\\leq 10^{-3}$", "$10^{-2}$", "$10^{-1}$", "1"])
    bar.set_label("rate of dissipation")
    groups = (("rectangle", "phi 20", "rectangles, φ = 20°"), ("rectangle", "phi 30", "rectangles, φ = 30°"),
              ("footing", "phi", "strip footings"))
    for k, (word, angle, title) in enumerate(groups):
        axis = figure.add_subplot(grid[1, k])
        group = {name: rows for name, rows in results.items() if word in name and angle in name}
        convergence(axis, group, title, 0.26 if word == "footing" else 0.13)
        if k == 0:
            axis.set_ylabel("load / middle of the finest bounds - 1  [%]")
    styles = (("^--", "lower bound"), ("v--", "upper bound"), ("o-", "finite elements (q2)"), ("o", "their limit"),
              (":", "closed form"))
    lines = [axis.plot([], [], style, color="black", label=label)[0] for style, label in styles]
    lines[3].set_markerfacecolor("white")
    lines.append(matplotlib.patches.Patch(color="black", alpha=0.2, label="between the finest bounds"))
    lines += right.plot([], [], color="#ff8c1a", linestyle="--", label="Prandtl's mechanism")
    key = figure.add_subplot(grid[2, :])
    key.axis("off")
    key.legend(handles=lines, loc="center", ncol=4, frameon=False)
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    with open(sys.argv[1]) as source:
        draw(json.load(source), sys.argv[2])
