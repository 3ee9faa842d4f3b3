# diptych: the command `import`, from its words to the door in C++
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hands the frames of a reader to the compiled module, which checks them and writes the results."""

import argparse
import runpy
import signal
import sys
import traceback
from typing import Any, Sequence

from .. import _diptych
from ..errors import SceneError
from .frames import Options
from .readers import read_frames, registered


def _vector(text: str) -> tuple[float, float]:
    try:
        x, y = (float(part) for part in text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' is not GX,GY, two numbers such as 0,-9.81") from None
    return x, y


def add_options(parser: argparse.ArgumentParser) -> None:
    """Adds the options of an import."""
    parser.add_argument("--columns", action="append", default=[], metavar="KIND=NAMES")
    for name in ("thickness", "timestep", "density", "pressure", "mean-diameter"):
        parser.add_argument("--" + name, type=float, metavar="NUMBER")
    parser.add_argument("--gravity", type=_vector, metavar="GX,GY")
    parser.add_argument("--frames", default="", metavar="LIST")
    for name in ("walls-touch", "overwrite", "quiet"):
        parser.add_argument("--" + name, action="store_true")


def _parser() -> argparse.ArgumentParser:
    """The program has checked the words; here they get their types."""
    parser = argparse.ArgumentParser(prog="diptych import", allow_abbrev=False)
    parser.add_argument("format")
    parser.add_argument("files", nargs="+")
    parser.add_argument("--output", required=True, metavar="DIR")
    add_options(parser)
    return parser


def with_joined_gravity(words: Sequence[str]) -> list[str]:
    """The words with --gravity=GX,GY as one word, because argparse takes a negative number for an option."""
    words = list(words)
    for k in range(len(words) - 1, 0, -1):
        if words[k - 1] == "--gravity":
            words[k - 1:k + 1] = ["--gravity=" + words[k]]
    return words


def format_of(word: str) -> str:
    """The name of a format: the word itself, or that of the reader that a Python file registers. Raises SceneError."""
    if not word.endswith(".py"):
        return word
    runpy.run_path(word)
    if not registered:
        raise SceneError(f"{word} registers no reader; write @importers.register('NAME') above the function that "
                         "takes the options and returns frames")
    return next(reversed(registered))


def _stop(*_: Any) -> None:
    raise KeyboardInterrupt


def main(words: Sequence[str] | None = None) -> int:
    """Runs `diptych import` with these words (sys.argv[1:]) and returns its exit code: 0, 2, 3 or 4."""
    words = list(sys.argv[1:] if words is None else words)
    signals = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
    try:
        for each in signals:
            signal.signal(each, _stop)
        signal.pthread_sigmask(signal.SIG_UNBLOCK, signals)
        given = vars(_parser().parse_intermixed_args(with_joined_gravity(words)))
        format = format_of(given.pop("format"))
        options = Options(command=" ".join(["diptych import", *words]), **given)
        frames = read_frames(format, options)
        sys.stdout.flush()
        _diptych.import_frames(format, frames, options.notes, options)
        return 0
    except ValueError as error:  # SceneError is one
        if words[0].endswith(".py") and not isinstance(error, SceneError):
            traceback.print_exc()  # shows the line of the user's reader
        code, text = 2, str(error)
    except KeyboardInterrupt:
        code, text = 3, "import: stopped on request"
    except MemoryError:
        code, text = 4, f"import {' '.join(words)}: not enough memory"
    except (OSError, RuntimeError, ImportError) as error:
        code, text = 4, str(error)
    print("diptych:", text, file=sys.stderr)
    return code
