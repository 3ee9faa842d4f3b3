# diptych: errors of the points of a study against their references, classes, orders, costs
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Evaluates the results of a study. Records are dicts with the keys of study.json and study_cost.json."""

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ...entries import describe
from .levels import Limit
from .points import Point, RunResult
from ..runs.statistics import Interval, jackknife_convergence, known, line_statistics, paired, statistics
from .study_file import Study
from ..runs.engine import WRONG_INPUT

CLASSES = ("right", "wrong, warned", "silently wrong", "struggled", "stopped", "refused", "unjudged", "not run")
Results = Sequence[Sequence[RunResult]]  # [point][sample]

describe("study_cost.json", """\
format: version of this file's format
phases (list): phases that count
disturbed: runs during which the machine was busy with other work
runs: runs that ended
total_cpu_s [s]: CPU time of all phases of all runs
points/: finished points
    point: index of the point in study.json
    cpu_s [s]: CPU time of the phases that count, mean over the samples
    peak_memory_mb [MB]: peak memory of the worst run
    disturbed: runs during which the machine was busy with other work
    front_of (list): quantities for which no point is both cheaper and closer to the reference
    phases/: phases of a run
        name (text): name of the phase
        cpu_s [s]: CPU time, mean over the samples
cheapest/: cheapest point within each accuracy
    quantity (text): quantity within the accuracy; empty: all with a limit
    accuracy [as errors]: required accuracy; for all quantities: a multiple of their limits
    reference: reference of the points that compete: index in study.json
    point: cheapest point within the accuracy: index in study.json; -1: none
    cpu_s [s]: CPU time of this point
    certain (yes or no): true if the 95 % intervals of the errors are within the accuracy, too
