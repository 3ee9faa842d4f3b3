# diptych: tables of numbers with named columns, and the grains in them
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables with named columns. Cells are converted when a column is used: other columns may hold text or nothing."""

from typing import Any, Callable, Sequence

import numpy as np

from .frames import Options, SceneError, refuse_where, refused

RADIUS, DIAMETER = ("radius", "r"), ("diameter", "d")
SPIN, ROTATION = ("omegaz", "omega", "wz", "angVel_z", "omega_z", "spin"), ("rotation", "angle", "theta", "angle_z")


class Table:
    """Rows of words below named columns; `lines` are their numbers in the file, from 1. Names ignore case."""

    def __init__(self, path: str, columns: Sequence[str], rows: list[list[str]], lines: Sequence[int]) -> None:
        self.path, self.columns, self.rows = path, [name.strip() for name in columns], rows
        self.lines = np.array(lines, dtype=int)

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

    def refuse(self, bad: Any, text: Callable[[int], str]) -> None:
        """Refuses the first row k for which `bad` is true, with text(k)."""
        refuse_where(self.path, bad, self.lines, text)

    def numbers(self, *names: str) -> np.ndarray:
        """(n) finite numbers of the first of these columns that exists. Raises SceneError with file, line, column."""
        k = self.find(*names)
        if k is None:
            raise refused(self.path, f"lacks a column {' or '.join(names)}; its columns are {', '.join(self.columns)}")
        words = [row[k] for row in self.rows]
        try:
            values = np.array(words, dtype=float)
        except ValueError:
            values = np.array([self._number(word.replace(",", "."), line, k) for word, line in zip(words, self.lines)])
        self.refuse(~np.isfinite(values), lambda row: f"column {self.columns[k]} = '{words[row]}' is not finite")
        return values

    def _number(self, word: str, line: int, k: int) -> float:
        try:
            return float(word)
        except ValueError:
            found = f"= '{word[:60]}' is not a number" if word.strip() else "is empty"
            raise refused(self.path, f"column {self.columns[k]} {found}", line) from None

    def optional(self, options: Options, *names: str) -> np.ndarray | None:
        """As numbers(); None if there is no such column, or, with a note, if a cell of it is no number."""
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
        self.refuse((values != np.floor(values)) | (abs(values) > 9e15),
                    lambda k: f"column {names[0]} = {values[k]:.10g} is not a whole number")
        return values.astype(np.int64)

    def vectors(self, x: str, y: str) -> np.ndarray:
        """(n, 2) from two columns."""
        return np.column_stack([self.numbers(x), self.numbers(y)])

    def optional_vectors(self, options: Options, x: Sequence[str], y: Sequence[str]) -> np.ndarray | None:
        """(n, 2) from the first of the columns `x` and `y` that exist, or None."""
        parts = self.optional(options, *x), self.optional(options, *y)
        return None if parts[0] is None or parts[1] is None else np.column_stack(parts)

    def in_plane(self, options: Options) -> "Table":
        """The table as the user sees the layer: with --plane xz, columns of y and z change their names."""
        return Table(self.path, names_in_plane(self.columns, options), self.rows, self.lines)

    def part(self, mask: Any) -> "Table":
        """The rows that a mask or a list of indices chooses."""
        index = np.arange(len(self.rows))[mask]
        return Table(self.path, self.columns, [self.rows[k] for k in index], self.lines[index])


def names_in_plane(columns: Sequence[str], options: Options) -> list[str]:
    """Names of columns as the user sees the layer: with --plane xz, z is y, and a y beside it is z."""
    if options.axes() == [0, 1]:
        return list(columns)
    turned = {name: name[:-1] + {"z": "y", "Z": "Y"}[name[-1]] for name in columns if name[-1:] in ("z", "Z")}
    return [{**turned, **{y: z for z, y in turned.items()}}.get(name, name) for name in columns]


def rows_below(path: str, lines: Sequence[str], start: int, count: int, columns: Sequence[str]) -> Table:
    """The table of `count` rows below line `start` (from 1). Raises SceneError."""
    rows = [line.split() for line in lines[start:start + count]]
    for k, row in enumerate(rows, 1):
        if len(row) != len(columns):
            raise refused(path, f"row {k} of {count} has {len(row)} entries instead of {len(columns)} "
                          f"({' '.join(columns)}); is the number of rows in the head right?", start + k)
    if len(rows) < count:
        raise refused(path, f"the file ends after {len(rows)} of {count} rows; is it truncated?", len(lines))
    return Table(path, columns, rows, np.arange(count) + start + 1)


def refuse_other_plane(path: str, y: np.ndarray, z: np.ndarray | None) -> None:
    """Refuses grains that all have the same y, but not the same z."""
    if z is not None and len(y) > 2 and np.ptp(y) == 0 and np.ptp(z) > 0:
        raise refused(path, f"all grains have y = {y[0]:g}: the layer lies in the x-z plane; give --plane xz")


def grains_of(table: Table, options: Options, position: np.ndarray | None = None) -> dict[str, np.ndarray]:
    """The grains of a frame: id, x, y, radius or diameter; mass, vx, vy, omega, rotation, fx, fy if present.

    `position` (n, 2) replaces x and y. Without ids, rows count from 0.
    """
    diameter = table.numbers(*DIAMETER) if table.find(*DIAMETER) is not None else None
    if diameter is None and table.find(*RADIUS) is None:
        if options.mean_diameter is None:
            raise refused(table.path, f"lacks a column {' or '.join(RADIUS + DIAMETER)}; its columns are "
                          f"{', '.join(table.columns)}. Points without radii need --mean-diameter D, their distance")
        diameter = np.full(len(table.rows), options.mean_diameter)
        options.used.add("mean_diameter")  # as radii
        options.note("no radii are in the files: every point counts as a disc of --mean-diameter, also "
                     "in the solid fraction")
    radius = table.numbers(*RADIUS) if diameter is None or table.find(*RADIUS) is not None else diameter / 2
    if diameter is not None:
        table.refuse(abs(radius - diameter / 2) > 1e-5 * diameter,
                     lambda k: f"a radius of {radius[k]:g} and a diameter of {diameter[k]:g} contradict each other")
    mass = table.optional(options, "mass", "m")
    for name, values in (("radius", radius), ("mass", mass)):
        if values is not None:
            table.refuse(values <= 0, lambda k: f"a {name} of {values[k]:g} must be positive")
    if table.has("z"):
        refuse_other_plane(table.path, table.numbers("y"), table.optional(options, "z"))
    turn = 1 if options.plane == "xy" else -1  # x, z and y are left-handed
    spin, rotation = (table.optional(options, *names) for names in (SPIN, ROTATION))
    grains = {"id": table.whole("id") if table.has("id") else np.arange(len(table.rows)), "radius": radius,
              "mass": mass, "position": table.vectors("x", "y") if position is None else position, "line": table.lines,
              "velocity": table.optional_vectors(options, ("vx", "vel_x"), ("vy", "vel_y")),
              "spin": None if spin is None else turn * spin, "rotation": None if rotation is None else turn * rotation,
              "resultant": table.optional_vectors(options, ("fx", "f_x"), ("fy", "f_y"))}
    return {name: values for name, values in grains.items() if values is not None}
