# diptych: columns of LIGGGHTS' local dumps, and which of them are walls
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Dumps of compute pair/gran/local and wall/gran/local name none of their columns."""

import re

import numpy as np

from .dumps import Section
from .frames import Frame, Options, refused, rows_of
from .tables import Table

# Keywords of compute pair/gran/local and wall/gran/local with their numbers of columns; history takes what is left.
WIDTHS = {"pos": 6, "vel": 6, "id": 3, "force": 3, "force_normal": 3, "force_tangential": 3, "torque": 3, "torque_normal": 3,
          "torque_tangential": 3, "torque_n": 3, "torque_t": 3, "contactArea": 1, "delta": 1, "heatFlux": 1, "contactPoint": 3,
          "ms_id": 2}
USUAL = {"contacts": [["pos", "id", "force", "force_normal", "force_tangential", "contactArea", "delta", "contactPoint"],
                      ["pos", "id", "force"]],
         "walls": [["pos", "id", "force", "contactPoint"], ["pos", "id", "force"]]}


def _expanded(keywords: list[str], width: int) -> list[str] | None:
    """pos.1 ... pos.6, id.1 ...: names of the columns; None if keywords and width do not agree."""
    unknown = [keyword for keyword in keywords if keyword not in WIDTHS and keyword != "history"]
    if unknown:
        raise refused("--columns",
                      f"'{unknown[0]}' is not a keyword of compute pair/gran/local; known are {', '.join(WIDTHS)}, history")
    left = width - sum(WIDTHS.get(keyword, 0) for keyword in keywords)
    if left < 0 or (left > 0) != ("history" in keywords):
        return None
    return [f"{keyword}.{k}" for keyword in keywords for k in range(1, 1 + WIDTHS.get(keyword, left))]


def named(section: Section, kind: str, options: Options) -> Table | None:
    """The table with names for its columns, if it may be of this kind."""
    table, given = section.table, options.columns_of(kind)
    for keywords in [given] if given else USUAL[kind]:
        columns = _expanded(keywords, len(table.columns))
        if columns:
            return Table(table.path, columns, table.rows, table.lines)
    return None


def pair(table: Table, keyword: str, first: int) -> np.ndarray:
    """(n, 2) from the columns `first` and `first` + 1 of a keyword."""
    return table.vectors(f"{keyword}.{first}", f"{keyword}.{first + 1}")


def _fits(table: Table | None, kind: str, frame: Frame) -> bool:
    """True if the rows are of this kind: grains have the ids and places that the rows tell.

    Contacts have two grains and a flag; walls have mesh and triangle, counted from 0, and the grain in the third column.
    """
    if table is None:
        return False
    for column, place in [("id.1", 1), ("id.2", 4)] if kind == "contacts" else [("id.3", 4)]:
        rows = rows_of(frame.grains["id"], table.numbers(column))
        is_there = rows >= 0
        if table.has("pos.1"):
            off = np.linalg.norm(frame.grains["position"][rows] - pair(table, "pos", place), axis=1)
            is_there &= off <= frame.grains["radius"][rows]
        if np.sum(is_there) < 0.9 * len(rows):
            return False
    return True


def group_of(section: Section) -> tuple[str, ...]:
    """Sections of one dump: the same columns in files whose names differ by numbers only."""
    return (*section.table.columns, re.sub(r"\d+", "", section.table.path))


def kinds_of(sections: list[Section], frames: dict[int, Frame], options: Options) -> dict[tuple[str, ...], str]:
    """The kind of every group of sections, by its columns and the numbers in them."""
    kinds: dict[tuple[str, ...], str] = {}
    for section in sorted(sections, key=lambda one: -len(one.table.rows)):
        group, frame = group_of(section), frames.get(section.step)
        if group in kinds or frame is None:
            continue
        fitting = [kind for kind in USUAL if _fits(named(section, kind, options), kind, frame)]
        if not fitting:
            raise refused(section.table.path,
                          f"step {section.step}: {len(section.table.columns)} columns are neither contacts nor "
                          "wall contacts of these grains; give the compute's keywords: --columns contacts=pos,id,force,... "
                          "or --columns walls=pos,id,force,...", section.head() + 1)
        kinds[group] = next((kind for kind in fitting if kind not in kinds.values()), fitting[0])
    return kinds
