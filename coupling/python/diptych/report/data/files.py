# diptych: reads the files of a result folder
# SPDX-License-Identifier: LGPL-2.1-or-later

import contextlib
import csv
import os
import re

import h5py
import numpy as np

from ...errors import InputError


def require(paths):
    """Raises InputError with the missing files."""
    missing = [path for path in paths if not os.path.isfile(path)]
    if missing:
        raise InputError(f"missing: {', '.join(missing)}")


@contextlib.contextmanager
def open_arrays(path):
    """The open HDF5 file. Raises InputError if it is damaged."""
    try:
        with h5py.File(path, "r") as file:
            yield file
    except (OSError, RuntimeError) as error:  # h5py raises either for a damaged file
        raise InputError(f"{path}: {error}") from error


def read_csv(path):
    """{column: array of numbers}; NaN: no number."""
    require([path])
    with open(path, encoding="utf-8", newline="") as stream:
        rows = list(csv.reader(stream))
    # A killed run may leave an incomplete last line.
    columns = zip(*[row for row in rows[1:] if len(row) == len(rows[0])])
    return {name: np.array([number(value) for value in values]) for name, values in zip(rows[0], columns)}


def read_text(path):
    """The text of the file, or "" if it does not exist."""
    if not os.path.isfile(path):
        return ""
    with open(path, encoding="utf-8", errors="replace") as stream:
        return stream.read()


def number(text):
    """The text as a float; NaN: no number."""
    try:
        return float(text)
    except ValueError:
        return float("nan")


def scene_section(text, section):
    """[(key, value, meaning)] of one section. The meaning is the comment above the key; nested sections give keys with
    slashes."""
    rows, path, comment = [], [], ""
    for line in text.splitlines():
        line = line.strip()
        entry = re.match(r"set\s+(.+?)\s*=\s*(.*?)\s*(#.*)?$", line)
        if line.startswith("#"):
            comment = line.lstrip("# ")
            continue
        if line.startswith("subsection "):
            path.append(line[len("subsection "):].strip())
        elif line == "end" and path:
            path.pop()
        elif entry and path[:1] == [section]:
            rows.append(("/".join(path[1:] + [entry[1]]), entry[2], comment))
        comment = ""
    return rows


def scene_value(text, section, key):
    """Value of one key as text, or ""."""
    return next((value for name, value, _ in scene_section(text, section) if name == key), "")
