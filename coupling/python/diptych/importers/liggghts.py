# diptych: reads LIGGGHTS: dump custom of grains, dump local of contacts and wall contacts, STL of plates
# SPDX-License-Identifier: LGPL-2.1-or-later
"""LIGGGHTS, one layer of spheres."""

import re

import numpy as np

from .dumps import Section, add_section, is_dump, read_dump, require_same_steps
from .frames import Frame, Options, Wall, contacts_of, joined, refused, rows_of
from .periods import shifts_of
from .tables import Table
from .text import number_in_name
from .walls import sorted_files, wall_of

# Keywords of compute pair/gran/local and wall/gran/local with their numbers of columns; history takes what is left.
WIDTHS = {"pos": 6, "vel": 6, "id": 3, "ms_id": 2, "contactPoint": 3, "contactArea": 1, "delta": 1, "heatFlux": 1,
          **dict.fromkeys(["force", "force_normal", "force_tangential"], 3),
          **dict.fromkeys(["torque", "torque_normal", "torque_tangential", "torque_n", "torque_t"], 3)}
USUAL = {"contacts": [["pos", "id", "force", "force_normal", "force_tangential", "contactArea", "delta",
                       "contactPoint"],
                      ["pos", "id", "force"]],
         "walls": [["pos", "id", "force", "contactPoint"], ["pos", "id", "force"]]}


def _expanded(keywords: list[str], width: int) -> list[str] | None:
    """pos.1 ... pos.6, id.1 ...: names of the columns; None if keywords and width do not agree."""
    unknown = [keyword for keyword in keywords if keyword not in WIDTHS and keyword != "history"]
    if unknown:
        raise refused("--columns", f"'{unknown[0]}' is no keyword of the computes; known are {', '.join(WIDTHS)}, "
                      "history")
    left = width - sum(WIDTHS.get(keyword, 0) for keyword in keywords)
    if left < 0 or (left > 0) != ("history" in keywords):
        return None
    return [f"{keyword}.{k}" for keyword in keywords for k in range(1, 1 + WIDTHS.get(keyword, left))]


def _named(section: Section, kind: str, options: Options) -> Table | None:
    """The table with names for its columns, if it may be of this kind."""
    table, given = section.table, options.columns_of(kind)
    found = (_expanded(keywords, len(table.columns)) for keywords in ([given] if given else USUAL[kind]))
    return next((Table(table.path, columns, table.rows, table.lines) for columns in found if columns), None)


def _pair(table: Table, keyword: str, first: int, options: Options) -> np.ndarray:
    """(n, 2) the part in the plane of the layer of the vector that begins at column `first` of a keyword."""
    return table.vectors(*(f"{keyword}.{first + axis}" for axis in options.axes()))


def _couple(table: Table, lever: np.ndarray, options: Options) -> np.ndarray:
    """(n) couple on the grain: its torque about its centre less the moment of the force, which acts at `lever`."""
    axis, sign = (3, 1) if options.axes() == [0, 1] else (2, -1)
    force = _pair(table, "force", 1, options)
    return sign * table.numbers(f"torque.{axis}") - (lever[:, 0] * force[:, 1] - lever[:, 1] * force[:, 0])


def _fits(table: Table | None, kind: str, frame: Frame, options: Options) -> bool:
    """True if the ids and places of the rows are those of grains: two in a contact, the third id in a wall contact."""
    if table is None:
        return False
    for column, place in [("id.1", 1), ("id.2", 4)] if kind == "contacts" else [("id.3", 4)]:
        rows = rows_of(frame.grains["id"], table.numbers(column))
        is_there = rows >= 0
        if table.has("pos.1"):
            off = frame.grains["position"][rows] - _pair(table, "pos", place, options)
            off = off - shifts_of(frame.period, off)
            is_there &= np.linalg.norm(off, axis=1) <= frame.grains["radius"][rows]
        if np.sum(is_there) < 0.9 * len(rows):
            return False
    return True


def _group_of(section: Section) -> tuple[str, ...]:
    """Sections of one dump: the same columns in files whose names differ by numbers only."""
    return (*section.table.columns, re.sub(r"\d+", "", section.table.path))


def _kinds_of(sections: list[Section], frames: dict[int, Frame], options: Options) -> dict[tuple[str, ...], str]:
    """The kind of every group of sections, by its columns and the numbers in them."""
    kinds: dict[tuple[str, ...], str] = {}
    for section in sorted(sections, key=lambda one: -len(one.table.rows)):
        group, frame, table = _group_of(section), frames[section.step], section.table
        if group in kinds:
            continue
        fitting = [kind for kind in USUAL if _fits(_named(section, kind, options), kind, frame, options)]
        if not fitting:
            raise refused(table.path, f"step {section.step}: {len(table.columns)} columns are neither contacts nor "
                          "wall contacts; give the compute's keywords: --columns contacts=pos,id,... or "
                          "walls=pos,id,...", section.head() + 1)
        kinds[group] = next((kind for kind in fitting if kind not in kinds.values()), fitting[0])
    return kinds


