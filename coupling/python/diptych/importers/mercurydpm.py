# diptych: reads MercuryDPM: .data with .fstat, or .restart
# SPDX-License-Identifier: LGPL-2.1-or-later
"""MercuryDPM, discs or spheres between infinite walls."""

import re

import numpy as np

from .frames import Frame, Options, Wall, contacts_of, refused
from .mercury_restart import Restart, read_restart
from .table_files import read_table
from .tables import Table, grains_of, rows_below
from .text import float_of, int_of, read_lines
from .walls import sorted_files

COLUMNS = {6: "x y vx vy r angle omega info".split(),
           8: "x y z vx vy vz r angle_x angle_y angle_z omega_x omega_y omega_z info".split()}
CONTACTS = "time i j cx cy cz overlap tangential_overlap fn ft nx ny nz tx ty tz".split()
SAME_TIME = 1e-8  # relative; files have ten digits


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
        table = rows_below(path, lines, k, count, COLUMNS[len(head)]).in_plane(options)
        frame = Frame("time " + head[1], grains_of(table, options), time=time, grain_file=path)
        old = frames.setdefault(time, frame)
        if old is not frame and not np.array_equal(old.grains["position"], frame.grains["position"]):
            raise refused(path, f"time {head[1]} occurs twice with different grains", k)
        if old is not frame:
            options.note(f"{path}: time {head[1]} occurs twice with the same grains; it was taken once")
        k += count
    return list(frames.values())


def _add_fstat(path: str, frames: list[Frame], options: Options) -> None:
    """Three comments before a frame, the first "# TIME 1"; rows of 16 numbers."""
    found: dict[int, tuple[list[list[str]], list[int]]] = {}  # rows and their lines
    index, comments, done = -1, 0, False
    for k, line in enumerate(read_lines(path), 1):
        words = line.split()
        if words[:1] == ["#"]:
            comments += 1
            if comments % 3 == 1:
                time = float_of(path, k, words[1], "time") if len(words) == 3 else float("nan")
                near = [n for n, frame in enumerate(frames) if abs(frame.time - time) <= SAME_TIME * abs(time)]
                if not near:
                    raise refused(path,
                                  "expected '# TIME 1' with the time of a frame of the .data file; the frames do not "
                                  "match", k)
                index, done = near[0], near[0] in found  # runs that were chained write a frame again
                found.setdefault(index, ([], []))
        elif words and not done:
            if len(words) != len(CONTACTS) or index < 0:
                raise refused(path, f"{len(words)} entries; a contact has {len(CONTACTS)}, below a head '# TIME 1'", k)
            found[index][0].append(words)
            found[index][1].append(k)
    for index, (rows, lines) in found.items():
        _take_rows(Table(path, CONTACTS, rows, lines).in_plane(options), frames[index])


def _take_rows(table: Table, frame: Frame) -> None:
    """Wall k is j = -k-1; the force acts on it."""
    time, second, overlap = table.numbers("time"), table.whole("j"), table.numbers("overlap")
    normal, point = table.vectors("nx", "ny"), table.vectors("cx", "cy")
    table.refuse(abs(time - frame.time) > SAME_TIME * abs(time),
                 lambda k: "the time differs from that of the frame's head")
    table.refuse(abs(np.sum(normal**2, axis=1) - 1) > 1e-5, lambda k: f"nx, ny are not a unit normal: {normal[k]}")
    force = table.numbers("fn")[:, None] * normal + table.numbers("ft")[:, None] * table.vectors("tx", "ty")
    wall = np.full(len(second), -1)
    for number in dict.fromkeys(second[second < 0].tolist()):
        of = np.flatnonzero(second == number)
        axis = int(abs(normal[of[0], 1]) > abs(normal[of[0], 0]))
        outward = int(normal[of[0], axis] > 0)
        # The face lies half an overlap before the contact point.
        place = np.mean(point[of, axis] - 0.5 * overlap[of] * normal[of, axis])
        wall[of] = len(frame.walls)
        frame.walls.append(Wall(f"wall {-number - 1}", (("left", "right"), ("lower", "upper"))[axis][outward],
                                float(place)))
    frame.contact_file = table.path
    frame.contacts = contacts_of(table.whole("i"), second, np.where(wall[:, None] >= 0, -force, force), wall,
                                 point=point, overlap=overlap, line=table.lines)


def _require_both_halves(frame: Frame) -> None:
    """A contact of two free grains occurs as (i, j) and as (j, i)."""
    pairs = frame.contacts["wall"] < 0
    ends = np.sort(np.column_stack([frame.contacts[name][pairs] for name in ("first", "second")]), axis=1)
    found, times = np.unique(ends, axis=0, return_counts=True)
    for (first, second), count in zip(found[times != 2], times[times != 2]):
        raise refused(frame.contact_file,
                      f"frame {frame.name}: the contact of {first} and {second} occurs {count} times, not twice; is "
                      "the file truncated? (With fixed grains, add the .restart file.)")


def _check_counts(path: str, frames: list[Frame]) -> None:
    """The .ene file contains the number of contacts of every frame."""
    table = read_table(path)
    times, counts = table.numbers("time"), table.whole("collisions")
    for frame in frames:
        if frame.contacts is None:
            continue
        walls = int(np.sum(frame.contacts["wall"] >= 0))
        found = (len(frame.contacts["wall"]) - walls) // 2 + walls
        table.refuse((abs(times - frame.time) <= 1e-5 * abs(frame.time)) & (counts != found),
                     lambda k: f"counts {counts[k]} contacts; {frame.contact_file} has {found}")


def read(options: Options) -> list[Frame]:
    """Frames of .data and .fstat, else of .restart files. Raises SceneError."""
    found = sorted_files(options, **{kind: re.compile(rf"\.{kind}(\.\d+)?(\.gz)?$").search
                                     for kind in ("data", "fstat", "ene", "restart")})
    if not found["data"] and not found["restart"]:
        raise refused("import mercurydpm", "no file contains grains (*.data or *.restart)")
    if found["fstat"] and not found["data"]:
        raise refused(found["fstat"][0], "needs the .data file of the same run")
    restarts: list[Restart] = [read_restart(path, options.axes()) for path in found["restart"]]
    frames = [frame for path in found["data"] for frame in _data_frames(path, options)]
    for path in found["fstat"]:
        _add_fstat(path, frames, options)
    for frame in frames:
        if frame.contacts is not None and not any(restart.has_fixed for restart in restarts):
            _require_both_halves(frame)
    for path in found["ene"]:
        _check_counts(path, frames)
    frames = frames or [restart.frame for restart in restarts]
    frames.sort(key=lambda frame: frame.time)
    for frame in frames:
        if restarts:
            frame.gravity, frame.spheres = restarts[0].frame.gravity, restarts[0].frame.spheres
            frame.period = next((one.frame.period for one in restarts if one.frame.time == frame.time),
                                restarts[0].frame.period)
            frame.grains.setdefault("mass", restarts[0].masses_of(frame.grains["radius"]))
        else:
            frame.lacking = ["density and gravity (a .restart file of the run contains them)"]
    return frames
