# diptych: a measured displacement field
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Points that an image correlation has followed through a test, at successive instants, as one panel beside others."""

from __future__ import annotations

import os
from dataclasses import KW_ONLY, dataclass, field, replace
from functools import cached_property
from typing import Any

import h5py
import numpy as np

from .arrays import Array, Record
from .errors import InputError
from .files import read_json

FIELD = "measured.h5"
FACTS = "measured.json"
HISTORY = "measured.csv"  # axial_strain, volumetric_strain and, if measured, stress_ratio
# 10-90 % width over subset of a jump that a square averages, at 0 and at 45 degrees: 0.80 and 0.78
OF_A_JUMP = 0.8
# name -> title, unit and meaning of the arrays of measured.h5
ARRAYS = {"position": ("position", "length", "of the points at every instant (k, n, 2), y upwards; nan: lost"),
          "deviation": ("standard deviation", "length", "of a component of the displacement since the first instant "
                        "(k, n); nan: unknown"),
          "progress": ("axial strain", "-", "at every instant (k)")}
NUMBERS = ("mean_diameter", "subset", "spacing", "centre")  # of measured.json


@dataclass
class FieldFrame:
    """One displacement field of a file, as a reader returns it.

    name          of the frame: that of its file, or its number in the file
    points        (n, 2): places in the reference image
    displacement  (n, 2) from the reference to this frame; NaN where the correlation failed
    deviation     (n) standard deviation of a component of the displacement; None: not in the file
    unit          of all lengths: "px" or a unit of length; "": not in the file
    path          of the file, for messages
    y_down        True: y points down, as the rows of an image; read_fields() turns it
    subset        side of the correlated squares, in the unit; None: not in the file
    """

    name: str
    points: Array
    displacement: Array
    _: KW_ONLY
    deviation: Array | None = None
    unit: str = ""
    path: str = ""
    y_down: bool = False
    subset: float | None = None

    @property
    def known(self) -> Array:
        """(n) True: the point has a displacement."""
        return np.isfinite(self.displacement).all(axis=1)


@dataclass(kw_only=True)
class Measurement:
    """A measured test. Lengths are in the unit of mean_diameter; y points upwards.

    position   (k, n, 2) of the points at every instant, NaN where the correlation lost them
    deviation  (k, n) standard deviation of a component of the displacement since the first instant; NaN: unknown
    progress   (k) axial strain, ascending
    subset     side of the correlated squares; 0: a point
    spacing    of the points
    centre     (2) of the sample at the first instant, in the frame of the points
    facts      origin and remarks: what `measured.json` holds
    """

    position: Array
    deviation: Array
    progress: Array
    mean_diameter: float
    subset: float
    spacing: float
    centre: Array
    facts: dict[str, Any] = field(default_factory=dict)

    def increment(self, start: int, end: int) -> Record:
        """Between two instants: points (m, 2) at the later one, displacement (m, 2) and deviation (m), where both are
        known."""
        moved = self.position[end] - self.position[start]
        known = np.isfinite(moved).all(axis=1)
        first, last = self.deviation[[start, end]][:, known] ** 2
        # fields against the image before: only those between the instants count
        variance = last - first if self.facts.get("reference") == "previous" else last + first
        return Record(points=self.position[end][known], displacement=moved[known], deviation=np.sqrt(abs(variance)))

    def filled(self, k: int) -> Array:
        """(n, 2): all points at an instant, the lost ones between the others as in the first image; NaN beyond them."""
        from scipy.interpolate import LinearNDInterpolator  # help needs none of it

        known = np.isfinite(self.position[k]).all(axis=1)
        moved = LinearNDInterpolator(self.position[0][known], (self.position[k] - self.position[0])[known])
        return np.where(known[:, None], self.position[k], self.position[0] + moved(self.position[0]))

    @cached_property
    def triangles(self) -> Array:
        """(t, 3): numbers of the points at their corners, in the first image."""
        from scipy.spatial import Delaunay

        return np.asarray(Delaunay(self.position[0]).simplices)

    def mean_gradient(self, start: int, end: int) -> Array:
        """(2, 2): as the function, between two instants."""
        before = self.filled(start)
        return mean_gradient(self.triangles, before, self.filled(end) - before)[0]

    @property
    def resolution(self) -> float:
        """The 10-90 % width at which a jump appears, and below which nothing is seen."""
        return max(OF_A_JUMP * self.subset, 2 * self.spacing)

    def scaled(self, mean_diameter: float) -> Measurement:
        """The same in a unit in which this is the mean diameter."""
        scale = mean_diameter / self.mean_diameter
        return replace(self, **{name: scale * getattr(self, name) for name in ("position", "deviation", *NUMBERS)})


def read_measurement(folder: str | os.PathLike[str]) -> Measurement:
    """The measurement in a folder of `diptych import field`. Raises InputError with the file that is missing or
    damaged."""
    path, facts = os.path.join(folder, FIELD), read_json(os.path.join(folder, FACTS), 1)
    try:
        with h5py.File(path) as file:
            arrays = {name: file[name][()] for name in ARRAYS}
        numbers: dict[str, Any] = {name: np.array(facts[name], dtype=float)[()] for name in NUMBERS}
    except (OSError, KeyError, TypeError, ValueError) as error:
        raise InputError(f"{path}: is missing or damaged ({error}); import the measurement again") from error
    return Measurement(**arrays, **numbers, facts=facts)


def mean_gradient(triangles: Array, before: Array, displacement: Array) -> tuple[Array, float]:
    """(2, 2): mean of d u_k / d x_l over triangles of points (t, 3), linear in each, and their area. An affine fit
    would give too much weight to a band in the middle. Triangles with an unknown corner do not count."""
    known = np.isfinite(before + displacement).all(axis=1)
    corners = triangles[known[triangles].all(axis=1)]
    (a, b), (c, d) = np.moveaxis(before[corners[:, 1:]] - before[corners[:, :1]], 0, -1)  # two edges of each triangle
    moved = displacement[corners[:, 1:]] - displacement[corners[:, :1]]
    adjugates, twice = np.sign(a * d - b * c) * np.array([[d, -b], [-c, a]]), abs(a * d - b * c).sum()
    return np.einsum("ijt,tjk->ki", adjugates, moved) / twice, 0.5 * float(twice)
