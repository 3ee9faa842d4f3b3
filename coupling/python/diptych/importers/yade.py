# diptych: reads Yade: text exports of spheres, interactions and walls
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Yade, one layer of spheres between Wall bodies."""

import re

import numpy as np

from .frames import Frame, Options, Wall, acting, contacts_of, refused, rows_of
from .table_files import by_frame, read_table, table_of_kind
from .tables import Table, grains_of
from .text import float_of, int_of, read_lines
from .walls import is_wall_columns

# Rows of 15 numbers without names.
CONTACTS = ["id1", "id2", *(name + axis for name in ("contactPoint_", "normal_", "normalForce_", "shearForce_")
                            for axis in "xyz"), "penetrationDepth"]
# of walls; the force acts on the wall
BODIES = ["name", "id", "axis", "position_x", "position_y", "force_x", "force_y"]
KINDS = {"walls": is_wall_columns, "contacts": {"id1", "id2"}.issubset, "wall bodies": {"id", "axis"}.issubset,
         "particles": {"x", "y", "r"}.issubset}


def _kind(path: str, options: Options) -> tuple[str, Table]:
    lines = [line for line in read_lines(path) if line.strip()]
    heads = [line for line in lines if line.startswith("#")]
    width = len(lines[0].split())
    if not heads and width == len(CONTACTS) and not any(options.has_columns(kind, width) for kind in KINDS):
        return "contacts", read_table(path, CONTACTS)
    if any(re.match(r"#.*\bname\b.*\bid\b.*\baxis\b", line) for line in heads):
        return "wall bodies", read_table(path, BODIES)
    if heads[:1] == ["#format x_y_z_r"]:  # export.text
        return "particles", read_table(path, ["x", "y", "z", "r"])
    return table_of_kind(path, options, KINDS)


def _add_walls(table: Table, frame: Frame, options: Options) -> dict[int, int]:
    """Adds the walls, time and step of the comment "iter N time T". Returns the index of each wall by its id."""
    frame.wall_file, ids, axis = table.path, table.whole("id"), table.whole("axis")
    up = options.axes()[1]
    table.refuse((axis != 0) & (axis != up), lambda k: f"axis = {axis[k]} must be 0 (a wall across x) or {up} (across "
                 f"{'xyz'[up]})" + ("; if the layer lies in the x-z plane, give --plane xz" if axis[k] == 2 else ""))
    axis = np.minimum(axis, 1)
    place, force = table.vectors("position_x", "position_y"), table.vectors("force_x", "force_y")
    frame.walls = [Wall(row[table.find("name")], place=place[k, axis[k]], force=tuple(force[k]))
                   for k, row in enumerate(table.rows)]
    for number, line in enumerate(read_lines(table.path), 1):
        told = dict(re.findall(r"\b(time|iter) (\S+)", line) if line.startswith("#") else [])
        if "time" in told:
            frame.time = float_of(table.path, number, told["time"], "time")
        if "iter" in told:
            frame.step = int_of(table.path, number, told["iter"], "iter")
    return {int(number): k for k, number in enumerate(ids)}


def _add_interactions(table: Table, of_id: dict[int, int], frame: Frame, options: Options) -> None:
    """normalForce + shearForce acts on id2. A body that is no sphere is a wall and always id1."""
    other, grain = table.whole("id1"), table.whole("id2")
    table.refuse(rows_of(frame.grains["id"], grain) < 0, lambda k: f"id2 = {grain[k]} is not a sphere of "
                 f"{frame.grain_file}")
    is_wall = rows_of(frame.grains["id"], other) < 0
    for number in dict.fromkeys(other[is_wall].tolist()):
        if number not in of_id:
            of_id[number] = len(frame.walls)
            frame.walls.append(Wall(f"body {number}"))
    force = table.vectors("normalForce_x", "normalForce_y")
    if table.has("shearForce_x", "shearForce_y"):
        force = force + table.vectors("shearForce_x", "shearForce_y")
    wall = np.array([of_id[number] if outside else -1 for number, outside in zip(other.tolist(), is_wall)], dtype=int)
    frame.contacts = acting(contacts_of(grain, other, force, wall, line=table.lines,
                                        overlap=table.optional(options, "penetrationDepth"),
                                        point=table.optional_vectors(options, ["contactPoint_x"], ["contactPoint_y"])))
    frame.contact_file = table.path


def _frame(number: int, tables: dict[str, Table], options: Options) -> Frame:
    spheres, contacts = tables["particles"], tables.get("contacts")
    if contacts and not spheres.has("id"):
        raise refused(spheres.path,
                      f"has no ids (export.text renumbers the spheres), but {contacts.path} refers to grains by id; "
                      "use export.textExt with format='x_y_z_r_attrs' and attrs=['b.id', ...]")
    frame = Frame(f"_{number}", grains_of(spheres, options), step=number, spheres=True, grain_file=spheres.path)
    of_id = _add_walls(tables["wall bodies"], frame, options) if "wall bodies" in tables else {}
    if contacts:
        _add_interactions(contacts, of_id, frame, options)
    return frame


def read(options: Options) -> list[Frame]:
    """Frames of text exports or of VTKRecorder. The last number in a file's name is the frame. Raises SceneError."""
    if any(path.endswith((".vtu", ".vtp")) for path in options.files):
        from . import yade_vtk

        return yade_vtk.read(options)
    found = by_frame(options, lambda path: _kind(path, options))
    return [_frame(number, tables, options) for number, tables in found.items()]
