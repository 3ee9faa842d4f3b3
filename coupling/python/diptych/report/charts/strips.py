# diptych: charts of the mean displacement increment in strips parallel to the band
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Moreau 1997, section 3: 16 strips, here for both panels and with the fitted profile of the band."""

import numpy as np

from .drawing import Figure
from .style import PANEL_COLOURS, Pair, signed, svg
from ...arrays import ends_text
from ..data.numbers import interval, plain
from ..data.panels import DIFFUSE, PANEL_NAMES

LARGEST_TURN = 10  # degrees; fits of bands with a larger angle to the strips are not drawn


def pair(increment):
    """Both panels on the same axes."""
    # edges [d] (n+1), mean (n), deviation (n); null becomes nan: an empty strip
    stored = {panel: increment.panel(panel)["strips"] for panel in PANEL_NAMES}
    profiles = {panel: [np.array(strips[name], dtype=float) for name in ("edges_d", "mean", "deviation")]
                for panel, strips in stored.items()}
    lowest = min(min(0.0, np.nanmin(mean)) for _, mean, _ in profiles.values())
    highest = max(max(1.0, np.nanmax(mean)) for _, mean, _ in profiles.values())
    reach = max(np.abs(edges).max() for edges, _, _ in profiles.values())
    box = (-reach, reach, lowest - 0.12, highest + 0.12)
    angles = {panel: strips["angle_deg"] for panel, strips in stored.items()}
    pictures = [_panel(increment, panel, profiles[panel], box, angles[panel]) for panel in PANEL_NAMES]
    words = [f"{PANEL_NAMES[panel].lower()} {signed(f'{angle:.1f}°')}" for panel, angle in angles.items()]
    return Pair(*pictures, caption=f"Inclination of the strips: {', '.join(words)}; {increment.title}.")


def _panel(increment, panel, profile, box, angle):
    edges, mean, deviation = profile
    middle, colour = (edges[1:] + edges[:-1]) / 2, PANEL_COLOURS[panel]
    figure = Figure((4.5, 3.1), [[0.14, 0.16, 0.84, 0.8]])
    axes, = figure.axes
    axes.stairs(np.nan_to_num(mean), edges, fill=True, color=colour, alpha=0.35, label="mean of each strip")
    across = np.tile([box[2], box[3], np.nan], len(edges))
    axes.plot(np.repeat(edges, 3), across, color="white", linewidth=0.8)  # strips apart
    axes.errorbar(middle, mean, deviation, fmt="none", ecolor=colour, elinewidth=1, capsize=2,
                  label="standard deviation")
    bands = increment.bands(panel)
    # A band across the strips has no profile in them.
    narrow = [band for band in bands if not band.get("diffuse")]
    parallel = [band for band in narrow if _turn(band, angle) < LARGEST_TURN]
    # The linear background belongs to the first band of the panel.
    straight = [plain(increment.panel(panel)["strips"].get(name)) for name in ("background", "background_slope")]
    for band in parallel:
        _draw_fit(axes, band, box, straight if band is bands[0] else (None, None))
    if not parallel:
        axes.plot([], [], linestyle="", label="no band parallel to the strips" if narrow else DIFFUSE)
    axes.set(xlim=box[:2], ylim=box[2:], xlabel="distance along the normal of the strips / d",
             ylabel="displacement increment / |ΔU|")
    axes.title(PANEL_NAMES[panel])
    axes.axhline(0, linewidth=0.6)
    axes.legend()
    alt = f"{PANEL_NAMES[panel]}: mean longitudinal displacement increment of {len(mean)} strips, {increment.title}" + (
        ", with the fitted tanh." if parallel else "; no band parallel to them.")
    return svg(figure, alt)


def _turn(band, angle):
    """Angle between a band and the strips, in [0, 90] degrees."""
    return abs((plain(band["angle_deg"]) - angle + 90) % 180 - 90)


def _draw_fit(axes, band, box, background):
    """u = a + b x + (jump/2) tanh((x - offset)/delta); background: a and b of the strips, or None; 10-90 % width
    shaded."""
    jump, offset, delta, width = (plain(band[name]) for name in ("jump", "offset_d", "half_width_d", "width_10_90_d"))
    ends = interval(band["width_10_90_d"]) or (None, None)
    label = f"10–90 % width {width:.1f} d" + signed(ends_text(*ends, "{:.1f}".format))
    if None not in background:
        x = np.linspace(box[0], box[1], 150)
        axes.plot(x, background[0] + background[1] * x + jump / 2 * np.tanh((x - offset) / delta), label="fit")
    axes.axvspan(offset - width / 2, offset + width / 2, alpha=0.08, label=label)
