# diptych: the results of a folder, without measured times
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Compares every bit of .h5 files, and every text of .csv and .json files except times and dates."""

import csv
import json
import os

from judge import OWN_STATE
from running import bits

CLOCKS = ("ns_per_update", "cpu_s", "wall_s", "seconds", "_mb", "of_cpu", "disturbed", "load")
NOT_COMPARED = ("provenance.json", "study_cost.json", "calibration_cost.json", "import.json")  # paths, times, dates


def is_of_clock(name):
    return str(name).endswith(CLOCKS) or str(name).startswith("cpu_s of ")  # a column of study.csv


def without_clocks(item):
    if isinstance(item, dict):
        return {key: without_clocks(value) for key, value in item.items() if not is_of_clock(key)}
    if isinstance(item, list):  # in comparison.csv, a row is a number
        return [without_clocks(one) for one in item if not (isinstance(one, dict)
                                                            and is_of_clock(one.get("quantity", "")))]
    return item


def content_of(path):
    if path.endswith(".h5"):
        return bits(path)
    with open(path, encoding="utf-8", newline="") as file:
        return without_clocks(list(csv.DictReader(file)) if path.endswith(".csv") else json.load(file))


def results(folder, without=()):
    """The contents of all files by their relative path. `without`: damaged files that need not be readable. Folders
    NAME.1 hold what a repeated run has set aside."""
    paths = [os.path.join(root, name) for root, _, names in os.walk(folder) for name in names
             if (root == folder or not root.endswith(".1")) and name.endswith((".h5", ".csv", ".json"))
             and name not in OWN_STATE + NOT_COMPARED]
    return {os.path.relpath(path, folder): content_of(path) for path in paths if os.path.relpath(path, folder)
            not in without}


def differences(one, other):
    """The files that differ between two results(), with the names of their different arrays."""
    found = []
    for name in sorted(set(one) | set(other)):
        a, b = one.get(name), other.get(name)
        if a is None or b is None:
            found.append(name + (" is missing" if b is None else " is new"))
        elif a != b:
            parts = [part for part in sorted(set(a) | set(b)) if a.get(part) != b.get(part)] if isinstance(a,
                                                                                                           dict) else []
            found.append(name + (": " + ", ".join(map(str, parts[:4])) if parts else ""))
    return found
