# diptych: reads MercuryDPM: .data with .fstat, or .restart
# SPDX-License-Identifier: LGPL-2.1-or-later
"""MercuryDPM, discs or spheres between infinite walls."""

from __future__ import annotations

import re

import numpy as np

from .frames import Frame, Options, refused
from .mercury_fstat import add_fstat, check_counts, require_both_halves
from .mercury_restart import Restart, read_restart
from .table_files import table_of_kind
from .tables import Table
from .text import float_of, floats_of, int_of, number_in_name, read_lines
from .walls import add_wall_tables, is_wall_columns


def _data_frames(path: str, options: Options) -> list[Frame]:
    """Heads "N time and the domain", then N rows. The number of a row is the id.

    2D: x y vx vy r angle omega info. 3D: x y z vx vy vz r, three angles, three spins, info.
    """
    lines, k, frames = read_lines(path), 0, {}
    while k < len(lines):
        head = lines[k].split()
        k += 1
        if not head:
            continue
        if len(head) not in (6, 8):
            raise refused(path, f"{len(head)} entries; the head of a frame has 6 (2D) or 8 (3D)", k)
        count, time = int_of(path, k, head[0], "the number of grains"), float_of(path, k, head[1], "time")
        width, x, v, r, angle, spin = (8, 0, 2, 4, 5, 6) if len(head) == 6 else (14, 0, 3, 6, 9, 12)
        rows = []
        for row in range(count):
            words = lines[k + row].split() if k + row < len(lines) else []
            if len(words) != width:
                raise refused(path, f"{len(words)} entries; a grain has {width}", min(k + row + 1, len(lines)))
            rows.append(floats_of(path, k + row + 1, words[:width - 1], "a number of a grain"))
        values = np.array(rows).reshape(count, width - 1)
        if np.any(values[:, r] <= 0):
            raise refused(path, "a radius must be positive", k + 1 + int(np.argmax(values[:, r] <= 0)))
        frame = Frame("time " + head[1], {"id": np.arange(count), "position": values[:, x:x + 2], "radius": values[:, r],
                                          "velocity": values[:, v:v + 2], "rotation": values[:, angle], "spin": values[:, spin],
                                          "line": k + 1 + np.arange(count)}, time=time, grain_file=path)
        k += count
        old = frames.setdefault(time, frame)
        if old is not frame and not np.array_equal(old.grains["position"], frame.grains["position"]):
            raise refused(path, f"time {head[1]} occurs twice with different grains", k - count)
        if old is not frame:
            options.note(f"{path}: time {head[1]} occurs twice with the same grains; it was taken once")
    return list(frames.values())


def _sorted_files(options: Options) -> tuple[dict[str, list[str]], list[Table]]:
    found: dict[str, list[str]] = {"data": [], "fstat": [], "ene": [], "restart": []}
    tables = []
    for path in options.files:
        kind = re.search(r"\.(data|fstat|ene|restart)(\.\d+)?(\.gz)?$", path)
        if kind:
            found[kind[1]].append(path)
        else:
            tables.append(table_of_kind(path, options, {"walls": is_wall_columns})[1])
    for paths in found.values():
        paths.sort(key=number_in_name)
    if not found["data"] and not found["restart"]:
        raise refused("import mercurydpm", "no file contains grains (*.data or *.restart)")
    if found["fstat"] and not found["data"]:
        raise refused(found["fstat"][0], "needs the .data file of the same run")
    return found, tables


def read(options: Options) -> list[Frame]:
    """Frames of .data and .fstat, else of .restart files. Raises SceneError."""
    found, tables = _sorted_files(options)
    restarts: list[Restart] = [read_restart(path) for path in found["restart"]]
    frames = [frame for path in found["data"] for frame in _data_frames(path, options)]
    for path in found["fstat"]:
        add_fstat(path, frames)
    for frame in frames:
        if frame.contacts is not None and not any(restart.has_fixed for restart in restarts):
            require_both_halves(frame)
    for path in found["ene"]:
        check_counts(path, frames)
    frames = frames or [restart.frame for restart in restarts]
    frames.sort(key=lambda frame: frame.time)
    for frame in frames:
        if restarts:
            frame.gravity, frame.spheres = restarts[0].frame.gravity, restarts[0].frame.spheres
            frame.grains.setdefault("mass", restarts[0].masses_of(frame.grains["radius"]))
        else:
            frame.lacking = ["density and gravity (a .restart file of the run contains them)"]
    add_wall_tables(frames, tables, options)
    return frames
