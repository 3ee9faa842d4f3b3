# diptych: charts of force chains inside and outside the band, and of the traction along the band
# SPDX-License-Identifier: LGPL-2.1-or-later

import numpy as np

from .drawing import Figure
from .style import GRAINS, INK, PANEL_COLOURS, PANEL_LINES, framed, svg
from ..data.numbers import plain
from ..data.panels import PANEL_NAMES


def distribution(increment):
    """Share of grains whose major principal stress exceeds a multiple of the mean, inside and outside the band."""
    chains = increment.panel("discrete").get("force_chains")
    if not chains:
        return None
    above = 1 - np.array(chains["quantiles"])
    figure, axes = framed("major principal stress of a grain / mean", "share of grains above")
    axes.y.is_log = True
    for key, colour, dashes in (("inside", GRAINS, "-"), ("outside", INK, (0, (5, 1.5)))):
        values = np.array(chains[key]["values"], dtype=float)
        keep = np.isfinite(values) & (above > 0)
        axes.plot(values[keep], above[keep], color=colour, linestyle=dashes,
                  label=f"{key} the band ({chains[key]['grains']} grains)")
    axes.axvline(1, linewidth=0.7, linestyle=":")
    axes.set(xlim=(0, None))
    axes.legend()
    return svg(figure, "Distribution of the major principal stress of single grains inside and outside the band, "
               f"{increment.title}.")


def traction(increment):
    """Mean normal and shear traction on strips parallel to the band of the grains; uniform in equilibrium."""
    stored = {panel: increment.panel(panel).get("band_traction") for panel in PANEL_NAMES}
    if not all(stored.values()):
        return None
    figure = Figure((4.5, 3.9), [[0.15, 0.57 - 0.44 * k, 0.825, 0.385] for k in range(2)])
    for part, axes in zip(("normal", "shear"), figure.axes):
        for panel, record in stored.items():
            edges, values = (np.array(record[name], dtype=float) for name in ("edges_d", part))
            spread = plain(record.get("variation_" + part))
            label = PANEL_NAMES[panel] + ("" if spread is None else f", variation {100 * spread:.0f} %")
            axes.stairs(values, edges, color=PANEL_COLOURS[panel], linestyle=PANEL_LINES[panel],
                        linewidth=1.4, label=label)
            if record.get(part + "_error"):  # only of grains
                middle, error = (edges[1:] + edges[:-1]) / 2, np.array(record[part + "_error"], dtype=float)
                known = np.isfinite(error) & np.isfinite(values)
                axes.errorbar(middle[known], values[known], error[known], fmt="none", elinewidth=0.8, capsize=1.5,
                              color=PANEL_COLOURS[panel])
        low, high = axes.y.limits()
        axes.set(ylabel=f"{part} traction (P)", ylim=(min(low, 0), max(high, 0)))
        axes.legend()
    figure.axes[0].x.has_numbers = False
    axes.set(xlabel="distance along the normal of the band / d")
    return svg(figure, f"Normal and shear traction on strips parallel to the band, both panels, {increment.title}.")
