# diptych: the loading variable (progress)
# SPDX-License-Identifier: LGPL-2.1-or-later

from dataclasses import dataclass


@dataclass(frozen=True)
class Walk:
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


WALKS = {"axial_strain": Walk("axial strain"), "shear_strain": Walk("shear strain"), "time": Walk("time", "", 1.0)}


def walk_of(name):
    """For the entry `walk` of a file; if it is missing, a Walk without name or unit."""
    return WALKS.get(name, Walk("progress", "", 1.0))
