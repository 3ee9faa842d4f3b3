# diptych: reads Yade's VTKRecorder: spheres and interactions
# SPDX-License-Identifier: LGPL-2.1-or-later
"""VTKRecorder's .vtu of spheres and .vtp of interactions, in pairs."""

import tempfile
import xml.etree.ElementTree as ElementTree
from typing import Any

import meshio  # type: ignore
import numpy as np

from .frames import Frame, Options, contacts_of, refused
from .text import number_in_name
from .walls import sorted_files

LACKING = ["tangential forces (VTKRecorder keeps absolute components without direction)", "contacts with walls"]


def _put_in_place(root: Any) -> None:
    """Moves appended arrays into their elements: meshio decodes to the end of the text, which Python 3.13 refuses."""
    appended = root.find("AppendedData")
    if appended is None:
        return
    arrays = sorted((array for array in root.iter("DataArray") if array.get("format") == "appended"),
                    key=lambda array: int(array.get("offset")))
    text = appended.text.strip()[1:]  # without the underscore
    for array, later in zip(arrays, [*arrays[1:], None]):
        array.set("format", "binary")
        array.text = text[int(array.get("offset")):None if later is None else int(later.get("offset"))]
    root.remove(appended)


def mesh_of(path: str) -> Any:
    """The points and lines of a file. meshio reads unstructured grids; lines of a .vtp are written as one."""
    try:
        tree = ElementTree.parse(path)
        root = tree.getroot()
        _put_in_place(root)
        data = root.find("PolyData")
        if data is not None:
            root.set("type", "UnstructuredGrid")
            data.tag, piece = "UnstructuredGrid", data.find("Piece")
            piece.set("NumberOfCells", piece.get("NumberOfLines"))
            for name in ("Verts", "Strips", "Polys"):
                for unused in piece.findall(name):
                    piece.remove(unused)
            cells = piece.find("Lines")
            cells.tag = "Cells"
            types = ElementTree.SubElement(cells, "DataArray", type="UInt8", Name="types", format="ascii")
            types.text = "3 " * int(piece.get("NumberOfLines"))
        with tempfile.NamedTemporaryFile(suffix=".vtu") as file:
            tree.write(file.name)
            return meshio.vtu.read(file.name)  # meshio.read ends the process
    except Exception as error:  # of many kinds, on damaged files
        raise refused(path, f"is no complete VTK file of one piece ({error})") from error


def _spheres(path: str) -> dict[str, np.ndarray]:
    mesh = mesh_of(path)
    found = mesh.point_data or {}
    for name in ("radii", "id"):
        if name not in found:
            raise refused(path, f"lacks the array {name} of its points; its arrays are {', '.join(found)}")
    grains = {"id": np.ravel(found["id"]), "position": mesh.points[:, :2], "radius": np.ravel(found["radii"])}
    for name, array, part in (("mass", "mass", 0), ("velocity", "linVelVec", slice(2)), ("spin", "angVelVec", 2)):
        if array in found:
            grains[name] = found[array].reshape(len(mesh.points), -1)[:, part]
    return grains


def _interactions(path: str, frame: Frame) -> dict[str, np.ndarray]:
    """Lines join points: bodies in the order of their ids, including walls. Positions identify the grains."""
    mesh = mesh_of(path)
    ends = np.concatenate([block.data for block in mesh.cells])
    if "forceN" not in mesh.cell_data:
        raise refused(path, "lacks the array forceN of its lines")
    force = np.ravel(np.concatenate(mesh.cell_data["forceN"]))
    row_at = {tuple(place): row for row, place in enumerate(frame.grains["position"].tolist())}
    rows = np.array([row_at.get(tuple(place), -1) for place in mesh.points[:, :2].tolist()])[ends]
    if np.any(rows < 0):
        raise refused(path, f"line {np.flatnonzero(np.any(rows < 0, axis=1))[0]} (counted from 0) does not end at a "
                      f"sphere of {frame.grain_file}: the frames do not match")
    branch = frame.grains["position"][rows[:, 0]] - frame.grains["position"][rows[:, 1]]
    normal = branch / np.linalg.norm(branch, axis=1)[:, None]
    return contacts_of(frame.grains["id"][rows[:, 0]], frame.grains["id"][rows[:, 1]], force[:, None] * normal)


def read(options: Options) -> list[Frame]:
    """Frames of pairs of files with the same iteration in their names. Raises SceneError."""
    found = sorted_files(options, vtu=lambda path: path.endswith(".vtu"), vtp=lambda path: path.endswith(".vtp"))
    spheres, lines = ({number_in_name(path): path for path in found[kind]} for kind in ("vtu", "vtp"))
    if len(spheres) + len(lines) < sum(len(paths) for paths in found.values()):
        raise refused("import yade", "two files of one kind have the same last number in their names, the iteration")
    frames = []
    for number, path in sorted(spheres.items()):
        frame = Frame(f"iteration {number}", _spheres(path), step=number, time=options.time_of(number), spheres=True,
                      grain_file=path, lacking=LACKING)
        if number in lines:
            frame.contact_file = lines[number]
            frame.contacts = _interactions(frame.contact_file, frame)
        elif frames:
            raise refused(path, f"there is no .vtp of iteration {number}: the frames do not match")
        frames.append(frame)
    return frames
