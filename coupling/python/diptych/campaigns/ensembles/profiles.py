# diptych: means over samples of the profiles across the band
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The curves below window_N/profile/PANEL of the members' comparison.h5, averaged strip by strip. The strips have the
same distances from the band, in mean diameters, in every member; mirror images of a band have the same profiles."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any

import h5py
import numpy as np

from ..runs.statistics import student_quantile

_NAMES = ("relative_rotation", "spin", "couple_stress", "solid_fraction", "velocity_fluctuation")


def profile_arrays(folders: Sequence[str]) -> dict[str, tuple[Any, str, str, str]]:
    """name -> (values, title, unit, meaning) as write_arrays takes them. folders: result folders of the members. Raises
    OSError."""
    found: dict[tuple[str, str], list[np.ndarray]] = {}  # (group, name) -> values of the members
    words: dict[str, tuple[str, str]] = {}
    for folder in folders:
        with h5py.File(os.path.join(folder, "comparison.h5")) as file:
            for window in (name for name in file if name.startswith("window_")):
                for group in (f"{window}/profile/{panel}" for panel in ("discrete", "continuum")):
                    if not len(file[group]["distance"]):
                        continue
                    found.setdefault((group, "distance"), []).append(file[group]["distance"][()])
                    for name in _NAMES:
                        item = file[group][name]
                        found.setdefault((group, name), []).append(item[:, 0])
                        words[name] = tuple(item.attrs[key].decode() for key in ("title", "unit"))
    arrays: dict[str, tuple[Any, str, str, str]] = {}
    for (group, name), members in found.items():
        if name == "distance":
            arrays[f"{group}/distance"] = (members[0], "distance from the band", "mean diameters",
                                           "middles of the strips, along the band's normal")
            continue
        title, unit = words[name]
        for key, values in _means(np.array(members)).items():
            arrays[f"{group}/{name}/{key}"] = (values, title, unit, f"{key.replace('_', ' ')} over the members with a "
                                               "value; nan: fewer than two")
    return arrays


def _means(members: np.ndarray) -> dict[str, np.ndarray]:
    """mean, standard error and 95 % Student interval of each strip. members: (m, n); NaN where a member has no
    value."""
    known = np.isfinite(members)
    n = known.sum(axis=0)
    enough = np.maximum(n, 2)
    mean = np.where(known, members, 0).sum(axis=0) / enough
    variance = np.where(known, (members - mean) ** 2, 0).sum(axis=0) / (enough - 1)
    error = np.where(n > 1, np.sqrt(variance / enough), np.nan)
    mean = np.where(n > 1, mean, np.nan)
    half = error * np.array([student_quantile(0.975, count - 1) for count in enough])
    return {"mean": mean, "standard_error": error, "low": mean - half, "high": mean + half}
