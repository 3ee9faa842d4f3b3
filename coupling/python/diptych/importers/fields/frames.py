# diptych: what the readers of measured fields share
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The options of `diptych import field`, and columns of tables in which points may be lost."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...arrays import Array
from ...measurement import FieldFrame
from ..frames import Options
from ..table_files import read_table
from ..tables import Table


@dataclass(kw_only=True)
class FieldOptions(Options):
    """Words of the command line. A reader uses files, columns_of("field"), time_between and note(). Lengths are in the
    unit of the files, but mean_diameter in that after the scale."""

    mean_diameter: float = 1.0
    y: str = ""  # "down" or "up"; "": as the format prescribes
    time_between: float | None = None
    scale: float | None = None
    reference: str = ""  # "first" or "previous"
    subset: float | None = None
    centre: tuple[float, float] | None = None
    progress: Sequence[float] | None = None
    boundary: str | None = None
    static: tuple[float, float] | None = None
    outliers: float | None = None


def table_of(path: str, options: FieldOptions) -> Table:
    """The table of a file, whose columns --columns field=NAMES may name."""
    return read_table(path, options.columns_of("field"))


def numbers_where(table: Table, good: Array, *names: str) -> Array:
    """(n) of the first of these columns that exists; NaN where `good` is false, or where the cell is empty or nan."""
    k = table.find(*names)
    if k is not None:
        good = good & np.array([row[k].lower() not in ("", "nan", "-nan") for row in table.rows], bool)
    values = np.full(len(table.rows), np.nan)
    values[good] = table.part(good).numbers(*names)
    return values


def vectors_where(table: Table, good: Array, x: Sequence[str], y: Sequence[str]) -> Array:
    """(n, 2): numbers_where() of the columns x and y; a row that lacks one lacks both."""
    values = np.column_stack([numbers_where(table, good, *x), numbers_where(table, good, *y)])
    values[~np.isfinite(values).all(axis=1)] = np.nan
    return values


def by_frame(options: FieldOptions, column: str, frame_of: Callable[[str, Table], FieldFrame]) -> list[FieldFrame]:
    """One frame a file. If the tables have this column, it is the number of the frame, and a file may hold several
    frames, or some of the points of all frames."""
    tables = [table_of(path, options) for path in options.files]
    if not any(table.has(column) for table in tables):
        return [frame_of(os.path.basename(table.path), table) for table in tables]
    numbers = [table.whole(column) for table in tables]
    frames = []
    for number in np.unique(np.concatenate(numbers)).tolist():
        parts = [frame_of(str(number), table.part(own == number)) for table, own in zip(tables, numbers)
                 if number in own]
        arrays = {name: np.concatenate([getattr(part, name) for part in parts])
                  for name in ("points", "displacement", "deviation") if getattr(parts[0], name) is not None}
        frames.append(replace(parts[0], **arrays))
    return frames