""")


def is_finished(runs: Sequence[RunResult]) -> bool:
    """True if every sample of a point ended with exit code 0."""
    return all(run.known and run.exit_code == 0 for run in runs)


def _verdict(limit: float, error: Interval, alone: bool) -> str:
    """One sample has no interval, so its error decides. With several samples an unknown interval leaves a doubt."""
    if alone:
        return "within" if abs(error.value) <= limit else "beyond"
    if error.low > -limit and error.high < limit:
        return "within"
    return "beyond" if error.low > limit or error.high < -limit else "cannot tell"


def _quantity_at(quantity: dict[str, Any], reference: list[float], values: list[float], alone: bool) -> dict[str, Any]:
    average = line_statistics if quantity["line"] else statistics
    kind = "relative" if quantity["relative"] else "line" if quantity["line"] else "absolute"
    found, of_reference, here = paired(reference, values, kind), average(reference), average(values)
    scatter = of_reference.deviation / abs(of_reference.mean) if quantity["relative"] else of_reference.deviation
    verdict = ""
    # if only the reference has a value, the point is beyond any limit
    if quantity["limit"] is not None and found.n == 0:
        verdict = "beyond" if len(known(reference)) else "cannot tell"
    elif quantity["limit"] is not None:
        verdict = _verdict(quantity["limit"], found.difference, alone)
    return {"values": values, "mean": here.mean, "deviation": here.deviation, "pairs": found.n,
            "error": found.difference, "scatter": scatter, "verdict": verdict}


def _classify(study: Study, runs: Sequence[RunResult], point: dict[str, Any]) -> tuple[str, bool]:
    """The class of a point, and whether the intervals confirm it."""
    if not all(run.known for run in runs):
        return "not run", True
    if any(run.exit_code == WRONG_INPUT for run in runs):
        return "refused", True
    if any(run.exit_code for run in runs):
        return "stopped", True
    judged = [(q, one) for q, one in zip(study.quantities, point["quantities"]) if q["limit"] is not None]
    if not any(one["pairs"] > 0 or one["verdict"] == "beyond" for _, one in judged):
        return "unjudged", False
    beyond = [one["verdict"] == "beyond" for _, one in judged]
    doubtful = [one["verdict"] == "cannot tell" and abs(one["error"].value) > q["limit"] for q, one in judged]
    if any(beyond) or any(doubtful):
        return "wrong, warned" if point["warned"] else "silently wrong", any(beyond)
    certain = all(one["verdict"] == "within" for _, one in judged)
    return "struggled" if point["halved_steps"] or point["cut_backs"] else "right", certain


def evaluate(study: Study, points: Sequence[Point], results: Results,
             limits: Sequence[Sequence[Limit]] | None = None) -> list[dict[str, Any]]:
    """The points as study.json has them: errors are point minus reference, sample by sample. Without a reference:
    means. limits: [point][last quantities], two-level means."""
    records = []
    for point, runs in zip(points, results):
        values = [[run.values[q] for run in runs] for q in range(len(study.quantities))]
        record = {
            "family": "reference" if point.family < 0 else study.families[point.family].name,
            "labels": point.labels, "settings": [one.text() for one in point.settings],
            "folders": [f"runs/{run.name}" for run in point.runs],
            "words": next((run.words for run in runs if run.words), ""), "warned": sum(run.warned for run in runs),
            "halved_steps": max(run.halved_steps for run in runs), "cut_backs": max(run.cut_backs for run in runs)}
        if study.reference is None:
            record["quantities"] = [{"values": here, **(line_statistics if q["line"] else statistics)(here)._asdict()}
                                    for q, here in zip(study.quantities, values)]
            for one, limit in zip(reversed(record["quantities"]), reversed(limits[len(records)]) if limits else ()):
                one |= dict(zip(("mean", "low", "high"), limit.limit))
        else:
            of_reference = [[run.values[q] for run in results[point.reference]] for q in range(len(study.quantities))]
            record["reference"] = point.reference
            record["quantities"] = [_quantity_at(*one, not study.seeds)
                                    for one in zip(study.quantities, of_reference, values)]
            record["class"], record["certain"] = _classify(study, runs, record)
        records.append(record)
    return records


def orders_of(study: Study, points: Sequence[Point], records: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """Orders of convergence along every axis that converges, with all other settings fixed."""
    orders = []
    for f, family in enumerate(study.families):
        for a, axis in enumerate(family.axes):
            lines: dict[tuple[str, ...], list[int]] = {}  # by the labels on the other axes; that of this axis is empty
            for k, point in enumerate(points):
                if axis.converges and family.grid and point.family == f:
                    lines.setdefault((*point.labels[:a], "", *point.labels[a + 1:]), []).append(k)
            for labels in sorted(lines):
                for q, quantity in enumerate(study.quantities):
                    values = {k: np.asarray(records[k]["quantities"][q]["values"]) for k in lines[labels]}
                    complete = [k for k in lines[labels] if np.isfinite(values[k]).all()]
                    h = [axis.points[points[k].places[a]].value for k in complete]
                    found = jackknife_convergence(h, np.array([values[k] for k in complete])) if complete else None
                    if found:
                        orders.append({"family": family.name, "axis": axis.name, "quantity": quantity["name"],
                                       "labels": list(labels), "points": len(h), "order": found[0], "limit": found[1],
                                       "coefficient": found[2]})
    return orders


def _mean_cost(counts: Callable[[str], bool], runs: Sequence[RunResult], point: int) -> dict[str, Any]:
    phases: dict[str, float] = {}
    for run in runs:
        for phase in run.phases:
            phases[phase["name"]] = phases.get(phase["name"], 0.0) + phase["cpu_s"] / len(runs)
    return {"point": point, "cpu_s": sum(cpu for name, cpu in phases.items() if counts(name)),
            "peak_memory_mb": max((phase["peak_memory_mb"] for run in runs for phase in run.phases), default=0.0),
            "disturbed": sum(run.disturbed for run in runs), "front_of": [],
            "phases": [{"name": name, "cpu_s": cpu} for name, cpu in phases.items()]}


def _mark_fronts(study: Study, records: Sequence[dict[str, Any]], rivals: list[dict[str, Any]]) -> None:
    """Names the quantities for which no rival is both cheaper and closer to the reference."""
    for q, quantity in enumerate(study.quantities):
        errors = [abs(records[one["point"]]["quantities"][q]["error"].value) for one in rivals]
        for one, error in zip(rivals, errors):
            if math.isfinite(error) and not any(other["cpu_s"] < one["cpu_s"] and less < error
                                                for other, less in zip(rivals, errors)):
                one["front_of"].append(quantity["name"])


def _cheapest(study: Study, records: Sequence[dict[str, Any]], rivals: list[dict[str, Any]],
              reference: int) -> list[dict[str, Any]]:
    """The cheapest rival within each accuracy: 5, 2 and 1 % for relative errors; 2.5, 1 and 0.5 times the limit for
    absolute errors and for all quantities together. Without any limit there is none."""
    def found(name: str, accuracy: float, wanted: list[tuple[int, float]]) -> dict[str, Any]:
        fit = []
        for one in rivals:
            errors = [(records[one["point"]]["quantities"][q]["error"], most) for q, most in wanted]
            if all(abs(e.value) <= most for e, most in errors):
                certain = all(abs(end) <= most for e, most in errors for end in (e[1:] if study.seeds else e[:1]))
                fit.append({"point": one["point"], "cpu_s": one["cpu_s"], "certain": certain})
        best = min(fit, key=lambda one: one["cpu_s"], default={"point": -1, "cpu_s": math.nan, "certain": False})
        return {"quantity": name, "accuracy": accuracy, "reference": reference, **best}

    judged = [(q, quantity) for q, quantity in enumerate(study.quantities) if quantity["limit"] is not None]
    multiples, result = (2.5, 1.0, 0.5), []
    for q, quantity in judged:
        for accuracy in (0.05, 0.02, 0.01) if quantity["relative"] else [m * quantity["limit"] for m in multiples]:
            result.append(found(quantity["name"], accuracy, [(q, accuracy)]))
    for multiple in multiples if judged else ():
        result.append(found("", multiple, [(q, multiple * quantity["limit"]) for q, quantity in judged]))
    return result


def cost_of(study: Study, points: Sequence[Point], results: Results, records: Sequence[dict[str, Any]],
            more: dict[str, RunResult]) -> dict[str, Any]:
    """study_cost.json: CPU times of finished points, Pareto fronts and cheapest points. References do not compete.
    more: runs by name that count only in the total."""
    counts: Callable[[str], bool] = lambda name: name in study.cost if study.cost else name != "report"
    pairs = [(run.name, result) for point, row in zip(points, results) for run, result in zip(point.runs, row)]
    ended = list(({name: result for name, result in reversed(pairs)} | more).values())  # points may share runs
    everything = [phase for result in ended for phase in result.phases]
    costs = [_mean_cost(counts, results[k], k) for k in range(len(points)) if is_finished(results[k])]
    cheapest = []
    for reference in range(len(points)):
        # A point that is its own reference has no error and must not compete.
        own = records[reference]["folders"]
        rivals = [one for one in costs if points[one["point"]].family >= 0
                  and points[one["point"]].reference == reference and records[one["point"]]["folders"] != own]
        if rivals:
            _mark_fronts(study, records, rivals)
            cheapest += _cheapest(study, records, rivals, reference)
    return {"format": 1, "phases": sorted({phase["name"] for phase in everything if counts(phase["name"])}),
            "disturbed": sum(result.disturbed for result in ended),
            "runs": sum(result.known and bool(result.phases) for result in ended),
            "total_cpu_s": math.fsum(phase["cpu_s"] for phase in everything), "points": costs, "cheapest": cheapest}
