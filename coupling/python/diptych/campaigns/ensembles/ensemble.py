# diptych: the command run --seeds: the same scene on many samples
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the members of an ensemble and writes ensemble.json, ensemble.csv, ensemble.h5 and report.html."""

from __future__ import annotations

import argparse
import math
import os
import resource
import shlex
from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd

from ... import _diptych
from ...compiled import continuum
from ...errors import NotConverged, SceneError, Stopped
from . import summary as summaries
from . import validation
from ..runs.engine import Options, Run, execute, say
from .profiles import profile_arrays
from ..runs.folders import Folder, Runs, draw, read_json, write_arrays, write_json, write_text
from ..runs.histories import panel_table, resampled, running_mean
from ..runs.input_file import Setting, read_seeds, settings_of
from ..studies.level_runs import (Levels, add_summary, demand_rule, ensemble_levels, ensemble_quantities, fine_runs,
                                  of_members, paired_points,
                         read_levels)
from ..runs.key_numbers import QUANTITIES, summary_of
from ..runs.members import Member, member_of, number_name
from ..runs.statistics import line_statistics, statistics, student_quantile

_PANELS = ("discrete", "continuum")


def member_folder(directory: str, seed: int) -> str:
    """DIR/seed_3, the result folder of a member. Its log is DIR/seed_3.log."""
    return os.path.join(directory, f"seed_{seed}")


def _values(members: Sequence[Member], name: str) -> list[float]:
    return [member.value(name) for member in members]


def evaluate(members: Sequence[Member], margins: dict[str, float],
             responses: validation.Responses = validation.Responses()) -> dict[str, Any]:
    """quantities, bands, verdicts and validation as ensemble.json has them. margins: comparison/margin_* of the
    scene."""
    quantities: dict[str, dict[str, Any]] = {}
    for name, (_, unit, line, _place) in (pair for member in members for pair in member.numbers.items()):
        if name not in quantities:
            values = _values(members, name)
            found = (line_statistics if line else statistics)(values)
            quantities[name] = {"name": name, "unit": unit, **found._asdict(), "values": values}
    bands = [_band_count(name, members) for name in dict.fromkeys(name for member in members for name in member.bands)]
    verdicts, rows = _verdicts(margins, members, quantities, responses)
    return {"quantities": list(quantities.values()), "bands": bands, "verdicts": verdicts, "validation": rows}


def _band_count(name: str, members: Sequence[Member]) -> dict[str, Any]:
    found = [min(member.bands[name], 2) for member in members if name in member.bands]
    none, one, two = (found.count(k) for k in range(3))
    texts = [f"{words} in {n}" for words, n in (("one band", one), ("two bands", two), ("none", none)) if n]
    texts[0] += f" of {len(found)}"
    return {"name": name, "none": none, "one": one, "two": two, "text": ", ".join(texts)}


def _verdicts(margins: dict[str, float], members: Sequence[Member], quantities: dict[str, dict[str, Any]],
              responses: validation.Responses) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
    """Differences continuum minus grains with verdicts, and rows of the validation: of single numbers, and of the bands
    in every window."""
    windows = dict.fromkeys(window for member in members for window in member.windows)
    verdicts, rows = [], []
    for key, window in validation.compared_by(windows):
        kind, margin = QUANTITIES[key]["difference"], margins[QUANTITIES[key]["margin"]]
        name = f"{window} band {key.removeprefix('band_')}" if window else key
        names = [number_name(panel, key, window) for panel in _PANELS]
        units = [quantities[one]["unit"] for one in names if one in quantities]
        unit = units[0] if units else "degrees" if kind == "line" else "-"
        first, second = (_values(members, one) for one in names)
        parts = validation.uncertainties(key, window, members, responses)
        found, row = validation.validated(kind, (first, second), parts, len(responses.draws))
        verdict = found.verdict(margin)
        rows.append({"key": key, "quantity": name, **row, "unit": unit, "verdict": verdict})
        verdicts.append({"key": key, "quantity": name, "unit": "-" if kind == "relative" else unit, "margin": margin,
                         "relative": kind == "relative", "difference": found.difference,
                         "difference_90": found.difference_90,
                         "n": found.n, "verdict": verdict, "discrete": first, "continuum": second})
    return verdicts, rows


def with_means(members: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(mean, low, high) of curves (member, point), with the 95 % Student interval; NaN where a member has no value."""
    n = len(members)
    mean = members.mean(axis=0) if n else np.full(members.shape[1], np.nan)
    half = student_quantile(0.975, n - 1) * members.std(axis=0,
                                                        ddof=1) / math.sqrt(n) if n > 1 else np.full_like(mean, np.nan)
    return mean, mean - half, mean + half


