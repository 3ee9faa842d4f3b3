# diptych: a result folder read into plain values, lengths in d and stresses in P
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads comparison.json, comparison.h5, discrete.csv, continuum.csv, provenance.json; scene.prm if it is there."""

import csv
import json
import os
import re
from dataclasses import dataclass, field

import h5py
import numpy as np

REQUIRED = ("comparison.json", "comparison.h5", "discrete.csv", "continuum.csv", "provenance.json")
FORMAT = 1


class InputError(Exception):
    """A file is missing or cannot be read; the message names it."""


@dataclass
class Increment:
    """What happened between two axial strains, in both panels.

    arrays: datasets by path in the group, as "cells/corners" (C, 4, 2) [d], "cells/discrete_stress" (C, 2, 2) [P].
    record: {"discrete": PANEL, "continuum": PANEL, ...} of comparison.json. centre: of the sample [d].
    """

    key: str
    kind: str
    start: float
    end: float
    record: dict
    arrays: dict = field(default_factory=dict)
    centre: np.ndarray = None

    def panel(self, name):
        return self.record.get(name) or {}

    def bands(self, name):
        return self.panel(name).get("bands") or []

    @property
    def label(self):
        return f"{percent(self.start)}–{percent(self.end)} %" if self.kind == "window" else f"{percent(self.end)} %"

    @property
    def title(self):
        if self.kind == "window":
            return f"window {percent(self.start)}–{percent(self.end)} %"
        return f"stage {percent(self.end)} % (since {percent(self.start)} %)"


@dataclass
class Result:
    comparison: dict
    provenance: dict
    histories: dict   # "discrete", "continuum": column name -> array
    increments: list  # windows first, then stages
    diameter: float
    pressure: float
    height: float     # initial, d; nan if not given
    scene_text: str   # echo of the scene, empty if absent

    @property
    def averaging_strain(self):
        """Axial strain over which the stages' stress ratio is a mean; the histories draw the same mean. Mode time: a stage."""
        loading = _keys(self.scene_text, "loading")
        text = loading.get("stage_time") if loading.get("mode") == "time" else _keys(self.scene_text, "comparison").get(
            "averaging_strain")
        return _number(text) if text and _number(text) > 0 else 0.005

    @property
    def windows(self):
        return [i for i in self.increments if i.kind == "window"]

    @property
    def stages(self):
        return [i for i in self.increments if i.kind == "stage"]


def percent(strain):
    return f"{100 * strain:.4g}"


def load(folder):
    """Result of a folder. Raises InputError, naming the file, where one that is required is missing or broken."""
    missing = [name for name in REQUIRED if not os.path.isfile(os.path.join(folder, name))]
    if missing:
        raise InputError(f"{folder}: missing {', '.join(missing)}")
    comparison = _read_json(os.path.join(folder, "comparison.json"))
    if comparison.get("format") != FORMAT:
        raise InputError(f"{folder}/comparison.json: format {comparison.get('format')!r}, expected {FORMAT}")
    histories = {name: _read_csv(os.path.join(folder, name + ".csv")) for name in ("discrete", "continuum")}
    scene_path = os.path.join(folder, "scene.prm")
    scene_text = ""
    if os.path.isfile(scene_path):
        with open(scene_path, encoding="utf-8", errors="replace") as stream:
            scene_text = stream.read()
    _count_by_progress(histories["discrete"], _keys(scene_text, "loading").get("mode", "descent"))
    path = os.path.join(folder, "comparison.h5")
    try:
        with h5py.File(path, "r") as file:
            diameter = float(file.attrs.get("mean_diameter", comparison.get("mean_diameter", 1)))
            pressure = float(file.attrs.get("pressure", comparison.get("pressure", 1)))
            height = float(file.attrs.get("height0", np.nan)) / diameter
            increments = _increments(comparison, file, diameter, pressure)
    except OSError as error:
        raise InputError(f"{path}: {error}") from error
    except KeyError as error:
        raise InputError(f"{folder}/comparison.json: key {error} is missing in a stage or a window") from error
    return Result(comparison, _read_json(os.path.join(folder, "provenance.json")), histories, increments, diameter,
                  pressure, height, scene_text)


