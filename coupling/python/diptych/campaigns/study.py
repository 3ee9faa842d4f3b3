# diptych: the command study: many points of a scene, each on every sample
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the points of a study, evaluates them and writes study.json, study.csv, study_cost.json, study.h5 and report.html."""

from __future__ import annotations

import csv
import io
import math
import os
from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy as np

from .. import _diptych
from .engine import DONE, NOT_CONVERGED, Options, Outcome, complain, say
from .evaluation import CLASSES, UNFINISHED, Results, cost_of, evaluate, orders_of
from .folders import Folder, Runs, draw, write_arrays, write_json, write_text
from .histories import resampled, running_mean
from .input_file import Setting
from .points import Point, RunResult, points_of, result_of
from .statistics import line_turn, student_quantile
from .study_file import COMMANDS, Study, read_study

_RUN_COLUMNS = ("point", "family", "settings", "sample", "class", "exit_code", "halved_steps", "cut_backs", "sweeps",
                "newton_iterations", "peak_memory_mb", "folder")
_CURVES = (("stress_ratio", "stress ratio t/s", "running mean, averaged over the samples, one row per point; nan if a sample "
            "has no value"),
           ("volumetric_strain", "volumetric strain", "running mean, averaged over the samples, one row per point; dilation "
            "negative; nan beyond the end of a history"))


def study_record(study: Study, points: Sequence[Point], records: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """study.json. It does not depend on when, where or in which order the points ran."""
    n = len(study.seeds)
    return {
        "format": 1, "title": study.title, "name": study.name, "scene": os.path.basename(study.scene), "command": study.command,
        "revision": _diptych.git_revision, "settings": [setting.text() for setting in study.settings], "seeds": study.seeds,
        "student_t_95": student_quantile(0.975, n - 1) if n > 1 else math.nan,
        "quantities": [{key: value for key, value in q.items() if key != "line"} for q in study.quantities],
        "families": [{"name": family.name, "grid": family.grid, "axes": [
            {"name": axis.name, "converges": axis.converges, "own_reference": axis.own_reference,
             "points": [{"label": point.label, "value": point.value} for point in axis.points]} for axis in family.axes]}
                     for family in study.families],
        "borders": study.borders, "points": records, "orders": orders_of(study, points, records)}


def _difference(quantity: dict[str, Any], value: float, reference: float) -> float:
    if quantity["relative"]:
        return value / reference - 1 if reference else math.nan
    return float(line_turn(value, reference)) if quantity["line"] else value - reference


def study_csv(study: Study, points: Sequence[Point], results: Results, records: Sequence[dict[str, Any]]) -> str:
    """One line per point and sample."""
    phases = sorted({phase["name"] for runs in results for run in runs for phase in run.phases})
    out = io.StringIO()
    table = csv.writer(out, lineterminator="\n")
    names = [name for q in study.quantities for name in (q["name"], "error of " + q["name"])]
    table.writerow([*_RUN_COLUMNS, *names, *(f"cpu_s of {name}" for name in phases)])
    for k, (point, record) in enumerate(zip(points, records)):
        for sample, run in enumerate(results[k]):
            reference = results[point.reference][sample].values
            cpu = {phase["name"]: phase["cpu_s"] for phase in run.phases}
            memory = max((phase["peak_memory_mb"] for phase in run.phases), default=math.nan)
            row = [k, record["family"], "; ".join(point.settings), study.seeds[sample] if study.seeds else "", record["class"],
                   run.exit_code if run.known else "", run.halved_steps, run.cut_backs, run.sweeps, run.newton_iterations,
                   memory, record["folders"][sample]]
            for quantity, value, of_reference in zip(study.quantities, run.values, reference):
                row += [value, _difference(quantity, value, of_reference)]
            row += [cpu.get(name, "") for name in phases]
            table.writerow(["" if isinstance(cell, float) and not math.isfinite(cell) else cell for cell in row])
    return out.getvalue()


def _mean_curve(runs: Sequence[RunResult], source: str, name: str, grid: np.ndarray, width: float) -> np.ndarray:
    tables = [run.tables.get(source) if run.known and run.exit_code == 0 else None for run in runs]
    curves = [np.full(len(grid), np.nan) if table is None else resampled(table, running_mean(table, name, width), grid)
              for table in tables]
    return sum(curve / len(curves) for curve in curves)


def write_curves(directory: str, study: Study, points: Sequence[Point], results: Results) -> None:
    """study.h5 with a group for each panel that ran."""
    arrays, attributes = {}, {}
    width = points[0].runs[0].scene.averaging_width()
    for source in COMMANDS[study.command]:
        ends = [run.tables[source]["progress"].iloc[-1] for runs in results for run in runs
                if run.known and run.exit_code == 0 and run.tables.get(source) is not None]
        grid = max(ends, default=0.0) * np.arange(201) / 200
        arrays[source + "/progress"] = (grid, "progress", "strain or time", "points of the curves")
        attributes[source] = {"averaging_width": width}
        for name, title, meaning in _CURVES:
            curves = [_mean_curve(runs, source, name, grid, width) for runs in results]
            arrays[f"{source}/{name}"] = (np.array(curves), title, "-", meaning)
    write_arrays(os.path.join(directory, "study.h5"), arrays, attributes)


def _warn_of_missing(study: Study, reference: dict[str, Any]) -> None:
    for quantity, found in zip(study.quantities, reference["quantities"]):
        if reference["class"] not in UNFINISHED and not np.isfinite(found["values"]).any():
            complain(f"diptych: warning: the reference has no value of '{quantity['name']}': a window beyond the end of the "
                     "loading, or a number that no comparison has")


def _summary(points: Sequence[Point], records: Sequence[dict[str, Any]]) -> str:
    """ "12 points: 7 right, 3 silently wrong, 2 stopped" """
    counts = Counter(record["class"] for point, record in zip(points, records) if point.family >= 0)
    return f"{sum(counts.values())} points: " + ", ".join(f"{counts[name]} {name}" for name in CLASSES if counts[name])


def _conclude(study: Study, records: Sequence[dict[str, Any]], outcomes: Sequence[Outcome], directory: str) -> int:
    left = sum(outcome.interrupted for outcome in outcomes)
    lost = sum(record["class"] == "not run" for record in records)
    if not left and not lost:
        return DONE
    why = f"stopped on request; {left} runs are left" if left else f"{lost} points have runs that the system ended"
    complain(f"{why}, the rest is kept in {directory}; to go on: diptych study {study.file} --output {directory} --resume "
             "(with the same --set)")
    return NOT_CONVERGED


def run_study(file: str, output: str, settings: Sequence[Setting], options: Options, set_files: Sequence[str] = ()) -> int:
    """diptych study FILE. Returns the exit code."""
    study = read_study(file, settings)
    points = points_of(study)
    directory = output or f"results/{study.name}_study"

    def inputs() -> list[tuple[str, str]]:
        scenes = [run.scene for point in points for run in point.runs if run.scene is not None]
        return [("the study", file), ("the scene", study.scene), *(("--set-file", name) for name in set_files),
                *{pair for scene in scenes for pair in scene.input_files()}]

    with Folder(directory) as folder:
        folder.open_runs("study", file, options, inputs)
        runs = Runs(directory)
        outcomes = runs.do([run for point in points for run in point.runs], options)
        results = _results(runs, points, study.quantities)
        records = evaluate(study, points, results)
        write_json(os.path.join(directory, "study.json"), study_record(study, points, records))
        write_text(os.path.join(directory, "study.csv"), study_csv(study, points, results, records))
        write_json(os.path.join(directory, "study_cost.json"), cost_of(study, points, results, records))
        write_curves(directory, study, points, results)
        if not _diptych.stop_requested():
            draw(options, "study", directory)
        _warn_of_missing(study, records[0])
        say(options, f"{_summary(points, records)}; tables: {directory}/study.json, study.csv")
        return _conclude(study, records, outcomes, directory)


def _results(runs: Runs, points: Sequence[Point], quantities: Sequence[dict[str, Any]]) -> Results:
    """Each different run is read once."""
    read: dict[str, RunResult] = {}
    for point in points:
        for run in point.runs:
            if run.name not in read:
                read[run.name] = result_of(runs, run, quantities)
    return [[read[run.name] for run in point.runs] for point in points]
