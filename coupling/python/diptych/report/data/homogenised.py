# diptych: reads a folder of homogenised grains
# SPDX-License-Identifier: LGPL-2.1-or-later

import os
from types import SimpleNamespace

import meshio

from ...files import read_json
from .files import read_provenance, require
from .loading_variable import loading_variable_of


def load(folder):
    """record: homogenised.json, with its frames, the increments between successive frames, and `whole`, the one from
    the first to the last frame, if there are more than two. polygons (k, 4, 2) [d] and maps of the last frame; polygons
    have the origin of the files.
    """
    record = read_json(os.path.join(folder, "homogenised.json"), 1)
    frames, increments = record["frames"], record["increments"]
    fields = os.path.join(folder, f"fields_{len(frames) - 1:04d}.vtu")
    require([fields])
    mesh = meshio.vtu.read(fields)
    return SimpleNamespace(record=record, provenance=read_provenance(os.path.join(folder, "provenance.json")),
                           frames=frames, increments=increments[:len(frames) - 1],
                           whole=increments[-1] if len(frames) > 2 else None,
                           loading_variable=loading_variable_of(record["walk"]),
                           resolution_study=_relative(record["resolution_study"], frames),
                           polygons=mesh.points[mesh.cells_dict["quad"], :2] / record["mean_diameter"],
                           maps={name: values[0] for name, values in mesh.cell_data.items()})


def _relative(study, frames):
    """The study with s relative to the mean of the sample; {} without forces."""
    if not study:
        return {}
    mean = frames[study["frame"]]["s"]
    kernel = [{**row, "points": [{**point, "s": point["s"] / mean} for point in row["points"]]}
              for row in study["kernel"]]
    return {**study, "kernel": kernel}
