# diptych: reads a folder of the command element
# SPDX-License-Identifier: LGPL-2.1-or-later

import os
from dataclasses import dataclass

from ...files import read_json
from .files import read_csv, require
from .loading_variable import LoadingVariable, loading_variable_of


@dataclass
class Element:
    """record: element.json. curves: columns of element.csv by name."""

    record: dict
    curves: dict

    @property
    def loading_variable(self) -> LoadingVariable:
        return loading_variable_of(self.record["walk"])


def load(folder):
    """Raises InputError if a file is missing, broken or has another format."""
    paths = [os.path.join(folder, name) for name in ("element.json", "element.csv")]
    require(paths)
    return Element(read_json(paths[0], 1), read_csv(paths[1]))
