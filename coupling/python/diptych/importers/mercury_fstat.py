# diptych: reads contacts of MercuryDPM: .fstat, and .ene to count them
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Contacts of .fstat files. Pairs of free grains occur in two rows."""

from __future__ import annotations

import numpy as np

from .frames import Frame, Wall, contacts_of, refused
from .table_files import read_table
from .text import float_of, floats_of, read_lines

SAME_TIME = 1e-8  # relative; files have ten digits


def add_fstat(path: str, frames: list[Frame]) -> None:
    """Three comments before a frame, the first "# TIME 1"; rows of 16 numbers."""
    rows: dict[int, list[list[float]]] = {}
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
                                  "expected '# TIME 1' with the time of a frame of the .data file; the frames do not match", k)
                index, done = near[0], near[0] in rows  # runs that were chained write a frame again
                rows.setdefault(index, [])
        elif words and not done:
            if len(words) != 16 or index < 0:
                raise refused(path, f"{len(words)} entries; a contact has 16, below a head '# TIME 1'", k)
            values = floats_of(path, k, words, "a number of a contact")
            if abs(values[0] - frames[index].time) > SAME_TIME * abs(values[0]):
                raise refused(path, "the time differs from that of the frame's head", k)
            rows[index].append([*values, k])
    for index, values in rows.items():
        _take_rows(path, np.array(values).reshape(-1, 17), frames[index])


def _take_rows(path: str, rows: np.ndarray, frame: Frame) -> None:
    """Columns: time i j c(3) overlap, tangential overlap, fn ft n(3) t(3), line. Wall k is j = -k-1; the force acts on it."""
    normal, point, overlap = rows[:, 10:12], rows[:, 3:5], rows[:, 6]
    bad = np.flatnonzero(abs(np.sum(normal**2, axis=1) - 1) > 1e-5)
    if len(bad):
        raise refused(path, f"nx, ny are not a unit normal: {normal[bad[0]]}", int(rows[bad[0], 16]))
    force, wall = rows[:, 8:9] * normal + rows[:, 9:10] * rows[:, 13:15], np.full(len(rows), -1)
    for number in dict.fromkeys(rows[rows[:, 2] < 0, 2]):
        of = np.flatnonzero(rows[:, 2] == number)
        axis = int(abs(normal[of[0], 1]) > abs(normal[of[0], 0]))
        outward = int(normal[of[0], axis] > 0)
        # The face lies half an overlap before the contact point.
        place = np.mean(point[of, axis] - 0.5 * overlap[of] * normal[of, axis])
        wall[of] = len(frame.walls)
        frame.walls.append(Wall(f"wall {int(-number - 1)}", (("left", "right"), ("lower", "upper"))[axis][outward],
                                float(place)))
    frame.contact_file = path
    frame.contacts = contacts_of(rows[:, 1].astype(int), rows[:, 2].astype(int), np.where(wall[:, None] >= 0, -force, force),
                                 wall, point=point, overlap=overlap, line=rows[:, 16].astype(int))


def require_both_halves(frame: Frame) -> None:
    """A contact of two free grains occurs as (i, j) and as (j, i)."""
    pairs = frame.contacts["wall"] < 0
    ends = np.sort(np.column_stack([frame.contacts[name][pairs] for name in ("first", "second")]), axis=1)
    found, times = np.unique(ends, axis=0, return_counts=True)
    for (first, second), count in zip(found[times != 2], times[times != 2]):
        raise refused(frame.contact_file,
                      f"frame {frame.name}: the contact of {first} and {second} occurs {count} times, not twice; is the "
                      "file truncated? (With fixed grains, add the .restart file.)")


def check_counts(path: str, frames: list[Frame]) -> None:
    """The .ene file contains the number of contacts of every frame."""
    table = read_table(path)
    times, counts = table.numbers("time"), table.whole("collisions")
    for frame in frames:
        if frame.contacts is None:
            continue
        walls = int(np.sum(frame.contacts["wall"] >= 0))
        found = (len(frame.contacts["wall"]) - walls) // 2 + walls
        for row in np.flatnonzero((abs(times - frame.time) <= 1e-5 * abs(frame.time)) & (counts != found)):
            raise refused(path, f"counts {counts[row]} contacts; {frame.contact_file} has {found}", table.lines[row])
