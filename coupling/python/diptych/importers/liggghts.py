# diptych: reads LIGGGHTS: dump custom of grains, dump local of contacts and wall contacts, STL of plates
# SPDX-License-Identifier: LGPL-2.1-or-later
"""LIGGGHTS, one layer of spheres."""

import numpy as np

from .dumps import Section, add_section, is_dump, read_dump, require_same_steps
from .frames import Frame, Options, Wall, contacts_of, joined, refused
from .liggghts_columns import group_of, kinds_of, named, pair
from .tables import Table
from .text import number_in_name
from .walls import sorted_files, wall_of


def _contacts(table: Table, frame: Frame, options: Options) -> dict[str, np.ndarray]:
    table.refuse(table.numbers("id.3") != 0, lambda k: "a contact across a periodic edge; walls are needed")
    frame.contact_file = table.path
    return contacts_of(table.whole("id.1"), table.whole("id.2"), pair(table, "force", 1), line=table.lines,
                       point=pair(table, "contactPoint", 1) if table.has("contactPoint.1") else None,
                       overlap=table.optional(options, "delta.1"))


def _wall_contacts(table: Table, frame: Frame, _: Options) -> dict[str, np.ndarray]:
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
    local = []
    for section in (section for path in files["dump"] for section in read_dump(path)):
        if section.kind == "ENTRIES":
            local.append(section)
        else:
            add_section(found["grains"], section, options)
    frames = {step: _frame(section, options) for step, section in sorted(found["grains"].items())}
    kinds = kinds_of(local, frames, options)
    for section in local:
        if section.step in frames:
            add_section(found[kinds[group_of(section)]], section, options)
    require_same_steps(found, options)
    plates = {number_in_name(path): path for path in files["stl"]}
    for step, frame in frames.items():
        parts = [(_contacts if kind == "contacts" else _wall_contacts)(named(found[kind][step], kind, options), frame, options)
                 for kind in ("contacts", "walls") if step in found[kind]]
        frame.contacts = joined(*parts) if parts else None
        if step in plates:
            _add_plates(plates[step], frame)
    return list(frames.values())
