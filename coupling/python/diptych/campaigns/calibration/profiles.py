# diptych: the profile of rotation across a band as data of a calibration, and how it scatters
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The profile is twice the rotation of grains or Cosserat points over the distance from the middle of a band; in a wide
band it is the shear. Both sides count as one. A band has the shape c / cosh^2(y / delta). Its width varies from sample
to sample: this `stretch` is common to all strips and windows of a sample. The rest is noise, whose variance is
proportional to the profile and to 1 / breadth of a strip."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import scipy.optimize

from ...arrays import Array, Band

PROFILE = "rotation_profile"
STRIPS = (0, 2, 4, 6, 8, 10, 12.5, 15)  # edges, from the middle of the band [mean diameters]
FLOOR = 0.05  # of the largest value: the noise far from the band
NOISE_LENGTH, MISFIT_LENGTH = 1.0, 5.0  # correlation of the noise, and of the model tolerance [mean diameters]
# Corners, midpoints and centre of a cell in the order of a snapshot, and points in it: values of the biquadratic
# functions there.
NODES = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1), (0, -1), (1, 0), (0, 1), (-1, 0), (0, 0)])
POINTS = np.array([(a, b) for a in (-0.75, -0.25, 0.25, 0.75) for b in (-0.75, -0.25, 0.25, 0.75)])
AT_POINTS = np.prod(np.where(NODES == 0, 1 - POINTS[:, None] ** 2, 0.5 * POINTS[:, None] * (POINTS[:, None] + NODES)),
                    axis=2)


def profile(pair: Sequence[Any], weight: Array, band: Band, strips: Sequence[tuple[float, float]],
            unit: float) -> Array:
    """(strips): -2 x rotation between two snapshots x unit, positive in the sense of the band. weight: of grains or
    nodes. band: with the `centre` of its offset. strips: edges [length]. NaN in an empty strip."""
    angle, end = np.radians(band.angle_deg), pair[1]
    y = (end.position - band.centre) @ np.array([-np.sin(angle), np.cos(angle)]) - band.offset
    turn = -2 * np.sign(band.jump) * (end.rotation - pair[0].rotation) * unit
    if hasattr(end, "cells"):  # a strip holds few nodes, so their values are interpolated within the cells
        y, turn = ((values[end.cells] @ AT_POINTS.T).ravel() for values in (y, turn))
        weight = np.repeat(end.cell_area, len(POINTS))
    sides = [[weight * (side * y >= near) * (side * y < far) for side in (1, -1)] for near, far in strips]
    return np.array([np.mean([w @ turn / w.sum() if w.any() else np.nan for w in both]) for both in sides])


def shape(middle: Array, breadth: Array, mean: Array) -> tuple[Array, Array, Array]:
    """Fits c / cosh^2(y / delta) to the mean profile of a window. Returns its values, their derivative by ln delta at
    the same displacement across the band, and the variance of the noise over its factor; (strips) each."""
    def value(y: Array, c: float, delta: float) -> Array:
        return c / np.cosh(y / delta) ** 2

    largest = max(mean.max(), 1e-6)
    (c, delta), _ = scipy.optimize.curve_fit(value, middle, mean, p0=(largest, 5), bounds=([0, 1], [2 * largest, 20]))
    found = value(middle, c, delta)
    return found, found * (2 * middle / delta * np.tanh(middle / delta) - 1), (found + FLOOR * c) / breadth
