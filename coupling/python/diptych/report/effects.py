# diptych: the page of a study without a reference: quantities over parameters, means and changes
# SPDX-License-Identifier: LGPL-2.1-or-later

import textwrap

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, NullLocator
from matplotlib.transforms import ScaledTranslation

from . import studies as tables
from .charts.by_matplotlib import legend_above, place_labels, ruled, svg
from .charts.style import CONTINUUM, DASHES, FAINT, GRAINS, INK, LINE_COLOURS
from .page.writing import write
from .studies import PANEL_WORDS, unit_of
from .tables.wording import number, suffix, typeset

MOST_CURVES = 6  # ticked when the page opens
PANELS = {"discrete": ("grains", GRAINS, "o", "-"), "continuum": ("continuum", CONTINUUM, "s", DASHES)}
WIDE = 20   # a numeric axis that spans more than this factor is logarithmic
MOST_TICKS = 8
STEP = 9    # points (1/72 inch) between the lines at one value, so that their intervals do not cover each other
BESIDE = 4  # points between the samples and their mean


def draw(study, curves):
    by_name = {}  # {name: {panel: index of the quantity}}
    for k, quantity in enumerate(study.quantities):
        by_name.setdefault(quantity["name"], {})[quantity["source"]] = k
    parts = [(family["name"], [_part(study, family, name, places) for name, places in by_name.items()])
             for family in study.record["families"] if family["axes"]]
    write(study.folder, "effects.html", record=study.record, n_samples=len(study.record["seeds"]) or 1,
          changes=_changes(study), families=parts, disturbed=tables.disturbed(study), points=tables.points(study),
          n_ticked=MOST_CURVES, curves=curves, provenance=tables.provenance(study))


def _part(study, family, name, places):
    """Title, charts (panels, difference) and table of one quantity; charts without values are left out."""
    unit = unit_of(study.quantities[next(iter(places.values()))])
    panels = {panel: k for panel, k in places.items() if panel != "difference"}
    charts = [_over_parameter(study, family, panels, typeset(name) + unit)]
    if "difference" in places:
        charts.append(_over_parameter(study, family, {"difference": places["difference"]},
                                      PANEL_WORDS["difference"] + unit))
    return {"title": typeset(name), "charts": [chart for chart in charts if chart],
            "means": _means(study, family, places)}


def _over_parameter(study, family, places, label):
    """Means with 95 % intervals of one quantity over the first parameter of a family, samples as dots. One line per
    panel and per value of the other parameters. places: {panel: index of the quantity}. None without values."""
    across, lines = family["axes"][0], _lines(study, family)
    # inches, for long names
    below = 0.5 if _are_numbers(across) else 0.45 + 0.033 * max(len(p["label"]) for p in across["points"])
    height = 2.8 + below
    figure = Figure(figsize=(5.2, height))
    axes = ruled(figure.add_axes([0.17, below / height, 0.81, 2.67 / height]))
    place_labels(axes, 0.004, 0.13 / height)
    drawn = [(panel, k, name, points) for panel, k in places.items() for name, points in lines.items()
             if any(point["quantities"][k]["mean"] is not None for _, point in points)]
    if not drawn:
        return None
    positions, names = _positions(axes, across), list(lines)
    for n, (panel, k, name, points) in enumerate(drawn):
        word, colour, mark, dashes = PANELS.get(panel, ("", INK, "D", "-"))
        dashes = dashes if _are_numbers(across) else ""
        if len(names) > 1:
            colour = LINE_COLOURS[names.index(name) % len(LINE_COLOURS)]
        shift = STEP * (n - (len(drawn) - 1) / 2)
        at, beside = (axes.transData + ScaledTranslation(points_right / 72, 0, figure.dpi_scale_trans)
                      for points_right in (shift, shift - BESIDE))
        for place, point in points:
            values = [v for v in point["quantities"][k]["values"] if v is not None]
            axes.plot([positions[place]] * len(values), values, "o", color=colour, transform=beside, markersize=3,
                      alpha=0.6, markeredgewidth=0)
        look = {"color": colour, "transform": at, "label": ", ".join(text for text in (word, name) if text),
                "markerfacecolor": "white" if panel == "continuum" and len(names) > 1 else colour}
        _line([(positions[place], point["quantities"][k]) for place, point in points], axes, mark, dashes, look)
    if list(places) == ["difference"]:
        axes.axhline(0, color=FAINT, linewidth=0.9)
    axes.set(xlabel=across["name"])
    axes.set_ylabel(textwrap.fill(label, 40), va="top")  # a second line goes to the right
    if len(drawn) > 1:
        legend_above(axes, fontsize=8, handlelength=2.2)
    _set_limits(axes, positions, [point["quantities"][k] for _, k, _, points in drawn for _, point in points])
    return svg(figure, f"{label} over {across['name']}: means with 95 % intervals, samples as dots.")


