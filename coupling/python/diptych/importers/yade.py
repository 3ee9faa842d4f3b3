# diptych: reads Yade: text exports of spheres, interactions and walls
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Yade, one layer of spheres between Wall bodies."""

from __future__ import annotations

import re

import numpy as np

from .frames import Frame, Options, Wall, contacts_of, refused, rows_of
from .grains import grains_of
from .table_files import read_table, table_of_kind
from .tables import Table
from .text import float_of, floats_of, int_of, number_in_name, read_lines
from .walls import add_wall_tables, is_wall_columns

# Rows of 15 numbers without names.
CONTACTS = ["id1", "id2", *(name + axis for name in ("contactPoint_", "normal_", "normalForce_", "shearForce_")
                            for axis in "xyz"), "penetrationDepth"]
KINDS = {"wall tables": is_wall_columns, "contacts": {"id1", "id2"}.issubset, "walls": {"id", "axis"}.issubset,
         "particles": {"x", "y", "r"}.issubset}


def _kind(path: str, options: Options) -> tuple[str, Table | None]:
    lines = [line for line in read_lines(path) if line.strip()]
    if not any(line.startswith("#") for line in lines) and len(lines[0].split()) == len(CONTACTS):
        return "contacts", read_table(path, options.columns_of("contacts", len(CONTACTS)) or CONTACTS)
    heads = [line for line in lines if line.startswith("#")]
    if any(re.match(r"#.*\bname\b.*\bid\b.*\baxis\b", line) for line in heads):
        return "walls", None
    if heads[:1] == ["#format x_y_z_r"]:  # export.text
        return "particles", read_table(path, ["x", "y", "z", "r"])
    return table_of_kind(path, options, KINDS)


def _walls_in(path: str, frame: Frame) -> dict[int, int]:
    """Rows: name, id, axis, position x y, force x y on the wall; a comment "iter N time T". Returns the wall of each id."""
    of_id: dict[int, int] = {}
    for number, line in enumerate(read_lines(path), 1):
        words = line.split()
        if words and words[0].startswith("#"):
            for word, value in zip(words, words[1:]):
                if word == "time":
                    frame.time = float_of(path, number, value, "time")
                elif word == "iter":
                    frame.step = int_of(path, number, value, "iter")
        elif words:
            if len(words) != 7 or words[2] not in ("0", "1"):
                raise refused(path,
                              "expected name, id, axis (0: wall across x, 1: across y), position and force (2 numbers each) "
                              "of a wall", number)
            x, y, fx, fy = floats_of(path, number, words[3:], "position or force")
            of_id[int_of(path, number, words[1], "id")] = len(frame.walls)
            frame.walls.append(Wall(words[0], place=(x, y)[int(words[2])], force=(fx, fy)))
    if not of_id:
        raise refused(path, "contains no wall")
    return of_id


def _add_interactions(table: Table, of_id: dict[int, int], frame: Frame, options: Options) -> None:
    """normalForce + shearForce acts on id2. A body that is no sphere is a wall and always id1."""
    other, grain = table.whole("id1"), table.whole("id2")
    bad = np.flatnonzero(rows_of(frame.grains["id"], grain) < 0)
    if len(bad):
        raise refused(table.path, f"id2 = {grain[bad[0]]} is not a sphere of {frame.grain_file}", table.lines[bad[0]])
    is_wall = rows_of(frame.grains["id"], other) < 0
    for number in dict.fromkeys(other[is_wall].tolist()):
        if number not in of_id:
            of_id[number] = len(frame.walls)
            frame.walls.append(Wall(f"body {number}"))
    force = table.vectors(["normalForce_x"], ["normalForce_y"])
    if table.has("shearForce_x", "shearForce_y"):
        force = force + table.vectors(["shearForce_x"], ["shearForce_y"])
    wall = np.array([of_id[number] if outside else -1 for number, outside in zip(other.tolist(), is_wall)], dtype=int)
    contacts = contacts_of(grain, other, force, wall, line=table.lines, overlap=table.optional(options, "penetrationDepth"),
                           point=table.optional_vectors(options, ["contactPoint_x"], ["contactPoint_y"]))
    acts = np.any(force != 0, axis=1)
    frame.contacts = {name: values[acts] for name, values in contacts.items()}
    frame.contact_file = table.path


def _frame(number: int, files: dict[str, tuple[str, Table | None]], options: Options) -> Frame:
    path, spheres = files["particles"]
    if not spheres.has("id") and "contacts" in files:
        raise refused(path,
                      f"has no ids (export.text renumbers the spheres), but {files['contacts'][0]} refers to grains by id; use "
                      "export.textExt with format='x_y_z_r_attrs' and attrs=['b.id', ...]")
    frame = Frame(f"_{number}", grains_of(spheres, options), spheres=True, grain_file=path)
    of_id = {}
    if "walls" in files:
        frame.wall_file = files["walls"][0]
        of_id = _walls_in(frame.wall_file, frame)
    if "contacts" in files:
        _add_interactions(files["contacts"][1], of_id, frame, options)
    return frame


def read(options: Options) -> list[Frame]:
    """Frames of text exports or of VTKRecorder. The last number in a file's name is the frame. Raises SceneError."""
    if any(path.endswith((".vtu", ".vtp")) for path in options.files):
        from . import yade_vtk

        return yade_vtk.read(options)
    found: dict[int, dict[str, tuple[str, Table | None]]] = {}
    tables = []
    for path in options.files:
        kind, table = _kind(path, options)
        if kind == "wall tables":
            tables.append(table)
            continue
        files = found.setdefault(number_in_name(path), {})
        if kind in files:
            raise refused(path, f"{files[kind][0]} belongs to the same frame (the last number in the name is the frame)")
        files[kind] = path, table
    for number, files in found.items():
        if "particles" not in files:
            why = "its name contains no frame number" if number < 0 else f"there are no spheres of frame {number}"
            raise refused(next(iter(files.values()))[0],
                          f"{why}. The last number in a file name is the frame, as in contacts_3.txt with spheres_3.txt")
    frames = [_frame(number, found[number], options) for number in sorted(found)]
    add_wall_tables(frames, tables, options)
    return frames
