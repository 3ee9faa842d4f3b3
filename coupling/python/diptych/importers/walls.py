# diptych: places and forces of walls from a table beside another code's files
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables of walls and periods, a row a frame: step, time or frame; width and height, some of left_x ... upper_y,
cell_width, or cell_a1_x ... cell_a2_y."""

from typing import Callable

import numpy as np

from .frames import Frame, Options, Wall, refused
from .periods import period_of
from .table_files import table_of_kind
from .tables import Table

PLACES = {"lower": "lower_y", "upper": "upper_y", "left": "left_x", "right": "right_x"}


CELL = "cell_a1_x", "cell_a1_y", "cell_a2_x", "cell_a2_y"


def is_wall_columns(columns: set[str]) -> bool:
    """True for the columns of a table of walls or periods, in lower case."""
    others = {"width", "left_x", "right_x", "step", "time", "frame"}
    return columns.issuperset(CELL) or bool(columns & {"height", "lower_y", "upper_y", "cell_width"}
                                            and columns & others)


def sorted_files(options: Options, **kinds: Callable[[str], bool]) -> dict[str, list[str]]:
    """The files by the first kind that accepts them; wall tables are kept in the options. Raises SceneError."""
    found: dict[str, list[str]] = {kind: [] for kind in kinds}
    for path in options.files:
        kind = next((kind for kind, is_kind in kinds.items() if is_kind(path)), None)
        if kind:
            found[kind].append(path)
        else:
            why = f"is no {' or '.join(kinds).replace('_', ' ')} and "
            options.wall_tables.append(table_of_kind(path, options, {"walls": is_wall_columns}, why)[1])
    return found


def wall_of(frame: Frame, side: str) -> Wall:
    """The wall of a side, added if the frame has none."""
    for wall in frame.walls:
        if wall.side == side:
            return wall
    frame.walls.append(Wall(side, side))
    return frame.walls[-1]


def _rows_of(tables: list[Table], frame: Frame, number: int) -> list[tuple[Table, int]]:
    """Rows of a frame, by its step, its time or its number."""
    found, counted = [], []
    for table in tables:
        keys = []
        if table.has("step") and frame.step is not None:
            keys.append(table.whole("step") == frame.step)
        elif table.has("time") and frame.time is not None:
            keys.append(abs(table.numbers("time") - frame.time) <= 1e-9 * abs(frame.time))
        if table.has("frame"):
            keys += [table.whole("frame") == count for count in (frame.step, number)]
        if keys:
            found += [(table, row) for row in np.flatnonzero(next((key for key in keys if np.any(key)), False))]
        else:
            counted += [(table, row) for row in range(len(table.rows))]
    return found + counted[number:number + 1]


def _add_row(table: Table, row: int, frame: Frame, options: Options) -> None:
    if table.has("width", "height"):
        for name, side in (("width", "right"), ("height", "upper")):
            size = table.numbers(name)[row]
            if size <= 0:
                raise refused(table.path, f"column {name} = {size:g} must be positive", table.lines[row])
            wall_of(frame, side).place = size
        wall_of(frame, "lower").place = wall_of(frame, "left").place = 0.0
    for side, place in PLACES.items():
        if table.has(place):
            wall_of(frame, side).place = table.numbers(place)[row]
        force = table.optional_vectors(options, [side + "_fx"], [side + "_fy"])
        if force is not None:
            wall_of(frame, side).force = tuple(force[row])
    if table.has(*CELL):
        a1_x, a1_y, a2_x, a2_y = (table.numbers(name)[row] for name in CELL)
        frame.period = period_of([a1_x, a1_y], [a2_x, a2_y])
    elif table.has("cell_width"):
        frame.period = period_of([table.numbers("cell_width")[row], 0], [0, 0])
    if table.has("upper_travel"):
        wall_of(frame, "upper").travel = table.numbers("upper_travel")[row]
    if table.has("time") and frame.time is None:
        frame.time = table.numbers("time")[row]
    frame.wall_file = f"{table.path}, line {table.lines[row]}"


def add_wall_tables(frames: list[Frame], options: Options) -> None:
    """Adds places and forces of options.wall_tables to the walls of the frames.

    Raises SceneError for a frame without a row and for rows of one frame that differ.
    """
    for number, frame in enumerate(frames if options.wall_tables else []):
        rows = _rows_of(options.wall_tables, frame, number)
        if not rows and (options.frames or not len(frame.grains["id"])):
            continue  # this frame may be left out
        if not rows:
            raise refused(options.wall_tables[0].path,
                          f"has no row for frame {frame.name} (column step, time or frame)")
        first, at = rows[0]
        known = dict(zip(first.columns, first.rows[at]))
        for table, row in rows[1:]:
            for name, word in zip(table.columns, table.rows[row]):
                if known.get(name) != word:
                    raise refused(table.path, f"frame {frame.name} has another {name} in line {first.lines[at]} of "
                                  f"{first.path}", table.lines[row])
        _add_row(first, at, frame, options)
