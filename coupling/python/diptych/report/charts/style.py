# diptych: style of the figures, and their encoding for the page
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Colours, font sizes, frames that figures share, and conversion of a figure to an embedded picture."""

import base64
import io
from dataclasses import dataclass

import matplotlib
import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator
from matplotlib.transforms import Bbox, blended_transform_factory

from ...plotting import CONTINUUM, DASHES, GRAINS, INK, NO_VALUE
from ..data.numbers import interval, plain

THIRD = "#007A5E"   # for a third line
LINE_COLOURS = (GRAINS, CONTINUUM, THIRD, "#CC79A7", "#E69F00", "#56B4E9")  # of many lines
FAINT = "#9a9a9a"
GRID = "#e4e4e4"
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


def set_up():
    """Sets the style on top of matplotlib's defaults. A user's matplotlibrc does not change a report."""
    matplotlib.rcdefaults()
    matplotlib.rcParams.update({
        "font.size": 9, "axes.titlesize": 10, "axes.labelsize": 9.5, "legend.fontsize": 8.5,
        "xtick.labelsize": 8.5, "ytick.labelsize": 8.5, "axes.edgecolor": INK, "axes.linewidth": 0.7,
        "axes.unicode_minus": True, "legend.frameon": False, "lines.linewidth": 1.6,
        # A fixed title height saves a tenth of the time of a page.
        "axes.titley": 1.0, "svg.hashsalt": "diptych", "path.simplify_threshold": 0.3,
        # Text stays text, measured in the font of matplotlib. The other fonts are not wider, so nothing is cut.
        "svg.fonttype": "none", "font.sans-serif": ["DejaVu Sans", "Verdana", "Arial", "sans-serif"],
    })


def chart(result, label):
    """(figure, axes) for a curve over the progress `result.loading_variable`, always with the same frame."""
    figure = Figure(figsize=(4.5, 3.1))
    axes = ruled(figure.add_axes([0.15, 0.5 / 3.1, 0.825, 1 - 0.6 / 3.1]))
    axes.set(xlabel=result.loading_variable.label, ylabel=label)
    place_labels(axes, 0.035, 0.2 / 3.1)
    return figure, axes


def legend_above(axes, n_columns=2, **look):
    """Puts the legend above the axes, where it lies on no data. The figure grows by its rows."""
    figure, rows = axes.figure, -(-len(axes.get_legend_handles_labels()[0]) // n_columns)
    if not rows:
        return
    width, height = figure.get_size_inches()
    taller = height + 0.19 * rows
    figure.set_size_inches(width, taller)
    for one in figure.axes:
        left, bottom, across, up = one.get_position().bounds
        one.set_position([left, bottom * height / taller, across, up * height / taller])
    axes.legend(loc="lower left", bbox_to_anchor=(0, 1), ncol=n_columns, borderaxespad=0.1, borderpad=0.1,
                labelspacing=0.2, columnspacing=1.2, **look)


def logarithmic(axes):
    """Decades as plain numbers without minor ticks; formulas and minor ticks would take most of the time."""
    if axes.get_yscale() != "log":
        axes.set_yscale("log")
        axes.yaxis.set_major_formatter("{x:g}")
        axes.yaxis.set_minor_locator(NullLocator())


_frames = {}


def frame(name, size, boxes):
    """(figure, axes) without data, one ruled axes per box. They are kept under `name` for the next chart, because
    creating axes takes longer than drawing."""
    if name not in _frames:
        figure = Figure(figsize=size)
        _frames[name] = figure, [ruled(figure.add_axes(box)) for box in boxes]
        for axes, (left, bottom, _, _) in zip(_frames[name][1], boxes):
            place_labels(axes, left - 0.42 / size[0], bottom - 0.3 / size[1])
    figure, every = _frames[name]
    for axes in every:
        _empty(axes)
    return figure, every


def place_labels(axes, x, y):
    """Puts the y label at x and the x label at y, in fractions of the figure. Fixed places save a search among the tick
    labels."""
    axes.xaxis.set_label_coords(0.5, y, transform=blended_transform_factory(axes.transAxes, axes.figure.transFigure))
    axes.yaxis.set_label_coords(x, 0.5, transform=blended_transform_factory(axes.figure.transFigure, axes.transAxes))


def _empty(axes):
    for artist in [*axes.lines, *axes.collections, *axes.patches, *axes.texts]:
        artist.remove()
    axes.containers.clear()
    if axes.get_legend():
        axes.get_legend().remove()
    axes.dataLim.set_points(Bbox.null().get_points())
    axes.ignore_existing_data_limits = True
    axes.autoscale(True)


def ruled(axes):
    axes.grid(True, color=GRID, linewidth=0.6)
    axes.set_axisbelow(True)
    return axes


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
        axes.set_ylim(0, 1.05 * axes.get_ylim()[1])
        return
    axes.axhline(0, color=INK, linewidth=0.6)
    if np.ptp(axes.get_ylim()) < ROUND_OFF:
        axes.set_ylim(-ROUND_OFF, ROUND_OFF)


def thin(x, y, points=POINTS):
    """Keeps the lowest and highest point of each of points/2 bins, so that a long history keeps its spikes."""
    if len(x) <= points:
        return x, y
    keep = set()
    for part in np.array_split(np.flatnonzero(np.isfinite(y)), points // 2):
        if len(part):
            keep.update((part[np.argmin(y[part])], part[np.argmax(y[part])]))
    keep = sorted(keep)
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
    """Vector picture for curves. It has no date, so the same results give the same bytes."""
    stream = io.BytesIO()
    figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
    width, height = figure.get_size_inches()
    uri = "data:image/svg+xml;base64," + base64.b64encode(stream.getvalue()).decode("ascii")
    return Picture(uri=uri, alt=alt, width=round(96 * width), height=round(96 * height))