def _set_limits(axes, positions, found):
    """Shows all samples. An interval much longer than their range is cut, since it would hide them."""
    values = [v for one in found for v in one["values"] if v is not None]
    ends = [one[end] for one in found for end in ("low", "high") if one[end] is not None]
    room = (max(values) - min(values)) or 0.1 * abs(values[0]) or 1
    low, high = max(min(values + ends), min(values) - room), min(max(values + ends), max(values) + room)
    margin = 0.05 * (high - low or room)
    axes.set_ylim(low - margin, high + margin)
    ends = np.array([min(positions), max(positions)], float)
    if axes.get_xscale() == "log":
        axes.set_xlim(*(ends * (ends[1] / ends[0]) ** np.array([-0.08, 0.08])))
    else:
        axes.set_xlim(*(ends + np.array([-0.12, 0.12]) * (np.ptp(ends) or 1)))


def _line(found, axes, mark, dashes, look):
    """Means and their intervals. found: [(position, quantity of a point)]."""
    known = [(x, one) for x, one in found if one["mean"] is not None]
    x, means = [x for x, _ in known], [one["mean"] for _, one in known]
    axes.plot(x, means, mark, linestyle=dashes, linewidth=1.2, markersize=5, **look)
    colour, shift = look["color"], look["transform"]
    for at, one in known:
        if one["low"] is not None:
            axes.plot([at] * 2, [one["low"], one["high"]], "_-", color=colour, transform=shift, linewidth=1,
                      markersize=5)


def _lines(study, family):
    """{values of the other parameters: [(place on the first axis, point)]}. Parameters that move together are one
    line."""
    lines, others = {}, family["axes"][1:] if family["grid"] else []
    for _, point in study.of_family(family["name"]):
        name = ", ".join(f"{axis['name']} {label}" for axis, label in zip(others, point["labels"][1:]))
        place = [p["label"] for p in family["axes"][0]["points"]].index(point["labels"][0])
        lines.setdefault(name, []).append((place, point))
    values = [k if p["value"] is None else p["value"] for k, p in enumerate(family["axes"][0]["points"])]
    return {name: sorted(points, key=lambda entry: values[entry[0]]) for name, points in lines.items()}


def _are_numbers(across):
    return all(p["value"] is not None for p in across["points"])


def _positions(axes, across):
    """Positions of the values: numbers, or places in the list if one of them is a text."""
    values, labels = [p["value"] for p in across["points"]], [p["label"] for p in across["points"]]
    if not _are_numbers(across):
        axes.set_xticks(range(len(labels)), labels, rotation=30, ha="right")
        return range(len(labels))
    if min(values) > 0 and max(values) > WIDE * min(values):
        axes.set_xscale("log")
    if len(values) <= MOST_TICKS:
        axes.xaxis.set_major_locator(FixedLocator(values))
        axes.xaxis.set_minor_locator(NullLocator())
        axes.xaxis.set_major_formatter("{x:g}")
    return np.array(values, float)


def _changes(study):
    """One row per quantity, panel and parameter: verdict, change, smallest and largest mean."""
    several = len({(row["family"], row["parameter"]) for row in study.record["changes"]}) > 1
    head = ["quantity", "panel", *(["parameter"] if several else []), "verdict", "change [95 %]", "smallest mean",
            "largest mean", "samples"]
    rows = []
    for row in study.record["changes"]:
        where = [": ".join(filter(None, (row["family"], row["parameter"])))] if several else []
        panel = PANEL_WORDS["difference"] if row["panel"] == "difference" else row["panel"]
        rows.append([typeset(row["quantity"]), panel, *where, _verdict(row), *_ends(study, row), row["samples"]])
    return {"head": head, "rows": rows}


def _verdict(row):
    if row["verdict"] != "not resolved":
        return row["verdict"]
    n = row["samples_needed"]
    return f"not resolved: needs about {n} samples" if n else "not resolvable (more than 1000 samples)"


def _ends(study, row):
    """Change, smallest and largest mean. The means of a few complete samples would not be those of the charts."""
    unit = suffix(row["unit"])
    if row["verdict"] == "no change":
        return "0", number(row["smallest"], unit), number(row["smallest"], unit)
    if row["samples"] < min(2, len(study.record["seeds"]) or 1):
        return "–", "–", "–"
    means = (f"{number(row[end], unit)} at {row[end + '_at']}" for end in ("smallest", "largest"))
    return number(row["change"], unit, 3), *means


def _means(study, family, places):
    """One row per point: mean of each panel with its interval. places: {panel: index of the quantity}."""
    rows = []
    for k, point in study.of_family(family["name"]):
        rows.append([", ".join(point["labels"]) or study.name(k),
                     *(_mean(point["quantities"][q], study.quantities[q]) for q in places.values())])
    return {"head": [", ".join(axis["name"] for axis in family["axes"]),
                     *(PANEL_WORDS[panel] or "mean" for panel in places)], "rows": rows}


def _mean(found, quantity):
    if found["mean"] is None:
        return "none"
    text = number({"value": found["mean"], "low": found["low"], "high": found["high"]}, suffix(quantity["unit"]))
    n_missing = len(found["values"]) - found["n"]
    return text + (f" ({found['n']} of {len(found['values'])} samples)" if n_missing else "")
