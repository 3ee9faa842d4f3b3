# diptych: reads a study
# SPDX-License-Identifier: LGPL-2.1-or-later
import os
from dataclasses import dataclass

from ...files import read_json
from .files import open_arrays

FORMAT = 1
PANELS = ("discrete", "continuum", "material_point")
CURVES = ("stress_ratio", "volumetric_strain")
# class: (colour, text colour, letter) in maps and tables
CLASSES = {"right": ("#b7e1cd", "#222222", "R"), "struggled": ("#e3f0b5", "#222222", "S"),
           "wrong, warned": ("#f6c99b", "#222222", "W"), "silently wrong": ("#d55e00", "white", "X"),
           "stopped": ("#8d8d8d", "white", "!"), "refused": ("#cfcfcf", "#222222", "–"),
           "unjudged": ("#e8eef7", "#222222", "·"), "not run": ("white", "#222222", "?")}


@dataclass(kw_only=True)
class Study:
    """cost: of the finished points, by index in record["points"]. curves: {panel: (progress, {name: rows of
    points})}."""

    folder: str
    record: dict
    bill: dict
    cost: dict
    curves: dict

    @property
    def quantities(self):
        return self.record["quantities"]

    @property
    def points(self):
        return self.record["points"]

    def family(self, name):
        return next(f for f in self.record["families"] if f["name"] == name)

    def of_family(self, name):
        """[(index, point)] of a family, without references."""
        return [(k, point) for k, point in enumerate(self.points) if point["family"] == name
                and not self.is_reference(k)]

    @property
    def has_reference(self):
        """False: the study reports values and judges none."""
        return "reference" in self.points[0]

    def is_reference(self, place):
        return self.points[place].get("reference") == place

    @property
    def references(self):
        """Indices of the references."""
        return [k for k in range(len(self.points)) if self.is_reference(k)]

    def name(self, place):
        """"nscd: step 0.4, tolerance 1e-05"."""
        point = self.points[place]
        if self.is_reference(place):
            return "reference" + (": " + ", ".join(point["labels"]) if point["labels"] else "")
        axes = [axis["name"] for axis in self.family(point["family"])["axes"]]
        setting = ", ".join(f"{axis} {label}" for axis, label in zip(axes, point["labels"]))
        return ": ".join(text for text in (point["family"], setting) if text)


def load(folder):
    """The study of a folder. Raises InputError if a file is missing, broken or has another format."""
    record, bill = (read_json(os.path.join(folder, name), FORMAT) for name in ("study.json", "study_cost.json"))
    return Study(folder=folder, record=record, bill=bill, cost={c["point"]: c for c in bill["points"]},
                 curves=_curves(os.path.join(folder, "study.h5")))


def _curves(path):
    if not os.path.isfile(path):
        return {}
    with open_arrays(path) as file:
        panels = [panel for panel in PANELS if panel in file]
        return {panel: (file[panel]["progress"][()], {name: file[panel][name][()] for name in CURVES})
                for panel in panels}
