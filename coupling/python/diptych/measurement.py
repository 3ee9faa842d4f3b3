# diptych: a measured displacement field
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Points that an image correlation has followed through a test, at successive instants, as one panel beside others."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass, field
from typing import Any

import h5py
import numpy as np

from .arrays import Array, Record
from .errors import InputError, SceneError
from .files import part_of, read_json

FIELD = "measured.h5"
FACTS = "measured.json"
HISTORY = "measured.csv"  # axial_strain, volumetric_strain and, if measured, stress_ratio
# name -> title, unit and meaning of the arrays of measured.h5
ARRAYS = {"position": ("position", "length", "of the points at every instant (k, n, 2), y upwards; nan: lost"),
          "deviation": ("standard deviation", "length", "of a component of the displacement since the first instant "
                        "(k, n); nan: unknown"),
          "progress": ("axial strain", "-", "at every instant (k)")}


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
        both = self.deviation[[start, end]][:, known]
        return Record(points=self.position[end][known], displacement=moved[known], deviation=np.hypot(*both))

    def at(self, progress: float, tolerance: float) -> int | None:
        """The instant nearest to a progress; None if it is farther away than the tolerance."""
        nearest = int(np.argmin(np.abs(self.progress - progress)))
        return nearest if abs(self.progress[nearest] - progress) <= tolerance else None

    def write(self, folder: str) -> None:
        """Writes measured.h5 and measured.json."""
        with part_of(os.path.join(folder, FIELD)) as part, h5py.File(part, "w", libver=("v110", "v110")) as file:
            for name, words in ARRAYS.items():
                data = file.create_dataset(name, data=getattr(self, name), compression="gzip", fletcher32=True)
                data.attrs.update(zip(("title", "unit", "meaning"), map(np.bytes_, words)))
        record = {"format": 1, **{name: getattr(self, name) for name in ("mean_diameter", "subset", "spacing")},
                  "centre": self.centre.tolist(), **self.facts}
        with part_of(os.path.join(folder, FACTS)) as part, open(part, "w", encoding="utf-8") as file:
            file.write(json.dumps(record, indent=1, sort_keys=True, ensure_ascii=False) + "\n")


def read_measurement(folder: str | os.PathLike[str]) -> Measurement:
    """The measurement in a folder of `diptych import field`. Raises InputError with the file that is missing or
    damaged."""
    path, facts = os.path.join(folder, FIELD), read_json(os.path.join(folder, FACTS), 1)
    try:
        with h5py.File(path) as file:
            arrays = {name: file[name][()] for name in ARRAYS}
        numbers = {name: float(facts[name]) for name in ("mean_diameter", "subset", "spacing")}
        centre = np.array(facts["centre"], dtype=float)
    except (OSError, KeyError, TypeError, ValueError) as error:
        raise InputError(f"{path}: is missing or damaged ({error}); import the measurement again") from error
    return Measurement(**arrays, **numbers, centre=centre, facts=facts)


def tracked(frames: Sequence[FieldFrame], to_first: bool) -> tuple[Array, Array]:
    """Positions (k + 1, n, 2) and deviations (k + 1, n) of the points of the first frame at every instant.

    to_first  True: every frame holds the displacement since the first image, at the same points.
              False: since the image before. A point is then followed through the frames by linear interpolation, and
              the variances add up. It is lost 1.5 spacings away from all points of a frame.

    Raises SceneError if the frames have other points although they should not.
    """
    from scipy.interpolate import LinearNDInterpolator  # loads slowly
    from scipy.spatial import cKDTree

    start = frames[0].points
    position, variance = [start], [np.zeros(len(start))]
    for frame in frames:
        deviation = np.full(len(frame.points), np.nan) if frame.deviation is None else frame.deviation
        if to_first:
            if frame.points.shape != start.shape or not np.allclose(frame.points, start, atol=1e-6 * np.ptp(start)):
                raise SceneError(f"{frame.path}: its points are not those of {frames[0].path}. If every frame holds "
                                 "the displacement since the image before, give --reference previous")
            position.append(start + frame.displacement)
            variance.append(deviation**2)
            continue
        known = np.isfinite(frame.displacement).all(axis=1)
        field_at = LinearNDInterpolator(frame.points[known], np.column_stack([frame.displacement,
                                                                             deviation**2])[known])
        moved, tree = field_at(position[-1]), cKDTree(frame.points[known])
        spacing = np.median(tree.query(frame.points[known], 2)[0][:, 1])
        moved[tree.query(np.nan_to_num(position[-1]))[0] > 1.5 * spacing] = np.nan
        position.append(position[-1] + moved[:, :2])
        variance.append(variance[-1] + moved[:, 2])
    return np.array(position), np.sqrt(variance)


def gradient_of(points: Array, displacement: Array) -> Array:
    """(2, 2): d u_k / d x_l of the affine least-squares fit to a field, with respect to the places before it."""
    before = points - displacement
    centred = before - before.mean(0)
    return np.asarray(np.linalg.lstsq(centred, displacement - displacement.mean(0), rcond=None)[0].T)
