# diptych: both panels as an image correlation would see them
# SPDX-License-Identifier: LGPL-2.1-or-later
"""An image correlation returns the mean displacement of a small square, the subset, at each of its points. A panel that
is compared with a measurement is averaged over the same squares at the same points."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from scipy.interpolate import LinearNDInterpolator
from scipy.spatial import cKDTree

from .arrays import Array, Band, BandReport, Interval
from .measurement import Measurement
from .operators import find_bands, increment

ALONG = 5  # places along a side of a subset
NEAR = 0.5  # mean diameters: a place farther from every grain is outside of the sample
KEPT = 0.9  # of the draws must have a band, else an interval is unknown, as in the bootstrap
DRAWS = 20  # of the measurement's noise; their standard deviation is then known to a sixth

Field = Callable[[Array], Array]  # places (m, 2) at the end of an increment -> displacement (m, 2), NaN outside


def field_of(start: Any, end: Any) -> Field:
    """The displacement between two snapshots of a panel. A grain is rigid, and pores move with the nearest grain. The
    continuum is linear between its nodes."""
    moved = increment(start, end).displacement
    if hasattr(end, "cells"):
        return LinearNDInterpolator(end.position, moved)
    tree, reach = cKDTree(end.position), NEAR * end.mean_diameter
    turn = np.nan_to_num(end.rotation - start.rotation)  # other codes may write none

    def at(places: Array) -> Array:
        _, near = tree.query(places, k=min(6, len(end.position)))
        arm = places[:, None] - end.position[near]
        gap = np.hypot(*np.moveaxis(arm, -1, 0)) - end.radius[near]
        rows, nearest = np.arange(len(places)), gap.argmin(axis=1)
        grain, (x, y) = near[rows, nearest], arm[rows, nearest].T
        found = moved[grain] + turn[grain, None] * np.column_stack([-y, x])
        found[gap.min(axis=1) > reach] = np.nan
        return found

    return at


def levelled(field: Field, points: Array, subset: float) -> Array:
    """(n, 2): means of a field over squares of side `subset` [length] around the points; NaN where less than half of a
    square is in the sample, or the point is NaN."""
    known = np.isfinite(points).all(axis=1)
    steps = subset * ((np.arange(ALONG) + 0.5) / ALONG - 0.5)
    offsets = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    values = np.full((len(points), len(offsets), 2), np.nan)
    values[known] = field((points[known, None] + offsets).reshape(-1, 2)).reshape(-1, *values.shape[1:])
    inside = np.isfinite(values[..., 0]).mean(axis=1) >= 0.5
    means = np.full(points.shape, np.nan)
    means[inside] = np.nanmean(values[inside], axis=1)
    return means


def on_sample(measurement: Measurement, k: int, points: Array, centre: Array) -> Array:
    """Points of a measurement at its instant k, in the coordinates of a sample with this centre. The measured centre
    follows the mean motion since the first instant."""
    since = measurement.increment(0, k)
    before = since.points - since.displacement
    motion = since.displacement.mean(0) + measurement.mean_gradient(0, k) @ (measurement.centre - before.mean(0))
    return centre + points - measurement.centre - motion


def with_noise(report: BandReport, points: Array, displacement: Array, deviation: Array,
               options: Mapping[str, Any]) -> BandReport:
    """The bands of a measurement with the noise of its points in their intervals. Bands are searched again in fields
    with further noise of this deviation (n) [length]; half widths add in squares. NaN: unknown, and nothing is
    added."""
    if not report.bands or not np.isfinite(deviation).all():
        return report
    generator, again = np.random.default_rng(1), {**options, "band_resamples": 0}
    draws = [find_bands(points, displacement + deviation[:, None] * generator.standard_normal(points.shape),
                        **report.frame, **again).bands for _ in range(DRAWS)]
    return replace(report, bands=[_widened(band, draws) for band in report.bands])


def _widened(band: Band, draws: Sequence[Sequence[Band]]) -> Band:
    same = [min(found, key=lambda one: abs(one.angle_deg - band.angle_deg)) for found in draws if found]
    interval = {}
    for name, (value, low, high) in band.interval.items():
        known = len(same) >= KEPT * DRAWS
        half = 1.96 * np.std([getattr(one, name) for one in same], ddof=1) if known else np.nan
        interval[name] = Interval(value, value - np.hypot(value - low, half), value + np.hypot(high - value, half))
    return replace(band, interval=interval)
