# diptych: quadrilaterals in rows that fill the outline of a sample
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sheets of cells between the left and the right side of a sample."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .arrays import Array, Mesh, periods_of


@dataclass(kw_only=True)
class Sheet:
    """Quadrilaterals in rows between two sides: x of both at the heights of the rows.

    In a periodic cell these are shares of the vectors `sides`, a row each, counted from `corner`."""

    left: Array
    right: Array
    height: Array
    n_x: int
    corner: Array = field(default_factory=lambda: np.zeros(2))
    sides: Array = field(default_factory=lambda: np.eye(2))

    def shares(self, points: Array) -> Array:
        """(n, 2): the points in the coordinates of left, right and height."""
        return np.asarray((points - self.corner) @ np.linalg.inv(self.sides))

    @property
    def mesh(self) -> Mesh:
        """The cells in rows from left to right, the lowest row first."""
        share = np.linspace(0, 1, self.n_x + 1)
        x = self.left[:, None] * (1 - share) + self.right[:, None] * share
        nodes = np.column_stack([x.ravel(), np.repeat(self.height, self.n_x + 1)])
        first = (np.arange(len(self.height) - 1)[:, None] * (self.n_x + 1) + np.arange(self.n_x)).ravel()
        cells = np.column_stack([first, first + 1, first + self.n_x + 2, first + self.n_x + 1])
        return Mesh(self.corner + nodes @ self.sides, cells)

    def share_across(self, points: Array) -> Array:
        """(n): 0 on the left side, 1 on the right one."""
        x, y = self.shares(points).T
        left, right = (np.interp(y, self.height, side) for side in (self.left, self.right))
        return np.asarray((x - left) / (right - left))

    def cell_of(self, points: Array) -> Array:
        """(n): the cell of each point; the nearest one of its row or column if it lies outside."""
        up = self.shares(points)[:, 1]
        row = np.clip(np.searchsorted(self.height, up, side="right") - 1, 0, len(self.height) - 2)
        column = np.clip((self.share_across(points) * self.n_x).astype(int), 0, self.n_x - 1)
        return np.asarray(row * self.n_x + column)

    def at(self, across: float, up: float) -> Array:
        """(2): the place at these shares of width and height."""
        y = self.height[0] + up * (self.height[-1] - self.height[0])
        left, right = (np.interp(y, self.height, side) for side in (self.left, self.right))
        return np.asarray(self.corner + np.array([left + across * (right - left), y]) @ self.sides)


def outline_of(snapshot: Any, n_x: int, n_y: int) -> Sheet:
    """The outline of a sample, with its sides interpolated to n_y equal rows."""
    left, right = snapshot.outline_left, snapshot.outline_right
    height = np.linspace(left[0, 1], left[-1, 1], n_y + 1)
    return Sheet(left=np.interp(height, left[:, 1], left[:, 0]), right=np.interp(height, right[:, 1], right[:, 0]),
                 height=height, n_x=n_x)


def cell_of(snapshot: Any, size: float) -> Sheet:
    """The cell of a sample that is periodic in both directions, in parallelograms of about `size` [length]."""
    sides = periods_of(snapshot)
    n_x, n_y = (max(1, round(np.hypot(*side) / size)) for side in sides)
    none = np.zeros(n_y + 1)
    return Sheet(left=none, right=none + 1, height=np.linspace(0, 1, n_y + 1), n_x=n_x, sides=sides,
                 corner=snapshot.outline_left[0])
