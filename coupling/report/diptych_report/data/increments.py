# diptych: increments of a comparison (stages and strain windows) with their arrays, lengths in d and stresses in P
# SPDX-License-Identifier: LGPL-2.1-or-later
"""comparison.json says which increments there are; comparison.h5 holds a group of arrays for each."""

from dataclasses import dataclass, field

import h5py
import numpy as np

LENGTHS = ("position", "radius", "corners", "left", "right", "point")


@dataclass(frozen=True)
class Progress:
    """What the stages count: axial strain; travel of the upper platen over the height; or time."""

    word: str = "axial strain"
    unit: str = " %"
    factor: float = 100.0

    @property
    def label(self):
        return self.word + (" (%)" if self.unit else "")

    def number(self, strain):
        return f"{self.factor * strain:.4g}"

    def text(self, strain):
        return self.number(strain) + self.unit


PROGRESS = {"shear": Progress("travel / height"), "plane_shear": Progress("travel / height"), "time": Progress("time", "", 1.0)}


@dataclass
class Increment:
    """What happened between two axial strains, in both panels.

    arrays: datasets by path in the group, as "cells/corners" (C, 4, 2) [d], "cells/discrete_stress" (C, 2, 2) [P].
    state: arrays of the stage that ends at the same strain (a stage's own): stresses and forces at that instant.
    record: {"discrete": PANEL, "continuum": PANEL, ...} of comparison.json. centre: of the sample [d].
    end_record: record of the stage that ends at the same strain, {} without one.
    """

    key: str
    kind: str
    start: float
    end: float
    record: dict
    arrays: dict = field(default_factory=dict)
    state: dict = field(default_factory=dict)
    end_record: dict = field(default_factory=dict)
    centre: np.ndarray = None
    progress: Progress = Progress()

    def panel(self, name):
        return self.record.get(name) or {}

    def end_panel(self, name):
        return self.end_record.get(name) or {}

    def bands(self, name):
        return self.panel(name).get("bands") or []

    @property
    def label(self):
        return (self.progress.number(self.start) + "–" if self.kind == "window" else "") + self.progress.text(self.end)

    @property
    def title(self):
        if self.kind == "window":
            return f"window {self.label}"
        return f"stage {self.label} (since {self.progress.text(self.start)})"

    @property
    def platen_increment(self):
        """|Delta U| [d]: mean increment of the uppermost mesh nodes, which stick to the platen; 0 if not stored."""
        position, increment = self.arrays.get("nodes/position"), self.arrays.get("nodes/displacement_increment")
        if position is None or increment is None or not len(position):
            return 0.0
        height = position[:, 1].max() - position[:, 1].min()
        top = position[:, 1] > position[:, 1].max() - 1e-6 * height
        return float(np.linalg.norm(increment[top, :2].mean(axis=0)))


def plain(number):
    """The value of a number that may carry an interval {"value", "low", "high"}; None where there is no number."""
    if isinstance(number, dict):
        number = number.get("value")
    if isinstance(number, bool) or not isinstance(number, (int, float)) or not np.isfinite(number):
        return None
    return float(number)


def interval(number):
    """(low, high) of a number with an interval; None where it has none or an end is not known."""
    if not isinstance(number, dict):
        return None
    ends = plain(number.get("low")), plain(number.get("high"))
    return None if None in ends else ends


def scaled(number, factor):
    """The number, plain or with an interval, or each of a list, times factor; None stays None."""
    if isinstance(number, dict):
        return {key: scaled(value, factor) for key, value in number.items()}
    if isinstance(number, (list, tuple)):
        return [scaled(value, factor) for value in number]
    return number * factor if isinstance(number, (int, float)) and not isinstance(number, bool) else number


