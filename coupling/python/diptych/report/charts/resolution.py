# diptych: charts of the homogenised stress over the averaging width
# SPDX-License-Identifier: LGPL-2.1-or-later

from .drawing import Figure
from .style import FAINT, GRAINS, INK, THIRD, framed, svg
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


def _over_widths(axes, widths, study):
    axes.x.is_log = True
    axes.set(xticks=widths)
    if study.get("plateau_d"):
        axes.axvspan(*study["plateau_d"], color=FAINT, alpha=0.22)


def _points(rows, key, words, study, stress):
    names = list(dict.fromkeys(p.get("name", "") for row in rows for p in row.get("points") or []))
    if not names:
        return None
    figure = Figure((4.5, 3.9), [[0.15, 0.57 - 0.44 * k, 0.825, 0.385] for k in range(2)])
    for axes, quantity, label in zip(figure.axes, ("s", "t_over_s"), (stress, "stress ratio t/s")):
        _over_widths(axes, [row[key] for row in rows], study)
        axes.set(ylabel=label)
        for name, (colour, mark, dashes) in zip(names, LOOKS):
            points = [(row[key], plain(p.get(quantity))) for row in rows for p in row.get("points") or []
                      if p.get("name") == name and plain(p.get(quantity)) is not None]
            if points:
                axes.plot(*zip(*points), color=colour, marker=mark, markersize=4, linestyle=dashes, label=name)
        axes.set(ylim=(min(0, axes.y.limits()[0]), None))
    figure.axes[0].legend(3)
    figure.axes[0].x.has_numbers = False
    axes.set(xlabel=words)
    return svg(figure, f"Mean stress and stress ratio at {len(names)} points against the {words}.")


def _scatter(rows, key, words, study):
    figure, axes = framed(words, "scatter (% of the mean)")
    for quantity, label, colour, mark in (("scatter_s", "s", GRAINS, "o"), ("scatter_t", "t", INK, "s")):
        points = [(row[key], 100 * plain(row.get(quantity))) for row in rows if plain(row.get(quantity)) is not None]
        if points:
            axes.plot(*zip(*points), color=colour, marker=mark, markersize=4, label=label)
    if axes.is_empty:
        return None
    _over_widths(axes, [row[key] for row in rows], study)
    axes.set(ylim=(0, None))
    axes.legend()
    return svg(figure, f"Scatter of mean and deviatoric stress over the sample against the {words}.")
