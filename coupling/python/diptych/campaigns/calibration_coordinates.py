# diptych: values of continuum keys as points of the unit cube, in which the search of a calibration works
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Strengths, stiffnesses and lengths are varied in their logarithm. A residual angle is varied by its drop, and a dilatancy
angle by its share of a friction angle, so that no combination contradicts itself."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import Array
from .input_file import Setting

COORDINATES = ("value", "logarithm", "share_of", "drop_from")


def usual_coordinate(key: str) -> str:
    """The coordinate of a key if the file names none."""
    if key == "friction_angle_residual":
        return "drop_from"
    if key in ("dilatancy_angle_peak", "friction_angle_start"):
        return "share_of"
    return "value" if key == "poisson_ratio" else "logarithm"


@dataclass(frozen=True)
class Parameter:
    """A key of the section continuum. start, low and high are numbers of the coordinate: the value itself (also for a
    logarithm), a share or a drop. targets: names of the targets that it belongs to; empty: one value for all."""

    key: str
    coordinate: str
    start: float
    low: float
    high: float
    other: str = ""
    targets: tuple[str, ...] = ()

    @property
    def is_ratio(self) -> bool:
        return self.coordinate in ("share_of", "drop_from")

    def is_of(self, target: str) -> bool:
        """An empty name means: common to all targets."""
        return not self.targets or (target in self.targets)


class Coordinates:
    """others: values of fixed keys that shares and drops refer to. Raises ValueError if a parameter refers to an unknown key,
    to one that belongs to other targets, or to itself in a circle."""

    def __init__(self, parameters: Sequence[Parameter], others: Mapping[str, float]) -> None:
        self.parameters, self.others = parameters, others
        for p in parameters:
            referred = [q for q in parameters if q.key == p.other]
            for target in p.targets or ("",):
                if referred and not any(q.is_of(target) for q in referred):
                    raise ValueError(f"{p.key} refers to {p.other}, which belongs to other targets")
                self._value(p.key, target, [q.start for q in parameters], 0)

    def __len__(self) -> int:
        return len(self.parameters)

    def _scaled(self, name: str) -> Array:
        return np.array([np.log(getattr(p, name)) if p.coordinate == "logarithm" else getattr(p, name)
                         for p in self.parameters])

    @property
    def start(self) -> Array:
        """(n): the point where the first search begins."""
        low = self._scaled("low")
        return (self._scaled("start") - low) / (self._scaled("high") - low)

    def numbers(self, point: Array) -> list[float]:
        """Value, share or drop of every parameter."""
        low = self._scaled("low")
        here = low + point * (self._scaled("high") - low)
        return [float(np.exp(x)) if p.coordinate == "logarithm" else float(x) for p, x in zip(self.parameters, here)]

    def _value(self, key: str, target: str, numbers: Sequence[float], depth: int) -> float:
        if depth > len(self):
            raise ValueError(f"{key} refers to itself in a circle")
        for p, number in zip(self.parameters, numbers):
            if p.key == key and p.is_of(target):
                if not p.is_ratio:
                    return number
                share = number if p.coordinate == "share_of" else 1 - number
                return share * self._value(p.other, target, numbers, depth + 1)
        if key not in self.others:
            raise ValueError(f"{key} is needed by a share or drop, but has no value")
        return self.others[key]

    def values(self, point: Array) -> list[float]:
        """Values of the keys, in the order of the parameters."""
        numbers = self.numbers(point)
        return [self._value(p.key, p.targets[0] if p.targets else "", numbers, 0) for p in self.parameters]

    def settings(self, point: Array, target: str) -> list[Setting]:
        """Settings of one target. An empty name gives those that all targets share."""
        numbers = self.numbers(point)
        return [Setting("continuum", p.key, repr(self._value(p.key, target, numbers, 0)), "a point of the calibration")
                for p in self.parameters if p.is_of(target)]
