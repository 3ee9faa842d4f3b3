# diptych: the command run --seeds: the same scene on many samples
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the members of an ensemble and writes ensemble.json, ensemble.csv, ensemble.h5, summary.csv and report.html."""

from __future__ import annotations

import argparse
import math
import os
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd

from ... import _diptych
from ...compiled import continuum
from ...errors import NotConverged, SceneError, Stopped
from ...files import key_of_band, member_folders, number_name, read_ensemble, read_json
from . import summary as summaries
from . import validation
from ..measured.folder import compare_folder
from ..runs.engine import Options, Outcome, counted, say
from . import measured
from .profiles import profile_arrays
from ..runs.folders import (Folder, Runs, SceneRun, draw, record_phase, run_on, write_arrays, write_json,
                            write_text)
from ..runs.histories import curve_of, panel_table
from ..runs.input_file import seeds_of_line, settings_of
from ..studies.level_runs import add_summary, demand_rule, ensemble_levels, fine_runs, read_levels
from ..runs.key_numbers import QUANTITIES, summary_of
from ..runs.members import Member, member_of
from ..runs.statistics import line_statistics, statistics, student_quantile

_PANELS = ("discrete", "continuum")
_MARGINS = {one["margin"] for one in QUANTITIES.values()}  # keys of the section comparison
_ENDS = ("seeds", "folders", "done", "failed", "interrupted")  # entries of ensemble.json: how the members ended


def evaluate(members: Sequence[Member], margins: dict[str, float],
             responses: validation.Responses = validation.Responses()) -> dict[str, Any]:
    """quantities, bands, verdicts and validation as ensemble.json has them. margins: comparison/margin_* of the
    scene."""
    quantities: dict[str, dict[str, Any]] = {}
    for name, (_, unit, line) in (pair for member in members for pair in member.numbers.items()):
        if name not in quantities:
            values = [member.value(name) for member in members]
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
        name = f"{window} band {key_of_band(key)}" if window else key
        names = [number_name(panel, key, window) for panel in _PANELS]
        units = [quantities[one]["unit"] for one in names if one in quantities]
        unit = units[0] if units else "degrees" if kind == "line" else "-"
        first, second = ([member.value(one) for member in members] for one in names)
        parts = validation.uncertainties(key, window, members, responses)
        found, row = validation.validated(kind, (first, second), parts, len(responses.draws))
        diffuse = sum(not member.diffuse.isdisjoint(names) for member in members)
        verdict = "diffuse" if diffuse and not found.n else found.verdict(margin)
        rows.append({"key": key, "quantity": name, **row, "unit": unit, "verdict": verdict})
        verdicts.append({"key": key, "window": window, "quantity": name,
                         "unit": "-" if kind == "relative" else unit, "margin": margin, "relative": kind == "relative",
                         "difference": found.difference, "difference_90": found.difference_90, "n": found.n,
                         "diffuse": diffuse, "verdict": verdict, "discrete": first, "continuum": second})
    return verdicts, rows


def with_means(members: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(mean, low, high) of curves (member, point), with the 95 % Student interval; NaN where a member has no value."""
    n = len(members)
    mean = members.mean(axis=0) if n else np.full(members.shape[1], np.nan)
    half = student_quantile(0.975, n - 1) * members.std(axis=0,
                                                        ddof=1) / math.sqrt(n) if n > 1 else np.full_like(mean, np.nan)
    return mean, mean - half, mean + half


def _write_curves(directory: str, scene: Any, folders: dict[int, str]) -> None:
    """folders: result folders of the finished members by seed."""
    tables = {panel: [panel_table(folder, panel) for folder in folders.values()] for panel in _PANELS}
    last = max((table["progress"].iloc[-1] for panel in _PANELS for table in tables[panel]), default=0.0)
    grid, width = last * np.arange(401) / 400, scene.averaging_width()
    arrays = {"progress": (grid, "progress", "strain or time", "points of the curves"),
              "seeds": (np.array(list(folders), np.int32), "seeds", "-", "seeds of the members, one per row")}
    for panel in _PANELS:
        for name in ("stress_ratio", "volumetric_strain"):
            members = np.array([curve_of(table, name, width, grid) for table in tables[panel]])
            mean, low, high = with_means(members.reshape(-1, len(grid)))
            group = f"{panel}/{name}/"
            arrays[group + "members"] = (members, "every member", "-",
                                         "running mean, one row per seed; nan beyond the end of a history")
            arrays[group + "mean"] = (mean, "mean", "-", "mean over all members; nan if a member has no value")
            arrays[group + "low"] = (low, "lower end", "-",
                                     "lower end of the 95 % Student interval of the mean; nan like the mean")
            arrays[group + "high"] = (high, "upper end", "-", "upper end of the same interval; nan like the mean")
    arrays |= profile_arrays(list(folders.values()))
    write_arrays(os.path.join(directory, "ensemble.h5"), arrays, {"/": {"averaging_width": width}})


