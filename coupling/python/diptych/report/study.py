# diptych: report.html of a study: error over cost, maps of classes
# SPDX-License-Identifier: LGPL-2.1-or-later

import itertools

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.ticker import LogLocator

from . import effects, sensitivity
from . import studies as tables
from .charts.by_matplotlib import place_labels, ruled, styled, svg
from .charts.style import FAINT, INK, LINE_COLOURS, signed
from .page.writing import write
from .studies import CLASSES, PANEL_WORDS, load

CURVE_NAMES = {"stress_ratio": "stress ratio t/s", "volumetric_strain": "volumetric strain"}
FAMILY_MARKS = "osD^vP"
FEW = 50  # ranges below this ratio have ticks between the decades
LEAST_ERROR = 1e-6  # smaller differences count as zero


@styled()
def draw(folder):
    study = load(folder)
    curves = [{"title": f"{PANEL_WORDS[panel]}, {words}", "progress": _numbers(progress),
               "rows": [_numbers(row) for row in rows[name]]}
              for panel, (progress, rows) in study.curves.items() for name, words in CURVE_NAMES.items()]
    if "sensitivity" in study.record:
        sensitivity.draw(study)
    elif study.has_reference:
        _draw_errors(study, curves)
    else:
        effects.draw(study, curves)


def _numbers(values):
    """With five digits for the script of the page; None: no value."""
    return [None if not np.isfinite(v) else float(f"{v:.5g}") for v in values]


def _draw_errors(study, curves):
    charts = [(_error_against_cost(study, k, reference), ", ".join([q["name"], *study.points[reference]["labels"]]))
              for reference in study.references for k, q in enumerate(study.quantities)]
    judged = any(q["limit"] for q in study.quantities)  # else no point is right or wrong
    maps = [(family["name"], [(title, _class_map(study, family, pair, points))
                              for title, pair, points in parts_of(study, family)])
            for family in study.record["families"]] if judged else []
    write(study.folder, "study.html", record=study.record, judged=judged, counts=tables.counts(study),
          n_points=len(study.points) - len(study.references), cheapest=tables.cheapest(study),
          disturbed=tables.disturbed(study), charts=[chart for chart in charts if chart[0]],
          missing=[name for picture, name in charts if not picture], maps=[one for one in maps if one[1]],
          classes=CLASSES, orders=tables.orders(study), points=tables.points(study),
          curves=curves, provenance=tables.provenance(study))


def _mark(study, family):
    k = [f["name"] for f in study.record["families"]].index(family)
    return LINE_COLOURS[k % len(LINE_COLOURS)], FAMILY_MARKS[k % len(FAMILY_MARKS)]


def _error_against_cost(study, place, reference):
    """|error| of a quantity over CPU seconds for all points of a reference, with front, limit and scatter of the
    samples. None without points."""
    figure = Figure(figsize=(4.7, 3.5))
    axes = figure.add_axes([0.16, 0.14, 0.815, 0.83])
    place_labels(axes, 0.035, 0.055)
    if not draw_error_against_cost(axes, study, place, reference):
        return None
    name = study.quantities[place]["name"]
    return svg(figure, f"Error of {name} against CPU seconds of every finished point, with front, limit and scatter.")


