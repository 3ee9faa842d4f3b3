# diptych: numbers of a result with units and meanings, and the loading variable (progress)
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A number is plain, or {"value", "low", "high"} with its 95 % interval; None: unknown.

Units are those of the files: "pressure length^2", "length/time", "mean diameters" or "-".
"""

from dataclasses import dataclass

import numpy as np


def plain(number):
    """The value of a number with or without an interval, or None."""
    if isinstance(number, dict):
        number = number.get("value")
    if isinstance(number, bool) or not isinstance(number, (int, float)) or not np.isfinite(number):
        return None
    return float(number)


def known(numbers):
    """The values of those numbers that have one."""
    return [value for value in map(plain, numbers) if value is not None]


def interval(number):
    """(low, high) of a number with a complete interval, or None."""
    if not isinstance(number, dict):
        return None
    ends = plain(number.get("low")), plain(number.get("high"))
    return None if None in ends else ends


def scaled(number, factor):
    """The number (plain, with interval, or a list) times factor. Other values stay."""
    if isinstance(number, dict):
        return {key: scaled(value, factor) for key, value in number.items()}
    if isinstance(number, (list, tuple)):
        return [scaled(value, factor) for value in number]
    return number * factor if isinstance(number, (int, float)) and not isinstance(number, bool) else number


@dataclass(frozen=True)
class Units:
    """Units of shown lengths and stresses: mean diameter d [length] and pressure P [pressure] of the scene."""

    diameter: float = 1.0
    pressure: float = 1.0

    def size(self, unit):
        """Divisor of stored numbers with this unit. Times are not scaled."""
        above, _, below = (unit or "").partition("/")
        return self._product(above) / self._product(below)

    def _product(self, words):
        result = 1.0
        for word in words.split():
            name, _, power = word.partition("^")
            base = {"length": self.diameter, "pressure": self.pressure}.get(name, 1.0)
            result *= base ** (int(power) if power else 1)
        return result


@dataclass(frozen=True)
class Description:
    unit: str = "-"
    meaning: str = ""
    title: str = ""


class Descriptions:
    """Descriptions of the numbers of a comparison, by place: "stages/discrete/bands/angle_deg"."""

    def __init__(self, numbers):
        self._numbers = {place: Description(entry.get("unit", "-"), entry.get("meaning", ""))
                         for place, entry in (numbers or {}).items()}

    def unit(self, place):
        return self._numbers.get(place, Description()).unit

    def meaning(self, place):
        """The meaning from the program, or else the key."""
        found = self._numbers.get(place, Description()).meaning
        return found or place.rsplit("/", 1)[-1].replace("_", " ")

    def shown_in(self, tree, units, place=""):
        """A part of the comparison, converted to lengths in d and stresses in P."""
        if isinstance(tree, dict) and not (place in self._numbers and "value" in tree):
            return {key: self.shown_in(value, units, f"{place}/{key}" if place else key) for key, value in tree.items()}
        if isinstance(tree, list) and any(isinstance(entry, dict) for entry in tree):
            return [self.shown_in(entry, units, place) for entry in tree]
        size = units.size(self.unit(place))
        return tree if size == 1.0 else scaled(tree, 1 / size)


@dataclass(frozen=True)
class LoadingVariable:
    """Text of a progress: factor times the stored number, then the unit."""

    word: str
    unit: str = " %"
    factor: float = 100.0

    @property
    def label(self):
        """Label of an axis."""
        return self.word + (" (%)" if self.unit else "")

    def number(self, progress):
        return f"{self.factor * progress:.4g}"

    def text(self, progress):
        return self.number(progress) + self.unit

    def span(self, progress):
        """Text of a progress without a line break."""
        return self.text(progress).replace(" ", "\u00a0")


LOADING_VARIABLES = {"axial_strain": LoadingVariable("axial strain"), "shear_strain": LoadingVariable("shear strain"),
                     "time": LoadingVariable("time", "", 1.0)}


def loading_variable_of(name):
    """For the entry `walk` of a file; if it is missing, one without name or unit."""
    return LOADING_VARIABLES.get(name, LoadingVariable("progress", "", 1.0))
