# diptych: the key numbers of a run, which studies take when a user names no quantity
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The rows of summary.csv: peak, strength, platen force, volume, inclination and width of the band in the last window.
Their keys, names and margins are those of coupling/comparison/key_quantities.h."""

import math
import os
from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd

from ... import _diptych, operators
from ...arrays import Band
from .folders import read_json
from .histories import columns_of

QUANTITIES: dict[str, dict[str, Any]] = {one["key"]: one for one in _diptych.key_quantities()}
OF_PANEL = [key for key, one in QUANTITIES.items() if not one["is_of_band"]]  # grains alone have no bands here
BAND_OPTIONS = ("max_bands", "huber_threshold", "correlation_length", "minimum_jump", "residual_floor")
SAME_PROGRESS = 1e-6
_ROWS = {"discrete": "grains", "continuum": "continuum", "difference": "difference"}


def summary_of(folder: str) -> dict[str, dict[str, Any]]:
    """The rows of the summary of comparison.json, by key. Raises ValueError with the file."""
    path = os.path.join(folder, "comparison.json")
    rows = read_json(path)["summary"]
    if not all("key" in row for row in rows):
        raise ValueError(f"{path}: an earlier version wrote its summary, without keys; diptych compare {folder} "
                         "writes it again")
    return {row["key"]: row for row in rows}


def panel_values(scene: Any, table: pd.DataFrame) -> dict[str, float]:
    """The key numbers of a panel's table, by key."""
    return _diptych.panel_values(scene, columns_of(table, *table.select_dtypes("number")))


def key_values(folder: str, scene: Any, tables: dict[str, pd.DataFrame | None]) -> dict[tuple[str, str], float]:
    """(panel, key) -> value. From comparison.json if both panels ran, in which bands correspond; else from the table.

    Raises ValueError with the name of a damaged file.
    """
    if len(tables) > 1:
        return {(panel, key): math.nan if row[part]["value"] is None else row[part]["value"]
                for key, row in summary_of(folder).items() for panel, part in _ROWS.items()}
    values = {(panel, key): value for panel, table in tables.items() if table is not None
              for key, value in panel_values(scene, table).items()}
    if tables.get("continuum") is not None:
        values |= _band_of_nodes(folder, scene)
    return values


def snapshots_at(snapshots: Sequence[Any], *progress: float) -> list[Any] | None:
    """The snapshots at each progress; None if one is missing."""
    found = [next((s for s in snapshots if abs(s.progress - at) < SAME_PROGRESS), None) for at in progress]
    return None if None in found else found


def bands_between(scene: Any, pair: Sequence[Any], frame: Mapping[str, Any]) -> list[Band]:
    """The bands between two snapshots, the strongest first, without intervals. frame: replaces the snapshots'."""
    keys = scene.dict()
    options = {name: keys["comparison"][name] for name in BAND_OPTIONS}
    return operators.find_bands(**{"mean_diameter": keys["sample"]["mean_diameter"],
                                   **operators.increment(*pair), **frame}, band_resamples=0, **options).bands


def _band_of_nodes(folder: str, scene: Any) -> dict[tuple[str, str], float]:
    """Inclination and width of the continuum's strongest band in the last window; nothing without a band."""
    edges = scene.dict()["comparison"]["window_edges"]
    pair = snapshots_at(_diptych.read_nodes(folder).snapshots, *edges[-2:])
    found = bands_between(scene, pair, {}) if pair else []
    if not found:
        return {}
    angle = math.nan if found[0].diffuse else found[0].angle_deg
    angle = abs(angle) if scene.is_mirror_symmetric() else angle
    return {("continuum", "band_angle_deg"): angle,
            ("continuum", "band_width_10_90_d"): found[0].width_10_90 / scene.dict()["sample"]["mean_diameter"]}
