# diptych: reads the text and Tecplot output of PIVlab
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A file a frame. The columns' units tell pixels or metres, and displacement or velocity. A line above them may hold
the factors of the calibration. They are surer: the writers put m/s above some displacements, and m/frame above some
velocities."""

from __future__ import annotations

import os
import re

from ...measurement import FieldFrame
from ..frames import refused
from ..table_files import read_table
from ..text import float_of, read_lines
from .frames import FieldOptions, numbers_where, vectors_where

VALID = 1  # other vectors were masked, rejected or interpolated
NAMES = "x [px],y [px],u [px/frame],v [px/frame],Vector type [-]"
FACTORS = re.compile(r"\(px -> m\): *([^,\s]+), .*\(px/frame -> m/s\): *([^,\s]+)")


def _units(text: str) -> dict[str, str]:
    """Units by the names of the columns. Names hold blanks, which may also separate them."""
    found = re.findall(r"([^\[\]]+)\[([^\[\]]*)\]", text.replace("isNaN?", "isNaN [-]"))
    return {name.strip(" \t,#"): unit for name, unit in found}


def _factor(path: str, unit: str, lines: list[str], options: FieldOptions) -> float:
    """Factor from u and v to displacements. unit: of u."""
    if unit.startswith("px"):
        return 1.0
    for k, match in [(k, match) for k, line in enumerate(lines, 1) if (match := FACTORS.search(line))]:
        length, velocity = (float_of(path, k, word, "conversion factor") for word in match.groups())
        if velocity <= 0:
            raise refused(path, f"conversion factor {velocity:g}: x points to the left; export with x to the right", k)
        options.note(f"{os.path.basename(path)}: displacement = u x {length / velocity:.6g}, from the conversion "
                     "factors in its head")
        return length / velocity
    if unit == "m/frame":
        return 1.0
    if options.time_between is None:
        raise refused(path, f"u is a velocity [{unit}], and no head holds the conversion factors; give --time-between "
                      "SECONDS, the time between the two images of a frame")
    options.used.add("time_between")
    return options.time_between


def _frame(path: str, options: FieldOptions) -> FieldFrame:
    lines = read_lines(path)
    heads = [line for line in lines if re.match(r"[#\s]*x \[", line)] or [",".join(options.columns_of("field") or [])]
    units = _units(heads[-1])
    if not units:
        raise refused(path, f"no line names the columns with their units; name them: --columns 'field={NAMES}'")
    first = next((k for k, line in enumerate(lines) if re.match(r"\s*[-+.\d]", line)), len(lines))
    table = read_table(path, list(units), first)
    factor = _factor(path, units.get("u", ""), lines, options)
    valid = table.numbers("isNaN") == 0 if table.has("isNaN") else table.numbers("Vector type") == VALID
    deviation = factor * numbers_where(table, valid, "uncertainty") if table.has("uncertainty") else None
    return FieldFrame(os.path.basename(path), table.vectors("x", "y"),
                      factor * vectors_where(table, valid, ("u",), ("v",)), deviation=deviation,
                      unit=units.get("x", ""), path=path, y_down=True)


def read(options: FieldOptions) -> list[FieldFrame]:
    """A frame a file. Raises SceneError."""
    options.note("only vectors of type 1 count; the others were masked, rejected or interpolated")
    return [_frame(path, options) for path in options.files]
