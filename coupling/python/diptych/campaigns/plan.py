# diptych: the command plan: settings and number of samples that a scene needs for an accuracy
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pilot runs in DIR/runs, plan.json and planned.prm; with --run the planned samples, too. A plan is a rule on runs of a
study."""

from __future__ import annotations

import argparse
import importlib
import os
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from .. import _diptych
from ..errors import Stopped
from .engine import DONE, NOT_CONVERGED, Options, complain
from .folders import Folder, Runs, read_json, write_json, write_text
from .input_file import Setting
from .plan_continuum import ContinuumPlan
from .plan_errors import half_interval, samples_for, summary_of
from .plan_grains import GrainsPlan
from .plan_question import PanelPlan, Pilot, Plan, Question, Task, percent, read_question, text_of
from .points import RunResult, result_of, scene_run

LEAST_SHARE_THAT_FINISHES = 0.75  # other samples are left out, as long as they are few
SHARED_SAMPLES = 4  # that give the cost of both panels together
SPARE_SAMPLES = 8


def _cpu_s(result: RunResult, name: str = "") -> float:
    """CPU time of a phase, or of all [s]."""
    return sum(phase["cpu_s"] for phase in result.phases if name in ("", phase["name"]))


class PilotRuns:
    """The runs of a plan, each done once."""

    def __init__(self, question: Question, directory: str, options: Options) -> None:
        self.question, self.runs, self.options = question, Runs(directory), replace(options, resume=False)
        self.cpu_s, self._counted = 0.0, set()

    def run(self, task: Task) -> Pilot:
        """Raises Stopped on a stop signal."""
        runs = []
        for seed in task.seeds or [None]:
            own = [] if seed is None else [Setting("sample", "seed", str(seed), self.question.scene)]
            runs.append(scene_run(self.question.scene, task.command, [one if seed is None else one.with_seed(seed)
                                                                      for one in [*task.settings, *own]]))
            if runs[-1].refusal:  # settings that contradict the scene
                return Pilot(failure=runs[-1].refusal)
        if any(outcome.interrupted for outcome in self.runs.do(runs, self.options)):
            raise Stopped("stopped on request")
        results = [result_of(self.runs, run, task.quantities) for run in runs]
        for run, result in zip(runs, results):
            if run.name not in self._counted:
                self._counted.add(run.name)
                self.cpu_s += _cpu_s(result)
        expected = [read_json(self.runs.path(run, "/provenance.json")).get("discrete", {})
                    for run, result in zip(runs, results) if result.known and result.exit_code == 0]
        return self._pilot(task, results, expected)

    @staticmethod
    def _pilot(task: Task, results: Sequence[RunResult], expected: Sequence[dict[str, float]]) -> Pilot:
        finished = [result for result in results if result.known and result.exit_code == 0]
        words = [result.words or "the run was lost" for result in results if result not in finished]
        pilot = Pilot(values=[[result.values[q] for result in results] for q in range(len(task.quantities))],
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
        for kind in ("strength", "dilation"):
            errors = [record.get(f"expected_{kind}_error") for record in expected]
            pilot.expected_error[kind] = float(np.mean([np.nan if one is None else one for one in errors]))
        for asked_for, values in zip(task.quantities, pilot.values):
            if not np.isfinite(values).any():
                pilot.failure = f"{asked_for['name']} has no value in any run: a window beyond the loading, or no band"
        return pilot


class Execution:
    """The planned samples of a panel, and more if they scatter more than the pilot's did."""

    def __init__(self, question: Question, plan: Plan, pilot: PilotRuns) -> None:
        self.question, self.pilot = question, pilot
        self.settings = [*question.changes, *(one for panel in plan.panels for one in panel.settings)]

    def run(self, panel: PanelPlan) -> bool:
        """Whether the accuracy is reached."""
        most, seeds = 2 * panel.n_samples + SPARE_SAMPLES, list(panel.seeds)
        while True:
            self._measure(panel, seeds)
            missing = self._missing(panel, len(seeds))
            if missing == 0 or not panel.outcomes or len(seeds) >= most:
                return missing == 0 and bool(panel.outcomes)
            more = min(most, len(seeds) + missing) - len(seeds)
            seeds += range(seeds[-1] + 1, seeds[-1] + 1 + more)

    def _measure(self, panel: PanelPlan, seeds: Sequence[int]) -> None:
        wanted = self.question.quantities[panel.panel]
        point = self.pilot.run(Task(panel.command, self.settings, seeds, wanted))
        panel.outcomes, panel.outcome_cpu_s = [], point.cpu_s
        if point.failure:
            panel.decisions.append(f"--run: {point.failure}")
            return
        for q, values in zip(wanted, point.values):
            found, scatter = summary_of(values, q["line"])
            panel.outcomes.append({"name": q["name"], "n": found.n, "mean": found.mean, "scatter": scatter,
                                   "half_interval": half_interval(scatter, found.n) if found.n > 1 else np.nan})

    def _missing(self, panel: PanelPlan, n: int) -> int:
        """How many samples more the intervals need. Some samples may have no value, such as the width of a band."""
        missing = 0
        for outcome, budget in zip(panel.outcomes if n > 1 else (), panel.quantities):
            if outcome["half_interval"] + budget.method <= self.question.accuracy:
                continue
            needed = samples_for(outcome["scatter"], self.question.accuracy - budget.method)
            share = outcome["n"] / n
            missing = max(missing, n if needed == 0 or share == 0 else max(1, int(needed / share) - n))
        return missing


