# diptych: style of the figures, and their encoding for the page
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Colours, the common frame, and conversion of a figure to an embedded picture."""

import base64
from dataclasses import dataclass

import numpy as np

from .drawing import Figure
from ...plotting import CONTINUUM, DASHES, GRAINS, INK, NO_VALUE
from ..data.numbers import interval, plain

THIRD = "#007A5E"   # for a third line
LINE_COLOURS = (GRAINS, CONTINUUM, THIRD, "#CC79A7", "#E69F00", "#56B4E9")  # of many lines
FAINT = "#9a9a9a"
PANEL_COLOURS = {"discrete": GRAINS, "continuum": CONTINUUM}
PANEL_LINES = {"discrete": "-", "continuum": DASHES}
PANEL_MARKS = {"discrete": "o", "continuum": "s"}
POINTS = 1500       # per curve
ROUND_OFF = 1e-3    # %, smallest range of the axis for a sample with constant volume


@dataclass(frozen=True, kw_only=True)
class Picture:
    """One embedded image; width and height in CSS pixels."""

    uri: str
    alt: str
    width: int
    height: int


@dataclass(frozen=True)
class Pair:
    """Two pictures of one instant, grains left and continuum right; None: not stored."""

    left: object
    right: object
    caption: str = ""


def chart(result, label):
    """(figure, axes) for a curve over the progress `result.loading_variable`, always with the same frame."""
    return framed(result.loading_variable.label, label)


def framed(xlabel, ylabel):
    """(figure, axes) with the common frame."""
    figure = Figure((4.5, 3.1), [[0.15, 0.5 / 3.1, 0.825, 1 - 0.6 / 3.1]])
    figure.axes[0].set(xlabel=xlabel, ylabel=ylabel)
    return figure, figure.axes[0]


def with_intervals(axes, x, numbers, **look):
    """Draws points with their 95 % intervals, if known; numbers as in data.numbers. Returns True if any has a value."""
    points = [(at, plain(n), interval(n)) for at, n in zip(x, numbers) if plain(n) is not None]
    if not points:
        return False
    at, values = np.array([p[0] for p in points]), np.array([p[1] for p in points])
    ends = np.array([p[2] or (p[1], p[1]) for p in points])
    # Round-off or a skewed bootstrap may put an end on the wrong side of the value; bars have no negative length.
    bars = np.clip(np.stack([values - ends[:, 0], ends[:, 1] - values]), 0, None)
    axes.errorbar(at, values, bars, capsize=2.5, elinewidth=1, **look)
    return True


def limit_below(axes, is_strain):
    """Starts the axis at zero; that of a volumetric strain shows zero as a line and at least the range of round-off."""
    if not is_strain:
        axes.set(ylim=(0, 1.05 * axes.y.limits()[1]))
        return
    axes.axhline(0, color=INK, linewidth=0.6)
    if np.ptp(axes.y.limits()) < ROUND_OFF:
        axes.set(ylim=(-ROUND_OFF, ROUND_OFF))


def thin(x, y, points=POINTS):
    """Keeps the lowest and highest point of each of points/2 bins, so that a long history keeps its spikes."""
    if len(x) <= points:
        return x, y
    n = points // 2
    bins = np.resize(np.arange(len(x)), (n, -(-len(x) // n)))  # at its end it repeats the first points
    every = np.arange(n)
    keep = np.unique([bins[every, y[bins].argmin(1)], bins[every, y[bins].argmax(1)]])
    return x[keep], y[keep]


def decades(values):
    """Whole decades around the values, so that a logarithmic axis always has labels."""
    if not len(values):
        return 0.1, 1.0
    low, high = np.floor(np.log10(values.min()) + 1e-9), np.ceil(np.log10(values.max()) - 1e-9)
    return 10.0 ** low, 10.0 ** max(high, low + 1)


def signed(text):
    """Digits with a true minus sign."""
    return text.replace("-", "−")


def svg(figure, alt):
    """The figure for the page."""
    text, *size = figure.svg()
    return embedded(text.encode(), alt, *size)


def embedded(picture, alt, width, height):
    """An SVG picture as part of the page; width and height in points."""
    uri = "data:image/svg+xml;base64," + base64.b64encode(picture).decode("ascii")
    return Picture(uri=uri, alt=alt, width=round(96 / 72 * width), height=round(96 / 72 * height))