@np.errstate(all="ignore")
def _levers(frame: Frame, first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """(n, 2) from the first grain to the middle of the overlap, where LIGGGHTS lets the force act."""
    a, b = (rows_of(frame.grains["id"], ids) for ids in (first, second))
    x, r = frame.grains["position"], frame.grains["radius"]
    branch = x[b] - x[a]
    branch = branch - shifts_of(frame.period, branch)
    distance = np.linalg.norm(branch, axis=1)
    return (0.5 * (distance + r[a] - r[b]) / distance)[:, None] * branch


def _contacts(table: Table, frame: Frame, options: Options) -> dict[str, np.ndarray]:
    if frame.period is None and options.period_x is None:
        table.refuse(table.numbers("id.3") != 0, lambda k: "a contact across a periodic edge, but the box is not "
                     "periodic; give --period-x and --period-y, or a table of cell_width")
    frame.contact_file = table.path
    first, second, couple = table.whole("id.1"), table.whole("id.2"), None
    if table.has("torque.1"):
        couple = _couple(table, _levers(frame, first, second), options)
    return contacts_of(first, second, _pair(table, "force", 1, options), line=table.lines,
                       point=_pair(table, "contactPoint", 1, options) if table.has("contactPoint.1") else None,
                       overlap=table.optional(options, "delta.1"), couple=couple)


def _wall_contacts(table: Table, frame: Frame, options: Options) -> dict[str, np.ndarray]:
    """The contact point is the first point of `pos`; the keyword contactPoint is 0 for plates."""
    numbers, wall = np.unique(table.whole("id.1"), return_inverse=True)
    frame.walls += [Wall(f"mesh {number}") for number in numbers]
    frame.contact_file = frame.contact_file or table.path
    grain, force, point, couple = table.whole("id.3"), _pair(table, "force", 1, options), None, None
    if table.has("pos.1"):
        point = _pair(table, "pos", 1, options)
        if table.has("torque.1"):
            lever = point - frame.grains["position"][rows_of(frame.grains["id"], grain)]
            couple = _couple(table, lever, options)
    return contacts_of(grain, -1, force, wall, line=table.lines, point=point, couple=couple)


def _add_plates(path: str, frame: Frame, options: Options) -> None:
    """Planes of an STL along the axes of the layer. It has six digits, so it gives only places that no other file
    contains."""
    import meshio  # type: ignore

    try:
        mesh = meshio.stl.read(path)  # meshio.read ends the process
        corners = mesh.points[mesh.cells_dict["triangle"]][:, :, options.axes()]
    except Exception as error:  # of many kinds, on damaged files
        raise refused(path, f"is no STL of triangles ({error}); is it truncated?") from error
    middle = frame.grains["position"].mean(axis=0)
    frame.wall_file = frame.wall_file or path
    for axis, sides in ((0, ("left", "right")), (1, ("lower", "upper"))):
        flat = corners[np.ptp(corners[:, :, axis], axis=1) == 0]
        for place in np.unique(flat[:, 0, axis]):
            wall = wall_of(frame, sides[int(place > middle[axis])])
            wall.place = float(place) if np.isnan(wall.place) else wall.place


def _frame(section: Section, options: Options) -> Frame:
    table = section.table
    table.columns = options.columns_of("particles", len(table.columns)) or table.columns
    frame = section.frame(options)
    frame.spheres = True
    density = table.optional(options, "density", "rho")
    if "mass" not in frame.grains and density is not None:
        frame.grains["mass"] = 4 / 3 * np.pi * frame.grains["radius"]**3 * density
    return frame


def read(options: Options) -> list[Frame]:
    """Frames of dumps. Raises SceneError."""
    files = sorted_files(options, stl=lambda path: path.endswith(".stl"), dump=is_dump)
    found: dict[str, dict[int, Section]] = {"grains": {}, "contacts": {}, "walls": {}}
    sections = [section for path in files["dump"] for section in read_dump(path, options)]
    for section in sections:
        if section.kind == "ATOMS":
            add_section(found["grains"], section, options)
    frames = {step: _frame(section, options) for step, section in sorted(found["grains"].items())}
    local = [section for section in sections if section.kind == "ENTRIES" and section.step in frames]
    kinds = _kinds_of(local, frames, options)
    for section in local:
        add_section(found[kinds[_group_of(section)]], section, options)
    require_same_steps(found, options)
    plates = {number_in_name(path): path for path in files["stl"]}
    for step, frame in frames.items():
        parts = [take(_named(found[kind][step], kind, options), frame, options)
                 for kind, take in (("contacts", _contacts), ("walls", _wall_contacts)) if step in found[kind]]
        frame.contacts = joined(*parts) if parts else None
        if step in plates:
            _add_plates(plates[step], frame, options)
    return list(frames.values())
