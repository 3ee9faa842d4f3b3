# diptych: charts of the sensitivity indices of a study
# SPDX-License-Identifier: LGPL-2.1-or-later

from matplotlib.figure import Figure

from .style import CONTINUUM, GRAINS, ruled, svg
from ..data.sensitivity import by_total

LOOKS = {"first": ("first: alone", GRAINS, "o", GRAINS, -0.16),
         "total": ("total: alone and with others", CONTINUUM, "s", "white", 0.16)}


def indices(one, names):
    """First and total indices of one quantity with their intervals, the largest total index on top. names: {key:
    label}."""
    ranked = by_total(one)
    height = 0.6 + 0.33 * len(ranked)
    left = (0.15 + 0.065 * max(map(len, names.values()))) / 4.5
    figure = Figure(figsize=(4.5, height))
    draw_indices(figure.add_axes([left, 0.5 / height, 0.97 - left, 1 - 0.55 / height]), ranked, names)
    return svg(figure, f"First and total Sobol indices of {one['quantity']}, {one['panel']}, with 95 % intervals.")


def draw_indices(axes, ranked, names):
    """Draws the indices of parameters, from top to bottom. names: {key: label}."""
    ruled(axes).grid(False, axis="y")
    for name, (label, colour, mark, face, shift) in LOOKS.items():
        for k, p in enumerate(ranked):
            value, low, high = (p[name][end] for end in ("value", "low", "high"))
            axes.plot([low, high], [k + shift] * 2, "|-", color=colour, linewidth=1.2, markersize=5)
            axes.plot(value, k + shift, mark, color=colour, markerfacecolor=face, markersize=5,
                      label=None if k else label)
    axes.set(xlim=(-0.02, 1.02), ylim=(len(ranked) - 0.5, -0.5), xlabel="share of the variance")
    axes.set_yticks(range(len(ranked)), [names[p["parameter"]] for p in ranked])
    axes.legend(loc="lower right", fontsize=8, handletextpad=0.3)
