# diptych: readers of measured fields by their names
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads files with the reader of a format, and turns y upwards."""

from __future__ import annotations

import functools
from typing import Any

from ...errors import SceneError
from ...measurement import FieldFrame
from ..frames import refused
from ..readers import reader_of, register as register_in, require_files
from ..text import number_in_name
from .frames import FieldOptions

FORMATS = {**{name: f"fields.{name}" for name in ("spam", "dice", "pivlab", "ncorr", "vtk")}, "csv": "fields.plain_csv"}
FEWEST = 30  # points of a field, as find_bands() needs
registered: dict[str, Any] = {}
register = functools.partial(register_in, readers=registered)  # the command and read_fields() then know the name


def _refuse_binary(format: str, path: str) -> None:
    """Refuses files of two programs that no reader should open, by the format or their first bytes."""
    with open(path, "rb") as file:
        first = file.read(2)
    out = "write x, y, u and v of every frame to a table in that program, and import it as csv"
    if format == "mudic" or first[:1] == b"\x80":
        raise refused(path, f"is a Python pickle, as muDIC writes it: to load it would run any code in it; {out}")
    if format == "sundic" or path.endswith(".sdic") or first in (b"x\x01", b"x\x9c", b"x\xda"):
        raise refused(path, f"is a binary file, as SUN-DIC writes it, whose layout is not fixed; {out}")


def _sort_files(options: FieldOptions) -> None:
    """By the last number in their names, if they all differ: a shell puts step_10 before step_2."""
    numbers = [number_in_name(path) for path in options.files]
    if -1 not in numbers and len(set(numbers)) == len(numbers) and numbers != sorted(numbers):
        options.files = [path for _, path in sorted(zip(numbers, options.files))]
        options.note("the files were sorted by the last number in their names")


def _refuse_unused(format: str, options: FieldOptions) -> None:
    """Refuses options that would have no effect, because the user believes that they count."""
    for text in options.columns:
        if text not in options.used:
            raise SceneError(f"import field {format}: --columns {text} would have no effect; write field=NAMES, if the "
                             "files do not name their columns")
    if options.time_between is not None and "time_between" not in options.used:
        raise SceneError(f"import field {format}: --time-between would have no effect: the files hold displacements, "
                         "or the factors that convert velocities")


def read_fields(format: str, options: FieldOptions) -> list[FieldFrame]:
    """The frames of the files, y upwards. Raises SceneError."""
    require_files(options.files)
    for path in options.files:
        _refuse_binary(format, path)
    reader = reader_of("import field", format, FORMATS, registered)
    _sort_files(options)
    frames = reader(options)
    _refuse_unused(format, options)
    for frame in frames:
        if (known := frame.known.sum()) < FEWEST:
            raise refused(frame.path, f"frame {frame.name}: {known} of {len(frame.points)} points have a displacement; "
                          f"at least {FEWEST} are needed")
        if options.y == "down" or frame.y_down and not options.y:
            frame.points, frame.displacement = frame.points * (1, -1), frame.displacement * (1, -1)
            options.note("y points down in the files, and was turned to point up")
    if not options.y and not frames[0].y_down:
        options.note("y points up in the files (--y down, if it does not)")
    return frames
