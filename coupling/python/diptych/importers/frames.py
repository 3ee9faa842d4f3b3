# diptych: what a reader of foreign files returns, and the options that it gets
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Frames of grains, contacts and walls, in the units of the files. Forces and masses are of the whole thickness."""

import math
from dataclasses import KW_ONLY, dataclass, field
from typing import Any, Callable, Sequence

import numpy as np

from ..errors import SceneError

# Names of the arrays -> number of their axes; those of two axes are vectors.
GRAINS = {"id": 1, "position": 2, "radius": 1, "mass": 1, "velocity": 2, "spin": 1, "rotation": 1, "resultant": 2,
          "line": 1}
CONTACTS = {"first": 1, "second": 1, "wall": 1, "force": 2, "point": 2, "overlap": 1, "couple": 1, "slides": 1,
            "line": 1}
REQUIRED = {"grains": ("id", "position", "radius"), "contacts": ("first", "second", "wall", "force")}


def refused(path: str, text: str, line: int = 0) -> SceneError:
    """The error to raise for wrong input: it names the file and its line (from 1; 0: none)."""
    error = SceneError(f"{path}, line {line}: {text}" if line else f"{path}: {text}")
    error.file, error.line = path, int(line)
    return error


def refuse_where(path: str, bad: Any, lines: Sequence[int], text: Callable[[int], str]) -> None:
    """Refuses the first row k for which `bad` is true, with text(k) and its line."""
    for k in np.flatnonzero(bad)[:1]:
        raise refused(path, text(k), lines[k])


@dataclass(slots=True)
class Wall:
    """A straight wall along x or y.

    side    "lower", "upper", "left" or "right"; None: the side of the grains that touch it
    place   of its inner face: y of lower and upper, x of left and right; nan: from its contact points
    travel  displacement along itself since the first frame, positive to the right; used for the upper wall, as in shear
    force   (x, y) between wall and sample, of either sign, as the code summed it up; nan: unknown
    """

    name: str
    side: str | None = None
    place: float = math.nan
    _: KW_ONLY
    travel: float = 0.0
    force: Any = (math.nan, math.nan)


@dataclass(slots=True, repr=False)
class Frame:
    """One instant. Arrays have one row per grain (n) or contact (m).

    name      a name that no other frame has
    grains    "id" (n), "position" (n, 2), "radius" (n); if known "mass" (n), "velocity" (n, 2), "spin" and "rotation"
              (n, counter-clockwise), "resultant" (n, 2: of all forces, as the code summed them up), "line" (n, of the
              file)
    contacts  "first", "second" (m, ids), "wall" (m, index in `walls`, -1: two grains), "force" (m, 2, on `first`); if
              known "point" (m, 2), "overlap" (m), "couple" (m, of rolling resistance on `first`, counter-clockwise),
              "slides" (m, 0 or 1), "line" (m). None: the files hold no contacts
    walls     list of Wall
    period    (2, 2), whose columns are the vectors a1 and a2 of a periodic sample; a2 = 0: along x only. None: none
    gravity   acceleration of every grain; None: unknown
    time      of the instant; None: unknown. step: its number
    spheres   True: one layer of spheres, so stresses need Options.thickness; False: discs
    lacking   texts: quantities that this format never contains; the import lists them
    *_file    path that messages about grains, contacts or walls name; "": the format, or grain_file for the other two
    """

    name: str
    grains: dict[str, np.ndarray]
    contacts: dict[str, np.ndarray] | None = None
    _: KW_ONLY
    walls: list[Wall] = field(default_factory=list)
    period: Any = None
    gravity: tuple[float, float] | None = None
    time: float | None = None
    step: int | None = None
    spheres: bool = False
    lacking: list[str] = field(default_factory=list)
    grain_file: str = ""
    contact_file: str = ""
    wall_file: str = ""

    def __repr__(self) -> str:
        contacts = "no" if self.contacts is None else len(self.contacts["first"])
        return f"<Frame {self.name!r}: {len(self.grains['id'])} grains, {contacts} contacts, {len(self.walls)} walls>"


@dataclass
class Options:
    """Words of the command line. A reader uses files, columns_of(), time_of() and note()."""

    files: list[str]
    _: KW_ONLY
    columns: list[str] = field(default_factory=list)  # "contacts=index,id1,..."
    timestep: float | None = None
    thickness: float | None = None
    density: float | None = None
    pressure: float | None = None
    mean_diameter: float | None = None
    gravity: tuple[float, float] | None = None
    period_x: float | None = None
    period_y: float | None = None
    plane: str = "xy"  # or "xz": a layer whose y is the z of the files
    frames: str = ""
    walls_touch: bool = False
    notes: list[str] = field(default_factory=list)
    used: set[str] = field(default_factory=set)  # options that had an effect
    wall_tables: list[Any] = field(default_factory=list)  # Tables that a reader found among its files

    def columns_of(self, kind: str, width: int | None = None) -> list[str] | None:
        """Names that the user gave for the columns of a kind ("particles", ...); `width`: only if they are so many."""
        for text in self.columns:
            names = text.partition("=")[2].split(",")
            if text.startswith(kind + "=") and width in (None, len(names)):
                self.used.add(text)
                return names
        return None

    def axes(self) -> list[int]:
        """Indices of the two axes of a layer of spheres; of the axis of spins it is the one left."""
        self.used.add("plane")
        return [0, 2] if self.plane == "xz" else [0, 1]

    def has_columns(self, kind: str, width: int) -> bool:
        """True if the user named so many columns of a kind."""
        return any(text.startswith(kind + "=") and text.count(",") == width - 1 for text in self.columns)

    def time_of(self, step: int) -> float | None:
        """The time of a step, if --timestep is given."""
        self.used.add("timestep")
        return None if self.timestep is None else step * self.timestep

    def note(self, text: str) -> None:
        """Tells the user about data that were left out or changed; once."""
        if text not in self.notes:
            self.notes.append(text)


def completed(frame: Frame, kind: str) -> dict[str, np.ndarray]:
    """All arrays of the "grains" or "contacts" of a frame as numbers; those that it lacks are nan, lines 0.

    Raises ValueError for an array that is missing or has another shape, and for forces that are not finite.
    """
    what, given, axes = f"{kind} of frame {frame.name}", getattr(frame, kind), GRAINS if kind == "grains" else CONTACTS
    if given is None:
        given = {name: np.empty((0, 2)[:axes[name]]) for name in REQUIRED[kind]}
    for name in REQUIRED[kind]:
        if name not in given:
            raise ValueError(f"{what} lacks '{name}'")
    shape, full = (len(given[REQUIRED[kind][0]]), 2), {}
    for name, n_axes in axes.items():
        values = np.asarray(given.get(name, np.full(shape[:n_axes], 0 if name == "line" else np.nan)), dtype=float)
        if values.shape != shape[:n_axes]:
            raise ValueError(f"{what}['{name}']: an array of shape {shape[:n_axes]} is needed, this one has "
                             f"{values.shape}")
        full[name] = values
    if "force" in full:
        refuse_where(frame.contact_file, ~np.isfinite(full["force"]).all(axis=1), full["line"],
                     lambda k: f"frame {frame.name}: a force is not finite")
    return full


def contacts_of(first: Any, second: Any, force: Any, wall: Any = -1, **more: Any) -> dict[str, np.ndarray]:
    """The contacts of a frame. Scalars count for all rows; members of `more` that are None are left out."""
    first = np.asarray(first)
    columns = {"first": first, "second": np.broadcast_to(second, first.shape), "force": np.reshape(force, (-1, 2)),
               "wall": np.broadcast_to(wall, first.shape)}
    return columns | {name: np.asarray(values) for name, values in more.items() if values is not None}


def acting(contacts: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """The contacts that have a force; other rows are close pairs."""
    acts = np.any(contacts["force"] != 0, axis=1)
    return {name: values[acts] for name, values in contacts.items()}


def joined(*parts: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Several lists of contacts as one; columns that a part lacks are nan."""
    def column(part: dict[str, np.ndarray], name: str) -> np.ndarray:
        n = len(part["first"])
        return part.get(name, np.full((n, 2) if name == "point" else n, np.nan))
    return {name: np.concatenate([column(part, name) for part in parts])
            for name in {name: 0 for part in parts for name in part}}


def rows_of(ids: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """The row of each wanted id in `ids`; -1: there is none."""
    if not len(ids):
        return np.full(len(wanted), -1)
    order = np.argsort(ids)
    place = order[np.minimum(np.searchsorted(ids, wanted, sorter=order), len(ids) - 1)]
    return np.where(ids[place] == wanted, place, -1)
