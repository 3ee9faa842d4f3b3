# diptych: histories of runs: their tables, and means over a range of the progress
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A history is a table with ascending `progress`, the loading variable: axial strain, shear strain or time."""

from __future__ import annotations

import math
import os

import numpy as np
import pandas as pd
from scipy.integrate import cumulative_trapezoid, trapezoid

from ... import _diptych

SOURCES = ("discrete", "continuum", "material_point")  # panels with a table NAME.csv


def panel_table(folder: str, source: str) -> pd.DataFrame | None:
    """Numeric columns of a panel's table in a result folder; None if there is no table or it has no rows.

    Raises ValueError, with the file, for a table without the columns of the panel.
    """
    path = os.path.join(folder, source + ".csv")
    if not os.path.exists(path):
        return None
    try:
        table = pd.read_csv(path, usecols=list(_diptych.numeric_columns()[source]), dtype=float,
                            float_precision="round_trip")
    except (ValueError, pd.errors.ParserError) as error:
        raise ValueError(f"{path}: {error}") from error
    return table if len(table) else None


def is_beyond(progress: float, end: float) -> bool:
    """True if progress > end, up to the rounding of a sum of steps."""
    return progress > end + 1e-9 * abs(end)


def mean_over(x: np.ndarray, y: np.ndarray, begin: float, end: float) -> float:
    """Mean over [begin, end] of the broken line through (x, y), constant beyond its ends; for begin = end its value there."""
    if not end > begin:
        return float(np.interp(begin, x, y))
    inside = x[(x > begin) & (x < end)]
    at = np.concatenate([[begin], inside, [end]])
    return float(trapezoid(np.interp(at, x, y), at) / (end - begin))


def stress_ratio_of_means(table: pd.DataFrame, begin: float, end: float) -> float:
    """T/S: mean of t over a range of the progress divided by the mean of s.

    t is half the difference of the principal stresses, s half their sum. Unlike the mean of t/s it gives less weight to moments
    of small load.
    """
    yx = table["syx"] if "syx" in table else table["sxy"]
    t = np.hypot(0.5 * (table["sxx"] - table["syy"]), 0.5 * (table["sxy"] + yx)).to_numpy()
    s = (0.5 * (table["sxx"] + table["syy"])).to_numpy()
    x = table["progress"].to_numpy()
    return mean_over(x, t, begin, end) / mean_over(x, s, begin, end)


def running_mean(table: pd.DataFrame, name: str, width: float) -> np.ndarray:
    """For each row the mean of a column over the preceding `width` of progress; NaN before the first full width."""
    x, y = table["progress"].to_numpy(), table[name].to_numpy()
    at = np.union1d(x, x - width)
    integral = cumulative_trapezoid(np.interp(at, x, y), at, initial=0)
    means = (np.interp(x, at, integral) - np.interp(x - width, at, integral)) / width
    return np.where(x >= width * (1 - 1e-9), means, np.nan)


def resampled(table: pd.DataFrame, values: np.ndarray, grid: np.ndarray) -> np.ndarray:
    """Values of the rows at the progress of a grid, linear between rows; NaN beyond the ends of the history."""
    return np.interp(grid, table["progress"].to_numpy(), values, left=np.nan, right=np.nan)


def reduced(table: pd.DataFrame | None, quantity: dict) -> float:
    """The number that a quantity takes from a table, by its reduction. NaN if the history is too short."""
    if table is None:
        return math.nan
    how, name, begin, end = (quantity[key] for key in ("reduction", "column", "from", "to"))
    end = begin if how == "at" else end
    if how in ("strength", "mean", "at") and is_beyond(end, table["progress"].iloc[-1]):
        return math.nan
    if how == "strength":
        return stress_ratio_of_means(table, begin, end)
    if how in ("mean", "at"):
        return mean_over(table["progress"].to_numpy(), table[name].to_numpy(), begin, end)
    if how == "peak":
        return float(pd.Series(running_mean(table, name, end)).max())  # without the NaNs
    return float(table[name].max() if how == "largest" else table[name].iloc[-1])