def draw_error_against_cost(axes, study, place, reference):
    """Draws |error| over CPU seconds into axes. Returns False without points."""
    ruled(axes)
    quantity, scatter = study.quantities[place], study.points[reference]["quantities"][place]["scatter"]
    shown = []
    for k, cost in study.cost.items():
        error = study.points[k]["quantities"][place]["error"]
        is_known = error["value"] is not None and abs(error["value"]) > LEAST_ERROR and cost["cpu_s"] > 0
        if is_known and study.points[k]["reference"] == reference != k:
            shown.append((k, cost, error))
    if not shown:
        return False
    factor = 100 if quantity["relative"] else 1
    for k, cost, error in shown:
        family = study.points[k]["family"]
        colour, mark = _mark(study, family)
        value, ends = abs(error["value"]), (error["low"], error["high"])
        if None not in ends:
            low = 0 if ends[0] <= 0 <= ends[1] else min(map(abs, ends))
            axes.plot([cost["cpu_s"]] * 2, [factor * max(low, 0.1 * value), factor * max(map(abs, ends))], color=colour,
                      linewidth=0.7, alpha=0.5)
        judged = study.points[k]["class"]
        axes.plot(cost["cpu_s"], factor * value, mark, color=colour, markersize=5,
                  markerfacecolor=colour if judged in ("right", "struggled", "unjudged") else "white")
    front = sorted((cost["cpu_s"], abs(error["value"])) for _, cost, error in shown
                   if quantity["name"] in cost["front_of"])
    if front:
        across, down = zip(*front)
        axes.step(across, factor * np.array(down), where="post", color=INK, linewidth=0.9, linestyle=(0, (4, 2)),
                  label="front")
    if quantity["limit"]:
        axes.axhline(factor * quantity["limit"], color="#00573d", linewidth=1, label="limit")
    if scatter:
        n = max(1, len(study.record["seeds"]))
        axes.axhspan(1e-12, factor * scatter / np.sqrt(n), color=FAINT, alpha=0.18, linewidth=0,
                     label=f"scatter of {n} samples’ mean")
    for family in study.record["families"]:
        if any(study.points[k]["family"] == family["name"] for k, _, _ in shown):
            colour, mark = _mark(study, family["name"])
            axes.plot([], [], mark, color=colour, markersize=5, linestyle="", label=family["name"] or "points")
    values = factor * np.array([abs(error["value"]) for _, _, error in shown])
    axes.set(xscale="log", yscale="log", xlabel="CPU seconds per sample",
             ylabel="|error|" + (" (%)" if quantity["relative"] else ""))
    floor = [factor * scatter / np.sqrt(max(1, len(study.record["seeds"])))] if scatter else []
    limit = [factor * quantity["limit"]] if quantity["limit"] else []
    axes.set_ylim(0.5 * min([*values, *limit, *floor]), 2 * max([*values, *limit]))
    for axis, ends in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim())):
        axis.set_major_locator(LogLocator(subs=(1, 2, 5) if ends[1] < FEW * ends[0] else (1,)))
        axis.set_major_formatter("{x:g}")
        axis.set_minor_formatter("")
    axes.legend(loc="best", fontsize=8, handlelength=1.6)
    return True


def _position(axis, value):
    """Position of a value on an axis of cells, interpolated by its logarithm; NaN: not possible."""
    places = [p["value"] for p in axis["points"]]
    if any(p is None or p <= 0 for p in places) or value <= 0 or len(places) < 2:
        return np.nan
    logs, order = np.log(places), np.argsort(places)
    steps = np.arange(len(places))[order]
    found = np.interp(np.log(value), logs[order], steps, left=np.nan, right=np.nan)
    if np.isnan(found):  # beyond the outer cells: extrapolate
        ends = (0, 1) if np.log(value) < logs.min() else (-2, -1)
        (a, b), (u, v) = logs[order][list(ends)], steps[list(ends)]
        found = v + (np.log(value) - b) / (b - a) * (v - u)
    return found


def parts_of(study, family):
    """Maps of a family: [(title, axes (across, down or None), {labels: point})], one for every value of the axes beyond
    two."""
    axes = family["axes"]
    if not axes or not family["grid"]:
        return []
    pair = axes[0], axes[1] if len(axes) > 1 else None
    by_labels = {tuple(point["labels"]): point for _, point in study.of_family(family["name"])}
    parts = []
    for others in itertools.product(*[[p["label"] for p in axis["points"]] for axis in axes[2:]]):
        title = ", ".join(f"{axis['name']} {label}" for axis, label in zip(axes[2:], others))
        parts.append((title, pair, {labels: point for labels, point in by_labels.items() if labels[2:] == others}))
    return parts


