# diptych: reads tables of particles, contacts and walls
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plain tables. The last number in a file's name is the frame, or the column `frame`."""

from __future__ import annotations

import numpy as np

from .frames import Frame, Options, Wall, contacts_of, refused
from .grains import grains_of
from .table_files import table_of_kind
from .tables import Table
from .text import number_in_name
from .walls import add_wall_tables, is_wall_columns

FIRST, SECOND = ("i", "id1", "a"), ("j", "id2", "b")
KINDS = {"walls": is_wall_columns, "particles": {"x", "y"}.issubset,
         "contacts": lambda columns: bool(columns & set(FIRST) and columns & set(SECOND))}


def _by_frame(table: Table) -> dict[int, Table]:
    if not table.has("frame"):
        return {number_in_name(table.path): table}
    numbers = table.whole("frame")
    return {int(number): table.part(numbers == number) for number in np.unique(numbers)}


def _add_contacts(table: Table, frame: Frame, options: Options) -> None:
    """A negative body is a wall; the grains that touch it show which one. Rows without a force are no contacts."""
    first, second, force = table.whole(*FIRST), table.whole(*SECOND), table.vectors(["fx"], ["fy"])
    both = np.flatnonzero((first < 0) & (second < 0))
    if len(both):
        raise refused(table.path, "this is a contact of two walls", table.lines[both[0]])
    swap = first < 0
    first, second, force = np.where(swap, second, first), np.where(swap, first, second), np.where(swap[:, None], -force, force)
    numbers = sorted({int(number) for number in second[second < 0]}, reverse=True)
    frame.walls += [Wall(f"wall {number}") for number in numbers]
    wall = np.array([numbers.index(number) if number < 0 else -1 for number in second], dtype=int)
    contacts = contacts_of(first, second, force, wall, line=table.lines,
                           overlap=table.optional(options, "overlap", "penetration"),
                           point=table.optional_vectors(options, ("px", "point_x"), ("py", "point_y")))
    acts = np.any(force != 0, axis=1)
    frame.contacts = {name: values[acts] for name, values in contacts.items()}
    frame.contact_file = table.path


def _frame(number: int, grains: Table, contacts: Table | None, options: Options) -> Frame:
    if contacts is not None and not grains.has("id"):
        raise refused(grains.path, f"has no column id, but {contacts.path} refers to grains by id")
    frame = Frame(str(number), grains_of(grains, options), step=number, grain_file=grains.path)
    if grains.has("time"):
        frame.time = float(grains.numbers("time")[0])
    if contacts is not None:
        _add_contacts(contacts, frame, options)
    return frame


def read(options: Options) -> list[Frame]:
    """Frames of tables. Raises SceneError."""
    found: dict[str, dict[int, Table]] = {"particles": {}, "contacts": {}}
    walls: list[Table] = []
    for path in options.files:
        kind, table = table_of_kind(path, options, KINDS)
        if kind == "walls":
            walls.append(table)
            continue
        for number, part in _by_frame(table).items():
            if number in found[kind]:
                raise refused(path, f"{found[kind][number].path} has {kind} of the same frame {number}")
            found[kind][number] = part
    for number, table in found["contacts"].items():
        if number not in found["particles"]:
            why = "its name contains no frame number" if number < 0 else f"there are no particles of frame {number}"
            raise refused(table.path,
                          f"{why}. The last number in a file name is the frame, as in contacts_3.csv with particles_3.csv")
    frames = [_frame(number, found["particles"][number], found["contacts"].get(number), options)
              for number in sorted(found["particles"])]
    add_wall_tables(frames, walls, options)
    return frames
