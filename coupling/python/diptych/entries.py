# diptych: descriptions of the entries of result files
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A module that writes a file describes its entries. The build collects them for `diptych explain results`."""

from __future__ import annotations

import re

LINE = re.compile(r"((?: {4})*)(.+?)(?: \((.+?)\))?(?: \[(.+?)\])?: (.+)")  # name (shape) [unit]: meaning
INTERVAL = "number with its 95 % interval"

_described: dict[str, list[tuple[str, str, str]]] = {}  # file -> (text, shape, below)


def describe(file: str, text: str, shape: str = "", below: str = "") -> None:
    """Describes entries of a file, one a line: `name (shape) [unit]: meaning`. Entries of `group/: meaning` follow it,
    indented by four blanks. No unit: -. No shape: number; `shape` is that of all. `below` comes before all names."""
    _described.setdefault(file, []).append((text, shape, below))


def described() -> list[dict[str, str]]:
    """file, entry, shape, unit and meaning of all entries that the loaded modules have described."""
    entries: list[dict[str, str]] = []
    for file, parts in _described.items():
        for text, shape, below in parts:
            groups: list[str] = []
            for line in text.strip("\n").split("\n"):
                found = LINE.fullmatch(line)
                assert found, f"{file}: {line}"
                indent, name, own, unit, meaning = found.groups()
                groups[len(indent) // 4:] = [name]
                is_group, own = name.endswith("/"), INTERVAL if own == "interval" else own
                entries.append({"file": file, "entry": (below + "".join(groups)).rstrip("/"),
                                "shape": "group" if is_group else shape or own or "number",
                                "unit": "" if is_group else unit or "-", "meaning": " ".join(meaning.split())})
    return entries
