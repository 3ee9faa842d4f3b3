# diptych: reads a calibration
# SPDX-License-Identifier: LGPL-2.1-or-later

import os
from types import SimpleNamespace

import numpy as np

from ...errors import InputError
from ...files import read_json

FORMAT = 1


def label(parameter):
    """The key of a parameter, and its targets if it is not common to all."""
    return parameter["key"] + (f" ({', '.join(parameter['targets'])})" if parameter["targets"] else "")


def load(folder):
    """record: calibration.json; cost: calibration_cost.json; model: "continuum" or "grains"; data: "measured" or
    "grains". Raises InputError if the calibration did not finish."""
    path = os.path.join(folder, "calibration.json")
    record = read_json(path, FORMAT)
    if record["status"] != "finished":
        raise InputError(f"{path}: the calibration is not finished ({record['status']})")
    return SimpleNamespace(record=record, cost=read_json(os.path.join(folder, "calibration_cost.json")),
                           model=record["model"], paths=record["paths"], parameters=record["parameters"],
                           data="measured" if all(path["curve"] for path in record["paths"]) else "grains")


def numbers(values):
    """The values as an array; None becomes NaN."""
    return np.array(values, dtype=float)
