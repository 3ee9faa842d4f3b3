# diptych: the command study: many points of a scene, each on every sample
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the points of a study, evaluates them, writes study.json, .csv, .h5, study_cost.json and report.html.

A study without a reference also writes effects.csv, one with ranges sensitivity.csv.
"""

import argparse
import math
import os
from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd

from ... import _diptych
from ...entries import describe
from ...errors import NotConverged, SceneError, Stopped
from ...files import read_json
from ..runs.engine import Options, complain, say
from .effects import changes_of, effects_table, text_of_changes, text_of_means, text_of_quantity
from .evaluation import CLASSES, Results, cost_of, evaluate, orders_of
from ..runs.folders import Folder, draw, write_arrays, write_json, write_text
from ..runs.histories import curve_of
from .level_runs import demand_rule, study_levels
from .points import Point, points_of, result_of
from .sensitivity import need_openturns, sensitivity_of, sensitivity_table, text_of_indices, warnings_of
from ..runs.statistics import line_turn, student_quantile
from .study_file import COMMANDS, Study
from .study_words import levels_of_words, study_of_words

MOST_LABELS = 6  # in the text that says where a law was fitted
_CURVES = (("stress_ratio", "stress ratio t/s", "running mean, averaged over the samples, one row per point; nan if a "
            "sample has no value"),
           ("volumetric_strain", "volumetric strain", "running mean, averaged over the samples, one row per point; "
            "dilation negative; nan beyond the end of a history"))

describe("study.json", """\
format: version of this file's format
title (text): title of the study
name (text): name of the study
scene (text): file name of the scene
command (text): command that every point runs
revision (text): revision of the program's source
settings (list): settings of all points
seeds (list): seeds of the samples; empty: the one sample of the scene
student_t_95: half width of the intervals in standard errors; null for less than two samples
levels/: with --levels only: the two settings of the quantities in the limit of short steps, and their pairs
    cheap: discrete/accuracy of all samples
    fine: discrete/accuracy of the pairs, the first samples of every point
    pairs: number of pairs of a point
quantities/: measured quantities
    name (text): name of the quantity
    key (text): key of a key number; empty: another quantity
    unit (text): unit of its values
    source (text): panel or comparison that it is read from; difference: continuum minus grains
    reduction (text): way to reduce a column to one number
    column (text): column of the panel's table, or name of the comparison's number
    from [strain or time]: start of the range, or the progress
    to [strain or time]: end of the range, or its width
    relative (yes or no): true if errors are relative to the reference's mean
    limit [as errors]: largest error that counts as right; null: no limit
families/: families of points
    name (text): name of the family
    grid (yes or no): true: all combinations of the axes; false: the k-th points of all axes together
    axes/: axes of the family
        name (text): name of the axis
        converges (yes or no): true if results have a limit as the values go to 0
        own_reference (yes or no): true if each point is compared with the reference at that point
        points/: points of the axis
            label (text): label of the point
            value: value of its key, if it is a number
borders/: borders beyond which a method fails by theory
    label (text): label of the border
    family (text): family that it belongs to
    x (text): axis x
    y (text): axis y: y = coefficient x^exponent
    coefficient: coefficient of the border
    exponent: exponent of the border
origins/: origins of the law's parameters; empty if only grains ran
    parameters_from (text): origin; empty: the scene sets the law and says nothing
    where (text): points that have it; empty: all
points/: all points, references first
    family (text): family of the point; references have none
    reference: index in this list of its reference point; missing if the study has no reference, like class, certain, \
        and pairs, error, scatter, verdict of the quantities
    labels (list): labels of its places on the axes; references add the name of the axis
    settings (list): settings beyond those of all points
    folders (list): folders of its runs, one per sample
    class (text): class: right; wrong, warned; silently wrong; struggled; stopped; refused; unjudged; not run
    certain (yes or no): true if the intervals confirm the class
    words (text): message of the first run that did not finish
    warned: runs in which a panel warned
    halved_steps: steps halved because the sweeps stalled, in the worst run
    cut_backs: load steps that were halved, in the worst run
    quantities/: in the order of the study's quantities
        values (list) [as the quantity says]: values of the samples; null if a sample has none
        mean [as the quantity says]: mean over the samples
        deviation [as the quantity says]: standard deviation of one sample
        n: samples with a value; without a reference only
        low [as the quantity says]: lower end of the 95 % interval of the mean (Student); without a reference only
        high [as the quantity says]: upper end of the 95 % interval of the mean; without a reference only
        pairs: samples with a value here and in the reference
        error (interval) [as the quantity says]: point minus reference, sample by sample, with its 95 % interval \
            (Student; relative errors: Fieller)
        scatter [as errors]: standard deviation of one sample about the reference's mean
        verdict (text): within, beyond or cannot tell
