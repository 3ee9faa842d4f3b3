# diptych: the quantities that the maps can show, and their colour limits
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A new quantity is one entry of QUANTITIES: how it is read in both panels, its label and its colours."""

from dataclasses import dataclass
from typing import Callable, Optional

import numpy as np

from style import PANEL_NAMES

PLACES = ("discs", "cells", "grid")  # the grains' panel: discs, or means on the mesh's cells or on a regular grid


@dataclass(frozen=True)
class Quantity:
    """discs(increment, result): one number a grain. cells(increment, place, panel, result): one number a cell. None: not stored.

    home: the place shown first. Limits: from_zero, or else signed (symmetric about 0), or else percentiles at both ends;
    per_strain: an increment, whose limits grow with the axial strain it spans.
    """

    key: str
    group: str
    title: str
    label: str
    cells: Callable
    discs: Optional[Callable] = None
    colour_map: str = "viridis"
    home: str = "discs"
    from_zero: bool = False
    signed: bool = False
    per_strain: bool = False

    def values(self, increment, result, place, panel):
        """Numbers of one panel at a place; None if not stored. Place discs: the continuum's panel shows its cells."""
        if place == "discs" and panel == "discrete":
            return self.discs(increment, result) if self.discs else None
        return self.cells(increment, "cells" if place == "discs" else place, panel, result)


def _field(increment, place, panel, name, of_state=False):
    arrays = increment.state if of_state else increment.arrays
    values, corners = arrays.get(f"{place}/{panel}_{name}"), increment.arrays.get(place + "/corners")
    if corners is None:
        corners = increment.state.get(place + "/corners")
    if values is None or corners is None or len(values) != len(corners) or not np.isfinite(values).any():
        return None
    return np.asarray(values, dtype=float)


def _increment(name, factor=1.0):
    """Reader of a scalar increment on cells."""
    def read(increment, place, panel, _):
        values = _field(increment, place, panel, name)
        return None if values is None else factor * values
    return read


def _state(name, factor=1.0):
    """Reader of a scalar or, by its length, of a vector at the stage's end."""
    def read(increment, place, panel, _):
        values = _field(increment, place, panel, name, of_state=True)
        return None if values is None else factor * (values if values.ndim == 1 else np.linalg.norm(values, axis=1))
    return read


def platen_unit(increment):
    """Length [d] that displacement increments count in: the upper platen's, or the grains' 98th percentile if it rests."""
    platen = increment.platen_increment
    if platen > 1e-9:
        return platen
    moved = increment.arrays.get("discrete/displacement_increment")
    largest = 0.0 if moved is None or not len(moved) else float(np.percentile(np.linalg.norm(moved, axis=1), 98))
    return largest if largest > 0 else 1.0


def platen_speed(increment, result):
    """Speed that velocities count in: platen_unit over the time of the increment; None if no time is stored."""
    start, end = result.at_strain("time", increment.start), result.at_strain("time", increment.end)
    return None if start is None or not end > start else platen_unit(increment) / (end - start)


def _moved_cells(increment, place, panel, _=None):
    values = _field(increment, place, panel, "displacement_increment")
    if values is None and (place, panel) == ("cells", "continuum"):
        values = _mean_of_corners(increment)
    return None if values is None else np.linalg.norm(values, axis=1) / platen_unit(increment)


def _mean_of_corners(increment):
    """Displacement increment of each cell [d]: mean of its corners, which are mesh nodes; None where one is not stored."""
    names = ("cells/corners", "nodes/position", "nodes/displacement_increment")
    corners, position, moved = (increment.arrays.get(name) for name in names)
    if corners is None or position is None or moved is None or not len(position):
        return None
    # Both were written from the same numbers; rounding makes whole numbers of them, which can be searched.
    wanted, known = (np.rint(1e6 * x.reshape(-1, x.shape[-1])[:, :2]).astype("i8").copy().view("i8,i8").ravel()
                     for x in (corners, position))
    order = np.argsort(known, kind="stable")
    at = order[np.minimum(np.searchsorted(known, wanted, sorter=order), len(order) - 1)]
    if (known[at] != wanted).any():
        return None
    return moved[at, :2].reshape(-1, 4, 2).mean(axis=1)


