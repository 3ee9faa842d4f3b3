# diptych: the command plan: settings and number of samples that a scene needs for an accuracy
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pilot runs in DIR/runs, plan.json and planned.prm; with --run the planned samples. A plan is a rule on runs."""

import argparse
import math
import os
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ... import _diptych
from ...compiled import continuum
from ...entries import describe
from ...errors import NotConverged
from ..runs.engine import Options, tell
from ..runs.folders import Folder, Runs, write_json, write_text
from ..runs.input_file import Setting
from ..studies.levels import limit_of
from .continuum import ContinuumPlan
from .errors import half_interval, samples_for, summary_of
from .grains import GrainsPlan
from .question import PanelPlan, Pilot, Plan, Question, percent, planned, read_question, text_of
from ..studies.points import RunResult, on_sample, result_of, scene_run

LEAST_SHARE_THAT_FINISHES = 0.75  # other samples are left out, as long as they are few
SHARED_SAMPLES = 4  # that give the cost of both panels together
SPARE_SAMPLES = 8

describe("plan.json", """\
format: version of this file's format
scene (text): file name of the scene
revision (text): revision of the program's source
accuracy: required accuracy, relative
pilot_cpu_s [s]: CPU time of the pilot's runs
total_cpu_s [s]: CPU time of all planned samples, predicted; shared runs of both panels count once
panels/: planned panels
    panel (text): panel: discrete or continuum
    command (text): command that computes its quantities
    settings (list): settings that the plan chose
    seeds (list): seeds of the samples; empty: the one sample of the scene
    reaches (yes or no): true if the plan reaches the required accuracy
    cpu_s [s]: CPU time of one sample, predicted
    total_cpu_s [s]: CPU time of all samples, predicted
    peak_memory_mb [MB]: peak memory of one sample, predicted
    decisions (list): findings on every setting, as text
    levels/: empty, or a plan with two levels: seeds, settings and cpu_s are those of the cheap one
        cheap: discrete/accuracy of all samples
        fine: discrete/accuracy of the pairs, the first samples
        pairs: number of pairs
        fine_cpu_s [s]: CPU time of one sample at the fine setting, predicted
    quantities/: quantities with their error budgets
        name (text): name of the quantity
        mean [as the quantity says]: mean in the pilot
        scatter: standard deviation of one sample, relative (angles: to 45 degrees)
        total: sum of the parts: upper estimate of the error of the mean, relative
        bias: expected error of the method: sum of the parts with their signs, relative
        parts/: parts of the error; that of the samples is half a 95 % interval
            cause (text): cause of this part of the error
            error: upper estimate of this part, relative
            bias: expected error with its sign, relative; positive: too large; 0: chance only
            deviation: standard deviation of that estimate; null: unknown
    outcome_cpu_s [s]: CPU time of one sample, measured; null before --run
    outcomes/: results of --run
        name (text): name of the quantity
        n: number of samples
        mean [as the quantity says]: mean over the samples
        scatter: standard deviation of one sample, relative (angles: to 45 degrees)
        half_interval: half the 95 % interval of the mean, relative
