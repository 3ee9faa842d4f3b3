# diptych: reads a result folder, with lengths in d and stresses in P
# SPDX-License-Identifier: LGPL-2.1-or-later
import os
from dataclasses import dataclass

import numpy as np

from ...files import read_json
from .files import open_arrays, read_csv, read_provenance, read_text, require
from .increments import read, read_arrays
from .numbers import Descriptions, Units
from .panels import PANEL_NAMES
from .loading_variable import LoadingVariable, loading_variable_of

REQUIRED = ("comparison.json", "comparison.h5", "discrete.csv", "continuum.csv", "provenance.json")
FORMAT = 2


@dataclass(kw_only=True)
class Result:
    """comparison: the record in d and P, without its list `numbers`. arrays: {path in a group: Description}.

    histories: "discrete", "continuum": column -> array in the units of the files; running means of comparison.h5 in d
    and P.
    """

    comparison: dict
    provenance: dict
    histories: dict
    increments: list  # windows first, then stages
    units: Units
    numbers: Descriptions
    arrays: dict
    scene_text: str   # the resolved scene, or ""
    imported: dict    # import.json of an imported sample, or {}

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

    def history(self, panel, name):
        """(progress, values) of the rows with finite numbers; None: no such column, or fewer than two rows."""
        progress, values = self.histories[panel]["progress"], self.histories[panel].get(name)
        if values is None:
            return None
        good = np.isfinite(progress) & np.isfinite(values)
        return (progress[good], values[good]) if good.sum() > 1 else None

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
    comparison = read_json(path_of("comparison.json"), FORMAT)
    units = Units(comparison["mean_diameter"], comparison["pressure"])
    numbers = Descriptions(comparison.pop("numbers"))
    comparison = numbers.shown_in(comparison, units)
    histories = {panel: read_csv(path_of(panel + ".csv")) for panel in PANEL_NAMES}
    with open_arrays(path_of("comparison.h5")) as file:
        increments, arrays = read(comparison, file, units)
        for panel, columns in histories.items():
            columns.update(read_arrays(file[f"histories/{panel}"], units, arrays))
    imported = os.path.join(folder, "import.json")
    return Result(comparison=comparison, provenance=read_provenance(path_of("provenance.json")), histories=histories,
                  increments=increments, units=units, numbers=numbers, arrays=arrays,
                  scene_text=read_text(path_of("scene.prm")),
                  imported=read_json(imported) if os.path.exists(imported) else {})
