# diptych: text files of a result folder read into plain values
# SPDX-License-Identifier: LGPL-2.1-or-later

import csv
import json
import os

import numpy as np

from diptych_report.data.input_error import InputError


def require(folder, names):
    """Raises InputError naming every file of names that the folder lacks."""
    missing = [name for name in names if not os.path.isfile(os.path.join(folder, name))]
    if missing:
        raise InputError(f"{folder}: missing {', '.join(missing)}")


def read_json(path):
    """The object of a JSON file. Raises InputError where it cannot be read or is no object."""
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
    """provenance.json as every run writes it. Raises InputError where it cannot be read or is no record of a run."""
    record = read_json(path)
    if record.get("program") != "diptych" or not isinstance(record.get("phases"), list):
        raise InputError(f"{path}: is no record of a run of diptych: 'program' or 'phases' is missing or is none that it writes")
    return record


def read_csv(path):
    """{column: array of its numbers}; nan where the text is no number. Raises InputError where there is no header."""
    try:
        with open(path, encoding="utf-8", newline="") as stream:
            rows = list(csv.reader(stream))
    except OSError as error:
        raise InputError(f"{path}: {error}") from error
    if not rows:
        raise InputError(f"{path}: empty")
    names = [name.strip() for name in rows[0]]
    # A killed run may leave its last line half written.
    rows = [row for row in rows[1:] if len(row) == len(names)]
    return {name: np.array([number(row[k]) for row in rows]) for k, name in enumerate(names)}


def read_text(path):
    """The file's text; empty where there is no file."""
    if not os.path.isfile(path):
        return ""
    with open(path, encoding="utf-8", errors="replace") as stream:
        return stream.read()


def number(text):
    """A float; nan where the text is none."""
    try:
        return float(text)
    except (TypeError, ValueError):
        return float("nan")
