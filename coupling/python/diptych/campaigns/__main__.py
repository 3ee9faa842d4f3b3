# diptych: the commands of campaigns; the program `diptych` starts this module for them
# SPDX-License-Identifier: LGPL-2.1-or-later
"""python -m diptych.campaigns WORDS. The program has checked the words and prints the help; see `diptych study --help`."""

from __future__ import annotations

import argparse
import importlib
import sys
from collections.abc import Sequence

from .. import _diptych
from ..errors import Stopped
from .runs.engine import NOT_CONVERGED, SYSTEM_FAILURE, WRONG_INPUT, Options, complain, on_first_process


COMMANDS = {"run": ("ensembles.ensemble", "run_ensemble"), "compare": ("ensembles.ensemble", "compare_again"),
            "study": ("studies.study", "run_study"), "plan": ("plans.plan", "main_plan"),
            "calibrate": ("calibration.calibration", "run_calibration"), "element": ("element.element", "run_element"),
            "homogenise": ("element.homogenise", "run_homogenise")}


def parsed(words: Sequence[str]) -> argparse.Namespace:
    """The words of a command line. Commands of scenes share their options; the program refuses those that a command does not have."""
    parser = argparse.ArgumentParser(prog="diptych", allow_abbrev=False)
    for name in ("command", "target"):
        parser.add_argument(name)
    for option in ("--output", "--seeds", "--accuracy", "--for", "--panels", "--levels"):
        parser.add_argument(option, default="")
    for option in ("--set", "--set-file", "--vary"):
        parser.add_argument(option, action="append", default=[])
    for option, default in (("--jobs", 0), ("--threads", 1)):
        parser.add_argument(option, type=int, default=default)
    for option in ("--resume", "--overwrite", "--quiet", "--run"):
        parser.add_argument(option, action="store_true")
    if "%" in words:  # --accuracy 2 % is two words
        k = words.index("%")
        words = [*words[:k - 1], words[k - 1] + "%", *words[k + 1:]]
    return parser.parse_args(words)


def main(words: Sequence[str]) -> int:
    """Does a command and returns its exit code; an error is a message."""
    module, function = COMMANDS[words[0]]
    try:
        loaded = importlib.import_module("." + module, __package__)  # pandas and SciPy load only now
        line = getattr(loaded, "parsed", parsed)(words)  # a command may have options of its own
        return getattr(loaded, function)(line, Options(line.jobs, line.threads, line.quiet, line.resume, line.overwrite, words))
    except Stopped as stopped:
        code, text = NOT_CONVERGED, str(stopped)
    except ValueError as error:
        code, text = WRONG_INPUT, str(error)
    except (OSError, RuntimeError, MemoryError, ImportError) as error:
        code, text = SYSTEM_FAILURE, str(error) or "out of memory"
    complain(f"diptych: {text}")
    return code


if __name__ == "__main__":
    _diptych.install_signals()
    sys.exit(on_first_process(lambda: main(sys.argv[1:])))
