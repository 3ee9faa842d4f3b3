# diptych: exceptions
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exceptions of the package."""


class SceneError(ValueError):
    """A scene is wrong. Attributes, as far as they are known: `file` and `line` (0: none), `key` ("sample/grains", or a
    section; None: unknown), `value`, `allowed` and `hint`."""

    file: str = ""
    line: int = 0
    value: str = ""
    allowed: str = ""
    hint: str = ""

    def __init__(self, text: str, key: str | None = None) -> None:
        super().__init__(text)
        self.key = key


class InputError(ValueError):
    """A file of a result folder is missing, broken or has another format."""


class NotConverged(RuntimeError):
    """A panel or a law did not converge. A panel keeps its results so far. `reached`: those of a law; else None."""

    def __init__(self, text: str, reached: object = None) -> None:
        super().__init__(text)
        self.reached = reached


class Stopped(RuntimeError):
    """Work was left on request (Ctrl-C, SIGTERM). Finished runs are kept. again: the command that goes on."""

    def __init__(self, why: str, again: str = "") -> None:
        super().__init__(f"{why}; to go on: {again}" if again else why)
        self.why = why


class SceneWarning(UserWarning):
    """A key has no effect, or a value is doubtful."""