def _read_json(path):
    try:
        with open(path, encoding="utf-8") as stream:
            value = json.load(stream)
    except ValueError as error:
        raise InputError(f"{path}: not valid JSON: {error}") from error
    if not isinstance(value, dict):
        raise InputError(f"{path}: an object is expected")
    return value


def _read_csv(path):
    with open(path, encoding="utf-8", newline="") as stream:
        rows = list(csv.reader(stream))
    if not rows:
        raise InputError(f"{path}: empty")
    names = [name.strip() for name in rows[0]]
    # A killed run may leave its last line half written.
    rows = [row for row in rows[1:] if len(row) == len(names)]
    return {name: np.array([_number(row[k]) for row in rows]) for k, name in enumerate(names)}


def scene_section(text, section):
    """[(key, value, meaning)] of one section of an echoed scene file; meaning is the comment above the key."""
    rows, path, comment = [], [], ""
    for line in text.splitlines():
        line = line.strip()
        entry = re.match(r"set\s+(.+?)\s*=\s*(.*?)\s*(#.*)?$", line)
        if line.startswith("#"):
            comment = line.lstrip("# ")
            continue
        if line.startswith("subsection "):
            path.append(line[len("subsection "):].strip())
        elif line == "end" and path:
            path.pop()
        elif entry and path[:1] == [section]:
            rows.append(("/".join(path[1:] + [entry[1]]), entry[2], comment))
        comment = ""
    return rows


def _keys(text, section):
    return {name: value for name, value, _ in scene_section(text, section)}


def _count_by_progress(history, mode):
    """The grains' history against what the stages count: descent, travel of the upper platen or time, as in comparison.json."""
    column = {"shear": "shear_strain", "plane_shear": "shear_strain", "time": "time"}.get(mode)
    if column in history:
        history["axial_strain"] = history[column]


def _number(text):
    try:
        return float(text)
    except ValueError:
        return float("nan")


def _increments(comparison, file, diameter, pressure):
    increments = []
    for k, window in enumerate(comparison.get("windows") or []):
        increments.append(Increment(f"window-{k}", "window", window["from"], window["to"], window))
    start = 0.0
    for k, stage in enumerate(comparison.get("stages") or []):
        if stage["axial_strain"] > 0:
            increments.append(Increment(f"stage-{k}", "stage", start, stage["axial_strain"], stage))
            start = stage["axial_strain"]
    for increment in increments:
        group = _group(file, increment)
        if group is not None:
            increment.start = float(group.attrs.get("from", increment.start))
            increment.arrays = _arrays(group, diameter, pressure)
        for panel in ("discrete", "continuum"):
            _scale_probes(increment.panel(panel), diameter, pressure)
    for increment in increments:
        same_end = [i for i in increments if i.kind == "stage" and abs(i.end - increment.end) < 1e-9]
        increment.centre = _centre([increment] + same_end)
    return increments


def _scale_probes(panel, diameter, pressure):
    for probe in panel.get("probes") or []:
        probe["polygon"] = [[x / diameter, y / diameter] for x, y in probe.get("polygon") or []]
        for name in ("s1", "s2"):
            if isinstance(probe.get(name), (int, float)):
                probe[name] /= pressure


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


def _arrays(group, diameter, pressure):
    arrays = {}
    group.visititems(lambda name, item: arrays.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    lengths = ("position", "radius", "corners", "displacement_increment", "left", "right")
    for name in arrays:
        last = name.split("/")[-1]
        scale = diameter if last in lengths else pressure if last.endswith("_stress") else None
        if scale is not None:
            arrays[name] = np.asarray(arrays[name], dtype=float) / scale
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
