# diptych: the pair of maps that a reader without scripts sees
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shear strain increment of the opening instant, as draw.js draws it."""

import matplotlib
import matplotlib.patheffects as effects
import numpy as np
from matplotlib.collections import EllipseCollection, PolyCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from increments import plain
from pair import Pair
from quantities import QUANTITIES, limits
from style import NO_VALUE, PANEL_NAMES, png
from viewer import box

WIDTH = 3.6  # inches
LEFT, RIGHT, TOP, BOTTOM, BAR = 0.5, 0.1, 0.28, 0.44, 0.52


def pair(result, increment):
    """Pictures of both panels; None where nothing is stored."""
    quantity, frame = QUANTITIES[0], box([i for i in result.increments if i.arrays])
    rule = limits(quantity, "discs", [i for i in result.increments if i.arrays], result)
    if increment is None or frame is None or rule is None:
        return Pair(None, None)
    return Pair(*[_panel(quantity, increment, frame, rule(increment), panel, result) for panel in PANEL_NAMES])


def _panel(quantity, increment, frame, colour_limits, panel, result):
    numbers = quantity.values(increment, result, "discs", panel)
    if numbers is None:
        return None
    x0, x1, y0, y1 = frame
    inner = WIDTH - LEFT - RIGHT
    tall = inner * (y1 - y0) / (x1 - x0)
    height = TOP + tall + BOTTOM + BAR
    figure = Figure(figsize=(WIDTH, height))
    axes = figure.add_axes([LEFT / WIDTH, (BOTTOM + BAR) / height, inner / WIDTH, tall / height])
    axes.set(xlim=(x0, x1), ylim=(y0, y1), xlabel="x / d", ylabel="y / d")
    axes.set_title(PANEL_NAMES[panel], loc="left", fontweight="bold")
    drawn = _discs(axes, increment) if panel == "discrete" else PolyCollection(
        increment.arrays["cells/corners"], edgecolors="face", linewidths=0.25)
    drawn.set_array(np.ma.masked_invalid(numbers))
    drawn.set_cmap(matplotlib.colormaps[quantity.colour_map].with_extremes(bad=NO_VALUE))
    drawn.set_norm(Normalize(*colour_limits))
    axes.add_collection(drawn, autolim=False)
    _bands(axes, increment, panel)
    bar = figure.colorbar(drawn, cax=figure.add_axes([LEFT / WIDTH, 0.40 / height, inner / WIDTH, 0.12 / height]),
                          orientation="horizontal")
    bar.set_label(quantity.label, labelpad=2)
    return png(figure, f"{PANEL_NAMES[panel]}: {quantity.title}, {increment.title}, {len(numbers)} values.")


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


def band_axes(angle_deg):
    """Unit vectors along and normal to a band: angle from the horizontal, in (-90, 90]; normal = direction + 90."""
    angle = np.radians(angle_deg)
    return np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
