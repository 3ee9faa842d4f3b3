# diptych: mean longitudinal displacement increment in strips parallel to the band
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Moreau 1997, section 3: 16 strips; here for both panels, with the fitted profile of the band."""

import numpy as np
from matplotlib.figure import Figure

from increments import interval, plain
from pair import Pair
from style import DIFFUSE, INK, PANEL_COLOURS, PANEL_NAMES, svg
from wording import rounded

LARGEST_TURN = 10  # degrees between a band and the strips, beyond which its fit is not drawn over their means


def pair(increment):
    """Both panels on the same axes. A picture is None where no strips are stored."""
    stored = {panel: increment.panel(panel).get("strips") or {} for panel in PANEL_NAMES}
    profiles = {panel: _profile(strips) for panel, strips in stored.items()}
    known = [profile for profile in profiles.values() if profile is not None]
    if not known:
        return Pair(None, None)
    lowest = min(min(0.0, np.nanmin(mean)) for _, mean, _, _ in known)
    highest = max(max(1.0, np.nanmax(mean)) for _, mean, _, _ in known)
    reach = max(np.abs(edges).max() for edges, _, _, _ in known)
    box = (-reach, reach, lowest - 0.12, highest + 0.35)
    pictures = [_panel(increment, panel, profiles[panel], box, plain(stored[panel].get("angle_deg")))
                for panel in PANEL_NAMES]
    angles = [f"{name.lower()} {rounded(stored[panel].get('angle_deg'), '°')}" for panel, name in PANEL_NAMES.items()]
    return Pair(*pictures, caption=f"Inclination of the strips: {', '.join(angles)}; {increment.title}.")


def _profile(strips):
    """(edges [d] (n+1), mean (n), deviation (n), count (n)); nan for an empty strip."""
    if not strips or not strips.get("edges_d"):
        return None
    edges = np.asarray(strips["edges_d"], dtype=float)
    columns = [np.array(strips.get(name) or [None] * (len(edges) - 1), dtype=float)  # null becomes nan
               for name in ("mean", "deviation", "count")]
    return (edges, *columns) if np.isfinite(columns[0]).any() else None


def _panel(increment, panel, profile, box, angle):
    if profile is None:
        return None
    edges, mean, deviation, count = profile
    middle, colour = (edges[1:] + edges[:-1]) / 2, PANEL_COLOURS[panel]
    figure = Figure(figsize=(4.5, 3.3))
    axes = figure.add_axes([0.14, 0.15, 0.84, 0.76])
    axes.bar(middle, mean, np.diff(edges) * 0.96, color=colour, alpha=0.35, linewidth=0, label="mean of each strip")
    axes.errorbar(middle, mean, deviation, fmt="none", ecolor=colour, elinewidth=1, capsize=2,
                  label="standard deviation in it")
    bands = increment.bands(panel)
    # A band that crosses the strips has no profile in them.
    parallel = [band for band in bands if angle is None or abs(plain(band["angle_deg"]) - angle) < LARGEST_TURN]
    for band in parallel:
        _draw_fit(axes, band, middle, mean, count, box)
    if not parallel:
        axes.plot([], [], " ", label="no band along these strips" if bands else DIFFUSE)
    axes.set(xlim=box[:2], ylim=box[2:], xlabel="distance along the strips' normal / d",
             ylabel="displacement increment / |ΔU|")
    axes.set_title(PANEL_NAMES[panel], loc="left", fontweight="bold")
    axes.axhline(0, color=INK, linewidth=0.6)
    axes.legend(loc="upper left", handlelength=1.6)
    alt = f"{PANEL_NAMES[panel]}: mean longitudinal displacement increment of {len(mean)} strips, {increment.title}" + (
        ", with the fitted tanh." if parallel else "; no band along them.")
    return svg(figure, alt)


def _draw_fit(axes, band, middle, mean, count, box):
    """u = a + b x + (jump/2) tanh((x - offset)/delta); 10-90 % width shaded.

    a and b from the record if they are there, otherwise the least squares of the strips with the other values held.
    """
    jump, offset, delta = (plain(band.get(name)) for name in ("jump", "offset_d", "half_width_d"))
    if jump is None or offset is None or not delta:
        return
    background = band.get("background")
    if background is None:
        good = np.isfinite(mean)
        weight = np.sqrt(np.where(np.isfinite(count[good]), count[good], 1.0))
        rest = mean[good] - jump / 2 * np.tanh((middle[good] - offset) / delta)
        matrix = np.column_stack([np.ones(good.sum()), middle[good]])
        background = np.linalg.lstsq(matrix * weight[:, None], rest * weight, rcond=None)[0]
    x = np.linspace(box[0], box[1], 400)
    width = plain(band.get("width_10_90_d"))
    ends = interval(band.get("width_10_90_d"))
    label = "fit" if width is None else f"fit, 10–90 % over {width:.1f} d"
    if ends:
        label += f" [{ends[0]:.1f}, {ends[1]:.1f}]".replace("-", "−")
    axes.plot(x, background[0] + background[1] * x + jump / 2 * np.tanh((x - offset) / delta), color=INK, label=label)
    if width is not None:
        axes.axvspan(offset - width / 2, offset + width / 2, color=INK, alpha=0.08, linewidth=0)
