# diptych: reads tables of points and displacements
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Columns x, y, u, v and perhaps sigma, the standard deviation of a component. A file a frame, or a column frame. Empty
cells and nan: the point was lost."""

from __future__ import annotations

import numpy as np

from ...measurement import FieldFrame
from ..tables import Table
from .frames import FieldOptions, by_frame, numbers_where, vectors_where


def _frame(name: str, table: Table) -> FieldFrame:
    everywhere = np.ones(len(table.rows), bool)
    return FieldFrame(name, table.vectors("x", "y"), vectors_where(table, everywhere, ("u",), ("v",)),
                      deviation=numbers_where(table, everywhere, "sigma") if table.has("sigma") else None,
                      path=table.path)


def read(options: FieldOptions) -> list[FieldFrame]:
    """Frames in the order of the files, or of the column frame. Raises SceneError."""
    return by_frame(options, "frame", _frame)