def _moved_discs(increment, _):
    values = increment.arrays.get("discrete/displacement_increment")
    return None if values is None else np.linalg.norm(values[:, :2], axis=1) / platen_unit(increment)


def velocity(increment, result):
    """Velocities of the grains at the increment's end, in units of the platen's (N, 2); None if not stored."""
    values, speed = increment.state.get("discrete/velocity"), platen_speed(increment, result)
    return None if values is None or not speed else values[:, :2] / speed


def _speed_discs(increment, result):
    values = velocity(increment, result)
    return None if values is None else np.linalg.norm(values, axis=1)


def _speed_cells(increment, place, panel, result):
    # The continuum is quasi-static: its velocity is its displacement increment over the time of the increment.
    if panel == "continuum":
        return _moved_cells(increment, place, panel)
    values, speed = _field(increment, place, panel, "velocity", of_state=True), platen_speed(increment, result)
    return None if values is None or not speed else np.linalg.norm(values, axis=1) / speed


def _disc_array(name, factor):
    def read(increment, _):
        values = increment.arrays.get("discrete/" + name)
        return None if values is None else factor * np.asarray(values, dtype=float)
    return read


def grain_stress(increment, result):
    """Internal moment of each grain over its share of the sample's area (N, 2, 2) [P]; None if not stored."""
    moment, radius = increment.state.get("discrete/internal_moment"), increment.state.get("discrete/radius")
    if moment is None or radius is None:
        return None
    area = np.pi * radius ** 2 / (result.at_strain("solid_fraction", increment.end) or 1.0)
    return moment[:, :2, :2] / area[:, None, None]


def _of_tensor(function):
    """Readers (cells, discs) of a number of the symmetric part of the stress, positive in compression [P]."""
    def from_tensor(stress):
        return None if stress is None else function(stress[:, 0, 0], stress[:, 1, 1], (stress[:, 0, 1] + stress[:, 1, 0]) / 2)

    def cells(increment, place, panel, _):
        return from_tensor(_field(increment, place, panel, "stress", of_state=True))

    def discs(increment, result):
        return from_tensor(grain_stress(increment, result))
    return {"cells": cells, "discs": discs, "home": "cells", "group": "Stress", "colour_map": "cividis"}


def _ratio(xx, yy, xy):
    # A cell in tension has no mobilised friction angle: it carries no value.
    s = (xx + yy) / 2
    return np.divide(np.hypot((xx - yy) / 2, xy), s, out=np.full_like(s, np.nan), where=s > 0)


def _turn_against_medium(increment, place, panel, _):
    turn, spin = (_field(increment, place, panel, name + "_increment") for name in ("rotation", "spin"))
    relative = _field(increment, place, panel, "relative_rotation")  # of the same grains, where it is stored
    if relative is not None:
        return np.degrees(relative)
    return None if turn is None or spin is None else np.degrees(turn - spin)


def _grains_only(name, factor=1.0):
    """Reader of a state of the grains that the continuum does not have."""
    read = _state(name, factor)
    return lambda increment, place, panel, result: read(increment, place, panel, result) if panel == "discrete" else None


def _solid_fraction(increment, place, panel, _):
    values, corners = (increment.state.get(f"{place}/{name}") for name in ("solid_fraction", "corners"))
    if panel != "discrete" or values is None or corners is None or len(values) != len(corners):
        return None
    return np.asarray(values, dtype=float)


