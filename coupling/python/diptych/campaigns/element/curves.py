# diptych: curves of grains and of the law's point along one path, and their numbers
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The path is divided into parts that end at its rows. Every curve has the mean of each part; t/s, anisotropy and
directions are those of the mean stress and fabric. Grains: (sample, part); NaN: beyond the end of a run.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
from scipy.integrate import cumulative_trapezoid

from ...arrays import rms
from ..runs.histories import path_bins, peak_on_path
from ..runs.statistics import line_statistics, paired, statistics

BINS = 200
# Quantity -> unit; directions are lines. The law has neither contacts nor their fabric.
QUANTITIES = {"stress_ratio": "-", "mean_stress": "P", "volumetric_strain": "-", "stress_direction": "degrees",
              "fabric_anisotropy": "-", "fabric_direction": "degrees", "coordination": "-", "solid_fraction": "-",
              **{c: "pressure" for c in ("sxx", "syy", "sxy")}, **{c: "-" for c in ("exx", "eyy", "exy")}}


@dataclass(kw_only=True)
class Curves:
    """progress (parts): the middle of each. grains: name -> (sample, parts). law: name -> (parts).

    ends: name -> (samples and law) in the last row; "peak": that of t/s. NaN if a run ended before the path."""

    progress: np.ndarray
    grains: dict[str, np.ndarray]
    law: dict[str, np.ndarray]
    ends: dict[str, np.ndarray]


def _means(x: np.ndarray, y: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Means of the broken line (x, y) between the edges; NaN from the part on in which it ends."""
    at = np.union1d(x, edges)
    integral = cumulative_trapezoid(np.interp(at, x, y), at, initial=0)
    means = np.diff(np.interp(edges, at, integral)) / np.diff(edges)
    return np.where(edges[1:] <= x[-1] * (1 + 1e-9), means, np.nan)


def _columns_of(table: pd.DataFrame) -> dict[str, np.ndarray]:
    """The columns whose means count; directions become the components of a tensor."""
    if "syx" in table:  # of grains
        a, double = table["fabric_anisotropy"], np.radians(2 * table["fabric_angle"])
        table = table.assign(sxy=0.5 * (table["sxy"] + table["syx"]), cosine=a * np.cos(double),
                             sine=a * np.sin(double))
    return {name: table[name].to_numpy() for name in (*QUANTITIES, "cosine", "sine") if name in table}


def _derived(found: dict[str, Any], pressure: float) -> dict[str, Any]:
    """With the quantities that follow from mean stress and fabric."""
    half, shear, s = 0.5 * (found["sxx"] - found["syy"]), found["sxy"], 0.5 * (found["sxx"] + found["syy"])
    found |= {"stress_ratio": np.hypot(half, shear) / np.where(s > 0, s, np.nan), "mean_stress": s / pressure,
              "stress_direction": 0.5 * np.degrees(np.arctan2(shear, half))}
    if "sine" in found:
        found |= {"fabric_anisotropy": np.hypot(found["sine"], found["cosine"]),
                  "fabric_direction": 0.5 * np.degrees(np.arctan2(found["sine"], found["cosine"]))}
    return found


def observed(scene: Any, tables: Sequence[pd.DataFrame], law: pd.DataFrame | None) -> Curves:
    """Curves of the samples and of the law along the path of the scene. law: None if it took no step."""
    edges, pressure = path_bins(scene, BINS), scene.dict()["loading"]["pressure"]
    curves, ends = [], []
    for table in (*tables, *([] if law is None else [law])):
        columns, x = _columns_of(table), table["progress"].to_numpy()
        curves.append(_derived({name: _means(x, values, edges) for name, values in columns.items()}, pressure))
        last = _derived({name: values[-1] for name, values in columns.items()}, pressure)
        ends.append({"peak": peak_on_path(scene, table), **(last if x[-1] >= edges[-1] * (1 - 1e-9) else {})})
    samples = curves[:len(tables)]
    return Curves(progress=0.5 * (edges[1:] + edges[:-1]), law={} if law is None else curves[-1],
                  grains={name: np.array([one[name] for one in samples]) for name in QUANTITIES},
                  ends={name: np.array([one.get(name, np.nan) for one in (*ends, *([{}] if law is None else []))])
                        for name in ("peak", *QUANTITIES)})


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


def key_numbers(curves: Curves) -> list[dict[str, Any]]:
    """Quantities of element.json with 95 % intervals over the samples: peak t/s, its friction angle, last values."""
    peaks, rows = curves.ends["peak"], []
    found = {"peak stress_ratio": ("-", peaks), "friction angle of the peak": ("degrees", np.degrees(np.arcsin(peaks))),
             **{f"last {name}": (unit, curves.ends[name]) for name, unit in QUANTITIES.items()}}
    for quantity, (unit, values) in found.items():
        is_line = quantity.endswith("_direction")
        grains, law = values[:-1], values[-1]
        difference = paired(grains, np.full(len(grains), law), "line" if is_line else "absolute").difference
        rows.append({"quantity": quantity, "unit": unit, "law": float(law), "difference": difference,
                     "grains": (line_statistics if is_line else statistics)(grains).interval()})
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