def read(comparison, file, diameter, pressure, progress=Progress()):
    """Windows first, then stages, in the order of comparison.json. Raises KeyError where one lacks its strains."""
    increments = []
    for k, window in enumerate(comparison.get("windows") or []):
        increments.append(Increment(f"window-{k}", "window", window["from"], window["to"], window))
    start = 0.0
    for k, stage in enumerate(comparison.get("stages") or []):
        if stage["axial_strain"] > 0:
            increments.append(Increment(f"stage-{k}", "stage", start, stage["axial_strain"], stage))
            start = stage["axial_strain"]
    for increment in increments:
        increment.progress = progress
        group = _group(file, increment)
        if group is not None:
            increment.start = float(group.attrs.get("from", increment.start))
            increment.arrays = _arrays(group, diameter, pressure)
        for panel in ("discrete", "continuum"):
            _scale_panel(increment.panel(panel), diameter, pressure)
    for increment in increments:
        same = [i for i in increments if i.kind == "stage" and abs(i.end - increment.end) < 1e-9]
        increment.centre = _centre([increment] + same)
        if same:
            increment.state, increment.end_record = same[0].arrays, same[0].record
            if "cells/corners" in increment.state:  # one mesh at one instant: a window need not store it again
                increment.arrays.setdefault("cells/corners", increment.state["cells/corners"])
    return increments


def _scale_panel(panel, diameter, pressure):
    """Lengths without "_d" in their name and stresses of a panel's record, in place."""
    for probe in panel.get("probes") or []:
        probe["polygon"] = scaled(probe.get("polygon") or [], 1 / diameter)
        for name in ("s1", "s2", "grain_pressure"):
            if name in probe:
                probe[name] = scaled(probe[name], 1 / pressure)
    circle = panel.get("circular_probe") or {}
    for name, unit in (("centre", diameter), ("radius", diameter), ("normal", pressure), ("tangential", pressure),
                       ("predicted_normal", pressure), ("predicted_tangential", pressure), ("normal_error", pressure),
                       ("tangential_error", pressure)):
        if name in circle:
            circle[name] = scaled(circle[name], 1 / unit)
    traction = panel.get("band_traction") or {}
    for name in ("normal", "shear", "normal_error", "shear_error"):
        if name in traction:
            traction[name] = scaled(traction[name], 1 / pressure)


def _group(file, increment):
    """Group of an increment, found by its strains: the numbering of groups does not matter."""
    for name in sorted(file):
        attributes = file[name].attrs
        if not name.startswith(increment.kind) or "axial_strain" not in attributes:
            continue
        same_end = np.isclose(attributes["axial_strain"], increment.end, rtol=1e-6, atol=1e-9)
        same_start = np.isclose(attributes.get("from", increment.start), increment.start, rtol=1e-6, atol=1e-9)
        if same_end and (same_start or increment.kind == "stage"):
            return file[name]
    return None


def unit_of(path, diameter, pressure):
    """What an array of comparison.h5 is divided by, by its name; velocities keep their time unit."""
    last = path.split("/")[-1]
    if last in LENGTHS or last.endswith("displacement_increment") or last == "velocity":
        return diameter
    if last.endswith("couple_stress") or path == "contacts/force":
        return pressure * diameter
    if last == "internal_moment":
        return pressure * diameter ** 2
    return pressure if last.endswith(("_stress", "_dissipation", "_standard_error")) else 1.0


def _arrays(group, diameter, pressure):
    arrays = {}
    group.visititems(lambda name, item: arrays.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    for name in arrays:
        unit = unit_of(name, diameter, pressure)
        if unit != 1.0:
            arrays[name] = np.asarray(arrays[name], dtype=float) / unit
    return arrays


def _centre(same_instant):
    """Centre from which the bands' offsets count: of the box round the grains' outline, which only stages store.

    same_instant: increments that end at one axial strain. Without an outline, the box round the mesh; None without either.
    """
    for names in (("outline/left", "outline/right"), ("cells/corners",)):
        for increment in same_instant:
            points = [increment.arrays[name].reshape(-1, 2) for name in names if name in increment.arrays]
            if points and len(points[0]):
                points = np.concatenate(points)
                return (points.min(axis=0) + points.max(axis=0)) / 2
    return None
