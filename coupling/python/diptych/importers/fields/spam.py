# diptych: reads the correlations of SPAM
# SPDX-License-Identifier: LGPL-2.1-or-later
"""TSV of spam-ddic (grains) and spam-ldic (grid), with the names of any version. Axes are z, y, x; a 2D image has one
z."""

from __future__ import annotations

import os

import numpy as np

from ...measurement import FieldFrame
from .frames import FieldOptions, table_of, vectors_where

CONVERGED = 2


def _frame(path: str, options: FieldOptions) -> FieldFrame:
    table = table_of(path, options)
    if table.has("Label"):
        table = table.part(table.whole("Label") != 0)  # a row of zeros stands for the background
    z = table.numbers("Zpos")
    table.refuse(z != z[:1], lambda k: f"column Zpos = {z[k]:g}, but {z[0]:g} before: a field in a plane is needed; "
                 "keep the rows of one slice, whose Zpos is the same")
    good = table.numbers("returnStatus", "SubPixReturnStat") == CONVERGED
    points = np.column_stack([table.numbers("Xpos"), table.numbers("Ypos")])
    return FieldFrame(os.path.basename(path), points, vectors_where(table, good, ("Xdisp", "F34"), ("Ydisp", "F24")),
                      unit="px", path=path, y_down=True)


def read(options: FieldOptions) -> list[FieldFrame]:
    """A frame a file. Raises SceneError."""
    return [_frame(path, options) for path in options.files]
