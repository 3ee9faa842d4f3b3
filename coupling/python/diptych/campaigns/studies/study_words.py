# diptych: studies that the words of a command line describe
# SPDX-License-Identifier: LGPL-2.1-or-later
"""`diptych study SCENE --vary KEY=VALUES` as the study file that gives the same study."""

import argparse
import json
import os
from typing import Any

from ... import _diptych
from ...errors import SceneError
from ..runs.input_file import Part, name_of, seeds_of_line, settings_of
from .level_runs import Levels, read_levels
from .study_file import Study, read_study, study_of

_COMMANDS = {"": "run", "both": "run", "discrete": "discrete", "continuum": "continuum"}  # of --panels
# no key number needs the second mesh; a word --set replaces it
_WITHOUT_COARSE_MESH = {"comparison/coarse_element_size": 0}


def _is_study_file(file: str) -> bool:
    """Scenes may be JSON, too; only a study file names a scene."""
    if not file.endswith(".json") or not os.path.isfile(file) or os.path.getsize(file) == 0:
        return file.endswith(".json")
    contents = json.loads(_diptych.read_json(file)[0])
    return not isinstance(contents, dict) or not set(contents) & set(_diptych.section_names())


def _axis(text: str) -> dict[str, Any]:
    """The axis of --vary section/key=V1,V2."""
    key, equals, words = text.partition("=")
    if not equals or not all(map(str.strip, words.split(","))):
        raise SceneError(f"--vary {text}: not of the form section/key=value,value, such as discrete/friction=0.2,0.3",
                         key)

    def value(word: str) -> Any:
        try:
            number = float(word)
        except ValueError:
            return word
        return int(number) if number.is_integer() and abs(number) < 1e15 else number

    return {"name": key, "key": key, "values": [value(word.strip()) for word in words.split(",")]}


def levels_of_words(line: argparse.Namespace, study: Study) -> Levels | None:
    """--levels, whose cheap accuracy becomes a setting of all points. Raises SceneError if none are possible."""
    wrong = {"has no grains (--panels continuum)": study.command not in ("run", "discrete"),
             "has ranges; give axes": study.ranges, "has a reference; remove it": study.reference is not None}
    for words in [words for words, applies in wrong.items() if applies and line.levels]:
        raise SceneError(f"--levels {line.levels} gives means of grains over samples, and this study {words}",
                         "--levels")
    levels = read_levels(line.levels, len(study.seeds))
    study.settings += [levels.setting("cheap")] if levels else []
    return levels


def study_of_words(line: argparse.Namespace) -> tuple[Study, str]:
    """The study of `diptych study` and the text of its study file. Raises SceneError for contradictory words."""
    file, overrides = line.target, settings_of(line.set, line.set_file)
    if _is_study_file(file):
        for option, here in (("--vary", line.vary), ("--seeds", line.seeds), ("--panels", line.panels)):
            if here:
                raise SceneError(f"{option} is for scenes, and {file} is a study file; change its axes, seeds or "
                                 "command")
        study = read_study(file, overrides)
        with open(file, encoding="utf-8") as text:
            return study, text.read()
    if not os.path.isfile(file):
        raise SceneError(f"{file}: there is no such file")
    if not line.vary:
        raise SceneError(f"{file} is a scene; give --vary, such as --vary discrete/friction=0.2,0.3,0.5, or a study "
                         "file (.json)")
    seeds_of_line(line.seeds or "1-1")
    axes = [_axis(text) for text in line.vary]
    _check_panels(line, overrides, [axis["key"] for axis in axes])
    record = {"scene": os.path.abspath(file), "command": _COMMANDS[line.panels],
              "set": {} if line.panels in ("discrete", "continuum") else _WITHOUT_COARSE_MESH,
              "axes": axes, **({"seeds": line.seeds} if line.seeds else {})}
    study = study_of(Part("--vary", {}, record), name_of(file, "scene"), overrides)
    record["set"] = {**record["set"], **{f"{one.section}/{one.key}": one.value for one in overrides}}
    return study, json.dumps(record, indent=1) + "\n"


def _check_panels(line: argparse.Namespace, overrides: list[Any], varied: list[str]) -> None:
    """A mesh without grains has one panel and no samples."""
    file = line.target
    mesh = _diptych.read_changed_scene(file, [one.check() for one in overrides], False).dict()["continuum"]["mesh"]
    if mesh == "outline" or line.panels == "discrete" or "continuum/mesh" in varied:
        return
    if line.panels != "continuum":
        raise SceneError(f"{file}: continuum/mesh = {mesh} has no grains; give --panels continuum, or mesh = outline")
    if line.seeds:
        raise SceneError(f"--seeds {line.seeds}: continuum/mesh = {mesh} has no grains, so all samples would be the "
                         "same")
