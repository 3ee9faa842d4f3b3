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


def _parser() -> argparse.ArgumentParser:
    """The program has checked the words; here they get their types."""
    parser = argparse.ArgumentParser(prog="diptych import", allow_abbrev=False)
    parser.add_argument("format")
    parser.add_argument("files", nargs="+")
    parser.add_argument("--output", required=True, metavar="DIR")
    parser.add_argument("--columns", action="append", default=[], metavar="KIND=NAMES")
    for name in ("thickness", "timestep", "density", "pressure", "mean-diameter"):
        parser.add_argument("--" + name, type=float, metavar="NUMBER")
    parser.add_argument("--gravity", type=_vector, metavar="GX,GY")
    parser.add_argument("--frames", default="", metavar="LIST")
    for name in ("walls-touch", "overwrite", "quiet"):
        parser.add_argument("--" + name, action="store_true")
    return parser


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
        for k in range(len(words) - 1, 0, -1):  # argparse takes a negative number for an option
            if words[k - 1] == "--gravity":
                words[k - 1:k + 1] = ["--gravity=" + words[k]]
        given = vars(_parser().parse_intermixed_args(words))
        format = given.pop("format")
        if format.endswith(".py"):
            runpy.run_path(format)
            if not registered:
                raise SceneError(f"{format} registers no reader; write @importers.register('NAME') above the function that "
                                 "takes the options and returns frames")
            format = next(reversed(registered))
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
