# diptych: the points of a study on every sample, and the results of their runs
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Points are references and places on the axes of families. Each has one run per sample."""

import itertools
import math
import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from ... import _diptych
from ...compiled import demand_continuum
from ...errors import SceneError
from ...files import read_json, read_provenance
from ..runs.engine import WRONG_INPUT
from ..runs.folders import Runs, SceneRun, run_name
from ..runs.histories import panel_table, reduced
from ..runs.input_file import Setting
from ..runs.key_numbers import key_values
from ..runs.members import member_of
from .study_file import COMMANDS, Study

MOST_RUNS = 100000


@dataclass(kw_only=True)
class Point:
    """One point. family -1: a reference. `reference` is the index of its reference point; a reference has its own
    index, and a point of a study without references has -1."""

    family: int = -1
    reference: int = 0
    places: tuple[int, ...] = ()  # indices on the axes of the family
    labels: list[str] = field(default_factory=list)
    settings: list[Setting] = field(default_factory=list)  # beyond those of all points
    runs: list[SceneRun] = field(default_factory=list)  # one per sample


def on_sample(settings: Sequence[Setting], seed: int | None, file: str) -> list[Setting]:
    """The settings for one sample: the seed replaces {seed}, or becomes sample/seed. file: gives the seeds."""
    if seed is None:
        return list(settings)
    names_seed = any("{seed}" in setting.value for setting in settings)
    own = [] if names_seed else [Setting("sample", "seed", str(seed), file=f"{file}: seeds")]
    return [setting.with_seed(seed) for setting in [*settings, *own]]


def scene_run(scene: str, command: str, settings: Sequence[Setting]) -> SceneRun:
    """The run of a scene with settings; one without a scene if they contradict each other. Runs draw no report. Raises
    SceneError if the command needs the continuum and this build has none."""
    if command != "discrete":
        demand_continuum(command)
    try:
        no_report = Setting("output", "report", "false", file="")
        read = _diptych.read_changed_scene(scene, [*settings, no_report], command == "run")
        return SceneRun(command=command, name=run_name(read, command), scene=read)
    except SceneError as error:
        text = "".join(setting.text() + "\n" for setting in settings)
        return SceneRun(command=command, name="refused_" + _diptych.digest(text), scene=None, refusal=str(error))


def _point(study: Study, settings: list[Setting], **place: Any) -> Point:
    point = Point(**place, settings=settings)
    for seed in study.seeds or [None]:
        point.runs.append(scene_run(study.scene, study.command,
                                    on_sample([*study.settings, *settings], seed, study.file)))
    return point


def points_of(study: Study) -> list[Point]:
    """References first: that of the study, then one for every point of axes with their own references. Then all
    families, the last axis fastest. Raises SceneError for a refused reference, no point left, or too many runs."""
    n = 1 + sum(math.prod(len(axis.points) for axis in family.axes) if family.grid else len(family.axes[0].points)
                for family in study.families)
    n_samples = len(study.seeds) or 1
    if n * n_samples > MOST_RUNS:
        raise SceneError(f"{study.file}: {n} points on {n_samples} samples; at most {MOST_RUNS} runs are allowed")
    references: dict[tuple[str, ...], Point] = {}
    points = []
    for index, family in enumerate(study.families):
        counts = [range(len(axis.points)) for axis in family.axes]
        for places in itertools.product(*counts) if family.grid else zip(*counts):
            chosen = [axis.points[k] for axis, k in zip(family.axes, places)]
            settings = sum((one.settings for one in chosen), family.settings)
            point = _point(study, settings, family=index, places=places, labels=[one.label for one in chosen])
            points.append(point)
            if study.reference is None:
                point.reference = -1
                continue
            shared = [(axis.name, one) for axis, one in zip(family.axes, chosen) if axis.own_reference]
            labels = tuple(f"{name} {one.label}" for name, one in shared)
            if labels not in references:
                settings = sum((one.settings for _, one in shared), study.reference)
                references[labels] = reference = _point(study, settings, labels=list(labels), reference=len(references))
                for run in reference.runs:
                    if run.scene is None:
                        raise SceneError(f"{study.file}: the reference is refused: {run.refusal}")
            point.reference = references[labels].reference
    every = [run for point in points for run in point.runs]
    if study.reference is None and all(run.scene is None for run in every):
        raise SceneError(f"every point is refused: {every[0].refusal}")
    return [*references.values(), *points]


@dataclass(kw_only=True)
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
    # of the grains, by the rule of the step: strength, dilation
    expected_error: dict[str, float] = field(default_factory=dict)
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
        result.words = runs.last_words(run)
    folder = runs.path(run)
    if not os.path.exists(os.path.join(folder, "provenance.json")):
        return result
    record = read_provenance(os.path.join(folder, "provenance.json"))
    result.phases, grains = record["phases"], record.get("discrete", {})
    result.halved_steps, result.warned = grains.get("halved_steps") or 0, bool(grains.get("warnings"))
    for kind in ("strength", "dilation"):
        error = grains.get(f"expected_{kind}_error")
        result.expected_error[kind] = math.nan if error is None else error
    result.tables = {source: panel_table(folder, source) for source in COMMANDS[run.command]}
    if result.tables.get("discrete") is not None:
        result.sweeps = float(result.tables["discrete"]["sweeps"].sum())
    if result.tables.get("continuum") is not None:
        last = result.tables["continuum"].iloc[-1]
        result.newton_iterations, result.cut_backs = float(last["newton_iterations"]), float(last["cut_backs"])
    if result.exit_code == 0:
        numbers: dict[str, tuple[Any, ...]] = {}
        if any(q["source"] == "comparison" for q in quantities):
            comparison = read_json(os.path.join(folder, "comparison.json"))
            numbers = member_of(comparison, run.scene.is_mirror_symmetric()).numbers
        has_keys = any(q["reduction"] == "key number" for q in quantities)
        keys = key_values(folder, run.scene, result.tables) if has_keys else {}
        result.values = [numbers.get(q["column"], (math.nan,))[0] if q["source"] == "comparison"
                         else keys.get((q["source"], q["key"]), math.nan) if q["reduction"] == "key number"
                         else reduced(result.tables.get(q["source"]), q) for q in quantities]
    return result
