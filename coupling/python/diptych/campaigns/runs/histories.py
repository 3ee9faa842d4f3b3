# diptych: histories of runs: their tables, and means over a range of the progress
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A history is a table with ascending `progress`, the loading variable: axial strain, shear strain or time."""

import math
import os
from typing import Any

import numpy as np
import pandas as pd

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


is_beyond = _diptych.is_beyond  # (progress, end): progress > end, up to the rounding of a sum of steps
# (x, y, begin, end): mean over [begin, end] of the broken line through (x, y), constant beyond its ends;
# its value there if begin = end
mean_over = _diptych.mean_over


def columns_of(table: pd.DataFrame, *names: str) -> dict[str, np.ndarray]:
    """The named columns, those that the table has, as arrays."""
    return {name: table[name].to_numpy() for name in names if name in table}


def stress_ratio_of_means(table: pd.DataFrame, begin: float, end: float) -> float:
    """T/S: mean of t over a range of the progress divided by the mean of s; NaN if the history ends before."""
    return _diptych.stress_ratio_of_means(columns_of(table, "progress", "sxx", "sxy", "syx", "syy"), begin, end)


def nominal_stress_ratio(scene: Any, table: pd.DataFrame) -> np.ndarray:
    """t/s of the force on the platens and the pressure on the sides, as laboratories plot it; NaN without that
    pressure."""
    return _diptych.nominal_stress_ratio(scene, columns_of(table, "progress", "lower_fy", "upper_fy", "width"))


def running_mean(table: pd.DataFrame, name: str, width: float) -> np.ndarray:
    """For each row the mean of a column over the preceding `width` of progress; NaN before the first full width."""
    return _diptych.running_mean(table["progress"], table[name], width)


def peak_of_running_mean(table: pd.DataFrame, name: str, width: float) -> float:
    """NaN before the first full width."""
    return _diptych.peak_of_running_mean(table["progress"], table[name], width)


def peak_on_path(scene: Any, table: pd.DataFrame) -> float:
    """The largest mean of t/s over comparison/averaging_strain of strain along the path of an element test.

    The progress of the path may count rows. NaN before the first full width."""
    strain = np.interp(table["progress"], *scene.path_shape())
    return peak_of_running_mean(table.assign(progress=strain), "stress_ratio", scene.averaging_width())


def path_bins(scene: Any, count: int) -> np.ndarray:
    """Edges of about `count` parts of a prescribed path, in its progress. Parts end at the rows of the path, where it
    may turn back. Between two rows they have equal lengths; longer ways have more parts."""
    progress, strain = map(np.asarray, scene.path_shape())
    parts = np.maximum(1, np.round(count * np.diff(strain) / strain[-1]).astype(int))
    return np.append(np.concatenate([np.linspace(a, b, n, endpoint=False)
                                     for a, b, n in zip(progress, progress[1:], parts)]), progress[-1])


def curve_of(table: pd.DataFrame, name: str, width: float, grid: np.ndarray) -> np.ndarray:
    """The running mean of a column at the progress of a grid, linear between rows; NaN beyond the ends of the
    history."""
    values = running_mean(table, name, width)
    return np.interp(grid, table["progress"].to_numpy(), values, left=np.nan, right=np.nan)


def reduced(table: pd.DataFrame | None, quantity: dict) -> float:
    """The number that a quantity takes from a table, by its reduction. NaN if the history is too short."""
    if table is None:
        return math.nan
    how, name, begin, end = (quantity[key] for key in ("reduction", "column", "from", "to"))
    end = begin if how == "at" else end
    if how == "strength":
        return stress_ratio_of_means(table, begin, end)
    if how in ("mean", "at"):
        x = table["progress"]
        return math.nan if is_beyond(end, x.iloc[-1]) else mean_over(x, table[name], begin, end)
    if how == "peak":
        return peak_of_running_mean(table, name, end)
    return float(table[name].max() if how == "largest" else table[name].iloc[-1])
