# diptych: exceptions
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exceptions of the package."""

from __future__ import annotations

import re

# A key as messages write it, not a part of a path; or a section that is none.
_KEY = re.compile(r"(?<![\w/.-])(?:sample|loading|discrete|continuum|comparison|output)/\w+|(?<=unknown section ')[^']*")


class SceneError(ValueError):
    """A scene is wrong. The text names place, key, value and what is allowed; `key` is the first key that it names
    ("sample/grains"; an unknown section by itself), None where it names none."""

    def __init__(self, text: str) -> None:
        super().__init__(text)
        found = _KEY.search(text)
        self.key: str | None = found.group() if found else None


class NotConverged(RuntimeError):
    """A panel or a law did not get further. What was reached stays in the panel."""


class SceneWarning(UserWarning):
    """A key that nothing reads, or a value that is doubtful."""
