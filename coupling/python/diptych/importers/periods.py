# diptych: periods of imported samples
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A period is a (2, 2) array, whose columns are the vectors a1 and a2 of the repetition. A column of 0 is no period."""

from typing import Any, Callable

import numpy as np

from .frames import Frame


def period_of(a1: Any, a2: Any) -> np.ndarray | None:
    """The period with these two vectors; None without any."""
    period = np.column_stack([a1, a2]).astype(float)
    return period if period.any() else None


def is_cell(period: np.ndarray | None) -> bool:
    """True if the sample is periodic in both directions."""
    return period is not None and bool(period[:, 1].any())


def shifts_of(period: np.ndarray | None, branch: np.ndarray) -> np.ndarray:
    """(n, 2) whole periods that are nearest to the branches (n, 2); 0 without a period."""
    if period is None:
        return np.zeros_like(branch)
    return np.rint(branch @ np.linalg.pinv(period).T) @ period.T


def reduced(period: np.ndarray) -> np.ndarray:
    """The same cell with short vectors (Lagrange), so that the nearest image is found by rounding."""
    a1, a2 = period.T
    while is_cell(period):
        times = np.rint(a1 @ a2 / min(a1 @ a1, a2 @ a2))
        if times == 0:
            break
        a1, a2 = (a1, a2 - times * a1) if a1 @ a1 <= a2 @ a2 else (a1 - times * a2, a2)
    return np.column_stack([a1, a2])


def without_walls(frame: Frame, sides: list[int], refuse: Callable[[str], Exception]) -> np.ndarray | None:
    """The period of a frame, reduced; walls (sides 0 to 3: lower, upper, left, right) end it along their normal."""
    if frame.period is None:
        return None
    a1, a2 = np.array(frame.period, dtype=float).T
    if any(side in (2, 3) for side in sides):
        a1 = np.zeros(2)
    if any(side in (0, 1) for side in sides):
        a2 = np.zeros(2)
    if a2.any() and not a1.any():
        raise refuse("the sample is periodic along y only; supported are periods along x, or along both x and y (turn "
                     "the sample by 90 degrees)")
    if a1.any() and (a1[0] * a2[1] - a1[1] * a2[0] <= 0 if a2.any() else a1[1] != 0):
        raise refuse(f"the periods ({a1[0]:g}, {a1[1]:g}) and ({a2[0]:g}, {a2[1]:g}) are not those of a sample that "
                     "is periodic along x, or of a cell whose second vector is counter-clockwise from the first")
    period = period_of(a1, a2)
    return None if period is None else reduced(period)


def followed(period: np.ndarray | None, before: np.ndarray | None) -> np.ndarray | None:
    """The vectors of the same lattice that are nearest to those of the frame before: codes exchange tilted vectors."""
    if not is_cell(period) or not is_cell(before):
        return period
    whole = np.rint(np.linalg.solve(period, before))
    return period @ whole if round(np.linalg.det(whole)) == 1 else period


def gradient_between(before: np.ndarray | None, now: np.ndarray | None) -> np.ndarray:
    """(2, 2) deformation gradient that maps one period on the next; 1 along directions without a period."""
    if before is None or now is None:
        return np.eye(2)
    inverse = np.linalg.pinv(before)
    return now @ inverse + np.eye(2) - before @ inverse


def images_within(period: np.ndarray | None, x: np.ndarray, reach: float) -> tuple[np.ndarray, np.ndarray]:
    """Rows and places of the points and, behind them, of those images that lie within `reach` of the period."""
    rows, places = [np.arange(len(x))], [x]
    if period is not None:
        inverse = np.linalg.pinv(period)
        margin = reach * np.linalg.norm(inverse, axis=1)
        inside = (x @ inverse.T) % 1 @ period.T
        places = [inside + (x - (x @ inverse.T) @ period.T)]
        for along, upward in np.ndindex(3, 3):
            step = np.array([along - 1, upward - 1])
            share = (x @ inverse.T) % 1 + step
            near = np.all((share >= -margin) & (share < 1 + margin), axis=1) & bool((period @ step).any())
            rows.append(np.flatnonzero(near))
            places.append(places[0][near] + period @ step)
    return np.concatenate(rows), np.concatenate(places)
