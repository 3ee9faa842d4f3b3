# diptych: JSON input files of campaigns, with refusals that name file, line and key
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Parts of a JSON input file, with checked access to their members."""

import json
import os
import re
from collections import Counter
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, NoReturn

from ... import _diptych
from ...errors import SceneError

MOST_SEEDS = 10000
LARGEST_SEED = 2147483647


class Setting(NamedTuple):
    """One key of a scene with its place and the folder of the files that it names."""

    section: str
    key: str
    value: str
    file: str
    line: int = 0
    folder: str = ""

    def text(self) -> str:
        """ "section/key = value" """
        return f"{self.section}/{self.key} = {self.value}"

    def with_seed(self, seed: int | str) -> "Setting":
        """The setting with {seed} in its value replaced."""
        return self._replace(value=self.value.replace("{seed}", str(seed)))

    def check(self) -> "Setting":
        """Raises SceneError if no scene has such a key or such a value of it, or if it sets the folder of a run."""
        _diptych.check_entry(self.with_seed(1))
        if (self.section, self.key) == ("output", "directory"):
            place = f"{self.file}, line {self.line}: " if self.line else f"{self.file}: " if self.file else ""
            raise SceneError(f"{place}output/directory cannot be set; runs use their own folders below --output",
                             "output/directory")
        return self


def settings_of(overrides: Sequence[str], set_files: Sequence[str] = ()) -> list[Setting]:
    """The keys of --set-file, then those of --set."""
    settings = [Setting(*entry) for file in set_files for entry in _diptych.read_fragment(file)]
    return [*settings, *(Setting(*_diptych.entry_of_override(text)) for text in overrides)]


def _refuse_seeds(why: str) -> NoReturn:
    raise SceneError("--seeds" + why)


def seeds_of_line(text: str, refuse: Callable[[str], NoReturn] = _refuse_seeds) -> list[int]:
    """The seeds that a user gives. Refuses a number, which could be one seed or a number of samples."""
    if text.isdigit():
        refuse(f" {text} could be one seed or a number of samples; write 1-{text} for {text} samples, "
               f"{text}-{text} for the sample with seed {text}")
    return read_seeds(text, refuse)


def read_seeds(text: str, refuse: Callable[[str], NoReturn] = _refuse_seeds) -> list[int]:
    """Seeds of a list like 1-8 or 1,3,5-7, ascending. refuse: raises SceneError with " LIST is not allowed; ..."."""
    if not re.fullmatch(r"\d{1,10}(-\d{1,10})?(,\d{1,10}(-\d{1,10})?)*", text):
        refuse(f" {text} is not allowed; write a list like 1-8 or 1,3,5-7")
    ends = [[int(end) for end in item.split("-")] for item in text.split(",")]
    ranges = [range(first, (last or [first])[0] + 1) for first, *last in ends]
    if not all(ranges) or sum(map(len, ranges)) > MOST_SEEDS or max(map(max, ranges)) > LARGEST_SEED:
        refuse(f" {text} is not allowed; ranges ascend, with at most {MOST_SEEDS} seeds up to {LARGEST_SEED}")
    seeds = sorted(seed for one in ranges for seed in one)
    if len(set(seeds)) < len(seeds):
        refuse(f" {text} is not allowed; a seed is given twice")
    return seeds


def seeds_text(seeds: Sequence[int]) -> str:
    """The list as on the command line, "1-4,7"."""
    runs: list[list[int]] = []
    for seed in seeds:
        if runs and seed == runs[-1][-1] + 1:
            runs[-1].append(seed)
        else:
            runs.append([seed])
    return ",".join(f"{run[0]}-{run[-1]}" if len(run) > 1 else str(run[0]) for run in runs)


def name_of(file: str, usual: str) -> str:
    """The name of an input file, without its ending. A file with the usual name is called like its folder."""
    folder, name = os.path.split(os.path.abspath(file))
    stem = os.path.splitext(name)[0]
    return os.path.basename(folder) if stem == usual else stem


def value_text(value: Any) -> str:
    """A value as the text that a scene would hold: the entries of a list separated by ", "."""
    if isinstance(value, list):
        return ", ".join(map(value_text, value))
    return value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)


def is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


class Part:
    """A value of an input file and its place. A missing or wrong member raises SceneError with file, line and key."""

    def __init__(self, file: str, lines: dict[str, int], value: Any, pointer: str = "") -> None:
        self.file, self.lines, self.value, self.pointer = file, lines, value, pointer

    @staticmethod
    def read(file: str, usual: str) -> "Part":
        """The whole of a JSON file; comments are allowed. usual: the keys that it needs."""
        if os.path.isfile(file) and os.path.getsize(file) == 0:
            raise SceneError(f"{file}: is empty; a JSON object with {usual} is needed")
        text, lines = _diptych.read_json(file)
        return Part(file, lines, json.loads(text))

    def _line(self, key: str | None) -> int:
        pointer = self.pointer if key is None else f"{self.pointer}/{key.replace('/', '~1', 1)}"
        while pointer and pointer not in self.lines:
            pointer = pointer.rpartition("/")[0]
        return self.lines.get(pointer, 1) if self.lines else 0  # words of a command line have no lines

    def _place(self, line: int) -> str:
        return f"{self.file}, line {line}" if line else self.file

    def refuse(self, why: str, key: str | None = None) -> NoReturn:
        """Raises SceneError at the line of this part, or of its member `key`."""
        line = self._line(key)
        error = SceneError(f"{self._place(line)}: {key or ''}{why}", key)
        error.file, error.line = self.file, line
        raise error

    def allow(self, *keys: str) -> None:
        """Refuses a value that is no object, and other keys than these."""
        if not isinstance(self.value, dict):
            self.refuse(f"an object is needed; its keys are {', '.join(keys)}")
        for key in self.value:
            if key not in keys:
                nearest = _diptych.nearest_name(key, list(keys))
                self.refuse(f": unknown key; the nearest is '{nearest}'; allowed are {', '.join(keys)}", key)

    def demand_distinct(self, key: str, names: Sequence[str], of: str = "") -> None:
        """Refuses a name that the entries of a list have twice. of: the key whose values they are."""
        for name, count in Counter(names).items():
            if count > 1:
                self.refuse(f"{f' of {of}' if of else ''}: '{name}' is listed twice", key)

    def has(self, key: str) -> bool:
        return isinstance(self.value, dict) and key in self.value

    def at(self, key: str) -> "Part":
        """A member that must be there."""
        if not self.has(key):
            self.refuse(f"'{key}' is missing")
        return Part(self.file, self.lines, self.value[key], f"{self.pointer}/{key.replace('/', '~1', 1)}")

    def list(self, key: str) -> "list[Part]":
        """The entries of a list; empty if it is missing."""
        if not self.has(key):
            return []
        if not isinstance(self.value[key], list):
            self.refuse(" must be a list", key)
        return [Part(self.file, self.lines, entry, f"{self.pointer}/{key}/{k}")
                for k, entry in enumerate(self.value[key])]

    def word(self, key: str, otherwise: str = "") -> str:
        if not self.has(key):
            return otherwise
        if not isinstance(self.value[key], str):
            self.refuse(f" = {json.dumps(self.value[key])} is not allowed; use a text", key)
        return self.value[key]

    def number(self, key: str, low: float, high: float, is_whole: bool = False) -> Any:
        """A number in [low, high] that must be there: an int if it is to be whole, else a float."""
        value = self.at(key).value
        if not is_number(value) or not low <= value <= high or (is_whole and value != int(value)):
            self.refuse(f" = {json.dumps(value)} is not allowed; use a {'whole ' if is_whole else ''}number from "
                        f"{_diptych.text_of_number(low)} to {_diptych.text_of_number(high)}", key)
        return int(value) if is_whole else float(value)

    def flag(self, key: str) -> bool:
        """true or false; false if it is missing."""
        value = self.value.get(key, False)
        if not isinstance(value, bool):
            self.refuse(f" = {json.dumps(value)} is not allowed; use true or false", key)
        return value

    def existing_file(self, key: str) -> str:
        """The path of a file that must be there; relative ones begin at the folder of the input file."""
        self.at(key)
        path = os.path.join(os.path.dirname(self.file), self.word(key))
        if not os.path.isfile(path):
            self.refuse(f" = '{path}': there is no such file", key)
        return path

    def choice(self, key: str, choices: Sequence[str], otherwise: str) -> str:
        word = self.word(key, otherwise)
        if word not in choices:
            self.refuse(f" = '{word}' is not allowed; use one of {', '.join(choices)}", key)
        return word

    def seeds(self, key: str) -> "list[int]":
        """As on the command line: "1-8" or "1,3,5-7". Empty if it is missing."""
        return seeds_of_line(value_text(self.value[key]), lambda why: self.refuse(why, key)) if self.has(key) else []

    def settings(self, key: str) -> "list[Setting]":
        """{"section/key": value, ...}, each checked. Empty if it is missing."""
        if not self.has(key):
            return []
        part = self.at(key)
        if not isinstance(part.value, dict):
            self.refuse(' must be an object of "section/key": value', key)
        return [part.setting(name, name, value) for name, value in part.value.items()]

    def setting(self, key: str, name: str, value: Any) -> Setting:
        """One setting. key: the member of this part that contains it."""
        section, slash, rest = name.partition("/")
        line = self._line(key)
        if not slash:
            here = [one for one in _diptych.described_keys() if one.endswith("/" + name)]
            raise SceneError(f"{self._place(line)}: {name} is not a key of a scene; write section/key"
                             + (f", such as {here[0]}" if here else ""), name)
        folder = os.path.dirname(self.file)
        return Setting(section, rest, value_text(value), file=self.file, line=line, folder=folder).check()