def _write_curves(directory: str, scene: Any, seeds: Sequence[int]) -> None:
    tables = {panel: [panel_table(member_folder(directory, seed), panel) for seed in seeds] for panel in _PANELS}
    last = max((table["progress"].iloc[-1] for panel in _PANELS for table in tables[panel]), default=0.0)
    grid, width = last * np.arange(401) / 400, scene.averaging_width()
    arrays = {"progress": (grid, "progress", "strain or time", "points of the curves"),
              "seeds": (np.array(seeds, np.int32), "seeds", "-", "seeds of the members, one per row")}
    for panel in _PANELS:
        for name in ("stress_ratio", "volumetric_strain"):
            members = np.array([resampled(table, running_mean(table, name, width), grid) for table in tables[panel]])
            mean, low, high = with_means(members.reshape(-1, len(grid)))
            group = f"{panel}/{name}/"
            arrays[group + "members"] = (members, "every member", "-",
                                         "running mean, one row per seed; nan beyond the end of a history")
            arrays[group + "mean"] = (mean, "mean", "-", "mean over all members; nan if a member has no value")
            arrays[group + "low"] = (low, "lower end", "-",
                                     "lower end of the 95 % Student interval of the mean; nan like the mean")
            arrays[group + "high"] = (high, "upper end", "-", "upper end of the same interval; nan like the mean")
    arrays |= profile_arrays([member_folder(directory, seed) for seed in seeds])
    write_arrays(os.path.join(directory, "ensemble.h5"), arrays, {"/": {"averaging_width": width}})


def _record(scene: Any, seeds: Sequence[int], failed: Sequence[dict[str, Any]], interrupted: Sequence[int],
            runs: dict[str, Any]) -> dict[str, Any]:
    """ensemble.json, from the members that finished. runs: those of validation.respond(). Raises ValueError with the
    file of a member that is broken."""
    out = {one["seed"] for one in failed} | set(interrupted)
    done = [seed for seed in seeds if seed not in out]
    margins = {key: value for key, value in scene.dict()["comparison"].items() if key.startswith("margin_")}
    folded, n, members = scene.is_mirror_symmetric(), len(done), []
    for seed in done:
        folder = member_folder(scene.directory, seed)
        for part in ("", "comparison"):
            _diptych.check_part(folder, part)
        _demand_member(scene, seed)
        members.append(member_of(os.path.join(folder, "comparison.json"), folded))
    found = evaluate(members, margins, validation.responses_of(scene, done, members, runs))
    first = summary_of(member_folder(scene.directory, done[0])) if done else {}
    return {"format": 1, "scene": scene.name, "seeds": list(seeds), "done": done, "failed": list(failed),
            "interrupted": list(interrupted), "margins": margins, "walk": scene.loading_variable(), "folded": folded,
            "student_t_95": student_quantile(0.975, n - 1) if n > 1 else math.nan,
            "continuum_runs": runs, "summary": summaries.summary(first, found), **found}


def _write(scene: Any, record: dict[str, Any], options: Options, phase: tuple[str, os.times_result]) -> None:
    """phase: its name and when it began."""
    directory = scene.directory
    _diptych.forget_files(directory, "ensemble")  # killed from here on, it leaves none that look changed
    if os.path.exists(os.path.join(directory, "report.html")):  # of other statistics
        os.remove(os.path.join(directory, "report.html"))
    _write_curves(directory, scene, record["done"])
    write_json(os.path.join(directory, "ensemble.json"), record)
    columns = ["unit", "n", "mean", "deviation", "low", "high"]
    table = pd.DataFrame([[q["name"], *(q[key] for key in columns), *q["values"]] for q in record["quantities"]],
                         columns=["quantity", *columns, *(f"seed_{seed}" for seed in record["done"])])
    write_text(os.path.join(directory, "ensemble.csv"), table.to_csv(index=False, float_format="%.10g",
                                                                     lineterminator="\n"))
    (name, begin), end = phase, os.times()
    cost = (name, end.elapsed - begin.elapsed, sum(end[:4]) - sum(begin[:4]),  # with the CPU time of the workers
            resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)
    _diptych.record_phase(directory, (scene.name, record["seeds"], shlex.join(["diptych", *options.words])), cost)
    _diptych.record_files(directory, "ensemble")
    if record["summary"]:
        say(options, summaries.text_of(record["summary"]))
        say(options, _diptych.origin_of_law(scene.dict()["comparison"]["parameters_from"]))


