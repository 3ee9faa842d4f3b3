# diptych: what every map of the sample is drawn with: axes, grains, cells, bands
# SPDX-License-Identifier: LGPL-2.1-or-later
"""All lengths in mean diameters d. Left and right maps of a pair get the same axes and the same colour limits."""

import matplotlib.patheffects as effects
import numpy as np
from matplotlib.collections import EllipseCollection, PolyCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from style import INK, NO_VALUE

WIDTH = 4.3  # inches: type stays readable when a phone shows one panel at full width
LEFT, RIGHT, TOP, BOTTOM, BAR = 0.52, 0.12, 0.28, 0.46, 0.55


def extent(increments, margin=2.0):
    """(x0, x1, y0, y1) [d] holding every grain and cell of every increment: stepping does not move the axes."""
    low, high = [], []
    for increment in increments:
        position, radius = increment.arrays.get("discrete/position"), increment.arrays.get("discrete/radius")
        if position is not None and radius is not None and len(position):
            low.append((position[:, :2] - radius[:, None]).min(axis=0))
            high.append((position[:, :2] + radius[:, None]).max(axis=0))
        corners = increment.arrays.get("cells/corners")
        if corners is not None and len(corners):
            low.append(corners.min(axis=(0, 1)))
            high.append(corners.max(axis=(0, 1)))
    if not low:
        return None
    (x0, y0), (x1, y1) = np.min(low, axis=0) - margin, np.max(high, axis=0) + margin
    return x0, x1, y0, y1


def map_axes(box, title, bar=False):
    """Figure, axes of equal aspect filling it exactly, and the colour bar's axes (None without bar)."""
    x0, x1, y0, y1 = box
    inner = WIDTH - LEFT - RIGHT
    tall = inner * (y1 - y0) / (x1 - x0)
    below = BOTTOM + (BAR if bar else 0)
    height = TOP + tall + below
    figure = Figure(figsize=(WIDTH, height))
    axes = figure.add_axes([LEFT / WIDTH, below / height, inner / WIDTH, tall / height])
    axes.set(xlim=(x0, x1), ylim=(y0, y1), xlabel="x / d", ylabel="y / d")
    axes.set_title(title, loc="left", fontweight="bold")
    axes.tick_params(length=3)
    bar_axes = figure.add_axes([LEFT / WIDTH, 0.40 / height, inner / WIDTH, 0.13 / height]) if bar else None
    return figure, axes, bar_axes


def draw_discs(axes, position, radius, values, colour_map, limits):
    """Grains at their true radii. values: one a grain; nan is drawn grey."""
    discs = EllipseCollection(2 * radius, 2 * radius, np.zeros_like(radius), units="xy", offsets=position[:, :2],
                              transOffset=axes.transData, linewidths=0)
    return _coloured(axes, discs, values, colour_map, limits)


def draw_cells(axes, corners, values, colour_map, limits):
    """Cells as polygons. values: one a cell; nan is drawn grey."""
    # Edges in the face's colour close the hairlines that anti-aliasing leaves between neighbours.
    cells = PolyCollection(corners, edgecolors="face", linewidths=0.25)
    return _coloured(axes, cells, values, colour_map, limits)


def _coloured(axes, collection, values, colour_map, limits):
    collection.set_array(np.ma.masked_invalid(values))
    collection.set_cmap(colour_map.with_extremes(bad=NO_VALUE))
    collection.set_norm(Normalize(*limits))
    axes.add_collection(collection, autolim=False)
    return collection


def draw_colour_bar(figure, bar_axes, collection, label):
    """Horizontal bar; an arrow at an end says that values beyond that limit exist."""
    values = collection.get_array().compressed()
    low, high = collection.get_clim()
    beyond = (bool((values < low).any()), bool((values > high).any()))
    extend = {(True, True): "both", (True, False): "min", (False, True): "max"}.get(beyond, "neither")
    bar = figure.colorbar(collection, cax=bar_axes, orientation="horizontal", extend=extend)
    bar.set_label(label, labelpad=2)
    bar.ax.tick_params(length=2.5)


def draw_outline(axes, arrays):
    """The grains' two free sides, where they are stored."""
    for side in ("left", "right"):
        points = arrays.get("outline/" + side)
        if points is not None and len(points):
            axes.plot(points[:, 0], points[:, 1], color=INK, linewidth=0.6)


def band_axes(band):
    """Unit vectors along and normal to the band: angle from the horizontal, in (-90, 90]; normal = direction + 90."""
    angle = np.radians(plain(band["angle_deg"]))
    return np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])


def draw_bands(axes, bands, centre, on_colour=True):
    """Centre line of each band, and dashed lines at plus and minus half the 10-90 % width. centre: of the sample [d].

    on_colour: white lines with a dark rim, for colour maps; otherwise thin dark ones, for white paper.
    """
    halo = [effects.Stroke(linewidth=2.6, foreground="black"), effects.Normal()] if on_colour else None
    for band in bands:
        along, normal = band_axes(band)
        half, offset = (plain(band.get("width_10_90_d")) or 0.0) / 2, plain(band.get("offset_d")) or 0.0
        for position, line in ((offset, "-"), (offset - half, (0, (4, 2.5))), (offset + half, (0, (4, 2.5)))):
            if centre is None or (half == 0.0 and line != "-"):
                continue
            start = centre + position * normal
            axes.axline(start, start + along, color="white" if on_colour else INK, linestyle=line,
                        linewidth=1.4 if on_colour else 0.9, path_effects=halo)


def plain(number):
    """The value of a number that may carry an interval {"value", "low", "high"}; None stays None."""
    if isinstance(number, dict):
        number = number.get("value")
    return None if number is None or not np.isfinite(number) else float(number)
