# diptych: reads restart files of MercuryDPM
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Restart files: walls, particles and interactions, as lines "Name key value value key value"."""

import math
from dataclasses import dataclass
from typing import Callable

import numpy as np

from .frames import Frame, Wall, contacts_of, refuse_where, refused
from .text import floats_of, int_of, read_lines


@dataclass
class Restart:
    """A frame, and what .data files of the same run lack."""

    frame: Frame
    density: float  # of the first species [mass/length^dimension]
    has_fixed: bool = False  # grains of infinite mass

    def masses_of(self, radius: np.ndarray) -> np.ndarray:
        """(n) masses of discs, or of spheres."""
        return self.density * math.pi * radius**2 * (4 / 3 * radius if self.frame.spheres else 1.0)


class _Line:
    """Words of a line, with numbers after keywords."""

    def __init__(self, path: str, number: int, text: str) -> None:
        self.path, self.number, self.words = path, number, text.split()

    def after(self, key: str, n: int = 1) -> list[float]:
        place = self.words.index(key) + 1 if key in self.words else len(self.words)
        if place + n > len(self.words):
            raise refused(self.path, f"expected '{key}' with {n} values", self.number)
        return floats_of(self.path, self.number, self.words[place:place + n], key)


def _side(line: _Line) -> str:
    """The normal points out of the sample: `normal` in files of 2015, else the x axis turned by a quaternion (w, x, y, z)."""
    if "normal" in line.words:
        nx, ny = line.after("normal", 3)[:2]
    else:
        w, x, y, z = line.after("orientation", 4)
        nx, ny = w * w + x * x - y * y - z * z, 2 * (x * y + w * z)
    if abs(nx) > 0.99:
        return "left" if nx < 0 else "right"
    if abs(ny) > 0.99:
        return "lower" if ny < 0 else "upper"
    raise refused(line.path, f"the normal of this wall, ({nx:g}, {ny:g}), is neither along x nor along y", line.number)


def _wall(line: _Line) -> tuple[int, Wall]:
    if line.words[:1] != ["InfiniteWall"]:
        raise refused(line.path, "expected an InfiniteWall; other shapes are not supported", line.number)
    side, position = _side(line), line.after("position", 3)
    number = int(line.after("id")[0])
    return number, Wall(f"wall {number}", side, position[0 if side in ("left", "right") else 1],
                        force=tuple(line.after("force", 3)[:2]))


def _after(lines: list[_Line], key: str, n: int) -> np.ndarray:
    """(lines, n) numbers behind a key."""
    return np.array([line.after(key, n) for line in lines]).reshape(-1, n)


def _grains(lines: list[_Line], masses_of: Callable[[np.ndarray], np.ndarray]) -> tuple[dict[str, np.ndarray], bool]:
    numbers = np.array([line.number for line in lines])
    turn, radius, inverse = _after(lines, "orientation", 4), _after(lines, "radius", 1)[:, 0], _after(lines, "invMass", 1)[:, 0]
    refuse_where(lines[0].path, radius <= 0, numbers, lambda k: "a radius must be positive")
    refuse_where(lines[0].path, inverse < 0, numbers, lambda k: "invMass is negative")
    ids = [line.after("id")[0] if "id" in line.words else k for k, line in enumerate(lines)]
    grains = {"id": np.array(ids).astype(int), "radius": radius, "line": numbers,
              "position": _after(lines, "position", 3)[:, :2], "velocity": _after(lines, "velocity", 3)[:, :2],
              "spin": _after(lines, "angularVelocity", 3)[:, 2], "rotation": 2 * np.arctan2(turn[:, 3], turn[:, 0]),
              "resultant": _after(lines, "force", 3)[:, :2],
              "mass": np.where(inverse > 0, 1 / np.where(inverse > 0, inverse, 1), masses_of(radius))}
    return grains, bool(np.any(inverse == 0))


def _contacts(lines: list[_Line], walls: dict[int, int]) -> dict[str, np.ndarray]:
    """`walls`: index of each wall by its number."""
    is_wall = np.array(["particleWallIds" in line.words for line in lines], dtype=bool)
    ends = np.array([line.after("particleWallIds" if at_wall else "particleIds", 2) for line, at_wall in zip(lines, is_wall)])
    first, second = ends.reshape(-1, 2).astype(int).T
    numbers = np.array([line.number for line in lines], dtype=int)
    wall = np.array([walls.get(number, -2) if at_wall else -1 for number, at_wall in zip(second.tolist(), is_wall)], dtype=int)
    for k in np.flatnonzero(wall == -2):
        raise refused(lines[k].path, f"wall {second[k]} does not exist", lines[k].number)
    return contacts_of(first, second, _after(lines, "force", 3)[:, :2], wall, line=numbers,
                       point=_after(lines, "contactPoint", 3)[:, :2])


def read_restart(path: str) -> Restart:
    """Reads a restart file. Raises SceneError naming file, line and the expected text."""
    lines = [_Line(path, k, text) for k, text in enumerate(read_lines(path), 1)]
    sections: dict[str, list[_Line]] = {}
    restart = Restart(Frame("", {}, grain_file=path, contact_file=path), math.nan)
    for k, line in enumerate(lines):
        if line.words[:1] and line.words[0] in ("Walls", "Particles", "Interactions") and len(line.words) == 2:
            count = int_of(path, k + 1, line.words[1], "the number of " + line.words[0])
            sections[line.words[0]] = lines[k + 1:k + 1 + count]
            if len(sections[line.words[0]]) < count:
                raise refused(path, f"the file ends before {count} {line.words[0]}; is it complete?", len(lines))
        elif "Particles" not in sections:
            if "timeStep" in line.words and "time" in line.words:
                restart.frame.time = line.after("time")[0]
                restart.frame.name = "time " + line.words[line.words.index("time") + 1]
            if "particleDimensions" in line.words:
                restart.frame.spheres = line.after("particleDimensions")[0] == 3
            if "gravity" in line.words:
                restart.frame.gravity = tuple(line.after("gravity", 3)[:2])
            if "density" in line.words and math.isnan(restart.density):
                restart.density = line.after("density")[0]
    if not sections.get("Particles") or restart.frame.time is None:
        raise refused(path, "the file ends without particles or without a time; is it a restart file, and complete?",
                      len(lines))
    walls = dict(_wall(line) for line in sections.get("Walls", []))
    restart.frame.walls = list(walls.values())
    restart.frame.grains, restart.has_fixed = _grains(sections["Particles"], restart.masses_of)
    if "Interactions" in sections:
        restart.frame.contacts = _contacts(sections["Interactions"], {number: k for k, number in enumerate(walls)})
    return restart
