# diptych: tables of numbers with named columns
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables with named columns. Cells are converted when a column is used, so that other columns may hold text or nothing."""

from __future__ import annotations

from typing import Any, Sequence

import numpy as np

from .frames import Options, SceneError, refused


class Table:
    """Rows of words below named columns; `lines` are their numbers in the file, from 1. Names ignore case."""

    def __init__(self, path: str, columns: Sequence[str], rows: list[list[str]], lines: Sequence[int]) -> None:
        self.path, self.columns, self.rows, self.lines = path, [name.strip() for name in columns], rows, np.array(lines,
                                                                                                                  dtype=int)

    def find(self, *names: str) -> int | None:
        """Index of the first of these columns that exists. Refuses a name that two columns have."""
        lower = [name.lower() for name in self.columns]
        for name in names:
            if lower.count(name.lower()) > 1:
                raise refused(self.path, f"two columns have the name {name}")
            if name.lower() in lower:
                return lower.index(name.lower())
        return None

    def has(self, *names: str) -> bool:
        """True if all of these columns exist."""
        return all(self.find(name) is not None for name in names)

    def numbers(self, *names: str) -> np.ndarray:
        """(n) finite numbers of the first of these columns that exists. Raises SceneError with file, line and column."""
        k = self.find(*names)
        if k is None:
            raise refused(self.path, f"lacks a column {' or '.join(names)}; its columns are {', '.join(self.columns)}")
        words = [row[k] for row in self.rows]
        try:
            values = np.array(words, dtype=float)
        except ValueError:
            values = np.array([self._number(word.replace(",", "."), line, k) for word, line in zip(words, self.lines)])
        bad = np.flatnonzero(~np.isfinite(values))
        if len(bad):
            raise refused(self.path, f"column {self.columns[k]} = '{words[bad[0]]}' is not finite", self.lines[bad[0]])
        return values

    def _number(self, word: str, line: int, k: int) -> float:
        try:
            return float(word)
        except ValueError:
            found = f"= '{word[:60]}' is not a number" if word.strip() else "is empty"
            raise refused(self.path, f"column {self.columns[k]} {found}", line) from None

    def optional(self, options: Options, *names: str) -> np.ndarray | None:
        """The same; None if there is no such column, or, with a note, if a cell of it is no number."""
        if self.find(*names) is None:
            return None
        try:
            return self.numbers(*names)
        except SceneError as error:
            options.note(f"{error}; this column was not used")
            return None

    def whole(self, *names: str) -> np.ndarray:
        """(n) whole numbers."""
        values = self.numbers(*names)
        bad = np.flatnonzero((values != np.floor(values)) | (abs(values) > 9e15))
        if len(bad):
            raise refused(self.path, f"column {names[0]} = {values[bad[0]]:.10g} is not a whole number", self.lines[bad[0]])
        return values.astype(np.int64)

    def vectors(self, x: Sequence[str], y: Sequence[str]) -> np.ndarray:
        """(n, 2) from two columns."""
        return np.column_stack([self.numbers(*x), self.numbers(*y)])

    def optional_vectors(self, options: Options, x: Sequence[str], y: Sequence[str]) -> np.ndarray | None:
        """The same, or None."""
        parts = self.optional(options, *x), self.optional(options, *y)
        return None if parts[0] is None or parts[1] is None else np.column_stack(parts)

    def part(self, mask: Any) -> Table:
        """The rows that a mask or a list of indices chooses."""
        index = np.arange(len(self.rows))[mask]
        return Table(self.path, self.columns, [self.rows[k] for k in index], self.lines[index])
