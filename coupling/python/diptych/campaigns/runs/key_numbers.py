# diptych: the key numbers of a run, which studies take when a user names no quantity
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The rows of summary.csv: peak, strength, platen force, volume, inclination and width of the band in the last window."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd

from ... import _diptych, operators
from ...arrays import Band
from .folders import read_json
from .histories import is_beyond, mean_over, running_mean, stress_ratio_of_means

PEAK, STRENGTH, VOLUME = "peak t/s", "strength T/S from 0.3 % strain", "volumetric strain at the end"
FORCE = "platen force from 0.3 % strain"
ANGLE, WIDTH = "inclination of the band", "10-90 % width of the band"
# name, unit, whether it is the angle of a line; grains alone have no bands here
OF_GRAINS = ((PEAK, "-", False), (STRENGTH, "-", False), (FORCE, "P d", False), (VOLUME, "-", False))
OF_BOTH_PANELS = (*OF_GRAINS, (ANGLE, "degrees", True), (WIDTH, "mean diameters", False))
BAND_OPTIONS = ("max_bands", "huber_threshold", "correlation_length", "minimum_jump", "residual_floor")
SAME_PROGRESS = 1e-6
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
    if tables.get("continuum") is not None:
        values |= _band_of_nodes(folder, scene)
    return values


def snapshots_at(snapshots: Sequence[Any], *progress: float) -> list[Any] | None:
    """The snapshots at each progress; None if one is missing."""
    found = [next((s for s in snapshots if abs(s.progress - at) < SAME_PROGRESS), None) for at in progress]
    return None if None in found else found


def bands_between(scene: Any, pair: Sequence[Any], frame: Mapping[str, Any]) -> list[Band]:
    """The bands of the increment between two snapshots, the strongest first, without intervals. frame: replaces that of the
    snapshots."""
    keys = scene.dict()
    options = {name: keys["comparison"][name] for name in BAND_OPTIONS}
    return operators.find_bands(**{"mean_diameter": keys["sample"]["mean_diameter"], **operators.increment(*pair), **frame},
                                band_resamples=0, **options).bands


def _band_of_nodes(folder: str, scene: Any) -> dict[tuple[str, str], float]:
    """Inclination and width of the continuum's strongest band in the last window; nothing without a band."""
    edges = scene.dict()["comparison"]["window_edges"]
    last = [float(edge) for edge in (edges.split(",") if isinstance(edges, str) else edges)][-2:]
    pair = snapshots_at(_diptych.read_nodes(folder).snapshots, *last)
    found = bands_between(scene, pair, {}) if pair else []
    if not found:
        return {}
    angle = abs(found[0].angle_deg) if scene.is_mirror_symmetric() else found[0].angle_deg
    return {("continuum", ANGLE): angle, ("continuum", WIDTH): found[0].width_10_90 / scene.dict()["sample"]["mean_diameter"]}


def _platen_force(scene: Any, table: pd.DataFrame) -> float:
    """Mean vertical force of both platens in pressure x mean diameter, over the range of the later strength."""
    keys, progress = scene.dict(), table["progress"].to_numpy()
    if not is_beyond(progress[-1], _EARLY):
        return math.nan
    lower, upper = (mean_over(progress, table[name].to_numpy(), _EARLY, progress[-1]) for name in ("lower_fy", "upper_fy"))
    return (lower - upper) / 2 / (keys["loading"]["pressure"] * keys["sample"]["mean_diameter"])
