# diptych: reads LAMMPS: dump custom of grains and walls, dump local of contacts, data files
# SPDX-License-Identifier: LGPL-2.1-or-later
"""LAMMPS, discs in two dimensions."""

from __future__ import annotations

import re

import numpy as np

from .dumps import Section, add_section, is_dump, read_dump, require_same_steps
from .frames import Frame, Options, Wall, contacts_of, joined, refused, rows_of
from .grains import DIAMETER, RADIUS, grains_of
from .lammps_data import is_data_file, read_data
from .table_files import read_table
from .tables import Table
from .walls import add_wall_tables, is_wall_table

# compute pair/local and property/local in the order of the README.
CONTACTS = ["index", "patom1", "patom2", "dist", "force", "fx", "fy", "p1", "p2", "p4"]
FIRST, SECOND = ("patom1", "id1"), ("patom2", "id2")


def _walls_in(table: Table) -> list[str]:
    """Names of `fix wall/gran ... contacts` in columns such as f_left[2]."""
    return list(dict.fromkeys(found[1] for name in table.columns if (found := re.match(r"(f_\w+)\[2\]$", name))))


def _sorted_sections(options: Options) -> tuple[dict[str, dict[int, Section]], list[str], list[str]]:
    """Sections of grains, contacts and walls by step; wall tables; data files."""
    found: dict[str, dict[int, Section]] = {"grains": {}, "contacts": {}, "walls": {}}
    tables, data = [], []
    for path in options.files:
        if is_dump(path):
            for section in read_dump(path):
                for kind in _kinds_of(section, options):
                    add_section(found[kind], section, options)
        elif is_wall_table(path):
            tables.append(path)
        elif is_data_file(path):
            data.append(path)
        else:
            raise refused(path,
                          "is neither a dump (ITEM: TIMESTEP), a data file (N atoms) nor a wall table (step, width, height)")
    return found, tables, data


def _kinds_of(section: Section, options: Options) -> list[str]:
    table, path = section.table, section.table.path
    for axis in (0, 1):
        if section.periodic[axis]:
            raise refused(path, f"the box is periodic along {'xy'[axis]}; the files do not show contacts across its edge")
    if section.kind == "ENTRIES":
        return ["contacts"]
    names = None if _walls_in(table) else options.columns_of("particles", len(table.columns))
    if names:
        table.columns = names
    is_grains = section.has_places() and table.find(*RADIUS, *DIAMETER) is not None
    if not is_grains and not _walls_in(table):
        raise refused(path,
                      f"step {section.step}: grains need the columns id, x y (or xs ys, xu yu) and radius or diameter, wall "
                      f"contacts f_NAME[2] ...; its columns are {', '.join(table.columns)}; name others with "
                      "--columns particles=...", table.lines[0] - 1 if len(table.lines) else 0)
    return ["grains"] * is_grains + ["walls"] * bool(_walls_in(table))


def _contacts(table: Table, frame: Frame, options: Options) -> dict[str, np.ndarray]:
    names = options.columns_of("contacts") or (None if table.find(*FIRST) is not None else CONTACTS)
    if names and len(names) != len(table.columns):
        raise refused(table.path, f"rows have {len(table.columns)} columns, not {len(names)}; name them with "
                      "--columns contacts=index,patom1,patom2,...")
    table.columns = names or table.columns
    first, second, force = table.whole(*FIRST), table.whole(*SECOND), table.vectors(["fx"], ["fy"])
    _verify(table, frame, first, second, force)
    if table.has("p1", "p2"):
        force = force + table.vectors(["p1"], ["p2"])
    else:
        frame.lacking = ["tangential forces (fx, fy of compute pair/local are the normal part, p1, p2 the tangential part)"]
    acts = np.any(force != 0, axis=1)
    return contacts_of(first[acts], second[acts], force[acts], line=table.lines[acts])


def _verify(table: Table, frame: Frame, first: np.ndarray, second: np.ndarray, force: np.ndarray) -> None:
    """The distance is that of the centres, and the normal force is parallel to them: else the columns mean something else."""
    ids, position = frame.grains["id"], frame.grains["position"]
    a, b = rows_of(ids, first), rows_of(ids, second)
    branch, size = position[a] - position[b], np.linalg.norm(force, axis=1)
    length, known = np.linalg.norm(branch, axis=1), (a >= 0) & (b >= 0)
    across = abs(branch[:, 0] * force[:, 1] - branch[:, 1] * force[:, 0])
    wrong = {"the direction of the normal force": across > 1e-4 * length * size}
    if table.has("force"):
        wrong["the size of the normal force"] = abs(abs(table.numbers("force")) - size) > 1e-5 * size
    if table.has("dist"):
        wrong["the distance of the centres"] = abs(table.numbers("dist") - length) > 1e-5 * length
    for what, is_wrong in wrong.items():
        bad = np.flatnonzero(is_wrong & known)
        if len(bad):
            raise refused(table.path, f"{what} does not agree with the grains; does the column have another meaning (--columns "
                          "contacts=index,patom1,patom2,dist,...)?", table.lines[bad[0]])


def _wall_contacts(table: Table, frame: Frame) -> list[dict[str, np.ndarray]]:
    """Columns of `fix wall/gran ... contacts`: 1 touches, 2 and 3 force on the grain, 5 and 6 contact point."""
    parts = []
    for name in _walls_in(table):
        touches = table.numbers(name + "[1]") if table.has(name + "[1]") else table.numbers(name + "[2]")
        rows = table.part(touches != 0)
        point = rows.vectors([name + "[5]"], [name + "[6]"]) if rows.has(name + "[5]", name + "[6]") else None
        parts.append(contacts_of(rows.whole("id"), -1, rows.vectors([name + "[2]"], [name + "[3]"]), len(frame.walls),
                                 point=point, line=rows.lines))
        frame.walls.append(Wall(name))
    return parts


def _frame(step: int, found: dict[str, dict[int, Section]], options: Options) -> Frame:
    section = found["grains"][step]
    section.table.numbers("id")
    frame = Frame(f"step {step}", grains_of(section.table, options, section.positions()), step=step,
                  grain_file=section.table.path,
                  time=options.time_of(step) if section.time is None else section.time)
    parts = []
    if step in found["contacts"]:
        parts.append(_contacts(found["contacts"][step].table, frame, options))
        frame.contact_file = found["contacts"][step].table.path
    if step in found["walls"]:
        parts += _wall_contacts(found["walls"][step].table, frame)
    if parts:
        frame.contacts = joined(*parts)
    return frame


def read(options: Options) -> list[Frame]:
    """Frames of dumps, or of data files. Raises SceneError."""
    found, tables, data = _sorted_sections(options)
    require_same_steps(found, options)
    frames = [_frame(step, found, options) for step in sorted(found["grains"])]
    if data and frames:
        options.note(f"{data[0]}: this data file was not used, because there are dumps")
    frames = frames or [read_data(path, options) for path in data]
    add_wall_tables(frames, [read_table(path) for path in tables], options)
    return frames