orders/: orders of convergence
    family (text): family of the line
    axis (text): axis along which the line runs
    quantity (text): fitted quantity
    labels (list): labels of the points on the other axes
    points: number of points on the line
    order (interval): p of value = limit + coefficient h^p, with the interval of a jackknife over the samples
    limit (interval) [as the quantity says]: limit as h goes to 0
    coefficient: coefficient of the fit
changes/: changes along every parameter; empty if the study has a reference
    family (text): family of the points
    parameter (text): name of the axis; axes that move together are one parameter; other parameters are averaged over
    quantity (text): name of the quantity
    panel (text): grains, continuum, difference (continuum minus grains), material point or comparison
    unit (text): unit of the quantity
    samples: samples with a value at every point; the others do not count here
    smallest [as unit says]: smallest mean of a point
    smallest_at (text): label of this point
    largest [as unit says]: largest mean of a point
    largest_at (text): label of this point
    change (interval) [as unit says]: largest minus smallest mean; the interval covers the differences of all pairs of \
        points (Tukey)
    verdict (text): resolved: the interval excludes 0; not resolved; no change: all means are equal; unknown: fewer \
        than two samples
    samples_needed: if it is not resolved: samples whose interval would be narrower than this change; null: more than \
        1000
sensitivity/: Sobol indices; only if the study has ranges
    points: number of points
    parameters/: keys that vary, with their ranges
        key (text): section/key
        coordinate (text): number that is uniform between low and high: value, logarithm, share_of (key / of) or \
            drop_from (1 - key / of)
        of (text): key that a share or drop refers to; empty: none
        low [as the key says]: lower end of the range; of a share or drop: a ratio
        high [as the key says]: upper end of the range
    indices/: in the order of the study's quantities
        quantity (text): name of the quantity
        panel (text): grains, continuum, difference (continuum minus grains), material point or comparison
        unit (text): unit of the quantity
        used: points with a value, to which the polynomials are fitted
        failed: points with a run that ended with an exit code other than 0
        without_value: other points without a value: without a band, or not run
        q2: share of the variance that the polynomials predict at points that their fit has not seen; below 0.9 the \
            indices say little
        degree: degree of the polynomials; 0: none were fitted
        mean [as unit says]: mean over the used points
        deviation [as unit says]: standard deviation over the used points
        parameters/: in the order of the ranges; empty if no polynomials were fitted
            parameter (text): key of the parameter
            first (interval): first Sobol index: share of the variance that the parameter causes alone
            total (interval): total Sobol index: share that it causes alone and together with others
            correlation: rank correlation (Spearman) of parameter and quantity; positive: the quantity grows with it
""")

describe("study.csv", """\
point: index of the point in study.json
family: family of the point
settings: settings beyond those of all points, separated by ;
sample: seed of the sample; empty: the one sample of the scene
class: class of the point, from all its samples; missing without a reference
exit_code: exit code of this run; empty: not run
halved_steps: halved steps of the grains
cut_backs: halved load steps of the continuum
sweeps: sweeps of the contact solver
newton_iterations: Newton iterations of the continuum
peak_memory_mb [MB]: peak memory of the run
folder: result folder of the run; then for each range its key, for each quantity its value and its error against the \
    reference (relative [-] unless the limit is absolute), and for each phase its CPU time [s]
