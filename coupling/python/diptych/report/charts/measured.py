# diptych: charts of panels beside a measurement
# SPDX-License-Identifier: LGPL-2.1-or-later

import numpy as np

from .style import framed, PANEL_COLOURS, PANEL_LINES, PANEL_MARKS, svg, THIRD
from ...thickness import CONVENTIONS
from ..data.numbers import plain
from ..data.panels import PANE_NAMES

COLOURS, LINES, MARKS = ({**panels, "measured": look} for panels, look in (
    (PANEL_COLOURS, THIRD), (PANEL_LINES, (0, (1, 1.2))), (PANEL_MARKS, "D")))


def _panes(window):
    return [(pane, window["levelled"][pane]) for pane in PANE_NAMES if pane in window["levelled"]]


def profile(window):
    """Displacement along the strongest band of every levelled pane, in sixteen strips; None without a band."""
    figure, axes = framed("distance from the middle of the band / d", "displacement along the band / travel")
    for pane, found in _panes(window):
        if found["bands"]:
            strips = found["bands"][0]["profile"]
            axes.plot(strips["distance_d"], np.array(strips["displacement"], dtype=float), marker=MARKS[pane],
                      color=COLOURS[pane], linestyle=LINES[pane], markersize=4, label=PANE_NAMES[pane])
    if axes.is_empty:
        return None
    axes.legend()
    return svg(figure, "Displacement along the band over the distance from it, measurement and levelled panels.")


def thickness(window):
    """The thickness by every convention; None without a resolved band."""
    figure, axes = framed("", "thickness of the band / d")
    for pane, found in _panes(window):
        values = found["bands"][0]["thickness_d"] if found["bands"] else {}
        if values:
            shown = [np.nan if plain(values[name]) is None else values[name] for name in CONVENTIONS]
            axes.plot(np.arange(len(shown)), shown, MARKS[pane], color=COLOURS[pane], markersize=5,
                      label=PANE_NAMES[pane])
    if axes.is_empty:
        return None
    axes.set(ylim=(0, None), xlim=(-0.5, len(CONVENTIONS) - 0.5))
    axes.x.ticks = list(enumerate(title for title, _, _ in CONVENTIONS.values()))
    axes.legend()
    return svg(figure, "Thickness of the band by several conventions, measurement and levelled panels.")
