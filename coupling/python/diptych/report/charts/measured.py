# diptych: charts of panels beside a measurement
# SPDX-License-Identifier: LGPL-2.1-or-later

import numpy as np

from .style import framed, PANEL_COLOURS, PANEL_LINES, PANEL_MARKS, svg, THIRD
from ..data.panels import PANE_NAMES

COLOURS, LINES, MARKS = ({**panels, "measured": look} for panels, look in (
    (PANEL_COLOURS, THIRD), (PANEL_LINES, (0, (1, 1.2))), (PANEL_MARKS, "D")))


def profile(panes, alt):
    """Displacement along the strongest band of every pane, in sixteen strips; None without a band."""
    figure, axes = framed("distance from the middle of the band / d", "displacement along the band / travel")
    for pane in [pane for pane in PANE_NAMES if pane in panes and panes[pane]["bands"]]:
        strips = panes[pane]["bands"][0]["profile"]
        axes.plot(strips["distance_d"], np.array(strips["displacement"], dtype=float), marker=MARKS[pane],
                  color=COLOURS[pane], linestyle=LINES[pane], markersize=4, label=PANE_NAMES[pane])
    if axes.is_empty:
        return None
    axes.legend()
    return svg(figure, alt)
