# diptych: charts of grains and of the law's point along one path
# SPDX-License-Identifier: LGPL-2.1-or-later

import numpy as np

from .style import CONTINUUM, GRAINS, PANEL_LINES, THIRD, chart, limit_below, svg

# quantity -> factor, label, caption
CHARTS = {
    "stress_ratio": (1.0, "stress ratio t/s", "Stress ratio t/s of the mean stress."),
    "volumetric_strain": (100.0, "volumetric strain (%)", "Volumetric strain 1 − V/V₀; dilation is negative."),
    "fabric_anisotropy": (1.0, "anisotropy a of the fabric",
                          "Anisotropy a of the contact normals, in the density 1 + a cos 2(θ − θ₀)."),
    "coordination": (1.0, "contacts per grain",
                     "Mean number of force-carrying contacts per grain, without grains that have none."),
    "mean_stress": (1.0, "mean stress s/P", "Mean stress s = (σ₁ + σ₂)/2 over the pressure P of the start."),
}
DIRECTIONS = (("grains_stress_direction", GRAINS, "o", "grains, σ₁"),
              ("grains_fabric_direction", THIRD, "^", "grains, contact normals"),
              ("law_stress_direction", CONTINUUM, "s", "law, σ₁"))


def figures(element):
    """List of (Picture, caption): mean of the samples, its standard error (dark), one standard
    deviation of a sample (light), and the law."""
    return [_chart(element, name, *look) for name, look in CHARTS.items()] + [_directions(element)]


def _chart(element, name, factor, label, caption):
    figure, axes = chart(element, label)
    across, n = element.loading_variable.factor * element.curves["progress"], len(element.record["done"])
    mean, error = (factor * element.curves[f"grains_{name}{end}"] for end in ("", "_error"))
    for width, opacity in ((np.sqrt(n), 0.15), (1, 0.35)):
        axes.fill_between(across, mean - width * error, mean + width * error, color=GRAINS, alpha=opacity, linewidth=0)
    axes.plot(across, mean, color=GRAINS, label=f"grains, {n} sample{'s' if n > 1 else ''}")
    law = element.curves.get(f"law_{name}")
    if law is not None:
        axes.plot(across, factor * law, color=CONTINUUM, linestyle=PANEL_LINES["continuum"], label="law")
    limit_below(axes, name == "volumetric_strain")
    axes.set_xlim(left=0)
    axes.legend(loc="best")
    return svg(figure, f"{label} along the path, grains and law."), caption


def _directions(element):
    """Directions as points, from -30 to 150 degrees, so that vertical, horizontal and both diagonals lie inside."""
    figure, axes = chart(element, "direction (degrees)")
    for name, colour, mark, label in DIRECTIONS:
        if name in element.curves:
            axes.plot(element.loading_variable.factor * element.curves["progress"],
                      (element.curves[name] + 30) % 180 - 30, mark, color=colour, markersize=2.5, label=label)
    axes.set(ylim=(-30, 150), yticks=range(-30, 151, 30))
    axes.set_xlim(left=0)
    axes.legend(loc="best")
    return (svg(figure, "Directions along the path, grains and law."),
            "Directions from the horizontal: of the larger principal stress, and of most contact normals. They mean "
            "nothing where t/s or the anisotropy vanish.")