""")


def _cpu_s(result: RunResult, name: str = "") -> float:
    """CPU time of a phase, or of all [s]."""
    return sum(phase["cpu_s"] for phase in result.phases if name in ("", phase["name"]))


class PilotRuns:
    """The runs of a plan, each done once."""

    def __init__(self, question: Question, runs: Runs, options: Options) -> None:
        self.question, self.runs, self.options = question, runs, replace(options, resume=False)
        self.cpu_s, self._counted = 0.0, set()

    def run(self, command: str, settings: Sequence[Setting], seeds: Sequence[int],
            quantities: Sequence[dict[str, Any]]) -> Pilot:
        """Raises Stopped on a stop signal."""
        scene = self.question.scene
        runs = [scene_run(scene, command, on_sample(settings, seed, scene)) for seed in seeds or [None]]
        for run in runs:
            if run.refusal:  # settings that contradict the scene
                return Pilot(failure=run.refusal)
        self.runs.finish(runs, self.options)
        results = [result_of(self.runs, run, quantities) for run in runs]
        new = {run.name: result for run, result in zip(runs, results) if run.name not in self._counted}
        self.cpu_s += sum(map(_cpu_s, new.values()))
        self._counted |= set(new)
        return _pilot_of(results, quantities)


def _pilot_of(results: Sequence[RunResult], quantities: Sequence[dict[str, Any]]) -> Pilot:
    finished = [result for result in results if result.known and result.exit_code == 0]
    words = [result.words or "the run was lost" for result in results if result not in finished]
    pilot = Pilot(values=[[result.values[q] for result in results] for q in range(len(quantities))],
                  peak_memory_mb=max((phase["peak_memory_mb"] for result in results for phase in result.phases),
                                     default=0.0))
    if words and len(finished) >= LEAST_SHARE_THAT_FINISHES * len(results):
        pilot.remark = words[-1]
    elif words:
        pilot.failure = words[-1]
        return pilot
    pilot.sample_cpu_s = [_cpu_s(result) for result in finished]
    pilot.cpu_s = float(np.mean(pilot.sample_cpu_s))
    pilot.preparation_cpu_s = float(np.mean([_cpu_s(result, "preparation") for result in finished]))
    pilot.expected_error = {kind: float(np.mean([result.expected_error[kind] for result in finished]))
                            for kind in ("strength", "dilation")}
    for asked_for, values in zip(quantities, pilot.values):
        if not np.isfinite(values).any():
            pilot.failure = f"{asked_for['name']} has no value in any run: a window beyond the loading, or no band"
    return pilot


def _carry_out(question: Question, plan: Plan, panel: PanelPlan, pilot: PilotRuns) -> bool:
    """Runs the planned samples of a panel, and more if they scatter more than the pilot's did. True: it is accurate."""
    most, seeds, wanted = 2 * panel.n_samples + SPARE_SAMPLES, list(panel.seeds), question.quantities[panel.panel]
    while True:
        settings = [*question.changes, *plan.settings]
        point, fine = pilot.run(panel.command, settings, seeds, wanted), None
        panel.outcomes, panel.outcome_cpu_s = [], point.cpu_s
        if panel.levels:
            n_pairs = min(len(seeds), math.ceil(len(seeds) * panel.levels["pairs"] / panel.n_samples))
            settings = [*settings, planned("discrete/accuracy", panel.levels["fine"])]
            fine = pilot.run(panel.command, settings, seeds[:n_pairs], wanted)
        if point.failure or fine and fine.failure:
            panel.decisions.append(f"--run: {point.failure or fine.failure}")
            return False
        for k, q in enumerate(wanted):
            found, scatter = summary_of(point.values[k], q["line"])
            half, mean = half_interval(scatter, found.n) if found.n > 1 else np.nan, found.mean
            if fine:
                ratio = fine.expected_error["strength"] / point.expected_error["strength"]
                limit = limit_of(point.values[k], fine.values[k] + [np.nan] * (len(seeds) - n_pairs), ratio).limit
                half, mean = (limit.high - limit.low) / 2 / abs(limit.value), limit.value
            panel.outcomes.append({"name": q["name"], "n": found.n, "mean": mean, "scatter": scatter,
                                   "half_interval": half})
        missing = _missing(question.accuracy, panel, len(seeds))
        if missing == 0 or len(seeds) >= most:
            return missing == 0
        seeds += range(seeds[-1] + 1, seeds[-1] + 1 + min(missing, most - len(seeds)))


def _missing(accuracy: float, panel: PanelPlan, n: int) -> int:
    """How many samples more the intervals need. Some samples may have no value, such as the width of a band."""
    missing = 0
    for outcome, budget in zip(panel.outcomes if n > 1 else (), panel.quantities):
        if panel.levels and not outcome["half_interval"] + budget.method <= accuracy:
            missing = max(missing, math.ceil(n * (outcome["half_interval"] / (accuracy - budget.method))**2) - n)
        elif not outcome["half_interval"] + budget.method <= accuracy:
            needed, share = samples_for(outcome["scatter"], accuracy - budget.method), outcome["n"] / n
            missing = max(missing, n if needed == 0 or share == 0 else max(1, int(needed / share) - n))
    return missing


