# diptych: charts of force chains inside and outside the band, and of the traction along the band
# SPDX-License-Identifier: LGPL-2.1-or-later

import numpy as np

from .style import GRAINS, INK, PANEL_COLOURS, PANEL_LINES, frame, logarithmic, svg
from ..data.numbers import plain
from ..data.panels import PANEL_NAMES


def distribution(increment):
    """Share of grains whose major principal stress exceeds a multiple of the mean, inside and outside the band."""
    chains = increment.panel("discrete").get("force_chains")
    if not chains:
        return None
    above = 1 - np.array(chains["quantiles"])
    figure, (axes,) = frame("distribution", (4.5, 3.1), [[0.15, 0.16, 0.825, 0.8]])
    for key, colour, dashes in (("inside", GRAINS, "-"), ("outside", INK, (0, (5, 1.5)))):
        values = np.array(chains[key]["values"], dtype=float)
        keep = np.isfinite(values) & (above > 0)
        axes.plot(values[keep], above[keep], color=colour, linestyle=dashes,
                  label=f"{key} ({chains[key]['grains']} grains)")
    axes.axvline(1, color=INK, linewidth=0.7, linestyle=":")
    logarithmic(axes)
    axes.set(xlabel="major principal stress of a grain / mean", ylabel="share of grains above", xlim=(0, None))
    axes.legend(loc="best", title="10–90 % width of the band", title_fontsize=8.5)
    return svg(figure, "Distribution of the major principal stress of single grains inside and outside the band, "
               f"{increment.title}.")


def traction(increment):
    """Mean normal and shear traction on strips parallel to the band of the grains; uniform in equilibrium."""
    stored = {panel: increment.panel(panel).get("band_traction") for panel in PANEL_NAMES}
    if not all(stored.values()):
        return None
    figure, both = frame("traction", (4.5, 3.9), [[0.15, 0.57 - 0.44 * k, 0.825, 0.385] for k in range(2)])
    for k, (part, axes) in enumerate(zip(("normal", "shear"), both)):
        for panel, record in stored.items():
            edges, values = (np.array(record[name], dtype=float) for name in ("edges_d", part))
            spread = plain(record.get("variation_" + part))
            label = PANEL_NAMES[panel] + ("" if spread is None else f": {100 * spread:.0f} %")
            axes.stairs(values, edges, baseline=None, color=PANEL_COLOURS[panel], linestyle=PANEL_LINES[panel],
                        linewidth=1.4, label=label)
            if record.get(part + "_error"):  # only of grains
                middle, error = (edges[1:] + edges[:-1]) / 2, np.array(record[part + "_error"], dtype=float)
                known = np.isfinite(error) & np.isfinite(values)
                axes.errorbar(middle[known], values[known], error[known], fmt="none", elinewidth=0.8, capsize=1.5,
                              color=PANEL_COLOURS[panel])
        axes.set_ylabel(f"{part} traction (P)")
        axes.tick_params(labelbottom=k == 1)
        low, high = axes.get_ylim()
        low, high = min(low, 0), max(high, 0)
        axes.set_ylim(low, high + 0.45 * (high - low))
        axes.legend(loc="upper left", ncol=2, title="variation", title_fontsize=8.5, alignment="left")
    axes.set_xlabel("distance along the normal of the band / d")
    return svg(figure, f"Normal and shear traction on strips parallel to the band, both panels, {increment.title}.")