def _done(scene: Any, record: dict[str, Any]) -> dict[int, str]:
    """The result folders of the finished members by seed. record: with the entries _ENDS of ensemble.json."""
    return {seed: os.path.join(scene.directory, folder) for seed, folder in member_folders(record).items()
            if seed in record["done"]}


def _complete(scene: Any, ends: dict[str, Any], runs: Mapping[str, Any]) -> dict[str, Any]:
    """ensemble.json, from the members that finished. ends: with its entries _ENDS; runs: those of
    validation.respond(). Raises ValueError with the file of a member that is broken."""
    done, members, checks, keys = _done(scene, ends), [], {}, scene.dict()["comparison"]
    folded, n = scene.is_mirror_symmetric(), len(done)
    for seed, folder in done.items():
        for part in ("", "comparison"):
            _diptych.check_part(folder, part)
        sample, _, comparison = _diptych.changes_since(scene.in_folder(folder, scene.name, seed))
        if sample or comparison:
            raise SceneError(f"the results in '{folder}' are not of this ensemble: {sample or comparison}. Move them "
                             "elsewhere and run the ensemble with --resume, or with --overwrite.")
        record = read_json(os.path.join(folder, "comparison.json"))
        checks[seed] = record.get("checks", [])  # an earlier version wrote none
        members.append(member_of(record, folded))
    margins = {key: keys[key] for key in _MARGINS}
    found = evaluate(members, margins, validation.responses_of(scene, done, members, runs))
    first = summary_of(next(iter(done.values()))) if done else {}
    return {"format": 1, "scene": scene.name, **{key: ends[key] for key in _ENDS}, "margins": margins,
            "walk": scene.loading_variable(), "folded": folded,
            "student_t_95": student_quantile(0.975, n - 1) if n > 1 else math.nan,
            "continuum_runs": runs, "summary": summaries.summary(first, found),
            "checks": summaries.checks_of(checks), **found}


def _write(scene: Any, record: dict[str, Any], options: Options, phase: tuple[str, os.times_result]) -> None:
    """phase: its name and when it began."""
    directory = scene.directory
    _diptych.forget_files(directory, "ensemble")  # killed from here on, it leaves none that look changed
    if os.path.exists(os.path.join(directory, "report.html")):  # of other statistics
        os.remove(os.path.join(directory, "report.html"))
    _write_curves(directory, scene, _done(scene, record))
    write_json(os.path.join(directory, "ensemble.json"), record)
    columns = ["unit", "n", "mean", "deviation", "low", "high"]
    table = pd.DataFrame([[q["name"], *(q[key] for key in columns), *q["values"]] for q in record["quantities"]],
                         columns=["quantity", *columns, *(f"seed_{seed}" for seed in record["done"])])
    write_text(os.path.join(directory, "ensemble.csv"), table.to_csv(index=False, float_format="%.10g",
                                                                     lineterminator="\n"))
    write_text(os.path.join(directory, "summary.csv"), summaries.table_of(record).to_csv(
        index=False, float_format="%.9g", lineterminator="\n"))
    record_phase(directory, *phase, (scene.name, record["seeds"]), options)
    _diptych.record_files(directory, "ensemble")
    if record["summary"]:
        say(options, summaries.text_of(record["summary"]))
        if "measured" in record:
            say(options, measured.text_of(record["measured"]["rows"]))
        say(options, summaries.text_of_checks(record["checks"]))
        say(options, _diptych.origin_of_law(scene.dict()["comparison"]["parameters_from"]))


def _open(folder: Folder, scene: Any, options: Options, inputs: list[tuple[str, str]]) -> Runs:
    """Prepares the folder and writes ensemble.prm. Raises SceneError for the ensemble of another scene, or of a version
    that had other folders."""
    directory, file = folder.directory, os.path.join(folder.directory, "ensemble.prm")
    if options.resume and os.path.exists(file):
        if any(name.startswith("seed_") for name in os.listdir(directory)):
            raise SceneError(f"--resume: an earlier version wrote '{directory}', with a folder seed_K for each member. "
                             "diptych compare and diptych report read it, but its members cannot be continued. Use "
                             "--output with another folder, or --overwrite.")
        # one of a version with other keys cannot be read: its runs are repeated
        there, here = ((one or scene).identity("member") for one in (_diptych.resolved_scene(file), scene))
        differs = [f"{key} = '{here[key]}' here, '{there.get(key)}' there" for key in here
                   if here[key] != there.get(key)]
        if differs:  # with the keys that follow from a changed one
            raise SceneError(f"--resume: the scene differs from {file}: {'; '.join(differs)}. Give the same scene, or "
                             "--overwrite.")
    return folder.open_runs("ensemble", file, options, lambda: inputs, scene.text(), copy="ensemble.prm")


