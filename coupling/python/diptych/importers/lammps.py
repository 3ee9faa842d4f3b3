# diptych: reads LAMMPS: dump custom of grains and walls, dump local of contacts, data files
# SPDX-License-Identifier: LGPL-2.1-or-later
"""LAMMPS, discs in two dimensions."""

import re

import numpy as np

from ..errors import SceneError
from .dumps import PLACES, Section, add_section, is_dump, read_dump, require_same_steps
from .frames import Frame, Options, Wall, acting, contacts_of, joined, refused, rows_of
from .lammps_data import is_data_file, read_data
from .periods import shifts_of
from .tables import DIAMETER, RADIUS, Table
from .walls import sorted_files

# compute pair/local and property/local in the order of the README.
CONTACTS = ["index", "patom1", "patom2", "dist", "force", "fx", "fy", "p1", "p2", "p4"]
FIRST, SECOND = ("patom1", "id1"), ("patom2", "id2")


def _walls_in(table: Table) -> list[str]:
    """Names of `fix wall/gran ... contacts` in columns such as f_left[2]."""
    return list(dict.fromkeys(found[1] for name in table.columns if (found := re.match(r"(f_\w+)\[2\]$", name))))


def _kinds_of(section: Section, options: Options) -> list[str]:
    """The kinds of rows that a section has: grains, contacts, walls."""
    table = section.table
    if section.kind == "ENTRIES":
        return ["contacts"]
    names = None if _walls_in(table) else options.columns_of("particles", len(table.columns))
    if names:
        table.columns = names
    is_grains = all(table.find(*names) is not None for names in (*PLACES.values(), (*RADIUS, *DIAMETER)))
    if not is_grains and not _walls_in(table):
        columns = ", ".join(table.columns)
        raise refused(table.path, f"step {section.step}: grains need the columns id, x y (or xs ys, xu yu) and radius "
                      f"or diameter, wall contacts f_NAME[2] ...; its columns are {columns}; name others with "
                      "--columns particles=...", section.head())
    return ["grains"] * is_grains + ["walls"] * bool(_walls_in(table))


def _contacts(table: Table, frame: Frame, options: Options) -> dict[str, np.ndarray]:
    names = options.columns_of("contacts") or (None if table.find(*FIRST) is not None else CONTACTS)
    if names and len(names) != len(table.columns):
        raise refused(table.path, f"rows have {len(table.columns)} columns, not {len(names)}; name them with "
                      "--columns contacts=index,patom1,patom2,...")
    table.columns = names or table.columns
    first, second, force = table.whole(*FIRST), table.whole(*SECOND), table.vectors("fx", "fy")
    ids, position = frame.grains["id"], frame.grains["position"]
    a, b = rows_of(ids, first), rows_of(ids, second)
    branch = position[a] - position[b]
    branch = branch - shifts_of(frame.period, branch)
    size = np.linalg.norm(force, axis=1)
    across = abs(branch[:, 0] * force[:, 1] - branch[:, 1] * force[:, 0])  # else the columns mean something else
    table.refuse((across > 1e-4 * np.linalg.norm(branch, axis=1) * size) & (a >= 0) & (b >= 0),
                 lambda _: "fx, fy are not parallel to the line of the centres; do the columns have another meaning "
                 "(--columns contacts=index,patom1,patom2,dist,...)?")
    if table.has("p1", "p2"):
        force = force + table.vectors("p1", "p2")
    else:
        frame.lacking = ["tangential forces (fx, fy of compute pair/local are the normal part, p1, p2 the tangential "
                         "part)"]
    return acting(contacts_of(first, second, force, line=table.lines))


def _wall_contacts(table: Table, frame: Frame) -> list[dict[str, np.ndarray]]:
    """Columns of `fix wall/gran ... contacts`: 1 touches, 2 and 3 force on the grain, 5 and 6 contact point."""
    parts = []
    for name in _walls_in(table):
        touches = table.numbers(name + "[1]") if table.has(name + "[1]") else table.numbers(name + "[2]")
        rows = table.part(touches != 0)
        point = rows.vectors(name + "[5]", name + "[6]") if rows.has(name + "[5]", name + "[6]") else None
        parts.append(contacts_of(rows.whole("id"), -1, rows.vectors(name + "[2]", name + "[3]"), len(frame.walls),
                                 point=point, line=rows.lines))
        frame.walls.append(Wall(name))
    return parts


def _frame(section: Section, found: dict[str, dict[int, Section]], options: Options) -> Frame:
    frame, parts = section.frame(options), []
    if section.step in found["contacts"]:
        contacts = found["contacts"][section.step].table
        parts.append(_contacts(contacts, frame, options))
        frame.contact_file = contacts.path
    if section.step in found["walls"]:
        parts += _wall_contacts(found["walls"][section.step].table, frame)
    if parts:
        frame.contacts = joined(*parts)
    return frame


def read(options: Options) -> list[Frame]:
    """Frames of dumps, or of data files. Raises SceneError."""
    if options.plane != "xy":
        raise SceneError("import lammps: --plane xz would have no effect: discs in two dimensions lie in the x-y plane")
    files = sorted_files(options, dump=is_dump, data_file=is_data_file)
    found: dict[str, dict[int, Section]] = {"grains": {}, "contacts": {}, "walls": {}}
    for section in (section for path in files["dump"] for section in read_dump(path, options)):
        for kind in _kinds_of(section, options):
            add_section(found[kind], section, options)
    require_same_steps(found, options)
    if not found["grains"]:
        return [read_data(path, options) for path in files["data_file"]]
    for path in files["data_file"]:
        options.note(f"{path}: this data file was not used, because there are dumps")
    return [_frame(section, found, options) for _, section in sorted(found["grains"].items())]