def _find_shared_cost(question: Question, plan: Plan, pilot: PilotRuns) -> None:
    """The cost of `diptych run` with the settings of both panels, from the plan's first samples."""
    settings = [*question.changes, *(one for panel in plan.panels for one in panel.settings)]
    seeds = max((panel.seeds for panel in plan.panels), key=len)[:SHARED_SAMPLES]
    point = pilot.run(Task("run", settings, seeds, []))
    for panel in plan.panels if not point.failure else ():
        panel.cpu_s, panel.peak_memory_mb = point.cpu_s, point.peak_memory_mb


def make_plan(question: Question, scene: _diptych.Scene, pilot: PilotRuns) -> Plan:
    """The plans of all panels that the question asks for."""
    makers = {"discrete": GrainsPlan, "continuum": ContinuumPlan}
    panels = [makers[panel](question, scene, pilot.run).make() for panel, wanted in question.quantities.items() if wanted]
    plan = Plan(os.path.basename(question.scene), question.accuracy, panels)
    if plan.shares_samples:
        _find_shared_cost(question, plan, pilot)
    plan.pilot_cpu_s = pilot.cpu_s
    return plan


def write_plan(directory: str, question: Question, plan: Plan) -> None:
    """plan.json and planned.prm: the scene with the chosen settings."""
    write_json(directory + "/plan.json", plan.record())
    settings = [*question.changes, *(one for panel in plan.panels for one in panel.settings)]
    scene = _diptych.read_changed_scene(question.scene, [tuple(one) for one in settings], False)
    write_text(directory + "/planned.prm", scene.in_folder("", scene.name, scene.dict()["sample"]["seed"]).text())


def _carry_out(question: Question, scene: _diptych.Scene, directory: str, runs_the_plan: bool, options: Options) -> tuple[Plan,
                                                                                                                          bool]:
    pilot = PilotRuns(question, directory, options)
    plan = make_plan(question, scene, pilot)
    write_plan(directory, question, plan)
    reached = all(panel.reaches for panel in plan.panels)
    if runs_the_plan:
        execution = Execution(question, plan, pilot)
        reached = all([execution.run(panel) for panel in plan.panels if panel.reaches]) and reached
        write_plan(directory, question, plan)
    return plan, reached


def run_plan(question: Question, output: str, runs_the_plan: bool, options: Options,
             set_files: Sequence[str] = ()) -> tuple[Plan, bool, str]:
    """Makes a plan, and with `runs_the_plan` the planned runs. Returns it, whether the accuracy is reached, and the folder."""
    scene = _diptych.read_changed_scene(question.scene, [tuple(one) for one in question.changes], question.needs_comparison)
    if question.quantities["continuum"]:
        importlib.import_module("diptych._continuum").require_continuum(scene)  # loads deal.II only now
    directory = output or f"results/{scene.name}_plan"
    inputs = [*scene.input_files(), ("the scene", question.scene), *(("--set-file", file) for file in set_files)]
    with Folder(directory) as folder:
        folder.open_runs("plan", question.scene, options, lambda: inputs)
        plan, reached = _carry_out(question, scene, directory, runs_the_plan, options)
    return plan, reached, directory


def main_plan(args: argparse.Namespace, options: Options) -> int:
    """The command `diptych plan SCENE --accuracy A`. args: target, accuracy, for, set, set_file, output and run."""
    question = read_question(args.target, args.accuracy, getattr(args, "for"), args.set, args.set_file)
    try:
        plan, reached, directory = run_plan(question, args.output, args.run, options, args.set_file)
    except Stopped as stopped:
        raise Stopped(f"{stopped}; to go on: diptych plan {args.target} --output {args.output} --resume (with the same "
                      "options)") from None
    print(f"{text_of(plan)}\n{directory}/planned.prm, plan.json", flush=True)
    if not reached:
        complain(f"diptych: the accuracy of {percent(question.accuracy)} is not reached")
    return DONE if reached else NOT_CONVERGED
