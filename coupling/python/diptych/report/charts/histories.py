# diptych: charts of histories over the loading, both panels
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every step from discrete.csv and continuum.csv, running means from comparison.h5, stages from comparison.json. Forces
in P d (unit thickness)."""

import numpy as np

from .style import (INK, PANEL_COLOURS, PANEL_LINES, PANEL_MARKS, ROUND_OFF, chart, decades, svg,
                                         thin, with_intervals)
from ..data.numbers import scaled
from ..data.panels import PANEL_NAMES

RAW_WIDTH = {"discrete": 0.5, "continuum": 0.9}


def figures(result):
    """List of (Picture or None, caption) in the order of the page."""
    return [
        _both(result, ("stress_ratio", "stress_ratio_mean"), 1.0, "stress ratio t/s",
              f"Stress ratio of the whole sample. Thin: every step; thick: mean over {result.averaging}. Open marks: "
              "stages, with 95 % intervals of the mean in time."),
        _both(result, ("volumetric_strain", "volumetric_strain"), 100.0, "volumetric strain (%)",
              "Volumetric strain 1 − V/V₀, every step; dilation is negative. Open marks: stages."),
        _platens(result),
        _platen_difference(result),
    ]


def _both(result, columns, scale, label, caption):
    """columns: (name for every step, name for the thick line)."""
    figure, axes = chart(result, label)
    across, drawn, (every, thick) = result.loading_variable.factor, [], columns
    for panel, colour in PANEL_COLOURS.items():
        raw, mean = result.history(panel, every), result.history(panel, thick)
        if raw is not None and thick != every:
            axes.plot(*thin(across * raw[0], scale * raw[1]), color=colour, alpha=0.5, linewidth=RAW_WIDTH[panel])
        if mean is not None:
            axes.plot(*thin(across * mean[0], scale * mean[1]), color=colour, linewidth=1.8,
                      linestyle=PANEL_LINES[panel], label=PANEL_NAMES[panel])
        if raw is None and mean is None:
            continue
        with_intervals(axes, [across * s.end for s in result.stages],
                       [scaled(s.panel(panel).get(every), scale) for s in result.stages], fmt=PANEL_MARKS[panel],
                       markersize=4.5, markerfacecolor="white", color=colour, markeredgewidth=1.2)
        drawn.append(PANEL_NAMES[panel])
    if not drawn:
        return None, caption
    axes.set_xlim(left=0)
    if every == "stress_ratio":
        axes.set_ylim(bottom=0)
    elif np.ptp(axes.get_ylim()) < ROUND_OFF:
        axes.set_ylim(-ROUND_OFF, ROUND_OFF)
    axes.legend(loc="best")
    return svg(figure, f"{label} against the loading: {', '.join(drawn)}."), caption


def _platens(result):
    caption = ("Vertical force of each platen on the sample. Thin: every step of the grains; thick: mean over "
               f"{result.averaging}.")
    figure, axes = chart(result, "vertical platen force (P d)")
    across, unit, drawn = result.loading_variable.factor, result.units.size("pressure length"), 0
    for panel, colour in PANEL_COLOURS.items():
        for side, line in (("lower", "-"), ("upper", (0, (4, 2)))):
            raw, mean = result.history(panel, side + "_fy"), result.history(panel, side + "_fy_mean")
            if raw is not None and panel == "discrete":
                axes.plot(*thin(across * raw[0], np.abs(raw[1]) / unit), color=colour, linewidth=0.35, alpha=0.3)
            if mean is not None:
                axes.plot(*thin(across * mean[0], np.abs(mean[1])), color=colour, linestyle=line,
                          label=f"{PANEL_NAMES[panel]}, {side}")
                drawn += 1
    if not drawn:
        return None, caption
    axes.set_xlim(left=0)
    axes.legend(loc="best", ncol=2)
    return svg(figure, "Vertical platen forces against the loading, both panels, lower and upper platen."), caption


def _platen_difference(result):
    caption = ("Relative difference of the vertical forces of both platens on the grains, |F_lower + F_upper| "
               "over their mean magnitude. Moreau (1997) reports less than 1 %.")
    found = result.history("discrete", "platen_difference")
    if found is None or not (found[1] > 0).any():
        return None, caption
    good = found[1] > 0
    progress, difference = result.loading_variable.factor * found[0][good], 100 * found[1][good]
    figure, axes = chart(result, "difference of platen forces (%)", log=True)
    axes.plot(*thin(progress, difference), color=PANEL_COLOURS["discrete"], linewidth=0.6)
    axes.axhline(1, color=INK, linewidth=1, linestyle="--")
    axes.annotate("1 %", (0.99, 1), xycoords=("axes fraction", "data"), ha="right", va="bottom")
    axes.set_xlim(left=0)
    axes.set_ylim(decades(np.append(difference, 1.0)))
    return svg(figure, "Relative difference of the vertical platen forces against the loading, log scale."), caption