def _ends(runs: Runs, members: dict[int, SceneRun], outcomes: dict[str, Outcome]) -> dict[str, Any]:
    """The entries _ENDS of ensemble.json."""
    ended = {seed: outcomes[run.name] for seed, run in members.items()}
    return {"seeds": list(members), "folders": [f"runs/{run.name}" for run in members.values()],
            "done": [seed for seed, one in ended.items() if not one.exit_code and not one.interrupted],
            "failed": [{"seed": seed, "exit_code": one.exit_code, "message": runs.last_words(members[seed])}
                       for seed, one in ended.items() if one.exit_code and not one.interrupted],
            "interrupted": [seed for seed, one in ended.items() if one.interrupted]}


def run_ensemble(line: argparse.Namespace, options: Options) -> None:
    """diptych run SCENE --seeds LIST. line: target, seeds, levels, check, output, set, set_file. Raises NotConverged if
    a seed failed, or Stopped."""
    compiled, seeds = continuum("run --seeds"), seeds_of_line(line.seeds)
    settings = settings_of(line.set, line.set_file)
    for one in settings:
        if (one.section, one.key) == ("sample", "seed"):
            raise SceneError(f"--set sample/seed={one.value}: --seeds {line.seeds} sets the seed of each member")
    levels = read_levels(line.levels, len(seeds))
    settings += [levels.setting("cheap")] if levels else []
    read = _diptych.read_changed_scene(line.target, settings, True)
    if levels:
        demand_rule(read, levels)
    directory = line.output or read.directory + "_ensemble" * (read.directory == f"results/{read.name}")
    scene = read.in_folder(directory, read.name)
    if os.path.isdir(directory):
        _diptych.require_usable(directory, options.resume, options.overwrite)
    compiled.check(scene, seeds, vars(options) | {"check": line.check})  # whether it can run
    if line.check:
        return
    variations = validation.variations(line.target, settings, validation.draws_of(line.set_file, settings_of(line.set)))
    with Folder(directory) as folder:
        begin = os.times()
        runs = _open(folder, scene, options, [("the scene", line.target), *scene.input_files(),
                                              *(("--set-file", file) for file in line.set_file)])
        members = {seed: run_on(scene, seed, f"seed {seed}") for seed in seeds}
        outcomes = runs.do(list(members.values()), options)
        ends, changed = _ends(runs, members, outcomes), validation.NO_RUNS
        done = {seed: members[seed] for seed in ends["done"]}
        if done and not ends["interrupted"]:
            first = next(iter(done.values()))
            changed = validation.respond(runs, first, variations, outcomes[first.name].seconds > 0, options)
        record = _complete(scene, ends, changed)
        if levels and done and not ends["interrupted"]:
            fine = fine_runs(line.target, [*settings, levels.setting("fine")], list(done), "--seeds")
            add_summary(record, ensemble_levels(levels, runs, done, fine, options))
        runs.crew.close()
        _write(scene, record, options, ("ensemble", begin))
        if scene.dict()["output"]["report"] and not ends["interrupted"]:
            draw(options, directory, "ensemble")
    kept = f"{len(done)} of {len(seeds)} seeds are done, kept in {directory}"
    lost = f"failed: seed {', '.join(str(one['seed']) for one in ends['failed'])}; " if ends["failed"] else ""
    if ends["interrupted"]:
        raise Stopped(f"{lost}stopped on request; {kept}", options.again)
    if lost:
        raise NotConverged(lost + kept)


def _add_measured(scene: Any, record: dict[str, Any], source: str, options: Options) -> None:
    """Compares every finished member with the measurement in the folder `source`."""
    found = []
    for seed, folder in counted([*_done(scene, record).items()], "samples", options.quiet):
        with Folder(folder):
            found.append(compare_folder(folder, scene.in_folder(folder, scene.name, seed), source))
    if found:
        record["measured"] = {"folder": os.path.abspath(source), "rows": measured.rows_of(
            found, record["validation"], record["margins"], record["folded"])}


def compare_again(line: argparse.Namespace, options: Options) -> None:
    """diptych compare DIR of an ensemble: statistics and verdicts from the members' files; margins may be changed."""
    directory, settings = line.target, settings_of(line.set, line.set_file)
    for one in settings:
        is_margin = one.section == "comparison" and one.key in _MARGINS
        if not is_margin and (one.section != "output" or one.key == "directory"):
            raise SceneError(f"--set {one.text()}: only comparison/margin_* and keys of output/ except the directory "
                             "can be changed without running the members again")
    with Folder(directory):
        begin = os.times()
        read = _diptych.read_computed_scene(os.path.join(directory, "ensemble.prm"), [
            f"{one.section}/{one.key}={one.value}" for one in settings])
        scene = read.in_folder(directory, _diptych.recorded_scene(directory) or read.name)
        _diptych.check_part(directory, "ensemble")
        earlier = read_ensemble(directory)
        record = _complete(scene, earlier, earlier.get("continuum_runs", validation.NO_RUNS))
        if "levels" in earlier:
            add_summary(record, earlier["levels"])
        if source := line.measured or earlier.get("measured", {}).get("folder"):
            _add_measured(scene, record, source, options)
        _write(scene, record, options, ("statistics", begin))
        if scene.dict()["output"]["report"]:
            draw(options, directory, "ensemble")