def _member_scene(scene: Any, seed: int) -> Any:
    return scene.in_folder(member_folder(scene.directory, seed), scene.name, seed)


def _demand_member(scene: Any, seed: int) -> None:
    member = _member_scene(scene, seed)
    sample, _, comparison = _diptych.changes_since(member)
    if sample or comparison:
        raise SceneError(f"the results in '{member.directory}' are not of this ensemble: {sample or comparison}. Move "
                         "them elsewhere, or run the ensemble with --overwrite.")


def _open(folder: Folder, scene: Any, seeds: Sequence[int], options: Options, inputs: list[tuple[str, str]]) -> None:
    """Prepares the folder and writes ensemble.prm. Members that stand there must be of the same scene."""
    file = os.path.join(scene.directory, "ensemble.prm")
    if options.overwrite and not _diptych.is_empty_folder(folder.directory):
        folder.set_aside(inputs)
    elif not _diptych.is_empty_folder(folder.directory):
        earlier = _diptych.resolved_scene(file)
        there, here = earlier.identity("member") if earlier else {}, scene.identity("member")
        differs = next((key for key in here if here[key] != there.get(key)), None)
        if differs:
            why = "another version wrote it"
            if earlier:
                why = f"{differs} = '{here[differs]}' here, '{there.get(differs)}' there"
            raise SceneError(f"--resume: the scene differs from {file}: {why}. Give the same scene, or --overwrite.")
        for seed in seeds:
            if os.path.exists(os.path.join(member_folder(folder.directory, seed), "scene.prm")):
                _demand_member(scene, seed)
    write_text(file, scene.text())


def _finished(scene: Any, seeds: Sequence[int], options: Options) -> list[int]:
    """Members that need not run again. Raises, before anything changes, if a member is damaged."""
    if not options.resume:
        return []
    if _diptych.resolved_scene(os.path.join(scene.directory, "ensemble.prm")) is None:
        say(options, f"no ensemble in {scene.directory}: from the beginning")
    finished = []
    for seed in seeds:
        member = _member_scene(scene, seed)
        if _diptych.holds_finished_run(member):
            stages = read_json(os.path.join(member.directory, "comparison.json"))["stages"]
            if all(stage["mapping"]["total_relative_error"] < _diptych.LARGEST_ERROR_OF_THE_TOTAL for stage in stages):
                finished.append(seed)
    _record(scene, finished, [], [], validation.NO_RUNS)
    return finished


def _holds_finished(scene: Any, seeds: Sequence[int], levels: Levels | None) -> bool:
    """True if the folder holds the finished ensemble of this scene, these seeds and these levels."""
    earlier, record = _diptych.resolved_scene(os.path.join(scene.directory,
                                                           "ensemble.prm")), os.path.join(scene.directory,
                                                                                          "ensemble.json")
    return (earlier is not None and earlier.identity("member") == scene.identity("member") and os.path.exists(record)
            and read_json(record)["done"] == list(seeds) and _levels_of(read_json(record)) == levels
            and all(_diptych.holds_finished_run(_member_scene(scene, seed)) for seed in seeds))


def _levels_of(record: dict[str, Any]) -> Levels | None:
    return Levels(record["levels"]["cheap"], record["levels"]["fine"]) if "levels" in record else None


def _add_limits(scene: Any, record: dict[str, Any], given: tuple[str, list[Any]], levels: Levels,
                options: Options) -> None:
    """Runs the pairs of two-level means and adds the limits to the record. given: scene file and its settings. Raises
    Stopped."""
    seeds, wanted = record["done"], ensemble_quantities()
    cheap = of_members([member_folder(scene.directory, seed) for seed in seeds], record)
    fine = fine_runs(given[0], [*given[1], levels.setting("fine")], seeds, "--seeds")
    os.makedirs(os.path.join(scene.directory, "runs"), exist_ok=True)
    [point] = paired_points(Runs(scene.directory), [fine], [cheap], wanted, options)
    add_summary(record, ensemble_levels(levels, seeds, point))