def make_plan(question: Question, scene: _diptych.Scene, pilot: PilotRuns) -> Plan:
    """The plans of all panels that the question asks for."""
    makers = {"discrete": GrainsPlan, "continuum": ContinuumPlan}
    panels = [makers[panel](question, scene, pilot.run).make()
              for panel, wanted in question.quantities.items() if wanted]
    plan = Plan(scene=os.path.basename(question.scene), accuracy=question.accuracy, panels=panels)
    if plan.shares_samples:  # the cost of `diptych run` with the settings of both panels
        seeds = max((panel.seeds for panel in panels), key=len)[:SHARED_SAMPLES]
        point = pilot.run("run", [*question.changes, *plan.settings], seeds, [])
        for panel in panels if not point.failure else ():
            panel.cpu_s, panel.peak_memory_mb = point.cpu_s, point.peak_memory_mb
    plan.pilot_cpu_s = pilot.cpu_s
    return plan


def _text_with(text: str, names: set[str]) -> str:
    """The text of a scene with these keys only."""
    kept: dict[str, list[str]] = {}
    for line in text.splitlines():
        word, _, rest = line.strip().partition(" ")
        if word == "subsection":
            section = rest
        elif word == "set" and f"{section}/{rest.split(' =')[0]}" in names:
            kept.setdefault(section, []).append(line)
    return "".join(f"\nsubsection {name}\n" + "\n".join(lines) + "\nend\n" for name, lines in kept.items())


def write_plan(directory: str, question: Question, plan: Plan) -> None:
    """plan.json and planned.prm: the keys of the scene and those that the plan chose, without defaults."""
    write_json(directory + "/plan.json", plan.record())
    scene = _diptych.read_changed_scene(question.scene, [*question.changes, *plan.settings], False)
    lines = [f"# The first of two levels. For both: diptych run planned.prm --seeds {panel.seeds[0]}-{panel.seeds[-1]} "
             f"--levels {panel.levels['cheap']:g},{panel.levels['fine']:g}\n" for panel in plan.panels if panel.levels]
    given = [*map(Setting._make, _diptych.read_fragment(question.scene)), *question.changes, *plan.settings]
    text = _text_with(scene.in_folder("", scene.name).text(), {f"{one.section}/{one.key}" for one in given})
    write_text(directory + "/planned.prm", "".join(lines) + f"# planned from {plan.scene}\n" + text)


def main_plan(args: argparse.Namespace, options: Options) -> None:
    """The command `diptych plan SCENE --accuracy A`. args: target, accuracy, for, set, set_file, output and run. Raises
    NotConverged if the accuracy is not reached."""
    question = read_question(args.target, args.accuracy, getattr(args, "for"), args.set, args.set_file)
    scene = _diptych.read_changed_scene(question.scene, question.changes, question.needs_comparison)
    if question.quantities["continuum"]:
        continuum("plan").require_continuum(scene)
    directory = args.output or f"results/{scene.name}_plan"
    inputs = [*scene.input_files(), ("the scene", question.scene), *(("--set-file", file) for file in args.set_file)]
    with Folder(directory) as folder:
        pilot = PilotRuns(question, folder.open_runs("plan", question.scene, options, lambda: inputs), options)
        plan = make_plan(question, scene, pilot)
        write_plan(directory, question, plan)
        reached = all(panel.reaches for panel in plan.panels)
        if args.run:
            reached = all([_carry_out(question, plan, panel, pilot) for panel in plan.panels
                           if panel.reaches]) and reached
            write_plan(directory, question, plan)
    tell(f"{text_of(plan)}\n{directory}/planned.prm, plan.json")
    if not reached:
        raise NotConverged(f"the accuracy of {percent(question.accuracy)} is not reached")
