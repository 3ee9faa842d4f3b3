# diptych: a map as a picture, for readers without JavaScript
# SPDX-License-Identifier: LGPL-2.1-or-later

from dataclasses import dataclass

import matplotlib
import matplotlib.patheffects as effects
import numpy as np
from matplotlib.collections import EllipseCollection, PolyCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from diptych_report.charts.style import NO_VALUE, band_axes, png
from diptych_report.data.numbers import plain
from diptych_report.data.panels import PANEL_NAMES

WIDTH = 3.6  # inches
LEFT, RIGHT, TOP, BOTTOM, BAR = 0.5, 0.1, 0.28, 0.44, 0.52


@dataclass
class StillMap:
    """The map of one panel. numbers: one per grain or cell; NaN: no value. frame: (x0, x1, y0, y1) [d]. limits: (low, high)."""

    panel: str
    label: str
    colour_map: str
    numbers: np.ndarray
    limits: tuple
    frame: tuple


def picture(shown, increment):
    """Grains as discs or the continuum as cells, with the detected bands, as in draw.js."""
    x0, x1, y0, y1 = shown.frame
    inner = WIDTH - LEFT - RIGHT
    tall = inner * (y1 - y0) / (x1 - x0)
    height = TOP + tall + BOTTOM + BAR
    figure = Figure(figsize=(WIDTH, height))
    axes = figure.add_axes([LEFT / WIDTH, (BOTTOM + BAR) / height, inner / WIDTH, tall / height])
    axes.set(xlim=(x0, x1), ylim=(y0, y1), xlabel="x / d", ylabel="y / d")
    axes.set_title(PANEL_NAMES[shown.panel], loc="left", fontweight="bold")
    drawn = _discs(axes, increment) if shown.panel == "discrete" else PolyCollection(
        increment.arrays["cells/corners"], edgecolors="face", linewidths=0.25)
    drawn.set_array(np.ma.masked_invalid(shown.numbers))
    drawn.set_cmap(matplotlib.colormaps[shown.colour_map].with_extremes(bad=NO_VALUE))
    drawn.set_norm(Normalize(*shown.limits))
    axes.add_collection(drawn, autolim=False)
    _bands(axes, increment, shown.panel)
    bar = figure.colorbar(drawn, cax=figure.add_axes([LEFT / WIDTH, 0.40 / height, inner / WIDTH, 0.12 / height]),
                          orientation="horizontal")
    bar.set_label(shown.label, labelpad=2)
    return png(figure, f"{PANEL_NAMES[shown.panel]}: {shown.label}, {increment.title}, {len(shown.numbers)} values.")


def _discs(axes, increment):
    radius = increment.arrays["discrete/radius"]
    return EllipseCollection(2 * radius, 2 * radius, np.zeros_like(radius), units="xy", linewidths=0,
                             offsets=increment.arrays["discrete/position"][:, :2], transOffset=axes.transData)


def _bands(axes, increment, panel):
    """Centre line, and dashed lines at plus and minus half the 10-90 % width."""
    for band in increment.bands(panel):
        angle, offset = plain(band.get("angle_deg")), plain(band.get("offset_d")) or 0.0
        half = (plain(band.get("width_10_90_d")) or 0.0) / 2
        if angle is None or increment.centre is None:
            continue
        along, normal = band_axes(angle)
        for position, line in ((offset, "-"), (offset - half, (0, (4, 2.5))), (offset + half, (0, (4, 2.5)))):
            start = increment.centre + position * normal
            axes.axline(start, start + along, color="white", linestyle=line, linewidth=1.3,
                        path_effects=[effects.Stroke(linewidth=2.5, foreground="black"), effects.Normal()])
