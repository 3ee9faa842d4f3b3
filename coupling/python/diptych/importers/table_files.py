# diptych: reads tables as programs, scripts and spreadsheets write them
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files of tables: separated by semicolons, tabs, commas or blanks, with or without names of their columns."""

import csv
import os
import re
from typing import Callable, Iterable, Sequence

import numpy as np

from .frames import Options, refused
from .tables import names_in_plane, Table
from .text import number_in_name, read_lines


COMMENT = ("#", "***")  # DICe writes the second one


def split(line: str, separator: str | None) -> list[str]:
    """The cells of a line, without their quotes."""
    if separator is None:
        return line.split()
    return [cell.strip() for cell in next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])]


def _separator(line: str) -> str | None:
    return next((mark for mark in (";", "\t", ",") if mark in line), None)


def _is_names(words: list[str]) -> bool:
    """Column names, of which the first may be empty (the index of pandas and R)."""
    if not words[0]:
        words = words[1:]
    return bool(words) and all(re.match(r"[A-Za-z_]", word) and word.lower() not in ("nan", "inf", "na")
                               for word in words)


def _expanded(names: list[str]) -> list[str]:
    """force_x y z stands for force_x, force_y and force_z."""
    full: list[str] = []
    for name in names:
        before = full[-1] if full else ""
        follows = len(name) == 1 and re.search(r"_[a-z]$", before) and ord(name) == ord(before[-1]) + 1
        full.append(before[:-1] + name if follows else name)
    return full


def head_of(lines: Sequence[str]) -> tuple[list[str], int]:
    """Column names above the first row of numbers, perhaps behind a '#', else []; and the index of that row."""
    names: list[str] = []
    marked = True
    for k, line in enumerate(lines):
        plain = line.strip().lstrip("#").strip() if line.strip().startswith("#") else line.strip("\n ")
        words = split(plain, _separator(plain)) if plain.strip() else []
        if words and _is_names(words) and (marked or not line.strip().startswith("#")):
            names, marked = _expanded(words), line.strip().startswith("#")
        elif words and not line.strip().startswith(COMMENT):
            return names, k
    return names, len(lines)


def read_table(path: str, names: Sequence[str] | None = None, start: int | None = None) -> Table:
    """Reads a table. `names` replaces the names of its columns. start: index of the first row, below a head of another
    form. Raises SceneError with file and line."""
    lines = read_lines(path)
    columns, found = head_of(lines)
    columns, start = list(names or columns), found if start is None else start
    if not columns:
        raise refused(path, "no line above the numbers names the columns; use --columns")
    separator, rows, places = _separator(lines[min(start, len(lines) - 1)]), [], []
    if separator == "\t" and names is None and not any("\t" in line for line in lines[:start]):
        separator = None  # names with blanks, numbers with tabs
    for k, line in enumerate(lines[start:], start + 1):
        words = [] if line.lstrip().startswith(COMMENT) or not line.strip() else split(line, separator)
        if len(words) == len(columns) + 1 and not words[-1]:
            words = words[:-1]  # a separator ends the line
        elif len(words) == len(columns) + 1 and not rows:
            columns = ["", *columns]  # R does not name its index
        if not words or [word.lower() for word in words] == [name.lower() for name in columns]:
            continue
        if len(words) != len(columns):
            raise refused(path, f"{len(words)} entries; expected {len(columns)}: {', '.join(columns)}", k)
        rows.append(words)
        places.append(k)
    return Table(path, columns, rows, places)


def _told_kind(path: str, options: Options, kinds: Iterable[str], width: int) -> tuple[str, Table] | None:
    """The kind and the table, if --columns names so many columns. Of two such kinds that in the file's name counts."""
    told = [kind for kind in kinds if options.has_columns(kind, width)]
    if len(told) > 1:
        told = [kind for kind in told if kind in os.path.basename(path).lower()] or told
    if len(told) > 1:
        raise refused(path, f"--columns {' and '.join(told)} name {width} columns each; the file's name must contain "
                      "the kind that it holds")
    return (told[0], read_table(path, options.columns_of(told[0], width))) if told else None


def table_of_kind(path: str, options: Options, kinds: dict[str, Callable[[set[str]], bool]],
                  why: str = "") -> tuple[str, Table]:
    """The kind of a file, by the names of its columns (in lower case) or by --columns, and its table.

    Raises SceneError that begins with `why`.
    """
    lines = read_lines(path)
    columns, start = head_of(lines)
    width = len(split(lines[start], _separator(lines[start]))) if start < len(lines) else 0
    told = _told_kind(path, options, kinds, width) if len(columns) != width else None
    if told:
        return told
    for kind, has_columns in kinds.items():
        if has_columns({name.lower() for name in names_in_plane(columns, options)}):
            return kind, read_table(path)
    told = _told_kind(path, options, kinds, width)
    if told:
        return told
    found = f"its columns are {', '.join(columns)}" if columns else f"its {width} columns have no names"
    raise refused(path, f"{why}does not have the columns of {' or '.join(kinds)}; {found}; name them: "
                  "--columns KIND=NAME,NAME,...")


def by_frame(options: Options, kind_of: Callable[[str], tuple[str, Table]]) -> dict[int, dict[str, Table]]:
    """Tables by frame, ascending, and kind. The last number in a file's name is the frame, or the column `frame`.

    Tables of walls are kept in the options. Raises SceneError for two tables of a kind and frame, or no particles.
    """
    found: dict[int, dict[str, Table]] = {}
    for path in options.files:
        kind, table = kind_of(path)
        if kind == "walls":
            options.wall_tables.append(table)
            continue
        table = table.in_plane(options)
        numbers = table.whole("frame") if table.has("frame") else np.full(len(table.rows), number_in_name(path))
        for number in np.unique(numbers) if len(numbers) else [number_in_name(path)]:
            tables = found.setdefault(int(number), {})
            if kind in tables:
                raise refused(path, f"{tables[kind].path} has {kind} of the same frame {number}")
            tables[kind] = table.part(numbers == number)
    for number, tables in found.items():
        if "particles" not in tables:
            why = "its name contains no frame number" if number < 0 else f"there are no particles of frame {number}"
            raise refused(next(iter(tables.values())).path,
                          f"{why}. The last number in a file name is the frame, as in contacts_3 with particles_3")
    return dict(sorted(found.items()))