def run_ensemble(line: argparse.Namespace, options: Options) -> None:
    """diptych run SCENE --seeds LIST. line: target, seeds, levels, check, output, set, set_file. Raises NotConverged if
    a seed failed."""
    compiled, scene_file, seeds = continuum("run --seeds"), line.target, read_seeds(line.seeds)
    levels = read_levels(line.levels, len(seeds))
    settings = settings_of(line.set, line.set_file)
    if levels:
        settings.append(levels.setting("cheap"))
    read = _diptych.read_changed_scene(scene_file, settings, True)
    if levels:
        demand_rule(read, levels)
    directory = line.output or (read.directory + "_ensemble" if read.directory == f"results/{read.name}"
                                else read.directory)
    scene = read.in_folder(directory, read.name, read.dict()["sample"]["seed"])
    if not options.resume and not options.overwrite and _holds_finished(scene, seeds, levels):
        say(options, f"{directory} holds the finished ensemble of this scene; --overwrite runs it again")
        say(options, f"its table: diptych compare {directory}")
        return
    if os.path.isdir(directory):
        _diptych.require_usable(directory, options.resume, options.overwrite)
    for one in settings:
        if (one.section, one.key) == ("sample", "seed"):
            raise SceneError(f"--set sample/seed={one.value}: --seeds {line.seeds} sets the seed of each member")
    compiled.check(scene, seeds, vars(options))  # whether scene, first sample and resources suffice
    if line.check:
        return
    variations = validation.variations(scene_file, settings, validation.draws_of(line.set_file, line.set))
    with Folder(directory) as folder:
        begin = os.times()
        _diptych.require_usable(directory, options.resume, options.overwrite)
        finished = _finished(scene, seeds, options)
        inputs = [("the scene", scene_file), *(("--set-file", file) for file in line.set_file), *scene.input_files()]
        _open(folder, scene, seeds, options, inputs)
        if finished:
            say(options, f"{len(finished)} of {len(seeds)} seeds are finished in {directory}: not run again")
        pending = [seed for seed in seeds if seed not in finished]
        tasks = [Run(command="run", scene=scene_file, folder=member_folder(directory, seed), resume=options.resume,
                     log=member_folder(directory, seed) + ".log",
                     settings=[*settings, Setting("sample", "seed", str(seed), "--seeds")]) for seed in pending]
        ends = list(zip(pending, execute(tasks, options, noun="seeds", finished=len(finished))))
        failed = [{"seed": seed, "exit_code": outcome.exit_code, "message": outcome.message}
                  for seed, outcome in ends if outcome.exit_code and not outcome.interrupted]
        interrupted = [seed for seed, outcome in ends if outcome.interrupted]
        done, runs = [seed for seed in seeds if seed not in [one["seed"] for one in failed]], validation.NO_RUNS
        if done and not interrupted:
            runs = validation.respond(directory, done[0], variations, done[0] in finished, options)
        record = _record(scene, seeds, failed, interrupted, runs)
        if levels and done and not interrupted:
            _add_limits(scene, record, (scene_file, settings), levels, options)
        _write(scene, record, options, ("ensemble", begin))
        if scene.dict()["output"]["report"] and not record["interrupted"]:
            draw(options, directory, "ensemble")
        kept = f"{len(record['done'])} of {len(seeds)} seeds are done, kept in {directory}"
    lost = f"failed: seed {', '.join(str(one['seed']) for one in failed)}; " if failed else ""
    if record["interrupted"]:
        raise Stopped(f"{lost}stopped on request; {kept}; to go on: {options.again}")
    if failed:
        raise NotConverged(lost + kept)


def compare_again(line: argparse.Namespace, options: Options) -> None:
    """diptych compare DIR of an ensemble: statistics and verdicts from the members' files; margins may be changed."""
    directory, overrides = line.target, [f"{s.section}/{s.key}={s.value}" for s in settings_of(line.set, line.set_file)]
    for text in overrides:
        if not text.startswith(("comparison/margin_", "output/")) or text.startswith("output/directory="):
            raise SceneError(f"--set {text}: only comparison/margin_* and keys of output/ except the directory can be "
                             "changed without running the members again")
    with Folder(directory):
        begin = os.times()
        read = _diptych.read_computed_scene(os.path.join(directory, "ensemble.prm"), overrides)
        scene = read.in_folder(directory, _diptych.recorded_scene(directory) or read.name,
                               read.dict()["sample"]["seed"])
        _diptych.check_part(directory, "ensemble")
        earlier = read_json(os.path.join(directory, "ensemble.json"))
        record = _record(scene, earlier["seeds"], earlier["failed"], earlier["interrupted"],
                         earlier.get("continuum_runs", validation.NO_RUNS))
        if "levels" in earlier:
            add_summary(record, earlier["levels"])
        _write(scene, record, options, ("statistics", begin))
        if scene.dict()["output"]["report"]:
            draw(options, directory, "ensemble")
