# diptych: the command `homogenise`
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Grains of a result folder, or of files of another code, as fields: tables, maps for ParaView and a page."""

from __future__ import annotations

import argparse
import os
import shlex
import time
from typing import Any

import numpy as np

from ... import _diptych
from ...errors import SceneError
from ...homogenisation import Homogenised, homogenise
from ..exchange.imports import import_files, import_options
from ..runs.engine import Options, say, tell
from ..runs.folders import Folder, draw, write_json, write_text

SHOWN = {"progress": "progress", "t_over_s": "t/s", "direction_deg": "direction", "solid_fraction": "solid fr.",
         "coordination_number": "contacts/grain", "anisotropy": "anisotropy", "band_angle_deg": "band angle",
         "band_width_10_90_d": "band width/d"}


def _source(line: argparse.Namespace) -> tuple[str, str]:
    """The folder of the results, and that of the grains. Raises SceneError."""
    if line.files:
        if not line.output:
            raise SceneError(f"homogenise {line.target} FILES: add --output DIR, the folder of the results")
        return line.output, os.path.join(line.output, "imported")
    grains = line.target.rstrip("/") or "/"
    if not os.path.isfile(os.path.join(grains, "discrete.h5")):
        raise SceneError(f"{line.target}: holds no discrete.h5. Give a folder of `diptych run`, `discrete` or "
                         "`import`; or a FORMAT of `diptych import` and FILES")
    for name, value in vars(import_options(line)).items():
        if value:
            raise SceneError(f"homogenise {line.target}: --{name.replace('_', '-')} has no effect on a folder; it is "
                             "for FORMAT FILES")
    return line.output or grains + "_homogenised", grains


def _write_fields(folder: str, found: Homogenised) -> None:
    """fields_0000.vtu and so on, and fields.pvd with their progress; tensors have the components xx, xy, 0, yx, yy, 0,
    0, 0, 0."""
    import meshio  # type: ignore

    entries = ""
    for k, (mesh, maps) in enumerate(zip(found.meshes, found.maps)):
        name = f"fields_{k:04d}.vtu"
        cells = {key: [np.pad(value, ((0, 0), (0, 1), (0, 1))).reshape(-1, 9) if value.ndim == 3
                       else value.astype(float)]
                 for key, value in maps.items()}
        points = np.column_stack([mesh.nodes, np.zeros(len(mesh.nodes))])
        path = os.path.join(folder, name)
        meshio.vtu.write(path + ".part", meshio.Mesh(points, [("quad", mesh.cells)], cell_data=cells))
        os.replace(path + ".part", path)
        entries += f'<DataSet timestep="{found.frames[k]["progress"]!r}" part="0" file="{name}"/>\n'
    write_text(os.path.join(folder, "fields.pvd"), '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1" '
               f'byte_order="LittleEndian">\n<Collection>\n{entries}</Collection>\n</VTKFile>\n')


def _record(found: Homogenised, source: str) -> dict[str, Any]:
    return {"format": 1, "source": os.path.abspath(source), "walk": found.walk, "mean_diameter": found.mean_diameter,
            "grid_d": found.grid, "cells": len(found.meshes[0].cells), "frames": found.frames,
            "increments": found.increments, "resolution_study": found.resolution_study, "missing": found.missing}


def _print(found: Homogenised, options: Options) -> None:
    table = found.table()
    shown = [name for name in SHOWN if name in table]
    say(options, table[shown].rename(columns=SHOWN).to_string(float_format=lambda x: f"{x:.4g}", na_rep="",
                                                              index=False))
    if found.resolution_study:
        say(options, "averaging width: " + found.resolution_study["verdict"])
    for entry in found.missing:
        tell(f"missing: {entry['quantity']}: {entry['reason']}")


def run_homogenise(line: argparse.Namespace, options: Options) -> None:
    """The commands `diptych homogenise FOLDER` and `diptych homogenise FORMAT FILES`."""
    folder, grains = _source(line)
    began = time.perf_counter(), time.process_time()
    with Folder(folder) as locked:
        if not _diptych.is_empty_folder(folder):
            if not options.overwrite:
                raise SceneError(f"the folder '{folder}' is not empty. Add --overwrite to rename it to "
                                 f"{os.path.basename(folder)}.1, or " "--output with another folder.")
            _diptych.require_usable(folder, False, True)
            locked.set_aside([("the folder with the grains", line.target),
                              *(("the file", file) for file in line.files)])
        if line.files:
            import_files(line.target, import_options(line), grains, options)
        found = homogenise(grains, line.grid)
        found.table().to_csv(os.path.join(folder, "homogenised.csv.part"), index_label="frame")
        os.replace(os.path.join(folder, "homogenised.csv.part"), os.path.join(folder, "homogenised.csv"))
        _write_fields(folder, found)
        write_json(os.path.join(folder, "homogenised.json"), _record(found, grains))
        cost = ("homogenise", time.perf_counter() - began[0], time.process_time() - began[1], 0.0)
        _diptych.record_phase(folder, ("", [], shlex.join(["diptych", *options.words])), cost)
        _print(found, options)
        draw(options, folder, "homogenised")
