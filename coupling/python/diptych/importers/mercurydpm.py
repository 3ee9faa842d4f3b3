# diptych: reads MercuryDPM: .data with .fstat, or .restart
# SPDX-License-Identifier: LGPL-2.1-or-later
"""MercuryDPM, discs or spheres between infinite walls."""

import re

import numpy as np

from .frames import Frame, Options, refused
from .mercury_fstat import add_fstat, check_counts, require_both_halves
from .mercury_restart import Restart, read_restart
from .tables import grains_of, rows_below
from .text import float_of, int_of, read_lines
from .walls import sorted_files

COLUMNS = {6: "x y vx vy r angle omega info".split(),
           8: "x y z vx vy vz r angle_x angle_y angle omega_x omega_y omega info".split()}


def _data_frames(path: str, options: Options) -> list[Frame]:
    """Heads "N time and the domain", with 6 (2D) or 8 numbers (3D), then N rows. The number of a row is the id."""
    lines, k, frames = read_lines(path), 0, {}
    while k < len(lines):
        head = lines[k].split()
        k += 1
        if not head:
            continue
        if len(head) not in COLUMNS:
            raise refused(path, f"{len(head)} entries; the head of a frame has 6 (2D) or 8 (3D)", k)
        count, time = int_of(path, k, head[0], "the number of grains"), float_of(path, k, head[1], "time")
        table = rows_below(path, lines, k, count, COLUMNS[len(head)])
        frame = Frame("time " + head[1], grains_of(table, options), time=time, grain_file=path)
        old = frames.setdefault(time, frame)
        if old is not frame and not np.array_equal(old.grains["position"], frame.grains["position"]):
            raise refused(path, f"time {head[1]} occurs twice with different grains", k)
        if old is not frame:
            options.note(f"{path}: time {head[1]} occurs twice with the same grains; it was taken once")
        k += count
    return list(frames.values())


def read(options: Options) -> list[Frame]:
    """Frames of .data and .fstat, else of .restart files. Raises SceneError."""
    found = sorted_files(options, **{kind: re.compile(rf"\.{kind}(\.\d+)?(\.gz)?$").search
                                     for kind in ("data", "fstat", "ene", "restart")})
    if not found["data"] and not found["restart"]:
        raise refused("import mercurydpm", "no file contains grains (*.data or *.restart)")
    if found["fstat"] and not found["data"]:
        raise refused(found["fstat"][0], "needs the .data file of the same run")
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
    return frames
