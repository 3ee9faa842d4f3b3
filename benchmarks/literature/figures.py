# diptych: curves behind the figures of the literature, and their drawing
# SPDX-License-Identifier: LGPL-2.1-or-later
"""CURVES[source]() returns the curves of a source as lists; draw() draws those that are stored, a panel a source."""
import os

import numpy
from matplotlib.figure import Figure
from samples import (COLUMNS, FRICTIONS, HALF, HERE, MIXTURES, ambiguity, biaxial, close, coordination, forces, packing,
                     pooled, profile, shaebani, strength)

SEEDS = (1, 2, 3)
BLUE, RED, GREEN, GREY = "#0072B2", "#D55E00", "#007A5E", "0.5"


def rounded(values):
    return [float(f"{v:.4g}") for v in numpy.ravel(values)]


def spread(x, table):
    """[x, mean, standard error] over the first axis of the table, the seeds."""
    error = numpy.std(table, axis=0, ddof=1) / len(table) ** 0.5
    return [rounded(x), rounded(numpy.mean(table, axis=0)), rounded(error)]


def radjai():
    edges = numpy.geomspace(0.01, 8, 25)
    parts = [numpy.concatenate(part) for part in zip(*(pooled(seed)[:2] for seed in SEEDS))]
    return [rounded(numpy.sqrt(edges[1:] * edges[:-1])), *(
        rounded(numpy.histogram(part, edges)[0] / len(part) / numpy.diff(edges)) for part in parts)]


def directions():
    angles = [forces(shaebani(seed))[5] % numpy.pi for seed in (1, 2, 3, 4, 5)]
    return spread(15 * numpy.arange(12) + 7.5, [numpy.histogram(a, 12, (0, numpy.pi))[0] * 12 / len(a) for a in angles])


def packings():
    radii = [packing(1, mixture).radius for mixture in MIXTURES]
    return spread([((r - r.mean()) ** 3).mean() / r.std() ** 3 for r in radii],
                  [[close(seed, mixture) for mixture in MIXTURES] for seed in SEEDS])


def sheared():
    cases = ((1e-4, 0.6), (1e-3, 0.6))
    return spread([i for i, _ in cases], [[strength(seed, *case) for case in cases] for seed in (1, 2)])


CURVES = {
    "radjai": radjai, "shaebani": directions, "packings": packings, "strength": sheared,
    "cegeo": lambda: spread(numpy.arange(16), [[coordination(s) for s in biaxial(seed).snapshots] for seed in SEEDS]),
    "unger": lambda: spread(FRICTIONS, [[ambiguity(seed, mu) for mu in FRICTIONS] for seed in SEEDS]),
    "collapse": lambda: [[aspect, *map(rounded, profile(1, aspect))] for aspect in COLUMNS]}
# Source: (title, x, y, values of the source, scale of x).
LOOKS = {
    "radjai": ("Radjai et al. 1996 (dashed)", "force / mean", "density: normal (blue), tangential", (), "log"),
    "cegeo": ("CEGEO 2012: 4, then 3 to 4", "axial strain (%)", "contacts per grain z", (3, 4), "linear"),
    "unger": ("Unger et al. 2005: largest near 0.1", "friction (first point: 0)", "ambiguity of forces", (), "log"),
    "shaebani": ("Shaebani et al. 2008: 1 +- 0.03", "direction of contacts (degrees)", "share / mean", (0.97, 1.03),
                 "linear"),
    "packings": ("Meer et al. 2024: 0.840 without skewness", "skewness of the radii", "solid fraction", (0.84,),
                 "linear"),
    "strength": ("Clark et al. 2018: 0.11; dotted: plane_shear", "I, no friction", "shear / normal stress", (0.11,),
                 "log"),
    "collapse": ("Lube et al. 2005 (marks)", "x (d)", "height (d)", (), "linear")}


def draw_radjai(axis, x, *densities):
    for density, colour, power, rate in zip(densities, (BLUE, RED), (-0.3, -0.5), (1.4, 1.0)):
        axis.plot(x, density, "o", color=colour, markersize=4)
        law = numpy.where(numpy.array(x) < 1, numpy.power(x, power), numpy.exp(rate * (1 - numpy.array(x))))
        axis.plot(x, numpy.interp(1, x, density) * law, "--", color=colour)
    axis.set(yscale="log", ylim=(1e-3, 20))


def draw_collapse(axis, *columns):
    for (aspect, place, height), colour in zip(columns, (BLUE, RED, GREEN)):
        axis.step(place, height, where="mid", color=colour, label=f"a = {aspect}")
        front = HALF * (1 + 1.9 * aspect ** (2 / 3))
        axis.plot([-front, 0, front], [0, HALF * aspect ** 0.4, 0], "^", color=colour, clip_on=False)
    axis.legend()


def draw(curves):
    """figure.png: a panel per source. Grey: its values. Bars: 95 % of the mean."""
    picture = Figure(figsize=(14, 6.4), layout="constrained")
    axes = picture.subplots(2, 4).ravel()
    for axis, source in zip(axes, [source for source in LOOKS if source in curves]):
        title, x_label, y_label, values, scale = LOOKS[source]
        axis.set_title(title, fontsize=9)
        axis.set(xlabel=x_label, ylabel=y_label, xscale=scale)
        if source in ("radjai", "collapse"):
            {"radjai": draw_radjai, "collapse": draw_collapse}[source](axis, *curves[source])
        else:
            x, mean, error = map(numpy.array, curves[source])
            axis.errorbar(numpy.maximum(x, 1e-3) if source == "unger" else x, mean, 1.96 * error, fmt="o", capsize=2.5,
                          color=BLUE)
        if source == "strength":
            axis.plot(x, 0.138 + 1.23 * x, ":", color=RED)
        for value in values:
            axis.axhline(value, color=GREY, linestyle="--")
        axis.grid(alpha=0.3)
    for axis in axes[len(set(LOOKS) & set(curves)):]:
        axis.axis("off")
    picture.savefig(os.path.join(HERE, "figure.png"), dpi=90)