DEGREES = 180 / np.pi
QUANTITIES = (
    Quantity("shear", "Motion", "shear strain increment", "shear strain increment ε₁ − ε₂ (%)",
             _increment("shear_strain_increment", 100), _disc_array("shear_strain_increment", 100),
             from_zero=True, per_strain=True),
    Quantity("displacement", "Motion", "displacement increment", "|Δu| over the platen's |ΔU|", _moved_cells, _moved_discs,
             from_zero=True),
    Quantity("velocity", "Motion", "velocity at the instant", "|v| over the platen's |V|", _speed_cells, _speed_discs,
             from_zero=True),
    Quantity("rotation", "Motion", "rotation increment (grains; Cosserat rotation)", "rotation increment (degrees)",
             _increment("rotation_increment", DEGREES), _disc_array("rotation_increment", DEGREES), home="cells",
             colour_map="RdBu_r", signed=True, per_strain=True),
    Quantity("spin", "Motion", "spin increment of the medium", "half the curl of Δu (degrees)",
             _increment("spin_increment", DEGREES), colour_map="RdBu_r", home="cells", signed=True, per_strain=True),
    Quantity("turn", "Motion", "rotation minus spin", "rotation − spin increment (degrees)", _turn_against_medium,
             colour_map="RdBu_r", home="cells", signed=True, per_strain=True),
    Quantity("s", title="mean stress s", label="mean stress s = (σ₁ + σ₂)/2 (P)",
             **_of_tensor(lambda xx, yy, xy: (xx + yy) / 2)),
    Quantity("t_over_s", title="stress ratio t/s", label="stress ratio t/s = (σ₁ − σ₂)/(σ₁ + σ₂)", from_zero=True,
             **_of_tensor(_ratio)),
    Quantity("xx", title="stress σ_xx", label="stress σ_xx (P)", **_of_tensor(lambda xx, yy, xy: xx)),
    Quantity("yy", title="stress σ_yy", label="stress σ_yy (P)", **_of_tensor(lambda xx, yy, xy: yy)),
    Quantity("xy", title="stress σ_xy", label="stress σ_xy (P)", signed=True,
             **{**_of_tensor(lambda xx, yy, xy: xy), "colour_map": "RdBu_r"}),
    Quantity("couple", "Stress", "couple stress", "couple stress |μ| (P d)", _state("couple_stress"), home="cells",
             colour_map="cividis", from_zero=True),
    Quantity("dissipation", "Stress", "dissipation since the stage before (grains: friction alone)", "dissipation (P)", _state("dissipation"),
             home="cells", from_zero=True),
    Quantity("solid_fraction", "Grains only", "solid fraction", "solid fraction", _solid_fraction, home="cells"),
    Quantity("coordination", "Grains only", "coordination number", "coordination number",
             _grains_only("coordination_number"), home="cells"),
    Quantity("temperature", "Grains only", "granular temperature", "granular temperature (squared speed)",
             _grains_only("granular_temperature"), home="cells", from_zero=True),
    Quantity("error", "Grains only", "standard error of the mean pressure", "standard error of the mean pressure (P)",
             _grains_only("standard_error"), home="cells", from_zero=True),
)


def limits(quantity, place, increments, result):
    """Function increment -> (low, high): one rule for both panels and for every instant; None where nothing is stored.

    Limits are medians over the increments of 2nd and 98th percentiles, so that one instant does not set the scale of
    all, and means over the panels. A strain increment is scaled by the axial strain it spans, and of the two panels'
    percentiles the lower counts: a band one element thick saturates, which the bar's arrow says, instead of hiding the
    wider band of the grains.
    """
    if not _offered(quantity, place, increments, result):
        return None
    lows, highs = [], []
    for increment in increments:
        sets = [quantity.values(increment, result, place, panel) for panel in PANEL_NAMES]
        sets = [values[np.isfinite(values)] / _scale(quantity, increment) for values in sets if values is not None]
        sets = [np.abs(values) if quantity.signed else values for values in sets if len(values)]
        if sets:
            # One percentile a panel, so that each weighs the same whatever its number of grains or cells.
            join = np.min if quantity.per_strain and quantity.from_zero else np.mean
            lows.append(join([np.percentile(values, 2) for values in sets]))
            highs.append(join([np.percentile(values, 98) for values in sets]))
    if not highs:
        return None
    high = float(np.median(highs))
    low = -high if quantity.signed else 0.0 if quantity.from_zero else float(np.median(lows))
    if not high > low:
        high, low = low + 1.0, low - (1.0 if quantity.signed else 0.0)
    return lambda increment: tuple(_round(end * _scale(quantity, increment)) for end in (low, high))


def _offered(quantity, place, increments, result):
    """The grains decide where a quantity can be shown; one that only the continuum has is shown on its cells."""
    def has(panel, at):
        return any(quantity.values(i, result, at, panel) is not None for i in increments)
    if has("discrete", place):
        return True
    return place == "cells" and has("continuum", place) and not any(has("discrete", at) for at in PLACES)


def _scale(quantity, increment):
    return max(increment.end - increment.start, 1e-12) if quantity.per_strain else 1.0


def _round(value):
    return float(f"{value:.2g}")
