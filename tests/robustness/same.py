# diptych: what a folder holds, without what a clock measured
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Two runs that must not differ are compared here: every bit of .h5, every text of .csv and .json but clocks and dates."""

import csv
import json
import os

from judge import OWN_STATE
from running import bits

CLOCKS = ("ns_per_update", "cpu_s", "wall_s", "seconds", "_mb", "of_cpu", "disturbed")
OF_THE_MACHINE = ("load", )  # processes that ran beside
NOT_COMPARED = ("provenance.json", "study_cost.json", "calibration_cost.json", "import.json")  # paths, clocks, dates


def is_of_clock(name):
    """A study.csv names its columns `cpu_s of discrete`."""
    return name.endswith(CLOCKS) or name.startswith("cpu_s of ") or name in OF_THE_MACHINE


def without_clocks(item):
    if isinstance(item, dict):
        return {key: without_clocks(value) for key, value in item.items() if not is_of_clock(str(key))}
    return [without_clocks(one) for one in item if not is_clock(one)] if isinstance(item, list) else item


def is_clock(row):
    """Of comparison.csv, where a row is a number."""
    return isinstance(row, dict) and str(row.get("quantity", "")).endswith(CLOCKS)


def results(folder):
    """By relative path."""
    found = {}
    for root, _, names in os.walk(folder):
        for name in names:
            path = os.path.join(root, name)
            if name in OWN_STATE or name in NOT_COMPARED:
                continue
            if name.endswith(".h5"):
                found[os.path.relpath(path, folder)] = bits(path)
            elif name.endswith(".csv"):
                with open(path, encoding="utf-8", newline="") as file:
                    found[os.path.relpath(path, folder)] = without_clocks(list(csv.DictReader(file)))
            elif name.endswith(".json"):
                with open(path, encoding="utf-8") as file:
                    found[os.path.relpath(path, folder)] = without_clocks(json.load(file))
    return found


def differences(one, other):
    """Names of files of two results() that differ; of .h5 with the arrays."""
    found = []
    for name in sorted(set(one) | set(other)):
        a, b = one.get(name), other.get(name)
        if a is None or b is None:
            found.append(name + (" is missing" if b is None else " is new"))
        elif a != b:
            parts = [part for part in sorted(set(a) | set(b)) if a.get(part) != b.get(part)] if isinstance(a, dict) else []
            found.append(name + (": " + ", ".join(map(str, parts[:4])) if parts else ""))
    return found
