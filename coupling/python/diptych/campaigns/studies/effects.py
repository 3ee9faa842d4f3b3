# diptych: effects of parameters: means over samples, and changes that exceed the scatter of the samples
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Evaluates a study without a reference. The statistics are described in README.md of this folder."""

import bisect
import functools
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd

from ...arrays import Interval, short
from ...entries import describe
from .points import Point
from ..runs.statistics import line_statistics, line_turn
from .study_file import Family, Study

PANELS = {"discrete": "grains", "continuum": "continuum", "difference": "difference",
          "material_point": "material point", "comparison": "comparison"}
MOST_SAMPLES = 1000
_ROUNDING = 1e-10  # smaller changes, relative to the values, are none
_WIDEST_TABLE = 6  # points in a row of the terminal

describe("effects.csv", """\
family: family of the point, if there are several; the parameters follow, a column each by the names of the axes
quantity: name of the quantity
panel: grains, continuum, difference (continuum minus grains), material point or comparison
unit: unit of the numbers
n: samples with a value
mean [as unit says]: mean over the samples; angles of lines: mean direction
low [as unit says]: lower end of the 95 % interval of the mean (Student); empty for less than two samples
high [as unit says]: upper end
deviation [as unit says]: standard deviation of one sample
""", "column")


def change_between(values: np.ndarray) -> tuple[Interval, float]:
    """values (points, samples), all finite. Largest minus smallest mean with the interval +- q s / sqrt(n); and s.

    s: residual standard deviation after the means of points and samples are removed; q: quantile of the studentized
    range, which covers all pairs of points at once. With two points this is Student's interval of the paired
    differences. Source: Tukey's method; Montgomery, Design and Analysis of Experiments (2017), sections 3.5 and 4.1.
    """
    k, n = values.shape
    means = values.mean(axis=1)
    change = float(np.ptp(means))
    if change <= _ROUNDING * np.abs(values).max():
        return Interval(0.0, 0.0, 0.0), 0.0
    if n < 2:
        return Interval(change, math.nan, math.nan), math.nan
    residual = values - means[:, None] - values.mean(axis=0) + values.mean()
    s = math.sqrt((residual**2).sum() / ((k - 1) * (n - 1)))
    half = _range_quantile(k, n) * s / math.sqrt(n)
    return Interval(change, change - half, change + half), s


@functools.cache
def _range_quantile(n_points: int, n_samples: int) -> float:
    """95 % quantile of the studentized range for the residuals of points on the same samples."""
    from scipy.stats import studentized_range  # loads slowly

    return float(studentized_range.ppf(0.95, n_points, (n_points - 1) * (n_samples - 1)))


def samples_needed(change: float, s: float, n_points: int) -> float:
    """The smallest number of samples whose interval is narrower than the change; NaN if it is above 1000."""
    from scipy.stats import studentized_range

    def resolves(n: int) -> bool:
        return studentized_range.sf(change * math.sqrt(n) / s, n_points, (n_points - 1) * (n - 1)) < 0.05

    found = bisect.bisect_left(range(2, MOST_SAMPLES + 1), True, key=resolves) + 2
    return found if found <= MOST_SAMPLES else math.nan


def _parameters(family: Family) -> list[tuple[str, list[str]]]:
    """(name, labels) of the parameters that vary independently. Axes that move together are one parameter."""
    if family.grid:
        return [(axis.name, [point.label for point in axis.points]) for axis in family.axes]
    return [(", ".join(axis.name for axis in family.axes),
             [", ".join(point.label for point in together)
              for together in zip(*(axis.points for axis in family.axes))])]


def _complete(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """values (levels, others, samples) without levels, others and samples that lack one; and which levels are left."""
    levels = np.flatnonzero(np.isfinite(values).any(axis=(1, 2)))
    values = values[levels]
    values = values[:, np.isfinite(values).any(axis=2).all(axis=0)]
    return values[:, :, np.isfinite(values).all(axis=(0, 1))], levels


def changes_of(study: Study, points: Sequence[Point], records: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """Changes along every parameter as in study.json, averaged over the others. Two points with values are needed."""
    changes = []
    for f, family in enumerate(study.families):
        mine = [record for point, record in zip(points, records) if point.family == f]
        parameters = _parameters(family)
        for a, (name, labels) in enumerate(parameters):
            for q, quantity in enumerate(study.quantities):
                found = np.array([record["quantities"][q]["values"] for record in mine], float)
                shaped = found.reshape(*(len(of_axis) for _, of_axis in parameters), -1)
                values, levels = _complete(np.moveaxis(shaped, a, 0).reshape(len(labels), -1, found.shape[1]))
                if len(levels) > 1:
                    changes.append({"family": family.name, "parameter": name, "quantity": quantity["name"],
                                    "panel": PANELS[quantity["source"]], "unit": quantity["unit"],
                                    **_change(quantity, values, [labels[k] for k in levels])})
    return changes


def _change(quantity: dict[str, Any], values: np.ndarray, labels: Sequence[str]) -> dict[str, Any]:
    """values (levels, others, samples), all finite"""
    if not values.size:
        return {"smallest": math.nan, "smallest_at": "", "largest": math.nan, "largest_at": "",
                "change": Interval(math.nan, math.nan, math.nan), "samples": 0, "verdict": "unknown",
                "samples_needed": math.nan}
    centre = line_statistics(values.ravel()).mean if quantity["line"] else 0.0
    turned = (line_turn(values, centre) if quantity["line"] else values).mean(axis=1)
    change, s = change_between(turned)
    means = turned.mean(axis=1) + centre
    low, high = int(np.argmin(means)), int(np.argmax(means))
    verdict = ("no change" if change.value == 0 else "unknown" if math.isnan(change.low) else
               "resolved" if change.low > 0 else "not resolved")
    needed = samples_needed(change.value, s, len(turned)) if verdict == "not resolved" else math.nan
    return {"smallest": means[low], "smallest_at": labels[low], "largest": means[high], "largest_at": labels[high],
            "change": change, "samples": turned.shape[1], "verdict": verdict, "samples_needed": needed}


def effects_table(study: Study, points: Sequence[Point], records: Sequence[dict[str, Any]]) -> pd.DataFrame:
    """effects.csv: a row per point, quantity and panel. The parameters come first, by the names of their axes."""
    rows = []
    for point, record in zip(points, records):
        family = study.families[point.family]
        places = [axis.points[k] for axis, k in zip(family.axes, point.places)]
        of_point = {"family": family.name} if len(study.families) > 1 else {}
        of_point |= {axis.name: place.label if math.isnan(place.value) else place.value
                     for axis, place in zip(family.axes, places)}
        rows += [{**of_point, "quantity": quantity["name"], "panel": PANELS[quantity["source"]],
                  "unit": quantity["unit"], **{key: value for key, value in found.items() if key != "values"}}
                 for quantity, found in zip(study.quantities, record["quantities"])]
    table = pd.DataFrame(rows)
    last = ["quantity", "panel", "unit", "n", "mean", "low", "high", "deviation"]
    return table[[*table.columns.drop(last), *last]]


def _shown(found: dict[str, Any]) -> str:
    """ "0.352 +- 0.013" """
    if math.isnan(found["mean"]):
        return "-"
    return f"{found['mean']:.4g}" + ("" if math.isnan(found["high"]) else f" +- {short(found['high'] - found['mean'])}")


def text_of_means(study: Study, points: Sequence[Point], records: Sequence[dict[str, Any]]) -> str:
    """A table for a terminal: a row per quantity, a column per point."""
    if len(points) > _WIDEST_TABLE:
        return f"the means of {len(points)} points are in effects.csv"
    one = len(study.families) == 1
    names = [("" if one else study.families[point.family].name + ": ") + ", ".join(point.labels) for point in points]
    axes = ", ".join(axis.name for axis in study.families[0].axes) if one else ""
    rows = {text_of_quantity(q): [_shown(record["quantities"][k]) for record in records]
            for k, q in enumerate(study.quantities)}
    table = pd.DataFrame.from_dict(rows, orient="index", columns=names).rename_axis(columns=axes)
    widths = " and half widths of their 95 % intervals" if len(study.seeds) > 1 else ""
    return f"means{widths}\n{table.to_string()}"


def text_of_quantity(quantity: dict[str, Any]) -> str:
    """ "10-90 % width of the band [mean diameters], grains" """
    panel = f", {PANELS[quantity['source']]}" if quantity["reduction"] == "key number" else ""
    return quantity["name"] + ("" if quantity["unit"] == "-" else f" [{quantity['unit']}]") + panel


WORDS = {"resolved": "changes beyond the scatter", "not resolved": "changes within the scatter",
         "unknown": "unknown, since fewer than two samples have a value at every point", "no change": "no change"}


def text_of_changes(study: Study, changes: Sequence[dict[str, Any]]) -> list[str]:
    """ "discrete/friction, changes within the scatter: peak t/s (grains: about 14 samples needed)", per verdict."""
    if len(study.seeds) < 2:
        return ["one sample has no scatter to compare a change with" +
                ("" if study.command == "continuum" else "; at least two are needed, such as --seeds 1-4")]
    lines = []
    for family, parameter in dict.fromkeys((change["family"], change["parameter"]) for change in changes):
        mine = [change for change in changes if (change["family"], change["parameter"]) == (family, parameter)]
        for verdict, words in WORDS.items():
            panels: dict[str, list[str]] = {}
            for change in mine:
                if change["verdict"] == verdict:
                    panels.setdefault(change["quantity"], []).append(change["panel"] + _needs(change))
            if panels:
                names = "; ".join(f"{name} ({', '.join(of_name)})" for name, of_name in panels.items())
                lines.append(f"{family}{': ' if family else ''}{parameter}, {words}: {names}")
    return lines


def _needs(change: dict[str, Any]) -> str:
    if change["verdict"] != "not resolved":
        return ""
    n = change["samples_needed"]
    return f": about {n:.0f} samples needed" if math.isfinite(n) else \
        f": not resolvable (more than {MOST_SAMPLES} samples)"
