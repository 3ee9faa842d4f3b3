# diptych: an ensemble of seeds read into plain values
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads ensemble.json and the members' histories; ensemble.prm and provenance.json if they are there."""

import csv
import json
import os
import re
from dataclasses import dataclass

import numpy as np

from curves import trailing_mean
from increments import PROGRESS, Progress
from load import InputError, scene_section

FORMAT = 1
MOST_HISTORIES = 200  # members whose curves are drawn
NUMBER = re.compile(r"[0-9.]+(?:e[+-]?[0-9]+)?")
COLUMNS = {"shear": "shear_strain", "plane_shear": "shear_strain", "time": "time"}  # of discrete.csv: what the stages count


@dataclass
class Results:
    """Of one ensemble. quantities: by name; scene: {"section/key": value}; provenance: {} if absent."""

    folder: str
    record: dict
    quantities: dict
    scene: dict
    provenance: dict

    @property
    def mode(self):
        return self.scene.get("loading/mode", "descent")

    @property
    def averaging(self):
        """Of the running means, in what the stages count."""
        key = "loading/stage_time" if self.mode == "time" else "comparison/averaging_strain"
        return float(self.scene.get(key, 0.005))

    @property
    def progress(self):
        """What the stages count, and how it is written."""
        return PROGRESS.get(self.mode, Progress())

    def place(self, text):
        """(kind, words) of "window 0.01-0.02" or "stage 0.02": ("window", "1–2 %")."""
        kind, at = text.split(" ", 1)
        ends = [float(x) for x in NUMBER.findall(at)]
        return kind, "–".join([self.progress.number(x) for x in ends[:-1]] + [self.span(ends[-1])])

    def span(self, value):
        return self.progress.text(value).replace(" ", "\u00a0")

    def quantity(self, name):
        return self.quantities.get(name)


def load(folder):
    """Results of a folder. Raises InputError, naming the file, where ensemble.json is missing or broken."""
    path = os.path.join(folder, "ensemble.json")
    record = _read_json(path)
    if record.get("format") != FORMAT:
        raise InputError(f"{path}: format {record.get('format')!r}, expected {FORMAT}")
    missing = [key for key in ("seeds", "done", "failed", "quantities", "bands", "verdicts") if key not in record]
    if missing:
        raise InputError(f"{path}: missing {', '.join(missing)}")
    provenance = os.path.join(folder, "provenance.json")
    return Results(folder, record, {q["name"]: q for q in record["quantities"]}, _scene(folder),
                   _read_json(provenance) if os.path.isfile(provenance) else {})


def _read_json(path):
    try:
        with open(path, encoding="utf-8") as stream:
            value = json.load(stream)
    except (OSError, ValueError) as error:
        raise InputError(f"{path}: {error}") from error
    if not isinstance(value, dict):
        raise InputError(f"{path}: an object is expected")
    return value


def _scene(folder):
    path = os.path.join(folder, "ensemble.prm")
    if not os.path.isfile(path):
        return {}
    with open(path, encoding="utf-8", errors="replace") as stream:
        text = stream.read()
    sections = [line.split(None, 1)[1].strip() for line in text.splitlines() if line.startswith("subsection ")]
    return {f"{section}/{key}": value for section in sections for key, value, _ in scene_section(text, section)}


def histories(results, name):
    """Running means of one column on a common grid: (grid, {panel: array (members, points)}); nan beyond a history's end."""
    curves = {panel: [] for panel in ("discrete", "continuum")}
    for seed in results.record["done"][:MOST_HISTORIES]:
        for panel, found in curves.items():
            history = _history(os.path.join(results.folder, f"seed_{seed}", panel + ".csv"),
                               COLUMNS.get(results.mode, "axial_strain") if panel == "discrete" else "axial_strain", name)
            if history is not None:
                found.append((history[0], trailing_mean(*history, results.averaging)))
    ends = [strain[-1] for found in curves.values() for strain, _ in found]
    if not ends:
        return None
    grid = np.linspace(0, max(ends), 401)
    return grid, {panel: np.array([np.interp(grid, strain, mean, left=np.nan, right=np.nan) for strain, mean in found])
                  for panel, found in curves.items()}


def _history(path, progress, name):
    """(progress, values) where both are finite; None where the file or a column is missing."""
    try:
        with open(path, encoding="utf-8", newline="") as stream:
            rows = list(csv.DictReader(stream))
        pairs = np.array([(float(row[progress]), float(row[name])) for row in rows])
    except (OSError, KeyError, TypeError, ValueError):
        return None
    pairs = pairs[np.isfinite(pairs).all(axis=1)] if len(pairs) else pairs
    return (pairs[:, 0], pairs[:, 1]) if len(pairs) > 1 else None
