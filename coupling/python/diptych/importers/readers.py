# diptych: readers by their names, and the frames that they return
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads files with the reader of a format, and checks them."""

import importlib
import os
import runpy
import traceback
from typing import Any, Callable, Mapping, Sequence, TypeVar

from .. import _diptych
from ..arrays import plain
from ..errors import SceneError
from .arrival import arrive
from .frames import CONTACTS, GRAINS, Frame, Options, refused
from .grain_results import results_of
from .periods import period_of
from .walls import add_wall_tables

Reader = Callable[[Options], "list[Frame]"]
Read = TypeVar("Read")
FORMATS = {"lammps": "lammps", "liggghts": "liggghts", "yade": "yade", "lmgc90": "lmgc90", "mercurydpm": "mercurydpm",
           "csv": "plain_csv"}
registered: dict[str, Reader] = {}


def register(name: str, readers: dict[str, Any] = registered) -> Callable[[Read], Read]:
    """Decorator: makes a function the reader of a format. The command and read() then know the name."""
    def keep(reader: Read) -> Read:
        readers[name] = reader
        return reader
    return keep


def reader_of(command: str, name: str, modules: Mapping[str, str], own: Mapping[str, Any]) -> Any:
    """The reader of a format: of a module below this package, or one of the user's own. Raises SceneError."""
    if name in own:
        return own[name]
    if name in modules:
        return importlib.import_module("." + modules[name], __package__).read
    known = [*modules, *own]
    raise SceneError(f"{command} {name}: unknown format; known are {', '.join(known)} (the nearest is "
                     f"'{_diptych.nearest_name(name, known)}'), or a Python file that registers a reader")


def read_with(word: str, own: Mapping[str, Any], mark: str, read: Callable[[str], Read]) -> Read:
    """read(name of the format). A word that ends in .py is a file that registers a reader with the decorator `mark`;
    an error in it shows its line. Raises SceneError."""
    try:
        if not word.endswith(".py"):
            return read(word)
        runpy.run_path(word)
        if not own:
            raise SceneError(f"{word} registers no reader; write @{mark}('NAME') above the function that takes the "
                             "options and returns frames")
        return read(next(reversed(own)))
    except ValueError as error:
        if word.endswith(".py") and not isinstance(error, SceneError):
            traceback.print_exc()  # shows the line of the user's reader
        raise


def require_files(paths: Sequence[str]) -> None:
    for path in paths:
        if not os.path.isfile(path):
            raise refused(path, "is not a regular file" if os.path.exists(path) else "there is no such file")


def _selected(frames: list[Frame], text: str) -> list[Frame]:
    """Frames of "10-20,30", counted from 0."""
    wanted: set[int] = set()
    for part in text.split(","):
        low, _, high = part.partition("-")
        if not low.isdigit() or not (high or low).isdigit() or not int(low) <= int(high or low) < len(frames):
            raise SceneError(f"--frames {text}: '{part}' is not allowed; give numbers as 10-20,30 from 0 to "
                             f"{len(frames) - 1}")
        wanted |= set(range(int(low), int(high or low) + 1))
    return [frames[k] for k in sorted(wanted)]


def _refuse_unused(format: str, options: Options) -> None:
    """Refuses options that would have no effect, because the user believes that they count."""
    if options.timestep is not None and "timestep" not in options.used:
        raise SceneError(f"import {format}: --timestep would have no effect: these files contain times, or no steps")
    if options.plane != "xy" and "plane" not in options.used:
        raise SceneError(f"import {format}: --plane {options.plane} would have no effect: these files are read in x, y")
    for text in options.columns:
        if text not in options.used:
            raise SceneError(f"import {format}: --columns {text} would have no effect: no such file has so many "
                             "columns, or the files name them")


def _add_period(frames: list[Frame], options: Options) -> None:
    """Gives the frames the periods of --period-x and --period-y."""
    if options.period_y is not None and options.period_x is None:
        raise SceneError("--period-y needs --period-x; a sample that is periodic along y only is not supported")
    for frame in frames if options.period_x is not None else []:
        if frame.period is not None:
            raise refused(frame.grain_file, f"frame {frame.name}: --period-x would have no effect: the files contain "
                          "the period")
        frame.period = period_of([options.period_x, 0], [0, options.period_y or 0])


def read_frames(format: str, options: Options) -> list[Frame]:
    """The frames that the options choose; those without grains are left out. Raises SceneError."""
    reader = reader_of("import", format, FORMATS, registered)
    require_files(options.files)
    for text in options.columns:
        kind, _, names = text.partition("=")
        if kind not in ("particles", "contacts", "walls") or not names:
            raise SceneError(f"--columns {text}: is not KIND=NAME,NAME,..., where KIND is particles, contacts or walls")
    frames = reader(options)
    add_wall_tables(frames, options)
    _add_period(frames, options)
    for frame in frames:
        frame.grain_file = frame.grain_file or f"import {format}"
        frame.contact_file = frame.contact_file or frame.grain_file
        for kind, known in (("grains", GRAINS), ("contacts", CONTACTS)):
            # a misspelt name would leave out what it holds
            for name in [name for name in getattr(frame, kind) or {} if name not in known]:
                raise SceneError(f"{kind} of frame {frame.name}: unknown name '{name}'; known are {', '.join(known)}")
        if not len(frame.grains["id"]):
            options.note(f"frame {frame.name} has no grains; it was left out")
    frames = [frame for frame in frames if len(frame.grains["id"])]
    if not frames:
        raise SceneError(f"import {format}: the files contain no frame with grains")
    _refuse_unused(format, options)
    return _selected(frames, options.frames) if options.frames else frames


def read(format: str, files: Sequence[str], **options: Any) -> list[Frame]:
    """Frames of files, in ascending order. `options` are members of Options. Raises SceneError (file, line)."""
    return read_frames(format, Options([str(file) for file in files], **options))


def check(format: str, files: Sequence[str], **options: Any) -> dict[str, Any]:
    """Reads and checks files without writing: the content of import.json as a dict. Raises SceneError."""
    given = Options([str(file) for file in files], **options)
    return check_frames(format, read_frames(format, given), given)


def check_frames(format: str, frames: Sequence[Frame], options: Options) -> dict[str, Any]:
    """Checks your own frames as check() does those of files."""
    arrival = arrive(format, frames, options)
    results_of(arrival)
    return plain(arrival.record())
