# diptych: reads a folder of homogenised grains
# SPDX-License-Identifier: LGPL-2.1-or-later

import os
from dataclasses import dataclass

import meshio
import numpy as np

from ...files import read_json
from .files import read_provenance, require
from .loading_variable import LoadingVariable, loading_variable_of


@dataclass(kw_only=True)
class Homogenised:
    """record: homogenised.json. polygons (k, 4, 2) [d] and maps of the last frame; polygons have the origin of the
    files."""

    record: dict
    provenance: dict
    polygons: np.ndarray
    maps: dict

    @property
    def loading_variable(self) -> LoadingVariable:
        return loading_variable_of(self.record["walk"])

    @property
    def frames(self):
        return self.record["frames"]

    @property
    def increments(self):
        """Between successive frames; `whole` is the one from the first to the last frame."""
        return self.record["increments"][:len(self.frames) - 1]

    @property
    def whole(self):
        return self.record["increments"][-1] if len(self.frames) > 2 else None

    @property
    def resolution_study(self):
        """With s relative to the mean of the sample; {} without forces."""
        study = self.record["resolution_study"]
        if not study:
            return {}
        mean = self.frames[study["frame"]]["s"]
        kernel = [{**row, "points": [{**point, "s": point["s"] / mean} for point in row["points"]]}
                  for row in study["kernel"]]
        return {**study, "kernel": kernel}


def load(folder):
    """Raises InputError if a file is missing, broken or has another format."""
    path = os.path.join(folder, "homogenised.json")
    require([path])
    record = read_json(path, 1)
    fields = os.path.join(folder, f"fields_{len(record['frames']) - 1:04d}.vtu")
    require([fields])
    mesh = meshio.vtu.read(fields)
    polygons = mesh.points[mesh.cells_dict["quad"], :2] / record["mean_diameter"]
    return Homogenised(record=record, provenance=read_provenance(os.path.join(folder, "provenance.json")),
                       polygons=polygons, maps={name: values[0] for name, values in mesh.cell_data.items()})
