# diptych: curves behind the figures of the literature, and their drawing
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A panel per figure: its curves() returns {label: [x, mean, standard error]}, draw() draws all of them."""
import os
from collections.abc import Callable
from dataclasses import dataclass

import numpy
from matplotlib.figure import Figure
from samples import (COLUMNS, FRICTIONS, HALF, HERE, MIXTURES, RADJAI, SWEEPS, ambiguity, between_walls, biaxial,
                     claims, close, coordination, forces, packing, pooled, profile, shaebani, strength, weak_share)

SEEDS = (1, 2, 3)
COLOURS = "#0072B2", "#D55E00", "#007A5E"
THEIRS = {"color": "0.4", "linestyle": "--"}


@dataclass(frozen=True, kw_only=True)
class Panel:
    source: str
    title: str
    x: str
    y: str
    curves: Callable[[], dict]
    theirs: Callable  # (axis, curves): draws the values of the source and says whose they are
    scales: tuple[str, str] = ("linear", "linear")
    line: str = "o"


def curve(x, table):
    """Mean and standard error over the first axis of the table, the seeds."""
    return [list(x), *claims.mean_and_error(table)]


def density():
    edges = numpy.geomspace(0.01, 8, 25)
    tables = zip(*([numpy.histogram(part, edges)[0] / len(part) / numpy.diff(edges) for part in pooled(seed)[:2]]
                   for seed in SEEDS))
    return {label: curve(numpy.sqrt(edges[1:] * edges[:-1]), table)
            for label, table in zip(("normal N", "tangential T"), tables)}


def force_law(axis, curves):
    """Power below the mean, exponential above it, continuous; the share of all contacts is 1."""
    x = numpy.geomspace(0.01, 8, 100)
    for (label, colour), (power, rate) in zip(zip(curves, COLOURS), ((-0.3, 1.4), (-0.5, 1.))):
        law = numpy.where(x < 1, x ** power, numpy.exp(rate * (1 - x))) / (1 / (1 + power) + 1 / rate)
        axis.plot(x, law, "--", color=colour, label=f"{label}: Radjai et al. 1996")
    axis.set_ylim(1e-3, 5)


def directions():
    angles = [forces(shaebani(seed))[4] % numpy.pi for seed in (1, 2, 3, 4, 5)]
    return {"here": curve(15 * numpy.arange(12) + 7.5,
                          [numpy.histogram(a, 12, (0, numpy.pi))[0] * 12 / len(a) for a in angles])}


def spreads():
    """Solid fraction over the spread of the radii, by their skewness."""
    groups = {}
    for mixture in MIXTURES:
        r = packing(1, mixture).radius
        skewness = ((r - r.mean()) ** 3).mean() / r.std() ** 3
        groups.setdefault(f"skewness {abs(skewness):.1f}", []).append((r.std() / r.mean(), mixture))
    return {label: curve([spread for spread, _ in group], [[close(s, name) for _, name in group] for s in SEEDS])
            for label, group in groups.items()}


def slabs():
    heights = (24, 12, 8)
    found = numpy.array([[between_walls(seed, height) for height in heights] for seed in SEEDS])
    return {"here": curve([0, *(1 / found[:, :, 0]).mean(axis=0)],
                          numpy.column_stack([[close(seed) for seed in SEEDS], found[:, :, 1]]))}


def straight(axis, curves):
    (x, y, _), = curves.values()
    axis.plot(x, numpy.interp(0, x[:2], y[:2]) + (y[1] - y[0]) / x[1] * numpy.array(x), **THEIRS,
              label="straight (two points ours):\nDesmond & Weeks 2009")


def deposit(axis, curves):
    """Fronts and height of a column."""
    for label, colour in zip(curves, COLOURS):
        aspect = float(label.split()[-1])
        front = HALF * (1 + 1.9 * aspect ** (2 / 3))
        axis.plot([-front, 0, front], [0, HALF * aspect ** 0.4, 0], "^", color=colour, clip_on=False, markersize=7,
                  zorder=3, label="Lube et al. 2005" if colour == COLOURS[0] else None)


def across(whose, *values):
    return lambda axis, _: [axis.axhline(v, **THEIRS, label=whose if v == values[0] else None) for v in values]


def of_seeds(x, number, seeds=SEEDS):
    return curve(x, [[number(seed, one) for one in x] for seed in seeds])


PANELS = {
    "forces": Panel(
        source="radjai", title="Distribution of forces", x="force / mean", y="probability density", curves=density,
        theirs=force_law, scales=("log", "log")),
    "weak": Panel(
        source="radjai", title="Contacts below the mean force", x="sample", y="share of the contacts",
        curves=lambda: {"here": of_seeds([*RADJAI], weak_share)},
        theirs=across("Radjai et al. 1996 (D): more;\nRadjai & Richefeu 2009: nearly", 0.6)),
    "coordination": Panel(
        source="cegeo", title="Contacts in a biaxial test", x="axial strain (%)", y="contacts per grain",
        curves=lambda: {"here": curve(range(16), [[coordination(s) for s in biaxial(seed).snapshots]
                                                  for seed in SEEDS])},
        theirs=across("CEGEO 2012: upper one, then between", 3, 4)),
    "ambiguity": Panel(
        source="unger", title="Ambiguity of forces", x="friction", y="scatter / mean force", scales=("symlog", "log"),
        curves=lambda: {f"here, at most {sweeps} sweeps": of_seeds(
            FRICTIONS, lambda seed, mu: ambiguity(seed, mu)[k]) for k, sweeps in enumerate(SWEEPS)},
        theirs=lambda axis, _: (axis.axvline(0.1, **THEIRS, label="largest: Unger et al. 2005"), axis.axhline(
            0.05, color="0.4", linestyle=":", label="practically none (limit ours):\nRadjai & Richefeu 2009"))),
    "directions": Panel(
        source="shaebani", title="Directions of contacts", x="direction (degrees)", y="share / mean", curves=directions,
        theirs=across("Shaebani et al. 2009: between", 0.97, 1.03)),
    "spreads": Panel(
        source="packings", title="Packings without friction", x="standard deviation / mean of the radii",
        y="solid fraction", curves=spreads, theirs=across("Meer et al. 2024, no skewness", 0.84)),
    "slabs": Panel(
        source="packings", title="Packings between two walls", x="d / height", y="solid fraction", curves=slabs,
        theirs=straight),
    "ratios": Panel(
        source="packings", title="Packings of two sizes, equal numbers", x="large / small radius", y="solid fraction",
        curves=lambda: {"here": of_seeds((1.1, 1.4, 2, 3), lambda seed, r: close(seed, f"two sizes 1:{r:g}"))},
        theirs=lambda axis, _: axis.axvline(1.4, **THEIRS, label="loosest: Koeze et al. 2016")),
    "strength": Panel(
        source="strength", title="Strength without friction", x="inertial number", y="shear / normal stress",
        curves=lambda: {"here": of_seeds((1e-4, 1e-3), strength)}, theirs=across("limit: Clark et al. 2018", 0.11),
        scales=("log", "linear")),
    "deposits": Panel(
        source="collapse", title="Deposits of columns", x="x / d", y="height / d", line="-", theirs=deposit,
        curves=lambda: {f"a = {aspect}": curve(place, [height]) for aspect in COLUMNS
                        for place, height in [profile(1, aspect)]})}


def draw(parts):
    """figure.png, from the stored parts."""
    picture = Figure(figsize=(17, 7), layout="constrained")
    for axis, (name, panel) in zip(picture.subplots(2, 5).ravel(), PANELS.items()):
        curves = parts[panel.source]["curves"][name]
        axis.set_xscale(panel.scales[0], **{"linthresh": 0.01} if panel.scales[0] == "symlog" else {})
        axis.set_yscale(panel.scales[1])
        for (label, (x, mean, error)), colour in zip(curves.items(), COLOURS):
            axis.errorbar(x, mean, 1.96 * numpy.array(error), fmt=panel.line, color=colour, label=label, markersize=4)
        panel.theirs(axis, curves)
        axis.set(xlabel=panel.x, ylabel=panel.y)
        axis.set_title(panel.title, fontsize=10)
        axis.margins(y=0.2)
        axis.legend(fontsize=7)
        axis.grid(alpha=0.3)
    picture.savefig(os.path.join(HERE, "figure.png"), dpi=80)
