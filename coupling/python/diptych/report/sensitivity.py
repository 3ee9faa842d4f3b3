# diptych: the page of a study with ranges
# SPDX-License-Identifier: LGPL-2.1-or-later

from matplotlib.figure import Figure

from . import studies as tables
from .charts.by_matplotlib import ruled, svg
from .charts.style import CONTINUUM, GRAINS
from .page.writing import write
from .tables.wording import number, rounded, suffix, typeset

ENOUGH = 0.9  # Q² below this: the indices say little
LOOKS = {"first": ("first: alone", GRAINS, "o", GRAINS, -0.16),
         "total": ("total: alone and with others", CONTINUUM, "s", "white", 0.16)}
COORDINATES = {"value": "", "logarithm": "in its logarithm", "share_of": "as a share of",
               "drop_from": "as 1 − a share of"}


def draw(study):
    record = study.record["sensitivity"]
    names = labels(record)
    parts = [{"title": typeset(one["quantity"]) + tables.unit_of(one), "basis": _basis(one, record),
              "doubtful": one["q2"] is not None and one["q2"] < ENOUGH, "panel": one["panel"],
              "chart": _chart(one, names) if one["parameters"] else None, "table": _indices(one, names)}
             for one in record["indices"]]
    write(study.folder, "sensitivity.html", record=study.record, n_points=record["points"], parts=parts,
          ranges=_ranges(record), failed=[point for point in tables.points(study) if point["messages"]],
          several=len({part["panel"] for part in parts}) > 1, disturbed=tables.disturbed(study),
          provenance=tables.provenance(study))


def short(key):
    """"friction angle peak" of the key continuum/friction_angle_peak."""
    return key.partition("/")[2].replace("_", " ")


def labels(record):
    """{key: label}; the index of a share or drop is that of the ratio, not of the key."""
    return {p["key"]: short(p["key"]) + (" (share)" if p["of"] else "") for p in record["parameters"]}


def by_total(one):
    """The parameters of a quantity, the largest total index first."""
    return sorted(one["parameters"], key=lambda p: -p["total"]["value"])


def _chart(one, names):
    """First and total indices of one quantity with their intervals, the largest total index on top. names: {key:
    label}."""
    ranked = by_total(one)
    height = 0.85 + 0.33 * len(ranked)
    left = (0.15 + 0.065 * max(map(len, names.values()))) / 4.5
    figure = Figure(figsize=(4.5, height))
    draw_indices(figure.add_axes([left, 0.5 / height, 0.97 - left, 1 - 0.8 / height]), ranked, names)
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
    axes.legend(loc="lower right", bbox_to_anchor=(1, 1), ncol=2, fontsize=8, handletextpad=0.3, borderaxespad=0.1,
                borderpad=0.1)


def _indices(one, names):
    """One row per parameter. names: {key: label}."""
    rows = [[names[p["parameter"]], rounded(p["first"], "", 2), rounded(p["total"], "", 2),
             rounded(p["correlation"], "", 2)]
            for p in by_total(one)]
    return {"head": ["parameter", "first index [95 %]", "total index [95 %]", "rank correlation"], "rows": rows}


def _ranges(record):
    """One row per parameter: key and range."""
    rows = []
    for p in record["parameters"]:
        how = " ".join(text for text in (COORDINATES[p["coordinate"]], short(p["of"])) if text)
        rows.append([p["key"], f"{p['low']:g} to {p['high']:g}", how or "–"])
    return {"head": ["key", "range", "varied uniformly"], "rows": rows}


def _basis(one, record):
    """"128 of 128 points, Q² 0.998; mean 0.365, standard deviation 0.058"."""
    unit = suffix(one["unit"])
    q2 = f", Q² {one['q2']:.3f}" if one["q2"] is not None else ""
    lost = [f"{one[name]} {words}" for name, words in (("failed", "failed"), ("without_value", "without a value"))
            if one[name]]
    left_out = f" (left out: {', '.join(lost)})" if lost else ""
    return (f"{one['used']} of {record['points']} points{left_out}{q2}; mean {number(one['mean'], unit, 3)}, "
            f"standard deviation {number(one['deviation'], unit, 2)}")
