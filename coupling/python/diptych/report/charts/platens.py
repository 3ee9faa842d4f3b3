# diptych: charts of the friction along the platens, both panels
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shear over normal stress and slip in parts of the platens, means over all stages; from comparison.h5."""

import numpy as np

from .style import GRAINS, PANEL_COLOURS, PANEL_LINES, PANEL_MARKS, framed, svg
from ..data.numbers import plain
from ..data.panels import PANEL_NAMES

RATIO = "shear / normal stress"


def figures(result):
    """List of (Picture, caption): along the platen, and over the slip. Empty along time."""
    panels = {panel: result.platens[panel] for panel in PANEL_NAMES
              if panel in result.platens and np.isfinite(result.platens[panel]["stress_ratio"]).any()}
    if not panels:
        return []
    return [_over(panels, "place", "place along the platen (half widths)", "along the platen"),
            _over(panels, "slip", f"slip per {result.loading_variable.word} (d)", "over the slip", _law(result))]


def _law(result):
    """(friction, slip length [d]) of the fit to these grains; None without slip."""
    summary = result.part("discrete_summary")
    fitted = plain(summary.get("platen_friction")), plain(summary.get("platen_slip_length_d"))
    return None if None in fitted else fitted


def _over(panels, name, label, words, law=None):
    figure, axes = framed(label, RATIO)
    for panel, arrays in panels.items():
        order = np.argsort(arrays[name])
        axes.plot(arrays[name][order], arrays["stress_ratio"][order], color=PANEL_COLOURS[panel],
                  marker=PANEL_MARKS[panel], markersize=4.5, linestyle=PANEL_LINES[panel] if name == "place" else "",
                  label=PANEL_NAMES[panel])
    caption = f"Friction {words}: parts of both platens, means over all stages."
    if law:
        slip = np.linspace(*axes.x.limits(), 100)
        axes.plot(slip, law[0] * np.tanh(slip / (law[0] * law[1])), color=GRAINS, linewidth=0.8)
        caption += f" Line: {law[0]:.2g} tanh(slip / ({law[0]:.2g} × {law[1]:.3g} d)), fitted to these grains alone."
    axes.legend()
    return svg(figure, f"{RATIO} of both panels {words}."), caption
