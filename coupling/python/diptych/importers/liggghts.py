# diptych: reads LIGGGHTS: dump custom of grains, dump local of contacts and wall contacts, STL of plates
# SPDX-License-Identifier: LGPL-2.1-or-later
"""LIGGGHTS, one layer of spheres."""

from __future__ import annotations

import numpy as np

from .dumps import Section, add_section, is_dump, read_dump
from .frames import Frame, Options, Wall, contacts_of, joined, refused, rows_of
from .grains import grains_of
from .liggghts_columns import group_of, kinds_of, named, pair
from .table_files import read_table
from .tables import Table
from .text import number_in_name
from .walls import add_wall_tables, is_wall_table, wall_of

def _check_places(table: Table, frame: Frame) -> None:
    rows = rows_of(frame.grains["id"], table.whole("id.1"))
    place = frame.grains["position"][rows]
    size = np.linalg.norm(place, axis=1)
    bad = np.flatnonzero((rows >= 0) & (np.linalg.norm(place - pair(table, "pos", 1), axis=1) > 1e-5 * (size + size.mean())))
    if len(bad):
        raise refused(table.path,
                      f"grain {table.whole('id.1')[bad[0]]} has another position in the dump of the grains; are these files of "
                      "different frames, or columns of another meaning (--columns contacts=pos,id,force,...)?",
                      table.lines[bad[0]])


def _contacts(table: Table, frame: Frame, options: Options) -> dict[str, np.ndarray]:
    periodic = np.flatnonzero(table.numbers("id.3") != 0)
    if len(periodic):
        raise refused(table.path, "a contact across a periodic edge; walls are needed", table.lines[periodic[0]])
    if table.has("pos.1"):
        _check_places(table, frame)
    frame.contact_file = table.path
    return contacts_of(table.whole("id.1"), table.whole("id.2"), pair(table, "force", 1), line=table.lines,
                       point=pair(table, "contactPoint", 1) if table.has("contactPoint.1") else None,
                       overlap=table.optional(options, "delta.1"))


def _wall_contacts(table: Table, frame: Frame) -> dict[str, np.ndarray]:
    """The contact point is the first point of `pos`; the keyword contactPoint is 0 for plates."""
    mesh = table.whole("id.1")
    numbers = list(dict.fromkeys(mesh.tolist()))
    frame.walls += [Wall(f"mesh {number}") for number in numbers]
    frame.contact_file = frame.contact_file or table.path
    return contacts_of(table.whole("id.3"), -1, pair(table, "force", 1), [numbers.index(number) for number in mesh],
                       line=table.lines, point=pair(table, "pos", 1) if table.has("pos.1") else None)


def _add_plates(path: str, frame: Frame) -> None:
    """Planes of an STL along x or y. It has six digits, so it gives only places that no other file contains."""
    import meshio  # type: ignore

    try:
        mesh = meshio.stl.read(path)  # meshio.read ends the process
        corners = mesh.points[mesh.cells_dict["triangle"]]
    except Exception as error:  # of many kinds, on damaged files
        raise refused(path, f"is no STL of triangles ({error}); is it truncated?") from error
    middle = frame.grains["position"].mean(axis=0)
    frame.wall_file = frame.wall_file or path
    for axis, sides in ((0, ("left", "right")), (1, ("lower", "upper"))):
        flat = corners[np.ptp(corners[:, :, axis], axis=1) == 0]
        for place in np.unique(flat[:, 0, axis]):
            wall = wall_of(frame, sides[int(place > middle[axis])])
            wall.place = float(place) if np.isnan(wall.place) else wall.place


def read(options: Options) -> list[Frame]:
    """Frames of dumps. Raises SceneError."""
    grains: dict[int, Section] = {}
    local, plates, tables = [], {}, []
    for path in options.files:
        if path.endswith(".stl"):
            plates[number_in_name(path)] = path
        elif is_dump(path):
            for section in read_dump(path):
                local.append(section) if section.kind == "ENTRIES" else add_section(grains, section, options)
        elif is_wall_table(path):
            tables.append(path)
        else:
            raise refused(path, "is neither a dump (ITEM: TIMESTEP), an .stl nor a wall table (step, width, height)")
    frames = {}
    for step, section in sorted(grains.items()):
        section.table.columns = options.columns_of("particles", len(section.table.columns)) or section.table.columns
        frames[step] = Frame(f"step {step}", grains_of(section.table, options, section.positions()), step=step, spheres=True,
                             grain_file=section.table.path, time=options.time_of(step) if section.time is None
                             else section.time)
    kinds, found = kinds_of(local, frames, options), {"contacts": {}, "walls": {}}
    for section in local:
        if section.step in frames:
            add_section(found[kinds[group_of(section)]], section, options)
    for step, frame in frames.items():
        parts = []
        for kind, sections in found.items():
            if step in sections:
                table = named(sections[step], kind, options)
                parts.append(_contacts(table, frame, options) if kind == "contacts" else _wall_contacts(table, frame))
            elif sections and step != min(frames):
                raise refused(frame.grain_file, f"there are no {kind} of step {step}: the frames do not match")
        frame.contacts = joined(*parts) if parts else None
    add_wall_tables(list(frames.values()), [read_table(path) for path in tables], options)
    for step, frame in frames.items():
        if step in plates:
            _add_plates(plates[step], frame)
    return list(frames.values())
