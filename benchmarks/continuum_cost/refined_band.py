# diptych: thickness of the oblique band on uniform and on refined meshes
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Measures as ../cosserat_band/width.py: full width at half maximum of the increment of the hardening variable across
the band, in current coordinates. A refined mesh is first written on the grid of its smallest elements. Each part of a
larger element gets the element's mean, and its points come from the element's biquadratic shape functions."""
import os
import sys

import h5py
import numpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../cosserat_band"))
from runs import ARMS  # noqa: E402
from width import Increment, measure, point_values, N_POINTS  # noqa: E402


def quadratics(t):
    return numpy.stack(((1 - t) * (1 - 2 * t), 4 * t * (1 - t), t * (2 * t - 1)))


class Grid:
    """A stage on a grid of squares of edge h: hardening variable of the squares, current positions of N_POINTS^2 points
    in each."""

    def __init__(self, stage, h):
        position = stage["nodes/position"][()][:, :2]
        cells = stage["cells/nodes"][()]
        initial = (position - stage["nodes/displacement"][()][:, :2])[cells]
        lower = initial.min(axis=1)
        sizes = initial.max(axis=1)[:, 0] - lower[:, 0]
        self.extent = initial.max(axis=(0, 1)) - lower.min(axis=0)
        columns, rows = numpy.rint(self.extent / h).astype(int)
        self.hardening = numpy.full((rows, columns), numpy.nan)
        self.points = numpy.zeros((rows, N_POINTS, columns, N_POINTS, 2))
        for corner, size, nodes, nine, k in zip(lower - lower.min(axis=0), sizes, position[cells], initial,
                                                stage["cells/equivalent_plastic_strain"][()]):
            n = int(round(size / h))
            column, row = numpy.rint(corner / h).astype(int)
            self.hardening[row:row + n, column:column + n] = k
            place = numpy.rint(2 * (nine - nine.min(axis=0)) / size).astype(int)
            ordered = numpy.zeros((3, 3, 2))
            ordered[place[:, 1], place[:, 0]] = nodes
            shape = quadratics((numpy.arange(n * N_POINTS) + 0.5) / (n * N_POINTS))
            inside = numpy.einsum("ai,bj,abk->ijk", shape, shape, ordered)
            self.points[row:row + n, :, column:column + n] = inside.reshape(n, N_POINTS, n, N_POINTS, 2)


class RefinedIncrement(Increment):
    """The members of Increment that measure() needs, for a refined mesh."""

    def __init__(self, before, after, h):
        earlier, later = Grid(before, h), Grid(after, h)
        self.h = h
        self.width, self.height = later.extent
        means = later.hardening - earlier.hardening
        self.points = later.points.reshape(-1, 2)
        self.values = (point_values(means.shape[0]) @ means @ point_values(means.shape[1]).T).ravel()
        self.shape = tuple(N_POINTS * n for n in means.shape)


def band_thickness(folder, refined=None, last=0.08, strain=0.01):
    """Thickness of the band [length]. `refined`: smallest element of a refined mesh."""
    if refined is None:
        return float(measure(Increment(folder, last, strain), ARMS["oblique"]).thickness)
    with h5py.File(os.path.join(folder, "continuum.h5")) as file:
        before, after = (next(s for s in file.values() if abs(s.attrs["axial_strain"] - at) < 1e-9)
                         for at in (last - strain, last))
        return float(measure(RefinedIncrement(before, after, refined), ARMS["oblique"]).thickness)
