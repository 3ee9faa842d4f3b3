# diptych: a result folder read into plain values, lengths in d and stresses in P
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads comparison.json, comparison.h5, discrete.csv, continuum.csv, provenance.json; scene.prm if it is there."""

import csv
import json
import os
import re
from dataclasses import dataclass

import h5py
import numpy as np

from increments import PROGRESS, Progress, read, scaled

REQUIRED = ("comparison.json", "comparison.h5", "discrete.csv", "continuum.csv", "provenance.json")
FORMAT = 1


class InputError(Exception):
    """A file is missing or cannot be read; the message names it."""


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
    progress: Progress

    @property
    def averaging_strain(self):
        """Axial strain over which the stages' stress ratio is a mean; the histories draw the same mean. Mode time: a stage."""
        loading = _keys(self.scene_text, "loading")
        text = loading.get("stage_time") if loading.get("mode") == "time" else _keys(self.scene_text, "comparison").get(
            "averaging_strain")
        return _number(text) if text and _number(text) > 0 else 0.005

    def at_strain(self, name, strain):
        """A column of discrete.csv, as "time" or "solid_fraction", at an axial strain; None where it is not there."""
        history = self.histories["discrete"]
        if name not in history or "axial_strain" not in history:
            return None
        good = np.isfinite(history["axial_strain"]) & np.isfinite(history[name])
        return float(np.interp(strain, history["axial_strain"][good], history[name][good])) if good.any() else None

    def across(self, strain):
        """Place on the axis of a history."""
        return self.progress.factor * strain

    @property
    def scene(self):
        """section -> {key: value as text} of the echoed scene file."""
        sections = ("sample", "loading", "discrete", "continuum", "comparison")
        return {section: _keys(self.scene_text, section) for section in sections}

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
    mode = _keys(scene_text, "loading").get("mode", "descent")
    progress = PROGRESS.get(mode, Progress())
    _count_by_progress(histories["discrete"], mode)
    path = os.path.join(folder, "comparison.h5")
    try:
        with h5py.File(path, "r") as file:
            diameter = float(file.attrs.get("mean_diameter", comparison.get("mean_diameter", 1)))
            pressure = float(file.attrs.get("pressure", comparison.get("pressure", 1)))
            height = float(file.attrs.get("height0", np.nan)) / diameter
            _scale_study(comparison.get("resolution_study") or {}, pressure)
            increments = read(comparison, file, diameter, pressure, progress)
    except OSError as error:
        raise InputError(f"{path}: {error}") from error
    except KeyError as error:
        raise InputError(f"{folder}/comparison.json: key {error} is missing in a stage or a window") from error
    return Result(comparison, _read_json(os.path.join(folder, "provenance.json")), histories, increments, diameter,
                  pressure, height, scene_text, progress)


def _scale_study(study, pressure):
    for row in (study.get("kernel") or []) + (study.get("cells") or []):
        for point in row.get("points") or []:
            point["s"] = scaled(point.get("s"), 1 / pressure)


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
