# diptych: values of keys as points of the unit cube, in which the search of a calibration works
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Strengths, stiffnesses and lengths are varied in their logarithm. A residual angle is varied by its drop, and a
dilatancy angle by its share of a friction angle, so that no combination contradicts itself. The dilatancy ratio of
`critical_state` and `kinematic` is varied by its distance from the least value that the law admits."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...arrays import Array
from .input_file import Setting

COORDINATES, ABOVE_LEAST = ("value", "logarithm", "share_of", "drop_from"), "above_least"  # the last: dilatancy_ratio
RATIOS, LOGARITHMS = ("share_of", "drop_from"), ("logarithm", ABOVE_LEAST)
USUAL = {"friction_angle_residual": "drop_from", "dilatancy_angle_peak": "share_of", "friction_angle_start": "share_of",
         "poisson_ratio": "value"}  # of a key if the file names none; else logarithm


@dataclass(frozen=True, kw_only=True)
class Parameter:
    """A key of the section continuum, or discrete/KEY. start, low, high: numbers of the coordinate, the value itself
    (also of a logarithm), a share, a drop or a distance. targets: names of those that it belongs to; empty: all."""

    key: str
    coordinate: str
    start: float
    low: float
    high: float
    other: str = ""
    targets: tuple[str, ...] = ()

    @property
    def setting(self) -> tuple[str, str]:
        """Section and key."""
        section, _, key = self.key.rpartition("/")
        return section or "continuum", key

    def is_of(self, target: str) -> bool:
        """An empty name means: common to all targets."""
        return not self.targets or (target in self.targets)


class Coordinates:
    """others: values of fixed keys that shares and drops refer to. Raises ValueError if a parameter refers to an
    unknown key, to one that belongs to other targets, or to itself in a circle."""

    def __init__(self, parameters: Sequence[Parameter], others: dict[str, float]) -> None:
        self.parameters, self.others = parameters, others
        low, start, high = (np.array([np.log(getattr(p, name)) if p.coordinate in LOGARITHMS else getattr(p, name)
                                      for p in parameters]) for name in ("low", "start", "high"))
        self.low, self.span = low, high - low
        self.start: Array = (start - low) / self.span  # (n): the point where the first search begins
        for p in parameters:
            referred = [q for q in parameters if q.key == p.other]
            for target in p.targets or ("",):
                if referred and not any(q.is_of(target) for q in referred):
                    raise ValueError(f"{p.key} refers to {p.other}, which belongs to other targets")
                self._value(p.key, target, [q.start for q in parameters], 0)

    def __len__(self) -> int:
        return len(self.parameters)

    def numbers(self, point: Array) -> list[float]:
        """Value, share, drop or distance of every parameter, in 12 digits: the start is the number of the file."""
        here = self.low + point * self.span
        return [float(f"{np.exp(x) if p.coordinate in LOGARITHMS else x:.12g}") for p, x in zip(self.parameters, here)]

    def _value(self, key: str, target: str, numbers: Sequence[float], depth: int) -> float:
        if depth > len(self):
            raise ValueError(f"{key} refers to itself in a circle")
        for p, number in zip(self.parameters, numbers):
            if p.key == key and p.is_of(target):
                if p.coordinate not in RATIOS:
                    return number + (p.coordinate == ABOVE_LEAST and self._least(target, numbers, depth))
                share = number if p.coordinate == "share_of" else 1 - number
                return share * self._value(p.other, target, numbers, depth + 1)
        if key not in self.others:
            raise ValueError(f"{key} is needed by a share or drop, but has no value")
        return self.others[key]

    def _least(self, target: str, numbers: Sequence[float], depth: int) -> float:
        """Least dilatancy ratio (CriticalStateHardening::check). The sine of the dilatancy angle is (t/s - critical
        t/s) / ratio. It exceeds t/s neither at the start nor at the largest t/s that the density permits."""
        critical, density, slope, start = (self._value(key, target, numbers, depth + 1) for key in (
            "critical_stress_ratio", "critical_solid_fraction", "strength_by_density", "stress_ratio_start"))
        possible = critical + slope * density * np.log(self.others.get("solid_fraction_start", density) / density)
        return max(0.0, 1 - critical / max(possible, start, critical))

    def values(self, point: Array) -> list[float]:
        """Values of the keys, in the order of the parameters."""
        numbers = self.numbers(point)
        return [self._value(p.key, p.targets[0] if p.targets else "", numbers, 0) for p in self.parameters]

    def settings(self, point: Array, target: str) -> list[Setting]:
        """Settings of one target. An empty name gives those that all targets share."""
        numbers = self.numbers(point)
        return [Setting(*p.setting, repr(self._value(p.key, target, numbers, 0)),
                        file=f"{p.key} = {number:.4g}" + (f" ({p.coordinate} {p.other})" if p.other else ""))
                for p, number in zip(self.parameters, numbers) if p.is_of(target)]
