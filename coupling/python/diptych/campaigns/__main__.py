# diptych: the commands of campaigns; the program `diptych` starts this module for them
# SPDX-License-Identifier: LGPL-2.1-or-later
"""python -m diptych.campaigns WORDS. The program has checked the words and prints the help; see `diptych study --help`."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from .. import _diptych
from ..errors import Stopped
from .engine import NOT_CONVERGED, SYSTEM_FAILURE, WRONG_INPUT, Options, complain, on_first_process


def parsed(words: Sequence[str]) -> argparse.Namespace:
    """The words of a command line. All commands share their options; the program refuses those that a command does not have."""
    parser = argparse.ArgumentParser(prog="diptych", allow_abbrev=False)
    parser.add_argument("command", choices=["run", "study", "plan", "calibrate", "compare"])
    parser.add_argument("target")
    for option in ("--output", "--seeds", "--accuracy", "--for"):
        parser.add_argument(option, default="")
    for option in ("--set", "--set-file"):
        parser.add_argument(option, action="append", default=[])
    for option, default in (("--jobs", 0), ("--threads", 1)):
        parser.add_argument(option, type=int, default=default)
    for option in ("--resume", "--overwrite", "--quiet", "--run"):
        parser.add_argument(option, action="store_true")
    joined: list[str] = []
    for word in words:  # --accuracy 2 % is two words
        if word == "%" and joined:
            joined[-1] += " %"
        else:
            joined.append(word)
    return parser.parse_args(joined)


def execute(words: Sequence[str]) -> int:
    """Does a command and returns its exit code."""
    line = parsed(words)
    options = Options(line.jobs, line.threads, line.quiet, line.resume, line.overwrite, " ".join(["diptych", *words]))
    changes = (line.set, line.set_file)
    if line.command == "study":
        from .input_file import settings_of
        from .study import run_study

        return run_study(line.target, line.output, settings_of(*changes), options, line.set_file)
    if line.command == "plan":
        from .plan import main_plan

        return main_plan(line, options)
    if line.command == "calibrate":
        from .calibration import main_calibrate

        return main_calibrate(line, options)
    from .ensemble import compare_again, run_ensemble

    if line.command == "compare":
        return compare_again(line.target, changes, options)
    return run_ensemble(line.target, line.seeds, line.output, changes, options)


def main(words: Sequence[str]) -> int:
    """Does a command; an error is a message and an exit code."""
    try:
        return execute(words)
    except Stopped as stopped:
        code, text = NOT_CONVERGED, str(stopped)
    except ValueError as error:
        code, text = WRONG_INPUT, str(error)
    except (OSError, RuntimeError, MemoryError) as error:
        code, text = SYSTEM_FAILURE, str(error) or "out of memory"
    complain(f"diptych: {text}")
    return code


if __name__ == "__main__":
    _diptych.install_signals()
    sys.exit(on_first_process(lambda: main(sys.argv[1:])))
