# diptych: a process that does one run after another for its parent
# SPDX-License-Identifier: LGPL-2.1-or-later
"""python -m diptych.campaigns.runs.worker PARENT. Reads runs from standard input until it ends, lines of JSON as
Run.line() makes them. Appends output and errors of each to its log, and answers with its exit code on a line."""

import json
import os
import sys
from typing import Any

from ... import _diptych
from ...compiled import continuum, has_continuum
from .engine import code_and_text, complain


def do(run: dict[str, Any], compiled: Any) -> int:
    """Does a run and returns its exit code."""
    try:
        log = os.open(run["log"], os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o666)
        for stream in (1, 2):
            os.dup2(log, stream)
        os.close(log)
        scene = _diptych.read_changed_scene(run["scene"], [], run["command"] == "run")
        return compiled.run(run["command"], scene.in_folder("", run["name"]), run["folder"], run["options"])
    except (ValueError, OSError, RuntimeError, MemoryError) as error:
        code, text = code_and_text(error)
        complain(f"diptych: {text}")
        return code


def main(parent: int) -> None:
    compiled = continuum("a worker") if has_continuum() else _diptych
    compiled.become_worker(os.environ["DIPTYCH_PROGRAM"])
    if os.getppid() != parent:  # it ended before this process could notice
        return
    answers = os.fdopen(os.dup(1), "w")
    for line in sys.stdin:
        try:
            print(do(json.loads(line), compiled), file=answers, flush=True)
        except BrokenPipeError:  # nobody waits for the answer
            return


if __name__ == "__main__":
    main(int(sys.argv[1]))
