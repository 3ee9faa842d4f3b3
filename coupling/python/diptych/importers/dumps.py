# diptych: reads dump files of LAMMPS and LIGGGHTS
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sections of `dump custom` (kind ATOMS) and `dump local` (kind ENTRIES)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .frames import Options, refused
from .tables import Table
from .text import floats_of, int_of, read_lines

PLACES = {"x": ("x", "xu", "xs", "xsu"), "y": ("y", "yu", "ys", "ysu")}  # as they are, unwrapped, scaled by the box


@dataclass
class Section:
    """One instant of a file."""

    step: int
    time: float | None
    kind: str
    table: Table
    box: np.ndarray  # (2, 2): low and high of x and y
    periodic: list[bool]  # along x and y

    def has_places(self) -> bool:
        """True if it holds positions, of whatever kind."""
        return all(self.table.find(*names) is not None for names in PLACES.values())

    def positions(self) -> np.ndarray:
        """(n, 2) positions, also from columns scaled by the box."""
        axes = []
        for names, (low, high) in zip(PLACES.values(), self.box):
            values = self.table.numbers(*names)
            scaled = self.table.find(*names) not in (self.table.find(names[0]), self.table.find(names[1]))
            axes.append(low + values * (high - low) if scaled else values)
        return np.column_stack(axes)


def _box(path: str, lines: list[str], k: int) -> tuple[np.ndarray, list[bool]]:
    """'ITEM: BOX BOUNDS ff ff pp' and three lines; a tilted box has the words xy xz yz and a third number in each line."""
    words = lines[k].split()
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
    k += 2
    if not lines[k].startswith("ITEM: BOX BOUNDS"):
        raise refused(path, "expected 'ITEM: BOX BOUNDS'", k + 1)
    box, periodic = _box(path, lines, k)
    head = lines[k + 4].split()
    if head[:2] not in (["ITEM:", "ATOMS"], ["ITEM:", "ENTRIES"]) or len(head) < 3:
        raise refused(path, "expected 'ITEM: ATOMS' or 'ITEM: ENTRIES' with the names of the columns", k + 5)
    first, rows = k + 5, []
    for row in range(count):
        words = lines[first + row].split()
        if words[:1] == ["ITEM:"]:
            raise refused(path, f"step {step} has {row} rows instead of {count} as in its head", first + row + 1)
        if len(words) != len(head) - 2:
            raise refused(path, f"{len(words)} entries; expected {len(head) - 2}: {' '.join(head[2:])}", first + row + 1)
        rows.append(words)
    table = Table(path, head[2:], rows, np.arange(count) + first + 1)
    return Section(step, time, head[1], table, box, periodic), first + count


def add_section(sections: dict[int, Section], section: Section, options: Options) -> None:
    """Keeps a section by its step. Runs that were chained write the last step again: the same rows count once."""
    old = sections.setdefault(section.step, section)
    if old is not section and (old.table.rows != section.table.rows or old.table.columns != section.table.columns):
        where = f"from line {old.table.lines[0]} of {old.table.path}" if len(old.table.rows) else f"empty in {old.table.path}"
        raise refused(section.table.path, f"step {section.step} occurs twice with different rows ({where})",
                      section.table.lines[0] if len(section.table.rows) else 0)
    if old is not section:
        options.note(f"{section.table.path}: step {section.step} occurs twice with the same rows; it was taken once")


def require_same_steps(found: dict[str, dict[int, Section]], options: Options) -> None:
    """Contacts and walls have the steps of the grains; the first frame may lack them."""
    steps = sorted(found["grains"])
    for kind in ("contacts", "walls"):
        for step in steps[1:] if found[kind] else []:
            if step not in found[kind]:
                other = next(iter(found[kind].values())).table.path
                raise refused(found["grains"][step].table.path, f"step {step} is not in {other}: the frames do not match")
        unused = [step for step in found[kind] if step not in found["grains"]]
        if unused:
            options.note(f"{len(unused)} sections of {kind} belong to steps without grains and were not used")
