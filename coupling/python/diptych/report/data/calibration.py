# diptych: reads a calibration
# SPDX-License-Identifier: LGPL-2.1-or-later
import os

import numpy as np

from ...errors import InputError
from ...files import read_json

FORMAT = 1


class Calibration:
    """record: calibration.json; cost: calibration_cost.json."""

    def __init__(self, record, cost):
        self.record, self.cost = record, cost
        self.paths, self.parameters = record["paths"], record["parameters"]
        self.model = record["model"]  # "continuum" or "grains"
        self.data = "measured" if all(path["curve"] for path in self.paths) else "grains"

    def names(self):
        return [label(p) for p in self.parameters]


def label(parameter):
    """The key of a parameter, and its targets if it is not common to all."""
    return parameter["key"] + (f" ({', '.join(parameter['targets'])})" if parameter["targets"] else "")


def load(folder):
    """Raises InputError if a file is missing, broken or has another format, or if the calibration did not finish."""
    path = os.path.join(folder, "calibration.json")
    record = read_json(path, FORMAT)
    if record["status"] != "finished":
        raise InputError(f"{path}: the calibration is not finished ({record['status']})")
    return Calibration(record, read_json(os.path.join(folder, "calibration_cost.json")))


def numbers(values):
    """The values as an array; NaN: unknown."""
    return np.array([np.nan if value is None else value for value in values], dtype=float)
