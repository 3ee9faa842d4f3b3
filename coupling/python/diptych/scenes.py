# diptych: scenes as nested dicts
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A scene is {"sample": {"grains": 2000, ...}, "loading": {...}, ...} or the path of a .prm or .json file."""

from __future__ import annotations

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
    """A value as a scene file holds it; None is "auto"."""
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


def _changes(sections: Mapping[str, Any]) -> Iterator[Change]:
    for section, keys in sections.items():
        if "/" in section:
            name, key = section.split("/", 1)
            yield name, key, text_of(keys)
        elif isinstance(keys, Mapping):
            if section not in _diptych.section_names():
                raise SceneError(f"scene: unknown section '{section}'; there are {', '.join(_diptych.section_names())}")
            for key, value in keys.items():
                yield section, key, text_of(value)
        else:
            raise SceneError(f"scene: '{section}' must be a section, a dict of keys, or stand as 'section/key'")


def read(scene: SceneLike, overrides: Mapping[str, Any] = {}, compares: bool = False) -> _diptych.Scene:
    """The checked scene as the compiled module holds it; points out what is doubtful as SceneWarning."""
    if isinstance(scene, _diptych.Scene):
        if not overrides:
            return scene
        scene = scene.dict()
    if isinstance(scene, Mapping):
        read = _diptych.read_scene(None, [*_changes(scene), *_changes(overrides)], compares)
    else:
        read = _diptych.read_scene(os.fspath(scene), list(_changes(overrides)), compares)
    for text in read.warnings:
        warnings.warn(text, SceneWarning, stacklevel=3)
    return read


def scene(scene: SceneLike, compares: bool = False, **overrides: Any) -> dict[str, dict[str, Any]]:
    """A scene with every key, checked like a file.

    scene      nested dict {"sample": {"grains": 500}}, or the path of a .prm or .json file; keys that are missing take their
               defaults. Values as in a file: numbers, True and False, texts, lists of numbers; None is "auto". Files that a dict
               names are found from the working directory.
    compares   whether both panels will be compared, so that the windows of the comparison must be stages
    overrides  sections with keys to change: scene(path, sample={"seed": 2}); "section/key" works too: **{"sample/seed": 2}

    Returns a dict of all sections and keys. Raises SceneError naming the key, its value and what is allowed. What is doubtful is
    pointed out as SceneWarning.

    >>> scene({"sample": {"grains": 500}})["sample"]["grains"]
    500
    """
    return read(scene, overrides, compares).dict()


def keys(section: str = "") -> dict[str, tuple[str, str, str]]:
    """"section/key" -> (unit, what is allowed, meaning), of all keys or of one section."""
    return {name: told for name, told in _diptych.described_keys().items() if name.startswith(section and section + "/")}
