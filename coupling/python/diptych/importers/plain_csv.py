# diptych: reads tables of particles, contacts and walls
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plain tables. The last number in a file's name is the frame, or the column `frame`."""

import numpy as np

from .frames import Frame, Options, Wall, acting, contacts_of, refused
from .table_files import by_frame, table_of_kind
from .tables import Table, grains_of
from .walls import is_wall_columns

FIRST, SECOND = ("i", "id1", "a"), ("j", "id2", "b")
KINDS = {"walls": is_wall_columns, "particles": {"x", "y"}.issubset,
         "contacts": lambda columns: bool(columns & set(FIRST) and columns & set(SECOND))}


def _add_contacts(table: Table, frame: Frame, options: Options) -> None:
    """A negative body is a wall; the grains that touch it show which one."""
    first, second, force = table.whole(*FIRST), table.whole(*SECOND), table.vectors("fx", "fy")
    table.refuse((first < 0) & (second < 0), lambda k: "this is a contact of two walls")
    swap = first < 0
    first, second = np.where(swap, second, first), np.where(swap, first, second)
    force = np.where(swap[:, None], -force, force)
    couple = table.optional(options, "couple")
    couple = None if couple is None else np.where(swap, -couple, couple)
    numbers = sorted({int(number) for number in second[second < 0]}, reverse=True)
    frame.walls += [Wall(f"wall {number}") for number in numbers]
    wall = np.array([numbers.index(number) if number < 0 else -1 for number in second], dtype=int)
    frame.contacts = acting(contacts_of(first, second, force, wall, line=table.lines,
                                        overlap=table.optional(options, "overlap", "penetration"), couple=couple,
                                        point=table.optional_vectors(options, ("px", "point_x"), ("py", "point_y"))))
    frame.contact_file = table.path


def _frame(number: int, grains: Table, contacts: Table | None, options: Options) -> Frame:
    if contacts is not None and not grains.has("id"):
        raise refused(grains.path, f"has no column id, but {contacts.path} refers to grains by id")
    frame = Frame(str(number) if number >= 0 else "of this file", grains_of(grains, options), step=number,
                  grain_file=grains.path)
    if grains.has("time") and grains.rows:
        frame.time = float(grains.numbers("time")[0])
    if contacts is not None:
        _add_contacts(contacts, frame, options)
    return frame


def read(options: Options) -> list[Frame]:
    """Frames of tables. Raises SceneError."""
    found = by_frame(options, lambda path: table_of_kind(path, options, KINDS))
    return [_frame(number, tables["particles"], tables.get("contacts"), options) for number, tables in found.items()]
