# diptych: the commands in Python; the program `diptych` starts this module for them
# SPDX-License-Identifier: LGPL-2.1-or-later
"""python -m diptych WORDS; see `diptych --help`."""

import shlex
import sys
from collections.abc import Sequence
from typing import Any

from . import _diptych
from .campaigns.commands import do
from .campaigns.runs.engine import DONE, SYSTEM_FAILURE, code_and_text, complain, on_first_process


def main(words: Sequence[str], pool: Any = None) -> int:
    """Does a command and returns its exit code; an error is a message. pool: of the other processes of mpirun."""
    try:
        do(words, pool)
        return DONE
    except MemoryError:
        code = SYSTEM_FAILURE
        text = f"{shlex.join(words)}: not enough memory, or this process may not have more (ulimit -v)"
    except (ValueError, OSError, RuntimeError, ImportError) as error:
        code, text = code_and_text(error)
    complain(f"diptych: {text}")
    return code


if __name__ == "__main__":
    _diptych.install_signals()
    sys.exit(on_first_process(lambda pool: main(sys.argv[1:], pool)))
