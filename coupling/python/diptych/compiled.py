# diptych: the compiled module of the continuum
# SPDX-License-Identifier: LGPL-2.1-or-later
"""diptych._continuum needs deal.II and loads slowly; a build without the continuum has none."""

import functools
import importlib
import importlib.util
from typing import Any

from .errors import SceneError


@functools.cache
def has_continuum() -> bool:
    return importlib.util.find_spec("diptych._continuum") is not None


def demand_continuum(what: str) -> None:
    """Raises SceneError in a build without the continuum. what: the command or object that needs it."""
    if not has_continuum():
        raise SceneError(f"{what}: this program was built without the continuum; it computes grains alone, for example "
                         "with `diptych discrete` or `diptych study --panels discrete`")


def continuum(what: str) -> Any:
    """The module. Raises SceneError in a build without it."""
    demand_continuum(what)
    return importlib.import_module("diptych._continuum")
