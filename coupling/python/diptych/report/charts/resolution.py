# diptych: charts of the homogenised stress over the averaging width
# SPDX-License-Identifier: LGPL-2.1-or-later

from matplotlib.figure import Figure

from .style import FAINT, GRAINS, INK, THIRD, legend_above, ruled, svg
from ..data.numbers import plain

LOOKS = ((GRAINS, "o", "-"), (INK, "s", (0, (5, 1.5))), (THIRD, "^", (0, (2, 1.2))))


def figures(study, stress="mean stress s (P)"):
    """List of (Picture, caption): values at points and scatter over cells, against the width of the kernel and the size
    of the cells. stress: label of s."""
    shaded = " Shaded: the plateau." if study.get("plateau_d") else ""
    found = []
    for rows, key, words in ((study.get("kernel") or [], "width_d", "standard deviation of the kernel (d)"),
                             (study.get("cells") or [], "size_d", "size of the cells (d)")):
        rows = [row for row in rows if plain(row.get(key))]
        found.append((_points(rows, key, words, study, stress),
                      f"Stress of the grains at points, against the {words[:-4]}.{shaded}"))
        found.append((_scatter(rows, key, words, study),
                      f"Scatter of s and t over the sample, relative to the mean, against the {words[:-4]}.{shaded}"))
    return [(picture, caption) for picture, caption in found if picture]


def _frame(figure, box, study):
    axes = ruled(figure.add_axes(box))
    if study.get("plateau_d"):
        axes.axvspan(*study["plateau_d"], color=FAINT, alpha=0.22, linewidth=0)
    return axes


def _ticks(axes, widths):
    axes.set_xscale("log")
    axes.set_xticks(widths, [f"{w:g}" for w in widths])
    axes.minorticks_off()


def _points(rows, key, words, study, stress):
    names = list(dict.fromkeys(p.get("name", "") for row in rows for p in row.get("points") or []))
    if not names:
        return None
    figure = Figure(figsize=(4.5, 3.9))
    for k, (quantity, label) in enumerate((("s", stress), ("t_over_s", "stress ratio t/s"))):
        axes = _frame(figure, [0.15, 0.57 - 0.44 * k, 0.825, 0.385], study)
        _ticks(axes, [row[key] for row in rows])
        axes.set_ylabel(label)
        axes.tick_params(labelbottom=k == 1)
        for name, (colour, mark, dashes) in zip(names, LOOKS):
            points = [(row[key], plain(p.get(quantity))) for row in rows for p in row.get("points") or []
                      if p.get("name") == name and plain(p.get(quantity)) is not None]
            if points:
                axes.plot(*zip(*points), color=colour, marker=mark, markersize=4, linestyle=dashes, label=name)
        axes.set_ylim(bottom=min(0, axes.get_ylim()[0]))
        if k == 0:
            legend_above(axes, 3)
    axes.set_xlabel(words)
    return svg(figure, f"Mean stress and stress ratio at {len(names)} points against the {words}.")


def _scatter(rows, key, words, study):
    figure = Figure(figsize=(4.5, 3.1))
    axes = _frame(figure, [0.15, 0.16, 0.825, 0.8], study)
    for quantity, label, colour, mark in (("scatter_s", "s", GRAINS, "o"), ("scatter_t", "t", INK, "s")):
        points = [(row[key], 100 * plain(row.get(quantity))) for row in rows if plain(row.get(quantity)) is not None]
        if points:
            axes.plot(*zip(*points), color=colour, marker=mark, markersize=4, label=label)
    if not axes.lines:
        return None
    _ticks(axes, [row[key] for row in rows])
    axes.set(xlabel=words, ylabel="scatter (% of the mean)", ylim=(0, None))
    legend_above(axes)
    return svg(figure, f"Scatter of mean and deviatoric stress over the sample against the {words}.")
