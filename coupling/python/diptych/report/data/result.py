# diptych: reads a result folder, with lengths in d and stresses in P
# SPDX-License-Identifier: LGPL-2.1-or-later
"""comparison.json lists the increments (stages and windows); comparison.h5 has a group of arrays for each."""

import os
from dataclasses import dataclass, field

import h5py
import numpy as np

from ...errors import InputError
from ...files import LEVELLED, read_json, read_provenance
from .files import open_arrays, read_csv, read_text, require
from .numbers import Description, Descriptions, LoadingVariable, Units, loading_variable_of
from .panels import PANEL_NAMES

REQUIRED = ("comparison.json", "comparison.h5", "discrete.csv", "continuum.csv", "provenance.json")
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
    levelled: dict = field(default_factory=dict)  # window of levelled.json

    def panel(self, name):
        """A group of the record, also "difference", or {}."""
        return self.record.get(name) or {}

    def bands(self, name):
        return self.panel(name).get("bands") or []

    def place(self, path):
        """Place of a number in the list of numbers: "discrete/bands/jump" -> "stages/discrete/bands/jump"."""
        return f"{self.kind}s/{path}"

    @property
    def shown_end(self):
        """The end in the unit of the axes."""
        return self.loading_variable.factor * self.end

    @property
    def label(self):
        start = self.loading_variable.number(self.start) + "–" if self.kind == "window" else ""
        return start + self.loading_variable.text(self.end)

    @property
    def title(self):
        if self.kind == "window":
            return f"window {self.label}"
        return f"stage {self.label} (since {self.loading_variable.text(self.start)})"


@dataclass(kw_only=True)
class Result:
    """comparison: the record in d and P, without its list `numbers`. arrays: {path in a group: Description}.

    histories: "discrete", "continuum": column -> array in the units of the files; running means of comparison.h5 in d
    and P. platens: the same of the parts of a platen; {} along time.
    """

    comparison: dict
    provenance: dict
    histories: dict
    platens: dict
    increments: list  # windows first, then stages
    units: Units
    numbers: Descriptions
    arrays: dict
    scene_text: str   # the resolved scene, or ""
    imported: dict    # import.json of an imported sample, or {}
    levelled: dict    # levelled.json of a comparison with a measurement, or {}

    @property
    def loading_variable(self) -> LoadingVariable:
        return loading_variable_of(self.comparison.get("walk"))

    @property
    def averaging(self):
        """The range of the running means as text."""
        across = self.loading_variable
        return f"the last {across.text(self.comparison['averaging_width'])} of {across.word}"

    def part(self, key):
        """A group of the comparison, or {}."""
        return self.comparison.get(key) or {}

    def check(self, key):
        """The check of a number by its place in the comparison, or {}."""
        return next((one for one in self.comparison.get("checks", []) if one["key"] == key), {})

    def history(self, panel, name):
        """(progress as shown, values) of the rows with finite numbers; None: no such column, or fewer than two rows."""
        progress, values = self.histories[panel]["progress"], self.histories[panel].get(name)
        if values is None:
            return None
        good = np.isfinite(progress) & np.isfinite(values)
        return (self.loading_variable.factor * progress[good], values[good]) if good.sum() > 1 else None

    @property
    def windows(self):
        return [i for i in self.increments if i.kind == "window"]

    @property
    def stages(self):
        return [i for i in self.increments if i.kind == "stage"]


def load(folder, next_folder):
    """The result of a folder. Files in next_folder take the place of older ones. Raises InputError if a required file
    is missing, broken or has another format."""
    def path_of(name):
        newer = os.path.join(next_folder, name)
        return newer if os.path.isfile(newer) else os.path.join(folder, name)

    require([path_of(name) for name in REQUIRED])
    comparison = read_json(path_of("comparison.json"), 2)
    units = Units(comparison["mean_diameter"], comparison["pressure"])
    numbers = Descriptions(comparison.pop("numbers"))
    comparison, described = numbers.shown_in(comparison, units), {}
    histories = {panel: read_csv(path_of(panel + ".csv")) for panel in PANEL_NAMES}
    with open_arrays(path_of("comparison.h5")) as file:
        increments = _increments(comparison, file, units, described)
        for panel, columns in histories.items():
            columns.update(_arrays(file[f"histories/{panel}"], units, described))
        platens = {panel: _arrays(group, units, described) for panel, group in file.get("platens", {}).items()}
    imported = os.path.join(folder, "import.json")
    return Result(comparison=comparison, provenance=read_provenance(path_of("provenance.json")), histories=histories,
                  levelled=_add_levelled(folder, increments, units) if "measured" in comparison else {},
                  platens=platens, increments=increments, units=units, numbers=numbers, arrays=described,
                  scene_text=read_text(path_of("scene.prm")),
                  imported=read_json(imported) if os.path.exists(imported) else {})


