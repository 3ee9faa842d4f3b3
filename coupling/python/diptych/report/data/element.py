# diptych: reads a folder of the command element
# SPDX-License-Identifier: LGPL-2.1-or-later

import os
from types import SimpleNamespace

from ...files import read_json
from .files import read_csv
from .loading_variable import loading_variable_of


def load(folder):
    """record: element.json. curves: columns of element.csv by name."""
    record = read_json(os.path.join(folder, "element.json"), 1)
    return SimpleNamespace(record=record, curves=read_csv(os.path.join(folder, "element.csv")),
                           loading_variable=loading_variable_of(record["walk"]))
