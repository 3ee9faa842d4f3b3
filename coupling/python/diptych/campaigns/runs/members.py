# diptych: numbers of one comparison.json by name
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Collects the numbers of a comparison that may be averaged over samples."""

import functools
import math
import re
from dataclasses import dataclass, field
from typing import Any

from ... import _diptych
from ...files import stage_name, window_name

_SINGULAR = {"probes": "probe", "probe_differences": "probe_difference"}


@functools.cache
def _described() -> dict[str, tuple[str, str]]:
    """place -> (unit, kind) of the numbers that may be averaged"""
    return {place: (unit, kind) for place, (unit, kind) in _diptych.comparison_numbers().items()
            if kind in ("number", "line")}


# Patterns that the lists of a comparison add to the names of their numbers.
_IN_NAMES = {"bands": "band", "windows": r"window \S+-\S+", "stages": r"stage \S+", "stress": r"stress \S.*",
             **{one: rf"{singular} \S.*" for one, singular in _SINGULAR.items()}}


def described(name: str) -> tuple[str, str, bool] | None:
    """(place, unit, True for the angle of a line) of a number by its name in ensemble.csv; None: no number has it."""
    for place, (unit, kind) in _described().items():
        *parts, key = place.removeprefix("continuum_coarse/windows/").split("/")
        words = " ".join(_IN_NAMES.get(part, part) for part in parts)
        if place.startswith("continuum_coarse/windows/"):
            words = f"continuum_coarse {_IN_NAMES['windows']} {words}".rstrip()
        if re.fullmatch(f"{words} {re.escape(key)}", name):
            return place, unit, kind == "line"
    return None


@dataclass(kw_only=True)
class Member:
    """numbers: name -> (value, unit, True for the angle of a line); windows: "window 0-0.01"; bands: "window 0-0.01
    discrete" -> their number. diffuse: angles of diffuse zones, which are no numbers. folded: mirror images of a band
    count as one."""

    folded: bool = False
    numbers: dict[str, tuple[float, str, bool]] = field(default_factory=dict)
    windows: list[str] = field(default_factory=list)
    bands: dict[str, int] = field(default_factory=dict)
    diffuse: set[str] = field(default_factory=set)

    def value(self, name: str) -> float:
        """NaN if the comparison has no such number."""
        return self.numbers.get(name, (math.nan,))[0]

    def collect(self, value: Any, place: str, name: str) -> None:
        """Adds the numbers below a value. Lists with names become "probe zone"; only the strongest band counts."""
        if isinstance(value, dict) and "value" in value:
            self.collect(value["value"], place, name)
        elif isinstance(value, dict):
            for key, entry in value.items():
                if isinstance(entry, list):
                    self._collect_list(entry, f"{place}/{key}", name, key)
                else:
                    self.collect(entry, f"{place}/{key}", f"{name} {key}")
        elif isinstance(value, (int, float)) and not isinstance(value, bool) and place in _described():
            unit, kind = _described()[place]
            self.numbers[name] = (float(value), unit, kind == "line")

    def _collect_list(self, entries: list[Any], place: str, name: str, key: str) -> None:
        if key == "bands":
            self.bands[name] = sum(not band.get("diffuse") for band in entries)
            for band in entries[:1]:
                self.collect(band, place, f"{name} band")
                if self.folded:
                    self._fold(f"{name} band")
                if band.get("diffuse"):  # its angle enters no mean and no verdict
                    self.numbers.pop(f"{name} band angle_deg", None)
                    self.diffuse.add(f"{name} band angle_deg")
            return
        for entry in entries if entries and isinstance(entries[0], dict) else ():
            own = entry.get("name") or entry.get("label") or (f"{entry['of']}-{entry['and']}" if "of" in entry else "")
            if own:
                self.collect(entry, place, f"{name} {_SINGULAR.get(key, key)} {own}")

    def _fold(self, band: str) -> None:
        """Folds mirror images of a band: angle and offset lose their sign, the jump changes it with the angle."""
        turn = -1 if self.value(f"{band} angle_deg") < 0 else 1
        for key, folded in (("angle_deg", abs), ("offset_d", abs), ("jump", lambda jump: turn * jump)):
            if f"{band} {key}" in self.numbers:
                value, *kind = self.numbers[f"{band} {key}"]
                self.numbers[f"{band} {key}"] = (folded(value), *kind)

    def collect_windows(self, windows: list[Any], place: str, prefix: str = "") -> None:
        for window in windows:
            name = window_name(window["from"], window["to"])
            self.windows += [] if prefix else [name]
            self.collect(window, place, prefix + name)


def member_of(record: dict[str, Any], folded: bool = False) -> Member:
    """The numbers of a comparison.json. Names: "stage 0.04 discrete probe zone t_over_s", "window 0.02-0.04 continuum
    band angle_deg" (of the strongest band), "discrete_summary peak_stress_ratio"."""
    member = Member(folded=folded)
    for panel in ("discrete_summary", "continuum_summary"):
        member.collect(record[panel], panel, panel)
    member.collect_windows(record["windows"], "windows")
    for stage in record["stages"]:
        member.collect(stage, "stages", stage_name(stage["progress"]))
    coarse = record.get("continuum_coarse") or {}
    if "windows" in coarse:
        member.collect(coarse, "continuum_coarse", "continuum_coarse")
        member.collect_windows(coarse["windows"], "continuum_coarse/windows", "continuum_coarse ")
    return member
