# diptych: reads dump files of LAMMPS and LIGGGHTS
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sections of `dump custom` (kind ATOMS) and `dump local` (kind ENTRIES)."""

from dataclasses import dataclass

import numpy as np

from .frames import Frame, Options, refused
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
    box: np.ndarray  # (2, 2): low and high of x and y
    periodic: list[bool]  # along x and y

    def head(self) -> int:
        """The line that names the columns; for messages."""
        return self.table.lines[0] - 1 if len(self.table.lines) else 0

    def positions(self) -> np.ndarray:
        """(n, 2) positions, also from columns scaled by the box."""
        axes = []
        for names, (low, high) in zip(PLACES.values(), self.box):
            values = self.table.numbers(*names)
            scaled = self.table.find(*names) not in (self.table.find(names[0]), self.table.find(names[1]))
            axes.append(low + values * (high - low) if scaled else values)
        return np.column_stack(axes)

    def frame(self, options: Options) -> Frame:
        """The frame of its grains."""
        self.table.numbers("id")
        return Frame(f"step {self.step}", grains_of(self.table, options, self.positions()), step=self.step,
                     time=options.time_of(self.step) if self.time is None else self.time, grain_file=self.table.path)


def _box(path: str, lines: list[str], k: int) -> tuple[np.ndarray, list[bool]]:
    """'ITEM: BOX BOUNDS ff ff pp' and three lines; a tilted box adds the words xy xz yz and a number to each line."""
    words = lines[k].split()
    if words[:3] != ["ITEM:", "BOX", "BOUNDS"]:
        raise refused(path, "expected 'ITEM: BOX BOUNDS'", k + 1)
    if "origin" in words:
        raise refused(path, "a general triclinic box; only upright boxes are supported", k + 1)
    flags = [word for word in words[3:] if set(word) <= set("pfsm")]
    bounds = [floats_of(path, k + 2 + axis, lines[k + 1 + axis].split(), "a bound of the box") for axis in range(3)]
    for axis, row in enumerate(bounds):
        if len(row) not in (2, 3):
            raise refused(path, "expected two bounds of the box", k + 2 + axis)
        if len(row) == 3 and row[2] != 0:
            raise refused(path, f"the box is tilted by {row[2]:g}; only upright boxes are supported", k + 2 + axis)
    return np.array([row[:2] for row in bounds[:2]]), [flag == "pp" for flag in (flags + ["ff", "ff"])[:2]]


def is_dump(path: str) -> bool:
    """True if the file begins like a dump."""
    return read_lines(path)[0].startswith("ITEM:")


def read_dump(path: str) -> list[Section]:
    """All sections of a dump. Raises SceneError naming file, line and the expected text."""
    lines = read_lines(path)
    sections, k = [], 0
    while k < len(lines):
        try:
            section, k = _section(path, lines, k)
        except IndexError:
            raise refused(path, "the file ends within a section; is it truncated?", len(lines)) from None
        sections.append(section)
    return sections


def _section(path: str, lines: list[str], k: int) -> tuple[Section, int]:
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
    box, periodic = _box(path, lines, k + 2)
    head = lines[k + 6].split()
    if head[:2] not in (["ITEM:", "ATOMS"], ["ITEM:", "ENTRIES"]) or len(head) < 3:
        raise refused(path, "expected 'ITEM: ATOMS' or 'ITEM: ENTRIES' with the names of the columns", k + 7)
    table = rows_below(path, lines, k + 7, count, head[2:])
    return Section(step=step, time=time, kind=head[1], table=table, box=box, periodic=periodic), k + 7 + count


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
