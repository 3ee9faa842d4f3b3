# diptych: bodies and contacts of LMGC90, shared by its two formats
# SPDX-License-Identifier: LGPL-2.1-or-later
"""RBDY2 bodies with one contactor each: a disc (DISKx) or a wall (JONCx)."""

import math
import re
from dataclasses import dataclass
from typing import Any

import numpy as np

from .frames import Frame, Options, Wall, acting, contacts_of, refuse_where, refused
from .text import float_of, read_lines


@dataclass(kw_only=True)
class Bodies:
    """Arrays with one entry a body, in the order of the file; body k of a contact is entry k - 1."""

    path: str
    number: list[str]  # as the file names the body
    is_wall: np.ndarray
    size: np.ndarray  # radius of a disc, half thickness of a wall
    place: np.ndarray  # (n, 3) coo1, coo2, coo3
    mass: np.ndarray  # nan: no density


def field(path: str, number: int, line: str, name: str) -> float:
    """The number behind a name (a regular expression): up to 14 characters, as columns are fixed and may touch."""
    found = re.search(name, line)
    if not found:
        raise refused(path, "expected '" + name.replace("\\", "").replace("?", "") + "'", number)
    return float_of(path, number, line[found.end():found.end() + 14].strip(), found[0])


def read_bulk(path: str) -> tuple[dict[str, float], tuple[float, float] | None]:
    """BULK_BEHAV.DAT: density by nickname [mass/length^2], and gravity."""
    densities, gravity = {}, None
    for k, line in enumerate(read_lines(path), 1):
        if line.lstrip()[:1] in ("!", ""):
            continue
        if re.search("grv1 *=", line):
            gravity = field(path, k, line, "grv1 *="), field(path, k, line, "grv2 *=")
        if re.search("Umas *=", line):
            densities[line.split()[0]] = field(path, k, line, "Umas *=")
    if not densities:
        raise refused(path, "contains no density (Umas=)")
    return densities, gravity


def read_bodies(path: str, densities: dict[str, float], options: Options) -> Bodies:
    """Reads BODIES.DAT, counting bodies in the order of the file, as LMGC90 does. Raises SceneError."""
    blocks: list[dict[str, Any]] = []
    for k, line in enumerate(read_lines(path), 1):
        words = line.split()
        if len(words) == 2 and words[0] in ("RBDY2", "RBDY3", "MAILx"):
            if words[0] != "RBDY2":
                raise refused(path, f"a body {words[0]}; only rigid bodies in two dimensions (RBDY2) are supported", k)
            blocks.append({"line": k, "number": words[1]})
        block = blocks[-1] if blocks else {}
        if "avrd" in line:
            block["avrd"] = field(path, k, line, "avrd *=")
            block["density"] = densities.get(words[3], math.nan) if len(words) > 3 else math.nan
        if "coo1" in line:
            block["place"] = [field(path, k, line, f"coo{axis} *=") for axis in (1, 2)]
            block["place"].append(field(path, k, line, "coo3 *=") if "coo3" in line else 0.0)
        if " color " in line:
            if words[0] not in ("DISKx", "JONCx") or "size" in block:
                raise refused(path, f"a contactor {words[0]}; a body may have one, DISKx or JONCx", k)
            block["is_wall"] = words[0] == "JONCx"
            block["size"] = field(path, k, line, "axe?2 *=" if block["is_wall"] else "byrd *=")
    if not blocks:
        raise refused(path, "contains no body RBDY2")
    for number, block in enumerate(blocks, 1):
        if "place" not in block or "size" not in block:
            raise refused(path, f"body {number} has no position (coo1, coo2), nor the radius of a disc (byrd) nor the "
                          "half axes of a wall (axe1, axe2); is the file truncated?", block["line"])
    if [block["number"] for block in blocks] != [str(k) for k in range(1, len(blocks) + 1)]:
        options.note(f"{path}: bodies are counted in the order of the file, because their numbers are not 1, 2, 3, ...")
    is_wall, size = np.array([block["is_wall"] for block in blocks]), np.array([block["size"] for block in blocks])
    equivalent = np.array([block.get("avrd", 0.0) for block in blocks])
    density = np.array([block.get("density", math.nan) for block in blocks])
    return Bodies(path=path, number=[block["number"] for block in blocks], is_wall=is_wall, size=size,
                  place=np.array([block["place"] for block in blocks]),
                  mass=density * math.pi * np.where(equivalent != 0, equivalent, size)**2)


def place_bodies(frame: Frame, bodies: Bodies, x: np.ndarray, v: np.ndarray) -> None:
    """Adds grains and walls. `x`, `v` (n, 3): displacement, velocity. The angle of a wall is coo3 + X(3)."""
    if len(x) != len(bodies.mass):
        raise refused(frame.grain_file, f"has {len(x)} bodies, but {bodies.path} has {len(bodies.mass)}")
    place, grain = bodies.place + x, np.flatnonzero(~bodies.is_wall)
    frame.grains = {"id": grain + 1, "position": place[grain, :2], "radius": bodies.size[grain],
                    "velocity": v[grain, :2], "spin": v[grain, 2], "rotation": x[grain, 2], "mass": bodies.mass[grain]}
    middle = place[grain, :2].mean(axis=0) if len(grain) else np.zeros(2)
    for k in np.flatnonzero(bodies.is_wall):
        turn = abs(math.sin(place[k, 2]))
        if 1e-4 < turn < 1 - 1e-8:
            raise refused(frame.grain_file,
                          f"wall body {k + 1} is inclined (coo3 + X(3) = {place[k, 2]:.6g}); only horizontal and "
                          "vertical walls are supported")
        axis = 0 if turn > 0.5 else 1  # normal to the wall
        before = bool(place[k, axis] < middle[axis])
        side = (("right", "left") if axis == 0 else ("upper", "lower"))[before]
        inner = place[k, axis] + (1 if before else -1) * bodies.size[k]
        frame.walls.append(Wall(f"body {k + 1}", side, float(inner), travel=float(x[k, 1 - axis])))


def contacts_with(path: str, numbers: np.ndarray, values: np.ndarray, slides: np.ndarray, bodies: Bodies,
                  *, lines: np.ndarray | None = None) -> dict[str, np.ndarray]:
    """Contacts from candidate and antagonist (m, 2) and rlt, rln, gap, n1, n2, coo1, coo2 (m, 7).

    The force on the candidate is rln n + rlt t with t = (n2, -n1). Rows without a force are close pairs.
    """
    normal, lines = values[:, 3:5], np.zeros(len(numbers), dtype=int) if lines is None else lines
    refuse_where(path, abs(np.sum(normal**2, axis=1) - 1) > 1e-5, lines,
                 lambda k: f"the normal of contact {k + 1} is not a unit normal: {normal[k]}")
    refuse_where(path, np.any((numbers < 1) | (numbers > len(bodies.mass)), axis=1), lines,
                 lambda k: f"a contact of body {numbers[k].max()}, but {bodies.path} has {len(bodies.mass)} bodies")
    wall_of = np.where(bodies.is_wall, np.cumsum(bodies.is_wall) - 1, -1)
    force = values[:, 1:2] * normal + values[:, 0:1] * np.column_stack([normal[:, 1], -normal[:, 0]])
    return acting(contacts_of(numbers[:, 0], numbers[:, 1], force, wall_of[numbers[:, 1] - 1], point=values[:, 5:7],
                              overlap=-values[:, 2], slides=slides, line=lines))
