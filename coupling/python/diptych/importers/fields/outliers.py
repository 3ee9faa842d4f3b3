# diptych: outliers of a measured displacement field
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The normalised median test of Westerweel & Scarano, Exp. Fluids 39 (2005), 1096, after the plane that fits the
neighbours best was taken out. Without this, the median of one-sided neighbours makes a strained edge an outlier."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ...arrays import Array

NEIGHBOURS, REACH = 8, 3.0  # nearest points: the squares around a point of a grid; if within that many spacings


def spacing_of(points: Array) -> float:
    """Median distance of the points (n, 2) from the nearest other one."""
    return float(np.median(cKDTree(points).query(points, 2)[0][:, 1]))


def outliers(points: Array, displacement: Array, *, spacing: float, threshold: float, noise: float) -> Array:
    """(n) True: |r - median of the neighbours| / (median of |neighbour - median| + noise) exceeds the threshold, with
    the residuals r from the plane of the neighbours. The ratios of both components are added as squares. points,
    displacement: (n, 2), NaN where lost. Points without enough neighbours are no outliers."""
    known = np.flatnonzero(np.isfinite(displacement).all(axis=1))
    places, u = points[known] / spacing, displacement[known]
    distance, index = cKDTree(places).query(places, NEIGHBOURS + 1)
    judged = distance[:, -1] <= REACH
    around, own = index[judged, 1:], u[judged]
    plane = np.insert(places[around] - places[judged][:, None], 0, 1, axis=2)  # (m, 8, 3): 1, x, y from the point
    fit = np.linalg.pinv(plane) @ u[around]
    left = u[around] - plane @ fit
    median = np.median(left, axis=1)
    spread = np.median(abs(left - median[:, None]), axis=1) + noise
    flags = np.zeros(len(points), bool)
    flags[known[judged]] = np.linalg.norm((own - fit[:, 0] - median) / spread, axis=1) > threshold
    return flags
