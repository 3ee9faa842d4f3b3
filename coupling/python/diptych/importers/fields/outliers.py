# diptych: outliers of a measured displacement field
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The normalised median test of Westerweel & Scarano, Exp. Fluids 39 (2005), 1096."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ...arrays import Array

NEIGHBOURS, REACH = 8, 1.6  # nearest points, within that many spacings: the squares around a point of a grid
FEWEST = 3  # neighbours to judge by


def spacing_of(points: Array) -> float:
    """Median distance of the points (n, 2) from the nearest other one."""
    return float(np.median(cKDTree(points).query(points, 2)[0][:, 1]))


def outliers(points: Array, displacement: Array, *, spacing: float, threshold: float, noise: float) -> Array:
    """(n) True: |u - median of the neighbours| / (median of |neighbour - median| + noise) exceeds the threshold. The
    ratios of both components are added as squares. points, displacement: (n, 2), NaN where lost."""
    flags = np.zeros(len(points), bool)
    known = np.flatnonzero(np.isfinite(displacement).all(axis=1))
    tree = cKDTree(points[known])
    index = tree.query(points[known], NEIGHBOURS + 1, distance_upper_bound=REACH * spacing)[1][:, 1:]
    judged = (index < len(known)).sum(axis=1) >= FEWEST
    u = np.vstack([displacement[known], [np.nan, np.nan]])  # the index of a missing neighbour is len(known)
    around = u[index[judged]]
    median = np.nanmedian(around, axis=1)
    spread = np.nanmedian(abs(around - median[:, None]), axis=1) + noise
    ratio = np.linalg.norm((u[:-1][judged] - median) / spread, axis=1)
    flags[known[judged]] = ratio > threshold
    return flags
