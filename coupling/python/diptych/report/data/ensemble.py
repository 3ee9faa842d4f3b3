# diptych: reads an ensemble of seeds
# SPDX-License-Identifier: LGPL-2.1-or-later
import os
import re
from dataclasses import dataclass

import numpy as np

from ...files import read_ensemble, read_json
from .files import open_arrays, read_provenance, read_text
from .numbers import Descriptions
from .panels import PANEL_NAMES
from .scene import scene_value
from .loading_variable import LoadingVariable, loading_variable_of

FORMAT = 1
MOST_CURVES = 200  # members with a drawn curve
NUMBER = re.compile(r"-?[0-9.]+(?:e[+-]?[0-9]+)?")


@dataclass(kw_only=True)
class Ensemble:
    """quantities: by name. numbers: those of a member's comparison. averaging: width of the running means; None: not
    stored.

    curves: {"discrete/stress_ratio": {"members": (m, n), "mean": (n), "low": (n), "high": (n)}} over progress (n); {}
    if absent. profiles: {window number: {panel: {"distance": (k), name: (k, 3) mean, low, high}}} of windows in which
    both panels have profiles.
    """

    folder: str
    record: dict
    quantities: dict
    numbers: Descriptions
    loading_variable: LoadingVariable
    progress: np.ndarray
    curves: dict
    averaging: float
    scene_text: str
    provenance: dict
    profiles: dict

    @property
    def parameters_from(self):
        return scene_value(self.scene_text, "comparison", "parameters_from")

    def place(self, text):
        """(kind, words) of "window 0.01-0.02" or "stage 0.02": ("window", "1–2 %")."""
        kind, at = text.split(" ", 1)
        # The dash between two ends is not a minus sign.
        ends = [float(x) for x in NUMBER.findall(re.sub(r"(?<=[0-9.])-", " ", at))]
        return kind, "–".join([self.loading_variable.number(x) for x in ends[:-1]] + [self.span(ends[-1])])

    def span(self, value):
        return self.loading_variable.text(value).replace(" ", "\u00a0")


def load(folder):
    """The ensemble of a folder. Raises InputError if ensemble.json is missing, broken or has another format."""
    record = read_ensemble(folder, FORMAT)
    member, provenance = _member(folder, record), os.path.join(folder, "provenance.json")
    progress, curves, profiles, averaging = _curves(os.path.join(folder, "ensemble.h5"),
                                                    member.get("pressure", 1) * member.get("mean_diameter", 1))
    return Ensemble(folder=folder, record=record, quantities={q["name"]: q for q in record["quantities"]},
                    numbers=Descriptions(member.get("numbers")),
                    loading_variable=loading_variable_of(record.get("walk", member.get("walk"))), progress=progress,
                    curves=curves, averaging=averaging, profiles=profiles,
                    scene_text=read_text(os.path.join(folder, "ensemble.prm")),
                    provenance=read_provenance(provenance) if os.path.isfile(provenance) else {})


def _member(folder, record):
    """comparison.json of the first finished member that has one, or {}."""
    paths = [os.path.join(folder, member, "comparison.json")
             for seed, member in zip(record["seeds"], record["folders"]) if seed in record["done"]]
    return next((read_json(path) for path in paths if os.path.isfile(path)), {})


def _curves(path, couple_unit):
    if not os.path.isfile(path):
        return None, {}, {}, None
    with open_arrays(path) as file:
        curves = {f"{panel}/{name}": {key: item[()] for key, item in group.items()}
                  for panel in PANEL_NAMES for name, group in file.get(panel, {}).items()}
        averaging = file.attrs.get("averaging_width")
        averaging = None if averaging is None else float(averaging)
        return file["progress"][()], curves, _profiles(file, couple_unit), averaging


def _profiles(file, couple_unit):
    found = {}
    for window in (name for name in file if name.startswith("window_")):
        panels = {panel: {name: item[()] if name == "distance"
                          else np.column_stack([item[key][()] for key in ("mean", "low", "high")])
                          for name, item in group.items()} for panel, group in file[window + "/profile"].items()}
        if len(panels) == len(PANEL_NAMES):
            for panel in panels.values():
                panel["couple_stress"] /= couple_unit
            found[int(window.rpartition("_")[2])] = panels
    return found
