# diptych: places and forces of walls from a table beside another code's files
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables of walls, one row a frame: step, time or frame; width and height, or some of left_x, right_x, lower_y, upper_y."""

from __future__ import annotations

import numpy as np

from .frames import SIDES, Frame, Options, Wall, refused
from .table_files import head_of
from .tables import Table
from .text import read_lines

PLACES = {"lower": "lower_y", "upper": "upper_y", "left": "left_x", "right": "right_x"}


def is_wall_columns(columns: set[str]) -> bool:
    """True for the columns of a wall table, in lower case."""
    return bool(columns & {"height", "lower_y", "upper_y"} and columns & {"width", "left_x", "right_x", "step", "time",
                                                                          "frame"})


def is_wall_table(path: str) -> bool:
    """True if the columns of the file are those of a wall table."""
    return is_wall_columns({name.lower() for name in head_of(read_lines(path)[:20])[0]})


def wall_of(frame: Frame, side: str) -> Wall:
    """The wall of a side, added if the frame has none."""
    for wall in frame.walls:
        if wall.side == side:
            return wall
    frame.walls.append(Wall(side, side))
    return frame.walls[-1]


def _rows_of(table: Table, frame: Frame, number: int) -> np.ndarray:
    """Rows of a frame, by its step, its time or its number."""
    nothing = np.zeros(0, dtype=int)
    rows, keyed = nothing, False
    if table.has("step") and frame.step is not None:
        rows, keyed = np.flatnonzero(table.whole("step") == frame.step), True
    elif table.has("time") and frame.time is not None:
        rows, keyed = np.flatnonzero(abs(table.numbers("time") - frame.time) <= 1e-9 * abs(frame.time)), True
    if table.has("frame") and not len(rows):
        keyed = True
        for count in (frame.step, number):
            if not len(rows) and count is not None:
                rows = np.flatnonzero(table.whole("frame") == count)
    return rows if keyed or number >= len(table.rows) else np.array([number])


def _add_row(table: Table, row: int, path: str, frame: Frame, options: Options) -> None:
    if table.has("width", "height"):
        for name, side in (("width", "right"), ("height", "upper")):
            size = table.numbers(name)[row]
            if size <= 0:
                raise refused(path, f"column {name} = {size:g} must be positive", table.lines[row])
            wall_of(frame, side).place = size
        wall_of(frame, "lower").place = wall_of(frame, "left").place = 0.0
    for side in SIDES:
        if table.has(PLACES[side]):
            wall_of(frame, side).place = table.numbers(PLACES[side])[row]
        force = table.optional_vectors(options, [side + "_fx"], [side + "_fy"])
        if force is not None:
            wall_of(frame, side).force = tuple(force[row])
    if table.has("upper_travel"):
        wall_of(frame, "upper").travel = table.numbers("upper_travel")[row]
    if table.has("time") and frame.time is None:
        frame.time = table.numbers("time")[row]
    frame.wall_file = f"{path}, line {table.lines[row]}"


def add_wall_tables(frames: list[Frame], tables: list[Table], options: Options) -> None:
    """Adds places and forces of tables with the same columns to the walls of the frames.

    Raises SceneError for a frame without a row and for rows of one frame that differ.
    """
    if not tables:
        return
    for table in tables[1:]:
        if table.columns != tables[0].columns:
            raise refused(table.path, f"its columns differ from those of {tables[0].path}")
    whole = Table(tables[0].path, tables[0].columns, [row for table in tables for row in table.rows],
                  [line for table in tables for line in table.lines])
    paths = [table.path for table in tables for _ in table.rows]
    for number, frame in enumerate(frames):
        rows = _rows_of(whole, frame, number)
        if not len(rows) and (options.frames or not len(frame.grains["id"])):
            continue  # this frame may be left out
        if not len(rows):
            raise refused(whole.path, f"has no row for frame {frame.name} (column step, time or frame)")
        first = rows[0]
        for row in rows[1:]:
            for k, name in enumerate(whole.columns):
                if whole.rows[row][k] != whole.rows[first][k]:
                    raise refused(paths[row],
                                  f"frame {frame.name} has another {name} in line {whole.lines[first]} of {paths[first]}",
                                  whole.lines[row])
        _add_row(whole, first, paths[first], frame, options)
