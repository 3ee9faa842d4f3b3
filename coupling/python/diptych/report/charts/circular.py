# diptych: charts of tractions across the diameters of a circle, and their prediction by the mean stress
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Moreau 1997, section 3 and figure 3."""

import numpy as np

from .drawing import Figure
from .style import PANEL_COLOURS, Pair, signed, svg
from ...arrays import ends_text
from ..data.numbers import interval, plain
from ..data.panels import PANEL_NAMES

PARTS = (("normal", "normal (P)"), ("tangential", "tangential (P)"))


def pair(increment):
    """Both panels on the same axes. A picture is None if no circle is stored."""
    circles = {panel: increment.panel(panel).get("circular_probe") for panel in PANEL_NAMES}
    if not all(circles.values()):
        return Pair(None, None)
    stored = {panel: _columns(circle) for panel, circle in circles.items()}
    spans = {}
    for part, _ in PARTS:
        every = np.concatenate([np.concatenate([c[part] + sign * c[part + "_error"], c["predicted_" + part]])
                                for c in stored.values() for sign in (-1, 1)])
        room = 0.08 * max(np.nanmax(every) - np.nanmin(every), 1e-6)
        spans[part] = (min(np.nanmin(every) - room, 0), np.nanmax(every) + room)
    pictures = [_panel(increment, panel, stored[panel], spans) for panel in PANEL_NAMES]
    return Pair(*pictures, caption=_sampling(circles["discrete"]))


def _sampling(circle):
    """Explains the bars. In equilibrium, neighbouring blocks compensate each other, so the difference is smaller than
    the bars."""
    alone = plain(circle.get("independent_blocks"))
    return "" if alone is None else (
        "Bars: standard errors for independent blocks along the diameter. Independent blocks would differ from the "
        f"mean stress by {100 * alone:.1f}\u00a0%.")


def _columns(circle):
    """The columns of the probe as arrays of equal length, and its relative_l2."""
    names = ["angles_deg"] + [prefix + part for part, _ in PARTS for prefix in ("", "predicted_")]
    columns = {name: np.array(circle[name], dtype=float) for name in names}  # null becomes nan
    for part, _ in PARTS:
        error = circle.get(part + "_error") or [0] * len(columns[part])  # only of grains
        columns[part + "_error"] = np.nan_to_num(np.array(error, dtype=float))
    return {**columns, "relative_l2": circle["relative_l2"]}


def _panel(increment, panel, columns, spans):
    figure = Figure((4.5, 3.9), [[0.14, 0.555 - 0.435 * k, 0.835, 0.375] for k in range(len(PARTS))])
    for (part, label), axes in zip(PARTS, figure.axes):
        axes.errorbar(columns["angles_deg"], columns[part], columns[part + "_error"], fmt="o", markersize=3,
                      elinewidth=0.8, color=PANEL_COLOURS[panel], label="across the diameter")
        axes.plot(columns["angles_deg"], columns["predicted_" + part], linewidth=1.3, label="from the mean stress")
        axes.set(ylabel=label, xlim=(0, 180), ylim=spans[part], xticks=range(0, 181, 30))
    first, last = figure.axes
    first.title(PANEL_NAMES[panel])
    first.title(_difference(columns["relative_l2"]), "right")
    first.legend()
    first.x.has_numbers = False
    last.set(xlabel="direction of the diameter (degrees)")
    alt = (f"{PANEL_NAMES[panel]}: mean traction across the diameters of the circular probe, measured and predicted, "
           f"{increment.title}; {_difference(columns['relative_l2'])}.")
    return svg(figure, alt)


def _difference(number):
    if plain(number) is None:
        return ""
    ends = ends_text(*(interval(number) or (None, None)), lambda end: f"{100 * end:.1f}")
    return signed(f"difference {100 * plain(number):.1f} %{ends}")