""", "column")

_H5 = "study.h5, groups discrete, continuum and material_point"
describe(_H5, "progress (numbers) [strain or time]: progress; points of the curves")
describe(_H5, "averaging_width (attribute, number) [strain or time]: width of the running means")
for _name, _title, _meaning in _CURVES:
    describe(_H5, f"{_name} (rows of numbers): {_title}; {_meaning}")


def _origins(study: Study, points: Sequence[Point]) -> list[dict[str, str]]:
    """Where the parameters of the law come from, and at which points."""
    found: dict[str, list[str]] = {}
    for point in points if study.command != "discrete" else ():
        if point.family >= 0 and point.runs[0].scene is not None:
            names = (f"{axis.name} {label}" for axis, label in zip(study.families[point.family].axes, point.labels))
            origin = point.runs[0].scene.dict()["comparison"]["parameters_from"]
            found.setdefault(origin, []).append(", ".join(names))
    return [{"parameters_from": origin, "where": "" if len(found) == 1 else
             "; ".join(labels) if len(labels) <= MOST_LABELS else f"{len(labels)} of {len(points)} points"}
            for origin, labels in found.items()]


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
        "borders": study.borders, "origins": _origins(study, points), "points": records,
        "orders": orders_of(study, points, records),
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
            row = {"point": k, "family": record["family"], "settings": "; ".join(record["settings"]),
                   "sample": study.seeds[sample] if study.seeds else "", "class": record.get("class"),
                   "exit_code": run.exit_code if run.known else "", "halved_steps": run.halved_steps,
                   "cut_backs": run.cut_backs, "sweeps": run.sweeps, "newton_iterations": run.newton_iterations,
                   "peak_memory_mb": max((phase["peak_memory_mb"] for phase in run.phases), default=math.nan),
                   "folder": record["folders"][sample]}
            if study.reference is None:
                del row["class"]
                row |= {f"{one.section}/{one.key}": one.value for one in point.settings if study.ranges}
                row |= dict(zip(map(text_of_quantity, study.quantities), run.values))
            else:
                references = results[point.reference][sample].values
                for quantity, value, reference in zip(study.quantities, run.values, references):
                    name = quantity["name"]
                    row |= {name: value, "error of " + name: _difference(quantity, value, reference)}
            cpu_s = {phase["name"]: phase["cpu_s"] for phase in run.phases}
            rows.append({**row, **{f"cpu_s of {name}": cpu_s.get(name) for name in phases}})
    return pd.DataFrame(rows).to_csv(index=False)


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
            curves = [[np.full(len(grid), np.nan) if table is None else curve_of(table, name, width, grid)
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
        write_text(os.path.join(directory, name + ".csv"), table.to_csv(index=False))
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
    found = ", ".join(f"{counts[name]} {name}" for name in CLASSES if counts[name])
    return f"{n} points: {found}" if found else f"{n} points"


def _demand_same_name(directory: str, study: Study, options: Options) -> None:
    """Points and quantities may change between attempts. Raises SceneError for another study, whose tables are
    there."""
    file = os.path.join(directory, "study.json")
    there = read_json(file)["name"] if options.resume and os.path.exists(file) else study.name
    if there != study.name:
        raise SceneError(f"--resume: {file} is of the study '{there}', not '{study.name}'. Give --output with another "
                         "folder, or --overwrite.")


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
        _demand_same_name(directory, study, options)
        runs = folder.open_runs("study", line.target, options, inputs, text)
        outcomes = runs.do([run for point in points for run in point.runs], options)
        read = {run.name: result_of(runs, run, study.quantities)  # each different run once
                for run in {run.name: run for point in points for run in point.runs}.values()}
        results = [[read[run.name] for run in point.runs] for point in points]
        left, limits, pairs = sum(outcome.interrupted for outcome in outcomes.values()), None, {}
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
        conclusion = _conclude(study, points, record, options)
        for one in record["origins"]:
            say(options, (f"{one['where']}: " if one["where"] else "") + _diptych.origin_of_law(one["parameters_from"]))
        say(options, f"{conclusion}; tables: {directory}/study.json, study.csv"
            + (", sensitivity.csv" if study.ranges else ", effects.csv" if study.reference is None else ""))
        lost = sum(not all(run.known for run in of_point) for of_point in results)
    if all(run.exit_code for run in read.values()):
        raise NotConverged(f"every run failed, the first with: {next(iter(read.values())).words}")
    if left:
        raise Stopped(f"stopped on request; {left} runs are left, the rest is kept in {directory}", options.again)
    if lost:
        raise NotConverged(f"{lost} points have runs that the system ended, the rest is kept in {directory}; to go on: "
                           f"{options.again}")
