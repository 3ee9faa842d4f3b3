# diptych: the points of a study on every sample, and the results of their runs
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Points are references and places on the axes of families. Each has one run per sample."""

from __future__ import annotations

import itertools
import math
import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

from .. import _diptych
from ..errors import SceneError
from .engine import WRONG_INPUT, last_words
from .folders import Runs, SceneRun, read_json, run_name
from .histories import panel_table, reduced
from .input_file import Setting
from .members import is_mirror_symmetric, member_of
from .study_file import COMMANDS, AxisPoint, Family, Study

MOST_RUNS = 100000


@dataclass
class Point:
    """One point. family -1: a reference. `reference` is the index of its reference point; a reference has its own index."""

    family: int = -1
    reference: int = 0
    places: tuple[int, ...] = ()  # indices on the axes of the family
    labels: list[str] = field(default_factory=list)
    settings: list[str] = field(default_factory=list)  # beyond those of all points
    runs: list[SceneRun] = field(default_factory=list)  # one per sample


def _on_sample(settings: list[Setting], seed: int | None, study: Study) -> list[Setting]:
    """The settings for one sample: the seed replaces {seed} in the values, or becomes sample/seed."""
    if seed is None:
        return settings
    if not any("{seed}" in setting.value for setting in settings):
        settings = [*settings, Setting("sample", "seed", str(seed), f"{study.file}: seeds")]
    return [setting.with_seed(seed) for setting in settings]


def scene_run(scene: str, command: str, settings: Sequence[Setting]) -> SceneRun:
    """The run of a scene with settings; one without a scene if they contradict each other. Runs draw no report."""
    try:
        read = _diptych.read_changed_scene(scene, [*settings, Setting("output", "report", "false", "")], command == "run")
        return SceneRun(command, run_name(read, command), read)
    except SceneError as error:
        text = "".join(setting.text() + "\n" for setting in settings)
        return SceneRun(command, "refused_" + _diptych.digest(text), None, str(error))


def _point(study: Study, settings: list[Setting], **place: Any) -> Point:
    point = Point(**place, settings=[setting.text() for setting in settings])
    for seed in study.seeds or [None]:
        point.runs.append(scene_run(study.scene, study.command, _on_sample([*study.settings, *settings], seed, study)))
    return point


def _places(family: Family) -> Iterable[tuple[int, ...]]:
    counts = [range(len(axis.points)) for axis in family.axes]
    return itertools.product(*counts) if family.grid or not counts else zip(*counts)


def points_of(study: Study) -> list[Point]:
    """References first: that of the study, then one for every point of axes with their own references. Then all families, the
    last axis fastest. Raises SceneError if a reference is refused or if there are more than 100000 runs."""
    n = 1 + sum(math.prod(len(axis.points) for axis in family.axes) if family.grid else len(family.axes[0].points)
                for family in study.families)
    n_samples = len(study.seeds) or 1
    if n * n_samples > MOST_RUNS:
        raise SceneError(f"{study.file}: {n} points on {n_samples} samples; at most {MOST_RUNS} runs are allowed")
    references: dict[tuple[str, ...], Point] = {}
    points = []
    for index, family in enumerate(study.families):
        for places in _places(family):
            chosen = [axis.points[k] for axis, k in zip(family.axes, places)]
            point = _point(study, [*family.settings, *_settings(chosen)], family=index, places=places,
                           labels=[one.label for one in chosen])
            shared = [(axis.name, one) for axis, one in zip(family.axes, chosen) if axis.own_reference]
            labels = tuple(f"{name} {one.label}" for name, one in shared)
            if labels not in references:
                settings = [*study.reference, *_settings(one for _, one in shared)]
                references[labels] = reference = _point(study, settings, labels=list(labels), reference=len(references))
                for run in reference.runs:
                    if run.scene is None:
                        raise SceneError(f"{study.file}: the reference is refused: {run.refusal}")
            point.reference = references[labels].reference
            points.append(point)
    return [*references.values(), *points]


def _settings(points: Iterable[AxisPoint]) -> list[Setting]:
    return [setting for point in points for setting in point.settings]


@dataclass
class RunResult:
    """The result of one run. Not known: it was interrupted or never started. Values are NaN if there are none."""

    known: bool = False
    exit_code: int = 0
    words: str = ""  # last line of its log if it did not finish, or the reason of the refusal
    warned: bool = False  # a panel warned
    halved_steps: int = 0  # of the grains
    cut_backs: float = 0.0  # of the continuum
    sweeps: float = math.nan
    newton_iterations: float = math.nan
    load: float = math.nan  # of the machine at the end
    at_once: int = 1
    phases: list[dict[str, Any]] = field(default_factory=list)
    values: list[float] = field(default_factory=list)  # one per quantity
    tables: dict[str, Any] = field(default_factory=dict)  # of the panels that ran

    @property
    def disturbed(self) -> bool:
        """The machine was busy with half a process more than the runs of this study."""
        return self.load > self.at_once + 0.5


def result_of(runs: Runs, run: SceneRun, quantities: Sequence[dict[str, Any]]) -> RunResult:
    """Reads one run. Raises ValueError with the name of a damaged file."""
    result = RunResult(values=[math.nan] * len(quantities))
    if run.scene is None:
        result.known, result.exit_code, result.words = True, WRONG_INPUT, run.refusal
        return result
    end = runs.found_end(run)
    if end is None:
        return result
    result.known, result.exit_code, result.at_once = True, end["exit_code"], end["at_once"]
    result.load = end["load"] if end["load"] is not None else math.nan
    if result.exit_code:
        result.words = last_words(runs.path(run, ".log")).replace(runs.directory + "/", "")
    folder = runs.path(run)
    if not os.path.exists(os.path.join(folder, "provenance.json")):
        return result
    record = read_json(os.path.join(folder, "provenance.json"))
    result.phases, grains = record["phases"], record.get("discrete", {})
    result.halved_steps, result.warned = grains.get("halved_steps") or 0, bool(grains.get("warnings"))
    result.tables = {source: panel_table(folder, source) for source in COMMANDS[run.command]}
    _add_effort(result)
    if result.exit_code == 0:
        result.values = values_of(folder, run, result.tables, quantities)
    return result


def _add_effort(result: RunResult) -> None:
    grains, continuum = result.tables.get("discrete"), result.tables.get("continuum")
    if grains is not None:
        result.sweeps = float(grains["sweeps"].sum())
    if continuum is not None:
        last = continuum.iloc[-1]
        result.newton_iterations, result.cut_backs = float(last["newton_iterations"]), float(last["cut_backs"])


def values_of(folder: str, run: SceneRun, tables: dict[str, Any], quantities: Sequence[dict[str, Any]]) -> list[float]:
    """The quantities of a finished run."""
    numbers: dict[str, float] = {}
    if any(q["source"] == "comparison" for q in quantities):
        member = member_of(os.path.join(folder, "comparison.json"), is_mirror_symmetric(run.scene))
        numbers = {name: value for name, (value, *_) in member.numbers.items()}
    return [numbers.get(q["column"], math.nan) if q["source"] == "comparison" else reduced(tables.get(q["source"]), q)
            for q in quantities]
