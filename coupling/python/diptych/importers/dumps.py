# diptych: reads dump files of LAMMPS and LIGGGHTS
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sections of `dump custom` (kind ATOMS) and `dump local` (kind ENTRIES)."""

from dataclasses import dataclass

import numpy as np

from .frames import Frame, Options, refused
from .periods import period_of
from .tables import Table, grains_of, rows_below
from .text import floats_of, int_of, read_lines

PLACES = {"x": ("x", "xu", "xs", "xsu"), "y": ("y", "yu", "ys", "ysu")}  # as they are, unwrapped, scaled by the box


@dataclass(kw_only=True)
class Section:
    """One instant of a file."""

    step: int
    time: float | None
    kind: str
    table: Table
    low: np.ndarray  # (2): corner of the box
    box: np.ndarray  # (2, 2), whose columns are its vectors
    periodic: list[bool]  # along each vector

    def head(self) -> int:
        """The line that names the columns; for messages."""
        return self.table.lines[0] - 1 if len(self.table.lines) else 0

    def positions(self) -> np.ndarray:
        """(n, 2) positions, also from columns scaled by the box."""
        places = np.column_stack([self.table.numbers(*names) for names in PLACES.values()])
        scaled = [self.table.find(*names) not in (self.table.find(names[0]), self.table.find(names[1]))
                  for names in PLACES.values()]
        if all(scaled):
            return self.low + places @ self.box.T
        # a scaled and an unscaled column together occur in upright boxes only
        return np.where(scaled, self.low + places * np.diag(self.box), places)

    def frame(self, options: Options) -> Frame:
        """The frame of its grains."""
        self.table.numbers("id")
        return Frame(f"step {self.step}", grains_of(self.table, options, self.positions()), step=self.step,
                     time=options.time_of(self.step) if self.time is None else self.time, grain_file=self.table.path,
                     period=period_of(*np.where(self.periodic, self.box, 0).T))


def _box(path: str, lines: list[str], k: int, axes: list[int]) -> tuple[np.ndarray, np.ndarray, list[bool]]:
    """Corner, vectors (columns) and periodicity from 'ITEM: BOX BOUNDS ff ff pp' and three lines.

    A tilted box adds the words xy xz yz and a number to each line; its bounds are those of the parallelogram. A general
    one has 'abc origin', and lines of a vector and a component of the corner.
    """
    words = lines[k].split()
    if words[:3] != ["ITEM:", "BOX", "BOUNDS"]:
        raise refused(path, "expected 'ITEM: BOX BOUNDS'", k + 1)
    flags = [word for word in words[3:] if set(word) <= set("pfsm")] + ["ff", "ff", "ff"]
    periodic = [flags[axis] == "pp" for axis in axes]
    rows = [floats_of(path, k + 2 + axis, lines[k + 1 + axis].split(), "a bound of the box") for axis in range(3)]
    for axis, row in enumerate(rows):
        if len(row) not in ((4,) if "origin" in words else (2, 3)):
            raise refused(path, "expected two bounds of the box", k + 2 + axis)
    if "origin" in words:
        corner = np.array(rows)
        return corner[axes, 3], corner[axes][:, axes].T, periodic
    tilts = [row[2] if len(row) == 3 else 0.0 for row in rows]  # xy, xz, yz
    tilt = tilts[axes[1] - 1]
    for axis, value in enumerate(tilts):
        if value and (axis != axes[1] - 1 or not periodic[1]):
            raise refused(path, f"the box is tilted by {value:g} out of the plane of the layer, or in a direction in "
                          "which it is not periodic", k + 2 + axis)
    (left, right), (lower, upper) = (rows[axis][:2] for axis in axes)
    left, right = left - min(0, tilt), right - max(0, tilt)
    return np.array([left, lower]), np.array([[right - left, tilt], [0, upper - lower]]), periodic


def is_dump(path: str) -> bool:
    """True if the file begins like a dump."""
    return read_lines(path)[0].startswith("ITEM:")


def read_dump(path: str, options: Options) -> list[Section]:
    """All sections of a dump, in the plane of the layer. Raises SceneError naming file, line and the expected text."""
    lines = read_lines(path)
    sections, k = [], 0
    while k < len(lines):
        try:
            section, k = _section(path, lines, k, options)
        except IndexError:
            raise refused(path, "the file ends within a section; is it truncated?", len(lines)) from None
        sections.append(section)
    return sections


def _section(path: str, lines: list[str], k: int, options: Options) -> tuple[Section, int]:
    """The section that begins at line k (from 0), and the line behind it."""
    step, time = None, None
    while not lines[k].startswith("ITEM: NUMBER OF"):
        if lines[k].startswith("ITEM: TIMESTEP"):
            step = int_of(path, k + 2, lines[k + 1].strip(), "the step")
        elif lines[k].startswith("ITEM: TIME"):
            time = floats_of(path, k + 2, [lines[k + 1].strip()], "the time")[0]
        elif not lines[k].startswith(("ITEM: UNITS", "ITEM: LABEL")):
            raise refused(path, "expected 'ITEM: TIMESTEP'", k + 1)
        k += 2
    if step is None:
        raise refused(path, "no 'ITEM: TIMESTEP' above this line", k + 1)
    count = int_of(path, k + 2, lines[k + 1].strip(), "the number of rows")
    low, box, periodic = _box(path, lines, k + 2, options.axes())
    head = lines[k + 6].split()
    if head[:2] not in (["ITEM:", "ATOMS"], ["ITEM:", "ENTRIES"]) or len(head) < 3:
        raise refused(path, "expected 'ITEM: ATOMS' or 'ITEM: ENTRIES' with the names of the columns", k + 7)
    table = rows_below(path, lines, k + 7, count, head[2:]).in_plane(options)
    return (Section(step=step, time=time, kind=head[1], table=table, low=low, box=box, periodic=periodic),
            k + 7 + count)


def add_section(sections: dict[int, Section], section: Section, options: Options) -> None:
    """Keeps a section by its step. Runs that were chained write the last step again: the same rows count once."""
    old, table = sections.setdefault(section.step, section), section.table
    if old is section:
        return
    if old.table.rows != table.rows or old.table.columns != table.columns:
        where = f"from line {old.head() + 1} of {old.table.path}" if old.table.rows else f"empty in {old.table.path}"
        raise refused(table.path, f"step {section.step} occurs twice with different rows ({where})", section.head())
    options.note(f"{table.path}: step {section.step} occurs twice with the same rows; it was taken once")


def require_same_steps(found: dict[str, dict[int, Section]], options: Options) -> None:
    """Contacts and walls have the steps of the grains; the first frame may lack them."""
    steps = sorted(found["grains"])
    for kind in ("contacts", "walls"):
        for step in steps[1:] if found[kind] else []:
            if step not in found[kind]:
                other = next(iter(found[kind].values())).table.path
                raise refused(found["grains"][step].table.path,
                              f"step {step} is not in {other}: the frames do not match")
        unused = [step for step in found[kind] if step not in found["grains"]]
        if unused:
            options.note(f"{len(unused)} sections of {kind} belong to steps without grains and were not used")
