# diptych: curves of grains and of the law's point along one path, and their numbers
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The path is divided into BINS equal parts of its progress. Every curve has the mean of each part; t/s, anisotropy and
directions are those of the mean stress and fabric. Grains: (sample, part); NaN: beyond the end of a run.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
from scipy.integrate import cumulative_trapezoid

from ...arrays import rms
from ..runs.statistics import Statistics, line_statistics, paired, statistics

BINS = 200
SPAN = 10  # parts of the path over which peaks and end values are averaged
# Quantity -> unit; directions are lines. The law has neither contacts nor their fabric.
QUANTITIES = {"stress_ratio": "-", "mean_stress": "P", "volumetric_strain": "-", "stress_direction": "degrees",
              "fabric_anisotropy": "-", "fabric_direction": "degrees", "coordination": "-", "solid_fraction": "-",
              **{c: "pressure" for c in ("sxx", "syy", "sxy")}, **{c: "-" for c in ("exx", "eyy", "exy")}}


@dataclass
class Curves:
    """progress (BINS): the middle of each part. grains: name -> (sample, BINS). law: name -> (BINS)."""

    progress: np.ndarray
    grains: dict[str, np.ndarray]
    law: dict[str, np.ndarray]


def _means(x: np.ndarray, y: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Means of the broken line (x, y) between the edges; NaN from the part on in which it ends."""
    at = np.union1d(x, edges)
    integral = cumulative_trapezoid(np.interp(at, x, y), at, initial=0)
    means = np.diff(np.interp(edges, at, integral)) / np.diff(edges)
    return np.where(edges[1:] <= x[-1] * (1 + 1e-9), means, np.nan)


def _curves_of(table: pd.DataFrame, edges: np.ndarray, pressure: float) -> dict[str, np.ndarray]:
    if "syx" in table:  # of grains
        a, double = table["fabric_anisotropy"], np.radians(2 * table["fabric_angle"])
        table = table.assign(sxy=0.5 * (table["sxy"] + table["syx"]), cosine=a * np.cos(double),
                             sine=a * np.sin(double))
    x = table["progress"].to_numpy()
    found = {name: _means(x, table[name].to_numpy(), edges) for name in (*QUANTITIES, "cosine", "sine")
             if name in table}
    half, shear, s = 0.5 * (found["sxx"] - found["syy"]), found["sxy"], 0.5 * (found["sxx"] + found["syy"])
    found |= {"stress_ratio": np.hypot(half, shear) / np.where(s > 0, s, np.nan), "mean_stress": s / pressure,
              "stress_direction": 0.5 * np.degrees(np.arctan2(shear, half))}
    if "sine" in found:
        found |= {"fabric_anisotropy": np.hypot(found["sine"], found["cosine"]),
                  "fabric_direction": 0.5 * np.degrees(np.arctan2(found["sine"], found["cosine"]))}
    return found


def observed(tables: Sequence[pd.DataFrame], law: pd.DataFrame | None, end: float, pressure: float) -> Curves:
    """Curves from progress 0 to `end`: of the samples' histories, and of the law's (none if it took no step)."""
    edges = np.linspace(0, end, BINS + 1)
    samples = [_curves_of(table, edges, pressure) for table in tables]
    return Curves(0.5 * (edges[1:] + edges[:-1]),
                  {name: np.array([one[name] for one in samples]) for name in QUANTITIES},
                  {} if law is None else _curves_of(law, edges, pressure))


def _mean_and_error(values: np.ndarray, name: str) -> tuple[np.ndarray, np.ndarray]:
    """Mean over the samples and its standard error; NaN where a sample has no value, or for the error of one sample."""
    if QUANTITIES[name] != "degrees":
        n, unknown = len(values), np.full(values.shape[1], np.nan)
        return values.mean(axis=0), values.std(axis=0, ddof=1) / np.sqrt(n) if n > 1 else unknown
    found = [line_statistics(column) for column in values.T]
    return (np.array([one.mean for one in found]), np.array([one.deviation for one in found]) / np.sqrt(len(values)))


def table_of(curves: Curves) -> pd.DataFrame:
    """element.csv: progress, then grains_NAME, grains_NAME_error (standard error of the mean) and law_NAME."""
    columns = {"progress": curves.progress}
    for name in QUANTITIES:
        columns[f"grains_{name}"], columns[f"grains_{name}_error"] = _mean_and_error(curves.grains[name], name)
        if name in curves.law:
            columns[f"law_{name}"] = curves.law[name]
    return pd.DataFrame(columns)


def _largest(values: np.ndarray) -> np.ndarray:
    """The largest mean over SPAN parts of curves (..., BINS)."""
    spans = np.apply_along_axis(np.convolve, -1, values, np.ones(SPAN) / SPAN, "valid")
    return np.fmax.reduce(spans, axis=-1)


def _last(values: np.ndarray, average: Callable[[Sequence[float]], Statistics]) -> np.ndarray:
    """The mean over the last SPAN parts of curves (..., BINS); NaN without all of them."""
    ends = values[..., -SPAN:]
    means = np.apply_along_axis(lambda end: average(end).mean, -1, ends)
    return np.where(np.isfinite(ends).all(axis=-1), means, np.nan)


def key_numbers(curves: Curves) -> list[dict[str, Any]]:
    """Quantities of element.json: largest t/s, and values in the last parts, with 95 % intervals over the samples."""
    rows = []
    for when, name in (("largest", "stress_ratio"), *(("last", name) for name in QUANTITIES)):
        is_line = QUANTITIES[name] == "degrees"
        average = line_statistics if is_line else statistics
        grains, law = (_largest(values) if when == "largest" else _last(values, average)
                       for values in (curves.grains[name], curves.law.get(name, np.full(BINS, np.nan))))
        difference = paired(grains, np.full(len(grains), law), "line" if is_line else "absolute").difference
        rows.append({"quantity": f"{when} {name}", "unit": QUANTITIES[name], "law": float(law),
                     "difference": difference, "grains": average(grains).interval()})
    return rows


def rms_differences(curves: Curves) -> list[dict[str, Any]]:
    """Root mean square over the path of law minus mean of the grains. error: its standard error (jackknife over the
    samples); noise: root mean square of the standard errors of the grains."""
    rows = []
    for name in ("stress_ratio", "mean_stress", "volumetric_strain"):
        if name in curves.law:
            grains, law = curves.grains[name], curves.law[name]
            n = len(grains)
            parts = [rms(law - np.delete(grains, k, axis=0).mean(axis=0)) for k in range(n)] if n > 1 else [np.nan]
            noise = rms(_mean_and_error(grains, name)[1]) if n > 1 else np.nan
            rows.append({"quantity": name, "unit": QUANTITIES[name], "value": rms(law - grains.mean(axis=0)),
                         "error": np.sqrt((n - 1) / n * np.sum((parts - np.mean(parts)) ** 2)) if n > 1 else np.nan,
                         "noise": noise})
    return rows
