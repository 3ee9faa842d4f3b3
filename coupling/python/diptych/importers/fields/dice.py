# diptych: reads the text output of DICe
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A file a frame, or a file a subset with a column FRAME. SIGMA is the predicted standard deviation of the
displacement; -1: the correlation failed."""

from __future__ import annotations

import re

import numpy as np

from ...measurement import FieldFrame
from ..tables import Table
from ..text import read_lines
from .frames import FieldOptions, by_frame, vectors_where


def read(options: FieldOptions) -> list[FieldFrame]:
    """Frames in the order of the files, or of FRAME. Raises SceneError."""

    def frame_of(name: str, table: Table) -> FieldFrame:
        if not table.has("SIGMA"):
            options.note(f"{table.path} has no column SIGMA, which marks failed points: all points are kept")
        sigma = table.numbers("SIGMA") if table.has("SIGMA") else np.full(len(table.rows), np.nan)
        side = re.search(r"^\*\*\* Subset size: (\d+)", "\n".join(read_lines(table.path)), re.MULTILINE)
        return FieldFrame(name, table.vectors("COORDINATE_X", "COORDINATE_Y"),
                          vectors_where(table, ~(sigma < 0), ("DISPLACEMENT_X",), ("DISPLACEMENT_Y",)),
                          deviation=np.where(sigma < 0, np.nan, sigma), unit="px", path=table.path, y_down=True,
                          subset=float(side[1]) if side else None)

    return by_frame(options, "FRAME", frame_of)
