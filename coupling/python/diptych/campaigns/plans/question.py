# diptych: question and answer of a plan: the settings and samples that a scene needs for an accuracy
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The question comes from the command line; the answer is plan.json, planned.prm and a report as text."""

import json
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ... import _diptych
from ...errors import SceneError
from ...files import number_name, window_name
from ..runs.input_file import Setting, settings_of
from ..runs.key_numbers import QUANTITIES
from ..runs.members import described
from ..studies.study_file import key_quantity, quantity

PANELS = {"discrete": ("sample", "discrete"), "continuum": ("continuum",)}  # and the sections that ask for them


@dataclass(kw_only=True)
class Question:
    """quantities: by panel; those of grains have step_error, the rule of their error: strength, dilation, "": none."""

    scene: str
    changes: list[Setting]  # --set-file, --set
    accuracy: float  # relative, of the mean of every quantity: method errors plus 95 % interval
    quantities: dict[str, list[dict[str, Any]]] = field(default_factory=lambda: {"discrete": [], "continuum": []})

    @property
    def needs_comparison(self) -> bool:
        return any(q["source"] == "comparison" for panel in self.quantities.values() for q in panel)


@dataclass(kw_only=True)
class Pilot:
    """The results of a scene with settings on samples. CPU times and memory per sample: mean and largest."""

    values: list[list[float]] = field(default_factory=list)  # [quantity][sample]; NaN if there is none
    failure: str = ""  # reason if a run did not finish
    remark: str = ""  # reason if a few samples are left out
    sample_cpu_s: list[float] = field(default_factory=list)  # of the samples that finished
    cpu_s: float = np.nan
    preparation_cpu_s: float = 0.0
    peak_memory_mb: float = 0.0
    expected_error: dict[str, float] = field(default_factory=dict)  # by the rule of the step: strength, dilation


# command, settings, seeds (empty: the one sample of the scene), quantities
RunPilot = Callable[[str, list[Setting], Sequence[int], list[dict[str, Any]]], Pilot]


SAMPLES, SAMPLES_AND_PAIRS = "samples", "samples, pairs and order"  # causes of parts that more samples reduce


@dataclass(kw_only=True)
class Part:
    """One part of the error of a mean, relative. bias: expected, with sign; 0: chance only."""

    cause: str
    error: float  # upper estimate
    bias: float = 0.0
    deviation: float = np.nan  # of that estimate

    @property
    def is_of_method(self) -> bool:
        return self.cause not in (SAMPLES, SAMPLES_AND_PAIRS)


@dataclass(kw_only=True)
class Budget:
    """The errors of one quantity. scatter: of one sample, relative."""

    name: str
    mean: float
    scatter: float
    parts: list[Part]

    @property
    def total(self) -> float:
        return sum(part.error for part in self.parts)

    @property
    def method(self) -> float:
        """Without half the interval of the samples."""
        return sum(part.error for part in self.parts if part.is_of_method)

    @property
    def bias(self) -> float:
        return sum(part.bias for part in self.parts)


@dataclass(kw_only=True)
class PanelPlan:
    """The plan of one panel. seeds: empty: the one sample of the scene. CPU time and memory are those of one sample.
    levels: cheap and fine (discrete/accuracy), pairs, fine_cpu_s of two levels. The rest is that of the cheap one."""

    panel: str
    command: str
    settings: list[Setting] = field(default_factory=list)
    seeds: list[int] = field(default_factory=list)
    cpu_s: float = np.nan
    peak_memory_mb: float = 0.0
    reaches: bool = True
    levels: dict[str, Any] = field(default_factory=dict)
    quantities: list[Budget] = field(default_factory=list)
    decisions: list[str] = field(default_factory=list)
    outcomes: list[dict[str, Any]] = field(default_factory=list)  # of --run
    outcome_cpu_s: float = np.nan

    @property
    def n_samples(self) -> int:
        return max(1, len(self.seeds))

    @property
    def total_cpu_s(self) -> float:
        of_pairs = self.levels["pairs"] * self.levels["fine_cpu_s"] if self.levels else 0.0
        return self.cpu_s * self.n_samples + of_pairs if self.quantities else 0.0

    def record(self) -> dict[str, Any]:
        return {**vars(self), "settings": [one.text() for one in self.settings], "total_cpu_s": self.total_cpu_s,
                "quantities": [{**vars(q), "total": q.total, "bias": q.bias, "parts": [vars(part) for part in q.parts]}
                               for q in self.quantities]}


@dataclass(kw_only=True)
class Plan:
    """The answer."""

    scene: str
    accuracy: float
    panels: list[PanelPlan]
    pilot_cpu_s: float = 0.0

    @property
    def shares_samples(self) -> bool:
        """True if both panels come from the same runs."""
        return len(self.panels) > 1 and all(panel.quantities and panel.command == "run" for panel in self.panels)

    @property
    def settings(self) -> list[Setting]:
        """The settings of all panels."""
        return [one for panel in self.panels for one in panel.settings]

    @property
    def total_cpu_s(self) -> float:
        return float((max if self.shares_samples else sum)(panel.total_cpu_s for panel in self.panels))

    def record(self) -> dict[str, Any]:
        return {"format": 1, "scene": self.scene, "revision": _diptych.git_revision, "accuracy": self.accuracy,
                "pilot_cpu_s": self.pilot_cpu_s, "total_cpu_s": self.total_cpu_s,
                "panels": [panel.record() for panel in self.panels]}


def planned(name: str, value: Any) -> Setting:
    """A setting that the plan makes: planned("discrete/step", "auto")."""
    text = value if isinstance(value, str) else _diptych.text_of_number(value)
    return Setting(*name.split("/"), text, file="plan")


def read_accuracy(text: str) -> float:
    """A relative accuracy from 0.1 to 50 %: "2 %", "2%", "0.02". Raises SceneError."""
    number, sign, rest = text.strip().partition("%")
    try:
        accuracy = float(number) / (100 if sign else 1)
    except ValueError:
        accuracy = np.nan
    if rest or not 0.001 <= accuracy <= 0.5:
        raise SceneError(f"--accuracy '{text}' is not allowed; use a number from 0.001 to 0.5, or from 0.1 % to 50 %")
    return accuracy


def _panels_of(file: str, scene: _diptych.Scene) -> set[str]:
    """Panels with keys in the scene file; a resolved scene sets all keys."""
    if _diptych.resolved_scene(file) is not None:
        return {"discrete", "continuum"} if scene.dict()["continuum"]["mesh"] == "outline" else {"continuum"}
    if file.endswith(".json"):
        sections = set(json.loads(_diptych.read_json(file)[0]))
    else:
        with open(file, encoding="utf-8") as opened:
            sections = set(re.findall(r"^\s*subsection\s+(\w+)", opened.read(), re.MULTILINE))
    return {panel for panel, asked in PANELS.items() if sections & set(asked)} or {"discrete"}


def _key_quantity(key: str, panel: str, scene: _diptych.Scene) -> dict[str, Any]:
    """A key number of one panel; that of a band from a comparison, because grains alone have none."""
    of_band = QUANTITIES[key]["is_of_band"]
    rule = "" if of_band else "dilation" if key == "final_volumetric_strain" else "strength"
    asked = key_quantity(key, panel) | {"name": f"{panel}.{key}", "step_error": rule}
    if not of_band:
        return asked
    window = window_name(*scene.dict()["comparison"]["window_edges"][-2:])
    return asked | {"source": "comparison", "reduction": "number",
                    "column": number_name(panel, key, window)}


def _add(question: Question, word: str, panels: set[str], scene: _diptych.Scene) -> None:
    prefix, _, rest = word.partition(".")
    named = {prefix} if prefix in PANELS and rest else set()
    name = rest if named else word
    if name in QUANTITIES:
        if "discrete" in named - panels:
            raise SceneError(f"--for '{word}': {question.scene} sets no key of sample or discrete")
        for panel in PANELS:
            if panel in (named or panels):
                question.quantities[panel].append(_key_quantity(name, panel, scene))
        return
    found = described(word)
    parts = found[0].split("/") if found else []
    of = [panel for panel in PANELS if {panel, panel + "_summary"} & set(parts)]
    if not of:
        raise SceneError(f"--for '{word}' is unknown; use {', '.join(QUANTITIES)}, with the prefix discrete. or "
                         "continuum. for one panel, or a number of a panel with its name in ensemble.csv")
    question.quantities[of[0]].append(quantity(word, source="comparison", reduction="number", column=word,
                                               unit=found[1], line=found[2], step_error=""))


def read_question(scene_file: str, accuracy: str, wanted: str, overrides: Sequence[str] = (),
                  set_files: Sequence[str] = ()) -> Question:
    """The question of a command line. Raises SceneError."""
    changes = [one.check() for one in settings_of(overrides, set_files)]
    question = Question(scene=scene_file, changes=changes, accuracy=read_accuracy(accuracy))
    scene = _diptych.read_changed_scene(scene_file, changes, False)
    panels = _panels_of(scene_file, scene)
    for word in (wanted or "peak_stress_ratio,strength").split(","):
        _add(question, word.strip(), panels, scene)
    keys = scene.dict()
    if keys["loading"]["mode"] == "time":
        raise SceneError(f"{scene_file}: loading/mode = time; plans support loadings along a strain only")
    if question.quantities["discrete"] and keys["discrete"]["method"] not in ("nscd", "compliant"):
        raise SceneError(f"{scene_file}: discrete/method = {keys['discrete']['method']}; plans support nscd and "
                         "compliant only (cost of springs: benchmarks/penalty, benchmarks/rigid_limit)")
    if question.needs_comparison and keys["continuum"]["mesh"] != "outline":
        raise SceneError(f"{scene_file}: continuum/mesh = {keys['continuum']['mesh']}; --for asks for a number of the "
                         "comparison, which needs both panels on one sample (mesh = outline)")
    return question


def percent(share: float) -> str:
    return f"{100 * share:.{2 if abs(share) < 0.995 else 3}g} %"


def _panel_text(panel: PanelPlan) -> list[str]:
    lines = ["", panel.panel, *("  " + decision for decision in panel.decisions)]
    if not panel.quantities:
        return [*lines, "  no plan was found: the accuracy is NOT reached"]
    for q in panel.quantities:
        scatter = f"; one sample scatters by {percent(q.scatter)}" if np.isfinite(q.scatter) else ""
        lines.append(f"  {q.name:<43} error at most about {percent(q.total)}, bias {percent(q.bias)}{scatter}")
        for part in q.parts:
            deviation = f" +- {percent(part.deviation)}" if np.isfinite(part.deviation) else ""
            lines.append(f"    {part.cause:<41} {percent(part.error)}{deviation}")
    lines += ["  set " + one.text() for one in panel.settings]
    lines += [] if panel.reaches else ["  the accuracy is NOT reached by this plan"]
    seeds = f" (seeds {panel.seeds[0]}-{panel.seeds[-1]})" if len(panel.seeds) > 1 else ""
    lines.append(f"  {panel.command} on {panel.n_samples} sample{'s' if panel.n_samples > 1 else ''}{seeds}: "
                 f"{panel.cpu_s:.3g} CPU s each, {panel.total_cpu_s:.3g} s in all, {panel.peak_memory_mb:.3g} MB")
    if panel.levels:
        pairs, cheap, fine, cpu_s = (panel.levels[name] for name in ("pairs", "cheap", "fine", "fine_cpu_s"))
        lines.append(f"  two levels: {pairs} of these also at discrete/accuracy = {fine:g}, {cpu_s:.3g} CPU s each; "
                     "the means are those in the limit of short steps. For both panels: --levels "
                     f"{cheap:g},{fine:g} of diptych run")
    if panel.outcomes:
        lines.append(f"  result, at {panel.outcome_cpu_s:.3g} CPU s per sample:")
        lines += [f"    {one['name']:<41} {one['mean']:.3g}" +
                  (f", 95 % interval +- {percent(one['half_interval'])} ({one['n']} samples)" if one["n"] > 1 else "")
                  for one in panel.outcomes]
    return lines


def text_of(plan: Plan) -> str:
    """Findings, error budget and cost of every panel, for the terminal."""
    lines = [f"{plan.scene}: plan for an accuracy of {100 * plan.accuracy:.4g} %"]
    for panel in plan.panels:
        lines += _panel_text(panel)
    if [panel.panel for panel in plan.panels] == ["discrete"]:
        lines += ["", "Only the grains were planned. `--for strength,continuum.strength` also plans the continuum."]
    if plan.shares_samples:
        lines += ["", "`diptych run` computes both panels on the same samples."]
    return "\n".join([*lines, "", f"CPU time of the plan {plan.total_cpu_s:.3g} s; the pilot took "
                      f"{plan.pilot_cpu_s:.3g} s"])
