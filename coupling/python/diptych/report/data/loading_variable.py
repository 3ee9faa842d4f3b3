# diptych: the loading variable (progress)
# SPDX-License-Identifier: LGPL-2.1-or-later

from dataclasses import dataclass


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


LOADING_VARIABLES = {"axial_strain": LoadingVariable("axial strain"), "shear_strain": LoadingVariable("shear strain"),
                     "time": LoadingVariable("time", "", 1.0)}


def loading_variable_of(name):
    """For the entry `walk` of a file; if it is missing, one without name or unit."""
    return LOADING_VARIABLES.get(name, LoadingVariable("progress", "", 1.0))