def _increments(comparison, file, units, described):
    """Windows first, then stages, in the order of comparison.json. Raises InputError if comparison.h5 lacks one."""
    listed = [("window", k, f"window_{k}", one["to"], one) for k, one in enumerate(comparison["windows"])]
    listed += [("stage", k, f"stage_{k + 1:04d}", one["progress"], one) for k, one in enumerate(comparison["stages"])]
    increments = []
    for kind, k, name, end, record in listed:
        group = _group(file, name, end)
        arrays = _arrays(group, units, described)
        for mesh in [mesh for mesh in ("cells", "grid") if mesh in group]:
            arrays[mesh + "/corners"] = arrays.pop(mesh + "/node_position")[arrays.pop(mesh + "/nodes").astype(int)]
        of_platen = {unit: group.attrs[unit] / units.diameter for unit in ("displacement_unit", "velocity_unit")}
        increments.append(Increment(
            key=f"{kind}-{k}", kind=kind, start=float(group.attrs["from"]), end=end, record=record,
            loading_variable=loading_variable_of(comparison.get("walk")), arrays=arrays,
            centre=group.attrs["centre"] / units.diameter,
            **{unit: value for unit, value in of_platen.items() if np.isfinite(value) and value > 0}))
    for increment in increments:
        same = [i for i in increments if i.kind == "stage" and abs(i.end - increment.end) < SAME]
        if same:
            increment.state, increment.end_record = same[0].arrays, same[0].record
    return increments


def _add_levelled(folder, increments, units):
    """Returns levelled.json. Its windows are added to the increments of the same windows: as `levelled`, as the panel
    "measured", and with the arrays "points/..."."""
    record = read_json(os.path.join(folder, LEVELLED), 1)
    with open_arrays(os.path.join(folder, "levelled.h5")) as file:
        for window, i in [(window, i) for window in record["windows"] for i in increments if i.kind == "window"
                          and abs(i.start - window["from"]) + abs(i.end - window["to"]) < SAME]:
            i.levelled, i.record["measured"] = window, window["levelled"]["measured"]
            arrays = _arrays(file[window["key"]], units, {})
            arrays["radius"] = np.full(len(arrays["position"]), 0.7 * record["spacing_d"])  # discs that leave no gap
            for pane in window["levelled"] if i.displacement_unit else ():
                arrays[f"{pane}_displacement_over_platen"] = np.linalg.norm(
                    arrays[f"{pane}_displacement_increment"], axis=1) / i.displacement_unit
            i.arrays |= {f"points/{name}": values for name, values in arrays.items()}
    return record


def _group(file, name, end):
    group = file.get(name)
    if not isinstance(group, h5py.Group):
        raise InputError(f"{file.filename}: has no group {name}, but comparison.json lists it")
    stored = group.attrs.get("to")
    if not (np.isscalar(stored) and abs(float(stored) - end) < SAME):
        raise InputError(f"{file.filename}: {name} does not end at {end!r}, as comparison.json states")
    return group


def _arrays(group, units, described):
    """{path: array} of a group, converted to d and P by the attribute `unit`. Adds the descriptions of the datasets to
    `described`."""
    arrays = {}

    def take(path, item):
        if isinstance(item, h5py.Dataset):
            if path not in described:
                texts = [item.attrs.get(name, "") for name in ("unit", "meaning", "title")]
                described[path] = Description(*(text.decode() if isinstance(text, bytes) else str(text)
                                                for text in texts))
            size = units.size(described[path].unit)
            arrays[path] = item[()] if size == 1.0 else np.asarray(item[()], dtype=float) / size

    group.visititems(take)
    return arrays
