# diptych: the key numbers of a run, which studies take when a user names no quantity
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The rows of summary.csv: peak, strength, platen force, volume, inclination and width of the band in the last window."""

from __future__ import annotations

import math
import os
from typing import Any

import pandas as pd

from .folders import read_json
from .histories import is_beyond, mean_over, running_mean, stress_ratio_of_means

PEAK, STRENGTH, VOLUME = "peak t/s", "strength T/S from 0.3 % strain", "volumetric strain at the end"
FORCE = "platen force from 0.3 % strain"
# name, unit, whether it is the angle of a line; bands are found only where both panels run
OF_ONE_PANEL = ((PEAK, "-", False), (STRENGTH, "-", False), (FORCE, "P d", False), (VOLUME, "-", False))
OF_BOTH_PANELS = (*OF_ONE_PANEL, ("inclination of the band", "degrees", True), ("10-90 % width of the band", "mean diameters", False))
_EARLY = 0.003  # the strength before depends on the start
_ROWS = {"discrete": "grains", "continuum": "continuum", "difference": "difference"}


def key_values(folder: str, scene: Any, tables: dict[str, pd.DataFrame | None]) -> dict[tuple[str, str], float]:
    """(panel, name) -> value. From comparison.json if both panels ran, in which bands correspond; else from the panel's table.

    Raises ValueError with the name of a damaged file.
    """
    if len(tables) > 1:
        rows = read_json(os.path.join(folder, "comparison.json"))["summary"]  # "width of the band (0.02 to 0.03)"
        return {(panel, row["quantity"].partition(" (")[0]): math.nan if row[key]["value"] is None else row[key]["value"]
                for row in rows for panel, key in _ROWS.items()}
    values = {}
    for panel, table in tables.items():
        if table is not None:
            along_time = scene.loading_variable() == "time"
            values |= {(panel, PEAK): float(pd.Series(running_mean(table, "stress_ratio", scene.averaging_width())).max()),
                       (panel, STRENGTH): math.nan if along_time
                       else stress_ratio_of_means(table, _EARLY, table["progress"].iloc[-1]),
                       (panel, FORCE): math.nan if along_time else _platen_force(scene, table),
                       (panel, VOLUME): float(table["volumetric_strain"].iloc[-1])}
    return values


def _platen_force(scene: Any, table: pd.DataFrame) -> float:
    """Mean vertical force of both platens in pressure x mean diameter, over the range of the later strength."""
    keys, progress = scene.dict(), table["progress"].to_numpy()
    if not is_beyond(progress[-1], _EARLY):
        return math.nan
    lower, upper = (mean_over(progress, table[name].to_numpy(), _EARLY, progress[-1]) for name in ("lower_fy", "upper_fy"))
    return (lower - upper) / 2 / (keys["loading"]["pressure"] * keys["sample"]["mean_diameter"])
