# diptych: scenes as nested dicts
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A scene is {"sample": {"grains": 2000, ...}, "loading": {...}, ...} or the path of a .prm or .json file."""

import os
import warnings
from collections.abc import Iterator, Mapping
from numbers import Integral, Real
from typing import Any, Union

import numpy as np

from . import _diptych
from .errors import SceneError, SceneWarning

SceneLike = Union[str, "os.PathLike[str]", Mapping[str, Mapping[str, Any]]]
Change = tuple[str, str, str]


def text_of(value: Any) -> str:
    """A value as text of a scene file; None is "auto"."""
    if value is None:
        return "auto"
    if isinstance(value, str):
        return value
    if isinstance(value, os.PathLike):
        return str(os.fspath(value))
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, Integral):
        return str(int(value))
    if isinstance(value, Real):
        return repr(float(value))
    return ", ".join(text_of(entry) for entry in value)


def changes(sections: Mapping[str, Any]) -> Iterator[Change]:
    for section, keys in sections.items():
        if "/" in section:
            name, key = section.split("/", 1)
            yield name, key, text_of(keys)
        elif isinstance(keys, Mapping):
            if section not in _diptych.section_names():
                raise SceneError(f"scene: unknown section '{section}'; there are {', '.join(_diptych.section_names())}",
                                 section)
            for key, value in keys.items():
                yield section, key, text_of(value)
        else:
            raise SceneError(f"scene: '{section}' must be a section, a dict of keys, or stand as 'section/key'")


def read(scene: SceneLike, overrides: Mapping[str, Any] = {}, compares: bool = False) -> _diptych.Scene:
    """The checked scene of the compiled module. Doubtful values give a SceneWarning."""
    if isinstance(scene, _diptych.Scene):
        if not overrides:
            return scene
        scene = scene.dict()
    if isinstance(scene, Mapping):
        read = _diptych.read_scene(None, [*changes(scene), *changes(overrides)], compares)
    else:
        read = _diptych.read_scene(os.fspath(scene), list(changes(overrides)), compares)
    for text in read.warnings:
        warnings.warn(text, SceneWarning, stacklevel=3)
    return read


def scene(scene: SceneLike, compares: bool = False, **overrides: Any) -> dict[str, dict[str, Any]]:
    """Checks a scene like a file and returns it with every key.

    scene      nested dict {"sample": {"grains": 500}}, or the path of a .prm or .json file. Missing keys take their
               defaults. Values are numbers, True, False, texts or lists of numbers; None is "auto". Paths in a dict are
               relative to the working directory.
    compares   True if both panels will be compared: the edges of the windows must then be stages
    overrides  sections with keys to change: scene(path, sample={"seed": 2}), or **{"sample/seed": 2}

    Returns all sections and keys. Raises SceneError with key, value and what is allowed. Warns by SceneWarning.

    >>> scene({"sample": {"grains": 500}})["sample"]["grains"]
    500
    """
    return read(scene, overrides, compares).dict()


def keys(section: str = "") -> dict[str, tuple[str, str, str]]:
    """"section/key" -> (unit, allowed values, meaning), for all keys or for one section."""
    return {name: described for name, described in _diptych.described_keys().items()
            if name.startswith(section and section + "/")}
