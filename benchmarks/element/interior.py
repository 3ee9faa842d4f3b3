# diptych: strength in the interior of a sample between walls
# SPDX-License-Identifier: LGPL-2.1-or-later
"""T/S of the grains far from all walls, from their mean internal moments over every stage in discrete.h5."""
import os

import h5py
import numpy


def _moment(stage, distance):
    """Sum of the mean internal moments of the grains whose centre is at least `distance` from every wall (2, 2)."""
    position = stage["grains/position"][:, :2]
    low = numpy.array([stage.attrs["left_x"], stage.attrs["lower_y"]]) + distance
    high = numpy.array([stage.attrs["right_x"], stage.attrs["upper_y"]]) - distance
    inside = ((position > low) & (position < high)).all(axis=1)
    return stage["grains/mean_internal_moment"][inside, :2, :2].sum(axis=0) / numpy.prod(high - low)


def strength(folder, begin, end, distance):
    """T/S of the stages that end in (begin, end]: mean of t over mean of s. distance: from the walls [length]."""
    t, s = [], []
    with h5py.File(os.path.join(folder, "discrete.h5")) as file:
        for stage in file.values():
            if begin * (1 + 1e-9) < stage.attrs["progress"] <= end * (1 + 1e-9):
                m = _moment(stage, distance)
                t.append(numpy.hypot(0.5 * (m[0, 0] - m[1, 1]), 0.5 * (m[0, 1] + m[1, 0])))
                s.append(0.5 * numpy.trace(m))
    return numpy.mean(t) / numpy.mean(s)
