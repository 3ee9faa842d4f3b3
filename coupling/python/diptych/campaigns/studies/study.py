# diptych: the command study: many points of a scene, each on every sample
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the points of a study, evaluates them and writes study.json, study.csv, study_cost.json, study.h5 and
report.html.

A study without a reference also writes effects.csv, one with ranges sensitivity.csv.
"""

from __future__ import annotations

import argparse
import math
import os
from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd

from ... import _diptych
from ...errors import NotConverged, Stopped
from ..runs.engine import Options, complain, say
from .effects import changes_of, effects_table, text_of_changes, text_of_means, text_of_quantity
from .evaluation import CLASSES, Results, cost_of, evaluate, orders_of
from ..runs.folders import Folder, Runs, draw, write_arrays, write_json, write_text
from ..runs.histories import resampled, running_mean
from .level_runs import demand_rule, study_levels
from .points import Point, points_of, result_of
from .sensitivity import need_openturns, sensitivity_of, sensitivity_table, text_of_indices, warnings_of
from ..runs.statistics import line_turn, student_quantile
from .study_file import COMMANDS, Study
from .study_words import levels_of_words, study_of_words

_CURVES = (("stress_ratio", "stress ratio t/s", "running mean, averaged over the samples, one row per point; nan if a "
            "sample has no value"),
           ("volumetric_strain", "volumetric strain", "running mean, averaged over the samples, one row per point; "
            "dilation negative; nan beyond the end of a history"))


def study_record(study: Study, points: Sequence[Point], records: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """study.json. It does not depend on when, where or in which order the points ran."""
    n = len(study.seeds)
    return {
        "format": 1, "title": study.title, "name": study.name, "scene": os.path.basename(study.scene),
        "command": study.command,
        "revision": _diptych.git_revision, "settings": [setting.text() for setting in study.settings],
        "seeds": study.seeds, "student_t_95": student_quantile(0.975, n - 1) if n > 1 else math.nan,
        "quantities": [{key: value for key, value in q.items() if key != "line"} for q in study.quantities],
        "families": [{"name": family.name, "grid": family.grid, "axes": [
            {"name": axis.name, "converges": axis.converges, "own_reference": axis.own_reference,
             "points": [{"label": point.label, "value": point.value} for point in axis.points]}
            for axis in family.axes]}
                     for family in study.families],
        "borders": study.borders, "points": records, "orders": orders_of(study, points, records),
        "changes": changes_of(study, points, records) if study.reference is None and not study.ranges else []}


def _difference(quantity: dict[str, Any], value: float, reference: float) -> float:
    if quantity["relative"]:
        return value / reference - 1 if reference else math.nan
    return float(line_turn(value, reference)) if quantity["line"] else value - reference


def study_csv(study: Study, points: Sequence[Point], results: Results, records: Sequence[dict[str, Any]]) -> str:
    """One line per point and sample."""
    phases = sorted({phase["name"] for runs in results for run in runs for phase in run.phases})
    rows = []
    for k, (point, record) in enumerate(zip(points, records)):
        for sample, run in enumerate(results[k]):
            row = {"point": k, "family": record["family"], "settings": "; ".join(point.settings),
                   "sample": study.seeds[sample] if study.seeds else "", "class": record.get("class"),
                   "exit_code": run.exit_code if run.known else "", "halved_steps": run.halved_steps,
                   "cut_backs": run.cut_backs, "sweeps": run.sweeps, "newton_iterations": run.newton_iterations,
                   "peak_memory_mb": max((phase["peak_memory_mb"] for phase in run.phases), default=math.nan),
                   "folder": record["folders"][sample]}
            if study.reference is None:
                del row["class"]
                row |= {p.key: setting.partition(" = ")[2] for p, setting in zip(study.ranges, point.settings)}
                row |= dict(zip(map(text_of_quantity, study.quantities), run.values))
            else:
                for quantity, value, reference in zip(study.quantities, run.values,
                                                      results[point.reference][sample].values):
                    row |= {quantity["name"]: value, "error of "
                            + quantity["name"]: _difference(quantity, value, reference)}
            cpu_s = {phase["name"]: phase["cpu_s"] for phase in run.phases}
            rows.append({**row, **{f"cpu_s of {name}": cpu_s.get(name) for name in phases}})
    return pd.DataFrame(rows).to_csv(index=False, lineterminator="\n")


def write_curves(directory: str, study: Study, points: Sequence[Point], results: Results) -> None:
    """study.h5 with a group for each panel that ran."""
    arrays, attributes = {}, {}
    width = next(run.scene for point in points for run in point.runs if run.scene is not None).averaging_width()
    for source in COMMANDS[study.command]:
        tables = [[run.tables.get(source) if run.known and run.exit_code == 0 else None for run in runs]
                  for runs in results]
        last = max((table["progress"].iloc[-1] for of_point in tables for table in of_point if table is not None),
                   default=0.0)
        grid = last * np.arange(201) / 200
        arrays[source + "/progress"] = (grid, "progress", "strain or time", "points of the curves")
        attributes[source] = {"averaging_width": width}
        for name, title, meaning in _CURVES:
            curves = [[np.full(len(grid), np.nan) if table is None
                       else resampled(table, running_mean(table, name, width), grid)
                       for table in of_point] for of_point in tables]
            arrays[f"{source}/{name}"] = (np.mean(curves, axis=1), title, "-", meaning)
    write_arrays(os.path.join(directory, "study.h5"), arrays, attributes)


def _write(directory: str, study: Study, points: Sequence[Point], results: Results, record: dict[str, Any]) -> None:
    records = record["points"]
    write_json(os.path.join(directory, "study.json"), record)
    write_text(os.path.join(directory, "study.csv"), study_csv(study, points, results, records))
    if study.reference is None:
        name, table = (("sensitivity", sensitivity_table(record["sensitivity"])) if study.ranges
                       else ("effects", effects_table(study, points, records)))
        write_text(os.path.join(directory, name + ".csv"), table.to_csv(index=False, lineterminator="\n"))
    write_curves(directory, study, points, results)


def _conclude(study: Study, points: Sequence[Point], record: dict[str, Any], options: Options) -> str:
    """Prints what the study found, and warnings. Returns "7 points: 5 right, 2 stopped"."""
    n, records = sum(point.family >= 0 for point in points), record["points"]
    if study.reference is None:
        for one in records:
            if one["words"]:
                complain(f"diptych: warning: {', '.join(one['labels'])}: {one['words']}")
        for line in warnings_of(record["sensitivity"]) if study.ranges else []:
            complain(f"diptych: warning: {line}")
        for line in (text_of_indices(study, record["sensitivity"]) if study.ranges else
                     [text_of_means(study, points, records), *text_of_changes(study, record["changes"])]):
            say(options, line)
        return f"{n} points"
    for quantity, found in zip(study.quantities, records[0]["quantities"]):
        if records[0]["class"] not in ("not run", "refused", "stopped") and not np.isfinite(found["values"]).any():
            complain(f"diptych: warning: the reference has no value of '{quantity['name']}': a window beyond the end "
                     "of the loading, or a number that no comparison has")
    counts = Counter(one["class"] for point, one in zip(points, records) if point.family >= 0)
    if all(q["limit"] is None for q in study.quantities):  # nothing was asked to be right
        counts["unjudged"] = 0
    return ": ".join([f"{n} points", *filter(None,
                                             [", ".join(f"{counts[name]} {name}" for name in CLASSES
                                                        if counts[name])])])


def run_study(line: argparse.Namespace, options: Options) -> None:
    """diptych study FILE. line: target, output, set, set_file, vary, seeds, panels, levels. Raises NotConverged if runs
    are missing, or Stopped."""
    study, text = study_of_words(line)
    levels = levels_of_words(line, study)
    if study.ranges:
        need_openturns()  # before the runs
    points = points_of(study)
    for run in [run for point in points for run in point.runs] if levels else ():
        if run.scene is not None:
            demand_rule(run.scene, levels)
    directory = line.output or f"results/{study.name}_study"

    def inputs() -> list[tuple[str, str]]:
        scenes = [run.scene for point in points for run in point.runs if run.scene is not None]
        return [("the study", line.target), ("the scene", study.scene),
                *(("--set-file", name) for name in line.set_file),
                *{pair for scene in scenes for pair in scene.input_files()}]

    with Folder(directory) as folder:
        folder.open_runs("study", line.target, options, inputs, text)
        runs = Runs(directory)
        outcomes = runs.do([run for point in points for run in point.runs], options)
        read = {run.name: result_of(runs, run, study.quantities)  # each different run once
                for run in {run.name: run for point in points for run in point.runs}.values()}
        results = [[read[run.name] for run in point.runs] for point in points]
        left, limits, pairs = sum(outcome.interrupted for outcome in outcomes), None, {}
        if levels and not left:
            results, limits, pairs = study_levels(study, results, levels, runs, options)
        record = study_record(study, points, evaluate(study, points, results, limits))
        if limits:
            record["levels"] = {**levels._asdict(), "pairs": max(one.pairs for of_point in limits for one in of_point)}
        if study.ranges:
            record["sensitivity"] = sensitivity_of(study, results, record["points"])
        _write(directory, study, points, results, record)
        write_json(os.path.join(directory, "study_cost.json"), cost_of(study, points, results, record["points"], pairs))
        if not left:
            draw(options, directory, "study")
        say(options, f"{_conclude(study, points, record, options)}; tables: {directory}/study.json, study.csv"
            + (", sensitivity.csv" if study.ranges else ", effects.csv" if study.reference is None else ""))
        lost = sum(not all(run.known for run in of_point) for of_point in results)
    if all(run.exit_code for run in read.values()):
        raise NotConverged(f"every run failed, the first with: {next(iter(read.values())).words}")
    if left or lost:
        why = f"stopped on request; {left} runs are left" if left else f"{lost} points have runs that the system ended"
        raise (Stopped if left else NotConverged)(f"{why}, the rest is kept in {directory}; to go on: {options.again}")