def _class_map(study, family, pair, points):
    across, down = pair
    n, m = len(across["points"]), len(down["points"]) if down else 1
    longest = max(len(p["label"]) for p in across["points"])
    left = 0.55 + 0.075 * max([len(p["label"]) for p in down["points"]] if down else [0])
    bottom = 0.55 + (0.055 * longest if longest > 8 else 0)
    figure = Figure(figsize=(left + 0.1 + 0.62 * n, bottom + 0.1 + 0.5 * m))
    width, height = figure.get_size_inches()
    draw_classes(figure.add_axes([left / width, bottom / height, 0.62 * n / width, 0.5 * m / height]), study, family,
                 pair, points)
    return svg(figure,
               "Classes of the points: " + "; ".join(f"{', '.join(labels)}: {point['class']}" for labels, point in
                                                             points.items()) + ".")


def draw_classes(axes, study, family, pair, points):
    """Draws class and worst error of every point, and the borders, into axes. pair and points come from parts_of()."""
    across, down = pair
    n, m = len(across["points"]), len(down["points"]) if down else 1
    for labels, point in points.items():
        i = [p["label"] for p in across["points"]].index(labels[0])
        j = [p["label"] for p in down["points"]].index(labels[1]) if down else 0
        colour, ink, letter = CLASSES[point["class"]]
        axes.add_patch(Rectangle((i - 0.5, j - 0.5), 1, 1, facecolor=colour, edgecolor="white", linewidth=1.5))
        worst = worst_error(study, point)
        axes.text(i, j + (0.17 if worst else 0), letter + ("" if point["certain"] else "?"), ha="center", va="center",
                  color=ink, fontsize=9, fontweight="bold")
        if worst:
            axes.text(i, j - 0.22, worst, ha="center", va="center", color=ink, fontsize=6.5)
    for border in study.record["borders"]:
        if down and border["family"] == family["name"] and {border["x"], border["y"]} == {across["name"], down["name"]}:
            _draw_border(axes, border, across, down)
    turned = max(len(p["label"]) for p in across["points"]) > 8
    axes.set(xlim=(-0.5, n - 0.5), ylim=(-0.5, m - 0.5), xticks=range(n), yticks=range(m) if down else [],
             xlabel=across["name"], ylabel=down["name"] if down else "")
    axes.set_xticklabels([p["label"] for p in across["points"]], rotation=45 if turned else 0,
                         ha="right" if turned else "center")
    if down:
        axes.set_yticklabels([p["label"] for p in down["points"]])
    axes.tick_params(length=0)


def worst_error(study, point):
    """The largest error relative to its limit, as "+3.4 %"; empty: unknown."""
    found = [(abs(q["error"]["value"]) / of["limit"], q["error"]["value"], of)
             for q, of in zip(point["quantities"], study.quantities)
             if of["limit"] and q["error"]["value"] is not None]
    if not found or point["class"] in ("refused", "stopped", "not run"):
        return ""
    _, error, of = max(found, key=lambda entry: entry[0])
    return signed(f"{100 * error:+.1f} %" if of["relative"] else f"{error:+.2g}")


def _draw_border(axes, border, across, down):
    """Draws y = c x^p, also if the axes of the map are swapped."""
    first = across if across["name"] == border["x"] else down
    values = [p["value"] for p in first["points"]]
    if any(v is None or v <= 0 for v in values):
        return
    x = np.geomspace(min(values) / 3, 3 * max(values), 200)
    y = border["coefficient"] * x ** border["exponent"]
    second = down if first is across else across
    u = np.array([_position(first, v) for v in x])
    w = np.array([_position(second, v) for v in y])
    line = (u, w) if first is across else (w, u)
    axes.plot(*line, color=INK, linewidth=1.4, linestyle=(0, (5, 2)), label=border["label"])
