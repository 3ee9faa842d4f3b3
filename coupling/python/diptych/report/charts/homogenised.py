# diptych: maps and curves of homogenised grains
# SPDX-License-Identifier: LGPL-2.1-or-later

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

from .style import GRAINS, INK, NO_VALUE, chart, limit_below, signed, svg, with_intervals
from ..data.numbers import plain, scaled

WIDTH, TALLEST = 3.6, 4.6  # of a map, inches
CURVES = (("t_over_s", 1.0, "stress ratio t/s", "Stress ratio of the sample."),
          ("volumetric_strain", 100.0, "volumetric strain (%)",
           "Volumetric strain 1 − V/V₀ of the outline; dilation is negative."),
          ("coordination_number", 1.0, "contacts per grain",
           "Mean number of force-carrying contacts per grain, rattlers included."),
          ("anisotropy", 1.0, "anisotropy a of the fabric",
           "Anisotropy a of the contact normals, in the density 1 + a cos 2(θ − θ₀)."))


def maps(result):
    """List of (Picture, caption) of the last frame; maps without values are left out."""
    shown, last, across = [], result.frames[-1], result.loading_variable
    at = f" at {across.word} {across.text(last['progress'])}" if len(result.frames) > 1 else ""
    if last.get("s"):
        shown += [_map(result, result.maps["s"] / last["s"], "cividis", "s / mean of the sample",
                       f"Mean stress s = (σ₁ + σ₂)/2{at}."),
                  _map(result, result.maps["t_over_s"], "cividis", "stress ratio t/s", f"Stress ratio t/s{at}.")]
    shown.append(_map(result, result.maps["solid_fraction"], "viridis", "solid fraction", f"Solid fraction{at}."))
    for increment, name in ((result.increments[-1:], "shear_strain_increment"),
                            ([result.whole], "shear_strain_since_start")):
        for one in filter(None, increment):
            when = f"from {across.number(one['from'])} to {across.text(one['to'])}"
            shown.append(_map(result, 100 * result.maps[name], "viridis", "shear strain ε₁ − ε₂ (%)",
                              f"Shear strain {when}: {_bands_text(one)}.", increment=one))
    return shown


def _bands_text(increment):
    n = len(increment["bands"])
    return f"{n} band{'s' if n > 1 else ''} (solid: middle, dashed: 10–90 % width)" if n else increment["band_verdict"]


def _map(result, values, colours, label, caption, *, increment=None):
    low, high = result.polygons.reshape(-1, 2).min(0), result.polygons.reshape(-1, 2).max(0)
    size = high - low
    scale = min((WIDTH - 0.2) / size[0], TALLEST / size[1])
    height = scale * size[1] + 1.05
    figure = Figure(figsize=(WIDTH, height))
    axes = figure.add_axes([0.5 - scale * size[0] / WIDTH / 2, 1.0 / height, scale * size[0] / WIDTH,
                            scale * size[1] / height])
    known = values[np.isfinite(values)]
    limits = np.percentile(known, (2, 98)) if len(known) else (0, 1)
    cells = PolyCollection(result.polygons, array=np.ma.masked_invalid(values), cmap=colours, edgecolors="face",
                           linewidths=0.3)
    cells.get_cmap().set_bad(NO_VALUE)
    cells.set_clim(*limits)
    axes.add_collection(cells)
    for band in increment["bands"] if increment else []:
        _draw_band(axes, band, result.record["mean_diameter"], 2 * np.hypot(*size))
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
    axes.axis("off")
    _scale_bar(figure, scale, size[0], height)
    bar = figure.colorbar(cells, cax=figure.add_axes([0.42, 0.66 / height, 0.53, 0.12 / height]),
                          orientation="horizontal", extend="both")
    bar.set_label(label)
    bar.ax.locator_params(nbins=4)
    return svg(figure, f"Map: {caption}"), caption


def _draw_band(axes, band, diameter, length):
    middle = np.array(band["middle"]) / diameter
    angle = np.radians(band["angle_deg"]["value"])
    along, across = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
    for side, look in ((0, "-"), (-0.5, (0, (4, 2))), (0.5, (0, (4, 2)))):
        at = middle + side * band["width_10_90_d"]["value"] * across
        ends = np.array([at - length * along, at + length * along])
        axes.plot(*ends.T, color="white", linewidth=2.2)
        axes.plot(*ends.T, color=INK, linewidth=1.2 if side == 0 else 0.8, linestyle=look)


def _scale_bar(figure, scale, width, height):
    """A bar of 1, 2 or 5 times a power of ten d, at most a third of the width."""
    power = 10.0 ** np.floor(np.log10(width / 3))
    length = max(k * power for k in (1, 2, 5) if k * power <= width / 3)
    axes = figure.add_axes([0.03, 0.5 / height, 0.37, 0.4 / height])
    axes.set(xlim=(0, 0.37 * WIDTH), ylim=(0, 0.4))
    axes.plot([0.05, 0.05 + scale * length], [0.22, 0.22], color=INK, linewidth=2, solid_capstyle="butt")
    axes.text(0.05, 0.02, f"{length:g} d", va="bottom", fontsize=8.5)
    axes.axis("off")


def curves(result):
    """List of (Picture, caption) over the frames."""
    found, across = [], result.loading_variable.factor
    for key, factor, label, caption in CURVES:
        known = [frame for frame in result.frames if plain(frame.get(key)) is not None]
        if len(known) < 2:
            continue
        figure, axes = chart(result, label)
        numbers = [scaled(frame[key], factor) for frame in known]
        at = [across * frame["progress"] for frame in known]
        axes.plot(at, [plain(number) for number in numbers], color=GRAINS, linewidth=1)
        with_intervals(axes, at, numbers, fmt="o", markersize=4, color=GRAINS)
        limit_below(axes, key == "volumetric_strain")
        found.append((svg(figure, f"{label} over {result.loading_variable.word}."), caption))
    return found + [_bands(result, *look) for look in (("angle_deg", "inclination of the bands (degrees)"),
                                                       ("width_10_90_d", "10–90 % width of the bands (d)"))
                    if sum(len(one["bands"]) > 0 for one in result.increments) > 1]


def _bands(result, key, label):
    figure, axes = chart(result, label)
    across = result.loading_variable.factor
    for rank, fill in ((0, GRAINS), (1, "white")):
        rows = [one for one in result.increments if len(one["bands"]) > rank]
        at, numbers = [across * one["to"] for one in rows], [one["bands"][rank][key] for one in rows]
        with_intervals(axes, at, numbers, fmt="o", markersize=4.5, color=GRAINS, markerfacecolor=fill)
    if key == "angle_deg":
        axes.set_ylim(-90, 90)
        axes.set_yticks(range(-90, 91, 30), [signed(f"{k}") for k in range(-90, 91, 30)])
    else:
        axes.set_ylim(bottom=0)
    return (svg(figure, f"{label} over {result.loading_variable.word}."),
            f"{label[0].upper() + label[1:]}, at the end of each increment. Filled: the stronger band; "
            "open: the other one.")
