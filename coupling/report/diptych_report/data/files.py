# diptych: reads text files of a result folder
# SPDX-License-Identifier: LGPL-2.1-or-later

import csv
import json
import os

import numpy as np

from diptych_report.data.input_error import InputError


def require(folder, names):
    """Raises InputError with the missing files."""
    missing = [name for name in names if not os.path.isfile(os.path.join(folder, name))]
    if missing:
        raise InputError(f"{folder}: missing {', '.join(missing)}")


def read_json(path):
    """The object of a JSON file. Raises InputError if it cannot be read or is not an object."""
    try:
        with open(path, encoding="utf-8") as stream:
            value = json.load(stream)
    except OSError as error:
        raise InputError(f"{path}: {error}") from error
    except ValueError as error:
        raise InputError(f"{path}: not valid JSON: {error}") from error
    if not isinstance(value, dict):
        raise InputError(f"{path}: an object is expected")
    return value


def read_provenance(path):
    """The record in provenance.json. Raises InputError if it cannot be read or is not the record of a run."""
    record = read_json(path)
    if record.get("program") != "diptych" or not isinstance(record.get("phases"), list):
        raise InputError(f"{path}: is not the record of a run of diptych: 'program' or 'phases' is missing or wrong")
    return record


def read_csv(path):
    """{column: array of numbers}; NaN: no number. Raises InputError if there is no header."""
    try:
        with open(path, encoding="utf-8", newline="") as stream:
            rows = list(csv.reader(stream))
    except OSError as error:
        raise InputError(f"{path}: {error}") from error
    if not rows:
        raise InputError(f"{path}: empty")
    names = [name.strip() for name in rows[0]]
    # A killed run may leave an incomplete last line.
    rows = [row for row in rows[1:] if len(row) == len(names)]
    return {name: np.array([number(row[k]) for row in rows]) for k, name in enumerate(names)}


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
    except (TypeError, ValueError):
        return float("nan")
