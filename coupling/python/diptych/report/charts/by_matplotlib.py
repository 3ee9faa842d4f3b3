# diptych: charts that matplotlib draws: of campaigns, which have few of them
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Maps, matrices and charts with their own scales. The many charts of a run are those of drawing.py."""

import contextlib
import io

import matplotlib
from matplotlib.transforms import blended_transform_factory

from .drawing import GRID
from .style import INK, embedded


@contextlib.contextmanager
def styled():
    """The style within a block, on top of matplotlib's defaults. A user's matplotlibrc does not change a page."""
    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        matplotlib.rcParams.update({
            "font.size": 9, "axes.titlesize": 10, "axes.labelsize": 9.5, "legend.fontsize": 8.5,
            "xtick.labelsize": 8.5, "ytick.labelsize": 8.5, "axes.edgecolor": INK, "axes.linewidth": 0.7,
            "axes.unicode_minus": True, "legend.frameon": False, "lines.linewidth": 1.6,
            "axes.titley": 1.0, "svg.hashsalt": "diptych", "path.simplify_threshold": 0.3,
            # Text stays text, measured in the font of matplotlib. The other fonts are not wider, so nothing is cut.
            "svg.fonttype": "none", "font.sans-serif": ["DejaVu Sans", "Verdana", "Arial", "sans-serif"],
        })
        yield


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


def ruled(axes):
    axes.grid(True, color=GRID, linewidth=0.6)
    axes.set_axisbelow(True)
    return axes


def place_labels(axes, x, y):
    """Puts the y label at x and the x label at y, in fractions of the figure. Fixed places save a search among the tick
    labels."""
    axes.xaxis.set_label_coords(0.5, y, transform=blended_transform_factory(axes.transAxes, axes.figure.transFigure))
    axes.yaxis.set_label_coords(x, 0.5, transform=blended_transform_factory(axes.figure.transFigure, axes.transAxes))


def svg(figure, alt):
    """The figure for the page. It has no date, so the same results give the same bytes."""
    stream = io.BytesIO()
    figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
    return embedded(stream.getvalue(), alt, *(72 * figure.get_size_inches()))
