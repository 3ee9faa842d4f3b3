# diptych: increments of a comparison (stages and windows) with their arrays, lengths in d and stresses in P
# SPDX-License-Identifier: LGPL-2.1-or-later
"""comparison.json lists the increments; comparison.h5 has a group of arrays for each."""

from dataclasses import dataclass, field

import h5py
import numpy as np

from ...errors import InputError
from .numbers import Description
from .loading_variable import LoadingVariable, loading_variable_of

MESHES = ("cells", "grid")
SAME = 1e-6  # tolerance of progress


@dataclass(kw_only=True)
class Increment:
    """Change between two instants of the loading, in both panels.

    arrays: datasets by path in the group, as "cells/discrete_stress" (C, 2, 2) [P]; "cells/corners" (C, 4, 2) [d] is
    the mesh. state: arrays of the stage that ends at the same progress (a stage's own): stresses and forces at that
    instant. record: {"discrete": PANEL, "continuum": PANEL, ...} of comparison.json. end_record: of the stage that ends
    at the same progress, {} without one. centre: of the sample (2) [d], from which the bands' offsets count.
    displacement_unit, velocity_unit: the upper platen's [d], [d/time]; None if unknown or zero.
    """

    key: str
    kind: str
    start: float
    end: float
    record: dict
    loading_variable: LoadingVariable
    arrays: dict = field(default_factory=dict)
    state: dict = field(default_factory=dict)
    end_record: dict = field(default_factory=dict)
    centre: np.ndarray = None
    displacement_unit: float = None
    velocity_unit: float = None

    def panel(self, name):
        return self.record.get(name) or {}

    def end_panel(self, name):
        return self.end_record.get(name) or {}

    def bands(self, name):
        return self.panel(name).get("bands") or []

    def place(self, path):
        """Place of a number in the list of numbers: "discrete/bands/jump" -> "stages/discrete/bands/jump"."""
        return f"{self.kind}s/{path}"

    @property
    def label(self):
        start = self.loading_variable.number(self.start) + "–" if self.kind == "window" else ""
        return start + self.loading_variable.text(self.end)

    @property
    def title(self):
        if self.kind == "window":
            return f"window {self.label}"
        return f"stage {self.label} (since {self.loading_variable.text(self.start)})"


def read(comparison, file, units):
    """(increments, {path: Description}): windows first, then stages, in the order of comparison.json.

    comparison: converted to `units`. Raises KeyError if a stage or window has no progress, InputError if comparison.h5
    does not have the stage or window.
    """
    loading_variable = loading_variable_of(comparison.get("walk"))
    increments, groups = [], {}
    for k, window in enumerate(comparison["windows"]):
        increments.append(Increment(key=f"window-{k}", kind="window", start=window["from"], end=window["to"],
                                    record=window, loading_variable=loading_variable))
        groups[f"window-{k}"] = f"window_{k}"
    start = 0.0
    for k, stage in enumerate(comparison["stages"]):
        increments.append(Increment(key=f"stage-{k}", kind="stage", start=start, end=stage["progress"], record=stage,
                                    loading_variable=loading_variable))
        groups[f"stage-{k}"] = f"stage_{k + 1:04d}"
        start = stage["progress"]
    described = {}
    for increment in increments:
        _take_group(increment, _group_of(increment, groups[increment.key], file), units, described)
    for increment in increments:
        same = [i for i in increments if i.kind == "stage" and abs(i.end - increment.end) < SAME]
        if same:
            increment.state, increment.end_record = same[0].arrays, same[0].record
    return increments, described


def read_arrays(group, units, described):
    """{path: array} of a group, converted to d and P by the attribute `unit`. Adds the descriptions of the datasets to
    `described`."""
    arrays = {}

    def take(path, item):
        if not isinstance(item, h5py.Dataset):
            return
        found = Description(*[text_of(item, name) for name in ("unit", "meaning", "title")])
        described.setdefault(path, found)
        size = units.size(found.unit)
        arrays[path] = item[()] if size == 1.0 else np.asarray(item[()], dtype=float) / size

    group.visititems(take)
    return arrays


def text_of(item, name):
    value = item.attrs.get(name, "")
    return value.decode() if isinstance(value, bytes) else str(value)


def _group_of(increment, name, file):
    """The group of comparison.h5 with the arrays of the increment."""
    group = file.get(name)
    if not isinstance(group, h5py.Group):
        raise InputError(f"{file.filename}: has no group {name}, but comparison.json lists it")
    end = group.attrs.get("to")
    if not (np.isscalar(end) and abs(float(end) - increment.end) < SAME):
        raise InputError(f"{file.filename}: {name} does not end at {increment.end!r}, as comparison.json states")
    return group


def _take_group(increment, group, units, described):
    arrays = increment.arrays = read_arrays(group, units, described)
    for mesh in [mesh for mesh in MESHES if mesh in group]:
        arrays[mesh + "/corners"] = arrays.pop(mesh + "/node_position")[arrays.pop(mesh + "/nodes").astype(int)]
    increment.start = float(group.attrs["from"])
    increment.centre = group.attrs["centre"] / units.diameter
    for name in ("displacement_unit", "velocity_unit"):
        value = group.attrs[name] / units.diameter
        setattr(increment, name, value if np.isfinite(value) and value > 0 else None)
