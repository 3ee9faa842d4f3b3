# diptych: curves behind the figures of the literature, and their drawing
# SPDX-License-Identifier: LGPL-2.1-or-later
"""CURVES[source]() returns {label: [x, mean, standard error]} of a source; draw() draws a panel a source."""
import os

import numpy
from matplotlib.figure import Figure
from samples import (COLUMNS, FRICTIONS, HALF, HERE, MIXTURES, ambiguity, biaxial, claims, close, coordination, forces,
                     packing, pooled, profile, shaebani, strength)

SEEDS = (1, 2, 3)
COLOURS = "#0072B2", "#D55E00", "#007A5E"


def curve(x, table):
    """Mean and standard error over the first axis of the table, the seeds."""
    return [[float(f"{value:.4g}") for value in numpy.ravel(part)] for part in (x, *claims.mean_and_error(table))]


def radjai():
    edges = numpy.geomspace(0.01, 8, 25)
    tables = zip(*([numpy.histogram(part, edges)[0] / len(part) / numpy.diff(edges) for part in pooled(seed)[:2]]
                   for seed in SEEDS))
    return {label: curve(numpy.sqrt(edges[1:] * edges[:-1]), table)
            for label, table in zip(("normal N", "tangential T"), tables)}


def directions():
    angles = [forces(shaebani(seed))[5] % numpy.pi for seed in (1, 2, 3, 4, 5)]
    return {"": curve(15 * numpy.arange(12) + 7.5,
                      [numpy.histogram(a, 12, (0, numpy.pi))[0] * 12 / len(a) for a in angles])}


def packings():
    """Solid fraction over the spread of the radii, by their skewness."""
    groups = {}
    for mixture in MIXTURES:
        r = packing(1, mixture).radius
        skewness = ((r - r.mean()) ** 3).mean() / r.std() ** 3
        groups.setdefault(f"skewness {abs(skewness):.1f}", []).append((r.std() / r.mean(), mixture))
    return {label: curve([spread for spread, _ in group], [[close(s, name) for _, name in group] for s in SEEDS])
            for label, group in groups.items()}


CURVES = {
    "radjai": radjai, "shaebani": directions, "packings": packings,
    "strength": lambda: {"": curve((1e-4, 1e-3), [[strength(seed, i) for i in (1e-4, 1e-3)] for seed in SEEDS])},
    "cegeo": lambda: {"": curve(range(16), [[coordination(s) for s in biaxial(seed).snapshots] for seed in SEEDS])},
    "unger": lambda: {"": curve(FRICTIONS, [[ambiguity(seed, mu) for mu in FRICTIONS] for seed in SEEDS])},
    "collapse": lambda: {f"a = {aspect}": curve(place, [height]) for aspect in COLUMNS
                         for place, height in [profile(1, aspect)]}}




def force_law(label):
    """Power below the mean, exponential above it, continuous; the share of all contacts is 1."""
    x, (power, rate) = numpy.geomspace(0.01, 8, 100), (-0.3, 1.4) if label == "normal N" else (-0.5, 1.)
    return x, numpy.where(x < 1, x ** power, numpy.exp(rate * (1 - x))) / (1 / (1 + power) + 1 / rate)


def deposit(label):
    """Fronts and height of a column."""
    aspect = float(label.split()[-1])
    front = HALF * (1 + 1.9 * aspect ** (2 / 3))
    return [-front, 0, front], [0, HALF * aspect ** 0.4, 0]


# Source: (title, x, y, values of the source or their function of the label, scale of x, kind of line).
LOOKS = {
    "radjai": ("Radjai et al. 1996", "force / mean", "probability density", force_law, "log", "o"),
    "cegeo": ("CEGEO 2012: 4, then between 3 and 4", "axial strain (%)", "contacts per grain", (3, 4), "linear", "o"),
    "unger": ("Unger et al. 2005: largest near 0.1", "friction", "ambiguity of forces", (), "symlog", "o"),
    "shaebani": ("Shaebani et al. 2009: within 3 %", "direction of contacts (degrees)", "share / mean", (0.97, 1.03),
                 "linear", "o"),
    "packings": ("Meer et al. 2024: 0.840 without skewness", "standard deviation / mean of the radii",
                 "solid fraction", (0.84,), "linear", "o"),
    "strength": ("Clark et al. 2018: 0.11", "inertial number I", "shear / normal stress, no friction", (0.11,), "log",
                 "o"),
    "collapse": ("Lube et al. 2005: fronts and height (marks)", "x / d", "height / d", deposit, "linear", "-")}


def draw(parts):
    """figure.png: a panel per source. Dashed: its values. Bars: 95 % of the mean."""
    picture = Figure(figsize=(14, 6.6), layout="constrained")
    axes = picture.subplots(2, 4).ravel()
    for axis, (source, part) in zip(axes, parts.items()):
        title, x_label, y_label, theirs, scale, line = LOOKS[source]
        axis.set_xscale(scale, **{"linthresh": 0.01} if scale == "symlog" else {})
        for (label, (x, mean, error)), colour in zip(part["curves"].items(), COLOURS):
            axis.errorbar(x, mean, 1.96 * numpy.array(error), fmt=line, color=colour, label=label, markersize=4)
            if callable(theirs):
                axis.plot(*theirs(label), "^" if line == "-" else "--", color=colour, clip_on=line == "o")
        for value in () if callable(theirs) else theirs:
            axis.axhline(value, color="0.4", linestyle="--")
        if source == "radjai":
            axis.set(yscale="log", ylim=(1e-3, 5))
        if len(part["curves"]) > 1:
            axis.legend(fontsize=9)
        axis.margins(y=0.08)
        axis.set_title(title, fontsize=10)
        axis.set(xlabel=x_label, ylabel=y_label)
        axis.grid(alpha=0.3)
    for axis in axes[len(parts):]:
        axis.axis("off")
    picture.savefig(os.path.join(HERE, "figure.png"), dpi=90)
