# diptych: reads restart files of MercuryDPM
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Restart files: walls, particles and interactions, as lines "Name key value value key value"."""

import math
from dataclasses import dataclass
from typing import Callable

import numpy as np

from .frames import Frame, Wall, contacts_of, joined, refuse_where, refused
from .periods import period_of
from .tables import refuse_other_plane
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


@dataclass
class _Rows:
    """Numbered lines with numbers behind keywords."""

    path: str
    rows: list[tuple[int, list[str]]]  # line from 1, words
    axes: list[int]  # of the layer

    def vectors(self, key: str) -> np.ndarray:
        """(rows, 2) the part in the plane of the layer of the vectors behind a keyword."""
        return self.after(key, 3)[:, self.axes]

    def turns(self, key: str) -> np.ndarray:
        """(rows) the part that turns within the plane of the layer, counter-clockwise; x, z and y are left-handed."""
        values = self.after(key, 3)
        return values[:, 2] if self.axes == [0, 1] else -values[:, 1]

    def having(self, key: str) -> "_Rows":
        """The rows that contain a keyword."""
        return _Rows(self.path, [row for row in self.rows if key in row[1]], self.axes)

    def after(self, key: str, n: int = 1) -> np.ndarray:
        """(rows, n) numbers behind a keyword, which every row must contain."""
        values = []
        for line, words in self.rows:
            place = words.index(key) + 1 if key in words else len(words)
            if place + n > len(words):
                raise refused(self.path, f"expected '{key}' with {n} values", line)
            values.append(floats_of(self.path, line, words[place:place + n], key))
        return np.array(values).reshape(-1, n)

    def lines(self) -> np.ndarray:
        """(rows) numbers of the lines."""
        return np.array([line for line, _ in self.rows], dtype=int)


def _side(wall: _Rows) -> str:
    """The normal points outwards: `normal` in files of 2015, else the x axis turned by a quaternion (w, x, y, z)."""
    if wall.having("normal").rows:
        normal = wall.after("normal", 3)[0]
    else:
        w, x, y, z = wall.after("orientation", 4)[0]
        normal = np.array([w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)])
    nx, ny = normal[wall.axes]
    if max(abs(nx), abs(ny)) < 0.99:
        told, other = ", ".join(f"{part:g}" for part in normal), abs(normal[2]) > 0.99 and wall.axes[1] == 1
        raise refused(wall.path, f"the normal of this wall, ({told}), is neither along x nor along "
                      f"{'xyz'[wall.axes[1]]}" + "; if the layer lies in the x-z plane, give --plane xz" * other,
                      wall.lines()[0])
    return ("left" if nx < 0 else "right") if abs(nx) > abs(ny) else "lower" if ny < 0 else "upper"


def _wall(wall: _Rows) -> tuple[int, Wall]:
    if wall.rows[0][1][:1] != ["InfiniteWall"]:
        raise refused(wall.path, "expected an InfiniteWall; other shapes are not supported", wall.lines()[0])
    side, number = _side(wall), int(wall.after("id")[0, 0])
    return number, Wall(f"wall {number}", side, wall.vectors("position")[0, 0 if side in ("left", "right") else 1],
                        force=tuple(wall.vectors("force")[0]))


def _period(rows: _Rows) -> np.ndarray | None:
    """The period of boundaries: PeriodicBoundary has its vector as `shift`, LeesEdwardsBoundary its box and `shift`."""
    shifts = []
    for row in rows.rows:
        one = _Rows(rows.path, [row], rows.axes)
        if row[1][0] == "PeriodicBoundary":
            shifts.append(one.vectors("shift")[0])
        elif row[1][0] == "LeesEdwardsBoundary":
            left, right, down, up, shift = (one.after(key)[0, 0] for key in ("left", "right", "down", "up", "shift"))
            shifts += [np.array([right - left, 0]), np.array([shift, up - down])]
    a1, a2 = np.zeros(2), np.zeros(2)
    for shift in shifts:
        if shift[1] == 0 and shift[0] != 0:
            a1 = np.abs(shift)
        elif shift[1] != 0:
            a2 = np.sign(shift[1]) * shift
    return period_of(a1, a2)


def _grains(rows: _Rows, masses_of: Callable[[np.ndarray], np.ndarray]) -> tuple[dict[str, np.ndarray], bool]:
    """The grains, and whether some of them are fixed."""
    radius, inverse = rows.after("radius")[:, 0], rows.after("invMass")[:, 0]
    refuse_where(rows.path, radius <= 0, rows.lines(), lambda k: "a radius must be positive")
    refuse_where(rows.path, inverse < 0, rows.lines(), lambda k: "invMass is negative")
    turn, place = rows.after("orientation", 4), rows.after("position", 3)
    if rows.axes == [0, 1]:
        refuse_other_plane(rows.path, place[:, 1], place[:, 2])
    about = turn[:, 3] if rows.axes == [0, 1] else -turn[:, 2]
    ids = rows.after("id")[:, 0].astype(int) if rows.having("id").rows else np.arange(len(radius))
    grains = {"id": ids, "radius": radius, "line": rows.lines(), "position": rows.vectors("position"),
              "velocity": rows.vectors("velocity"), "resultant": rows.vectors("force"),
              "spin": rows.turns("angularVelocity"), "rotation": 2 * np.arctan2(about, turn[:, 0]),
              "mass": np.where(inverse > 0, 1 / np.where(inverse > 0, inverse, 1), masses_of(radius))}
    return grains, bool(np.any(inverse == 0))


def _contacts(rows: _Rows, key: str, walls: dict[int, int] | None = None) -> dict[str, np.ndarray]:
    """The rows with a key; `walls` is the index of each wall by its number."""
    rows = rows.having(key)
    first, second = rows.after(key, 2).astype(int).T
    wall = np.array([-1 if walls is None else walls.get(number, -2) for number in second.tolist()], dtype=int)
    refuse_where(rows.path, wall == -2, rows.lines(), lambda k: f"wall {second[k]} does not exist")
    return contacts_of(first, second, rows.vectors("force"), wall, point=rows.vectors("contactPoint"),
                       couple=rows.turns("torque"), line=rows.lines())


def read_restart(path: str, axes: list[int]) -> Restart:
    """Reads a restart file; `axes` are those of the layer. Raises SceneError naming file, line and expected text."""
    rows = [(k, line.split()) for k, line in enumerate(read_lines(path), 1)]
    sections = {"Walls": _Rows(path, [], axes), "Boundaries": _Rows(path, [], axes)}
    for k, words in rows:
        if len(words) == 2 and words[0] in ("Walls", "Boundaries", "Particles", "Interactions"):
            count = int_of(path, k, words[1], "the number of " + words[0])
            sections[words[0]] = _Rows(path, rows[k:k + count], axes)
            if len(rows) < k + count:
                raise refused(path, f"the file ends before {count} {words[0]}; is it complete?", len(rows))
    head = _Rows(path, rows[:next((k for k, (_, words) in enumerate(rows) if words[:1] == ["Particles"]), 0)], axes)
    time = head.having("timeStep").after("time")
    if not len(time) or not sections["Particles"].rows:
        raise refused(path, "the file ends without particles or without a time; is it a restart file, and complete?",
                      len(rows))
    gravity, density = head.having("gravity").vectors("gravity"), head.having("density").after("density")
    frame = Frame(f"time {time[0, 0]:.10g}", {}, time=time[0, 0],
                  gravity=tuple(gravity[0]) if len(gravity) else None,
                  spheres=bool(np.any(head.having("particleDimensions").after("particleDimensions") == 3)),
                  grain_file=path, contact_file=path)
    restart = Restart(frame, density[0, 0] if len(density) else math.nan)
    frame.period = _period(sections["Boundaries"])
    walls = dict(_wall(_Rows(path, [row], axes)) for row in sections["Walls"].rows)
    frame.walls = list(walls.values())
    frame.grains, restart.has_fixed = _grains(sections["Particles"], restart.masses_of)
    if "Interactions" in sections:
        index = {number: k for k, number in enumerate(walls)}
        frame.contacts = joined(_contacts(sections["Interactions"], "particleIds"),
                                _contacts(sections["Interactions"], "particleWallIds", index))
    return restart
