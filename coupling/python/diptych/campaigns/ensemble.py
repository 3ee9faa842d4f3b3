# diptych: the command run --seeds: the same scene on many samples
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the members of an ensemble and writes ensemble.json, ensemble.csv, ensemble.h5 and report.html."""

from __future__ import annotations

import csv
import io
import math
import os
from collections.abc import Sequence
from typing import Any

import numpy as np

from .. import _diptych
from ..arrays import Interval
from ..errors import SceneError
from .engine import DONE, NOT_CONVERGED, Options, Outcome, Run, complain, execute, n_processes, panels, run_program, say
from .folders import Folder, Timer, draw, read_json, write_arrays, write_json, write_text
from .histories import panel_table, resampled, running_mean
from .input_file import read_seeds, settings_of
from .members import Member, is_mirror_symmetric, member_of
from .statistics import line_statistics, paired, statistics, student_quantile

_LARGEST_ERROR_OF_THE_TOTAL = 1e-12  # above it `diptych run` ends with exit code 1
_PANELS = ("discrete", "continuum")
_Question = tuple[str, str, str, float, str]  # name, quantity of the grains, that of the continuum, margin, kind of difference


def member_folder(directory: str, seed: int) -> str:
    """DIR/seed_3, the result folder of a member. Its log is DIR/seed_3.log."""
    return os.path.join(directory, f"seed_{seed}")


def is_ensemble_folder(directory: str) -> bool:
    """The folder holds ensemble.prm, the resolved scene of its members."""
    return _diptych.resolved_scene(os.path.join(directory, "ensemble.prm")) is not None


# ---- statistics -------------------------------------------------------------------------------------------------------------


def evaluate(members: Sequence[Member], margins: dict[str, float]) -> dict[str, Any]:
    """quantities, bands and verdicts as ensemble.json has them. margins: comparison/margin_* of the scene."""
    named: dict[str, tuple[str, bool]] = {}
    for member in members:
        for name, (_, unit, line, _place) in member.numbers.items():
            named.setdefault(name, (unit, line))
    nothing = (math.nan,)
    values = {name: [member.numbers.get(name, nothing)[0] for member in members] for name in named}
    quantities = []
    for name, (unit, line) in named.items():
        s = (line_statistics if line else statistics)(values[name])
        quantities.append({"name": name, "unit": unit, **s._asdict(), "values": values[name]})
    bands = [_band_count(name, members) for name in dict.fromkeys(name for member in members for name in member.bands)]
    verdicts = [_answer(question, values, named, len(members)) for question in _questions(bands, margins)]
    return {"quantities": quantities, "bands": bands, "verdicts": verdicts}


def _band_count(name: str, members: Sequence[Member]) -> dict[str, Any]:
    found = [min(member.bands[name], 2) for member in members if name in member.bands]
    none, one, two = (found.count(k) for k in range(3))
    texts = [f"{words} in {n}" for words, n in (("one band", one), ("two bands", two), ("none", none)) if n]
    texts[0] += f" of {len(found)}"
    return {"name": name, "none": none, "one": one, "two": two, "text": ", ".join(texts)}


def _questions(bands: Sequence[dict[str, Any]], margins: dict[str, float]) -> list[_Question]:
    single = [("peak_stress_ratio", "margin_peak_stress_ratio", "relative"),
              ("strength", "margin_peak_stress_ratio", "relative"),
              ("final_volumetric_strain", "margin_volumetric_strain", "absolute")]
    questions = [(key, f"discrete_summary {key}", f"continuum_summary {key}", margins[margin], kind)
                 for key, margin, kind in single]
    for count in bands:
        window, _, panel = count["name"].rpartition(" ")
        if panel == "discrete" and window.startswith("window "):
            for key, margin, kind in (("angle_deg", "margin_angle", "line"), ("width_10_90_d", "margin_thickness", "relative")):
                questions.append((f"{window} band {key}", f"{window} discrete band {key}", f"{window} continuum band {key}",
                                  margins[margin], kind))
    return questions


def _answer(question: _Question, values: dict[str, list[float]], named: dict[str, tuple[str, bool]], n: int) -> dict[str, Any]:
    name, grains, continuum, margin, kind = question
    units = [named[one][0] for one in (grains, continuum) if one in named]
    unit = "-" if kind == "relative" else units[0] if units else "degrees" if kind == "line" else "-"
    first, second = (values.get(one, [math.nan] * n) for one in (grains, continuum))
    found = paired(first, second, kind)
    return {"quantity": name, "unit": unit, "margin": margin, "relative": kind == "relative", "difference": found.difference,
            "difference_90": found.difference_90, "n": found.n, "verdict": found.verdict(margin), "discrete": first,
            "continuum": second}


def _text_of(verdict: dict[str, Any]) -> str:
    """ "window 0-0.01 band angle_deg: cannot tell: continuum - grains -1.1 [-3.8, 1.6] degrees, margin 3, 8 pairs" """
    scale = 100 if verdict["relative"] else 1
    unit = " % of the grains' mean" if verdict["relative"] else "" if verdict["unit"] == "-" else f" {verdict['unit']}"
    e: Interval = verdict["difference"]
    found = (f": continuum - grains {scale * e.value:.3g} [{scale * e.low:.3g}, {scale * e.high:.3g}]{unit}, margin "
             f"{scale * verdict['margin']:.3g}") if verdict["n"] else ""
    return f"{verdict['quantity']}: {verdict['verdict']}{found}, {verdict['n']} pairs"


def with_means(members: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(mean, low, high) of curves (member, point), with the 95 % Student interval; NaN where a member has no value."""
    n = len(members)
    mean = members.mean(axis=0) if n else np.full(members.shape[1], np.nan)
    half = student_quantile(0.975, n - 1) * members.std(axis=0, ddof=1) / math.sqrt(n) if n > 1 else np.full_like(mean, np.nan)
    return mean, mean - half, mean + half


# ---- result files -----------------------------------------------------------------------------------------------------------


def _histories(directory: str, seeds: Sequence[int]) -> dict[str, list[Any]]:
    """panel -> tables of the members. Raises ValueError with the first one that is missing or damaged."""
    tables: dict[str, list[Any]] = {panel: [] for panel in _PANELS}
    for panel in _PANELS:
        for seed in seeds:
            tables[panel].append(panel_table(member_folder(directory, seed), panel))
            if tables[panel][-1] is None:
                raise ValueError(f"{member_folder(directory, seed)}/{panel}.csv: is missing or has no rows")
    return tables


def _write_curves(directory: str, scene: Any, seeds: Sequence[int], tables: dict[str, list[Any]]) -> None:
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
    write_arrays(os.path.join(directory, "ensemble.h5"), arrays, {"/": {"averaging_width": width}})


def _csv(quantities: Sequence[dict[str, Any]], seeds: Sequence[int]) -> str:
    out = io.StringIO()
    table = csv.writer(out, lineterminator="\n")
    table.writerow(["quantity", "unit", "n", "mean", "deviation", "low", "high", *(f"seed_{seed}" for seed in seeds)])
    for q in quantities:
        numbers = [q[key] for key in ("mean", "deviation", "low", "high")] + q["values"]
        table.writerow([q["name"], q["unit"], q["n"], *(f"{x:.10g}" if math.isfinite(x) else "" for x in numbers)])
    return out.getvalue()


def _margins(scene: Any) -> dict[str, float]:
    return {key: value for key, value in scene.dict()["comparison"].items() if key.startswith("margin_")}


def _record(scene: Any, seeds: Sequence[int], failed: Sequence[dict[str, Any]], interrupted: Sequence[int]) -> dict[str, Any]:
    """ensemble.json, from the members that finished. Raises ValueError with the file of a member that is broken."""
    out = {one["seed"] for one in failed} | set(interrupted)
    done = [seed for seed in seeds if seed not in out]
    folded, n = is_mirror_symmetric(scene), len(done)
    return {"format": 1, "scene": scene.name, "seeds": list(seeds), "done": done, "failed": list(failed),
            "interrupted": list(interrupted), "margins": _margins(scene), "walk": scene.walk(), "folded": folded,
            "student_t_95": student_quantile(0.975, n - 1) if n > 1 else math.nan,
            **evaluate([_read_member(scene, seed, folded) for seed in done], _margins(scene))}


def _read_member(scene: Any, seed: int, folded: bool) -> Member:
    folder = member_folder(scene.directory, seed)
    path = os.path.join(folder, "comparison.json")
    for part in ("", "comparison"):
        _diptych.check_part(folder, part)
    _demand_member(scene, seed)
    member = member_of(path, folded)
    if member.seed != seed:
        raise ValueError(f"{path}: is of the seed {member.seed}, in the folder of another")
    return member


def _write(scene: Any, record: dict[str, Any], options: Options, timer: Timer) -> None:
    directory = scene.directory
    tables = _histories(directory, record["done"])
    _diptych.forget_files(directory, "ensemble")  # killed from here on, it leaves none that look changed
    if os.path.exists(os.path.join(directory, "report.html")):  # of other statistics
        os.remove(os.path.join(directory, "report.html"))
    _write_curves(directory, scene, record["done"], tables)
    write_json(os.path.join(directory, "ensemble.json"), record)
    write_text(os.path.join(directory, "ensemble.csv"), _csv(record["quantities"], record["done"]))
    _diptych.record_phase(directory, (scene.name, record["seeds"], options.command), timer.stop())
    _diptych.record_files(directory, "ensemble")
    for verdict in record["verdicts"]:
        say(options, _text_of(verdict))


# ---- members ----------------------------------------------------------------------------------------------------------------


def _member_scene(scene: Any, seed: int) -> Any:
    return scene.in_folder(member_folder(scene.directory, seed), scene.name, seed)


def _demand_member(scene: Any, seed: int) -> None:
    member = _member_scene(scene, seed)
    sample, _, comparison = _diptych.changes_since(member)
    if sample or comparison:
        raise SceneError(f"the results in '{member.directory}' are not of this ensemble: {sample or comparison}. Move them "
                         "elsewhere, or run the ensemble with --overwrite.")


def _is_finished(scene: Any, seed: int) -> bool:
    """Panels, comparison and report are complete; the mapping keeps the total. Raises ValueError with a changed file."""
    member = _member_scene(scene, seed)
    if not _diptych.holds_finished_run(member):
        return False
    comparison = read_json(os.path.join(member.directory, "comparison.json"))
    errors = [stage.get("mapping", {}).get("total_relative_error", 1.0) for stage in comparison.get("stages", [])]
    return comparison.get("seed") == seed and all(error < _LARGEST_ERROR_OF_THE_TOTAL for error in errors)


def _demand_same_scene(scene: Any) -> None:
    file = os.path.join(scene.directory, "ensemble.prm")
    earlier = _diptych.resolved_scene(file)
    there, here = earlier.identity("member") if earlier else {}, scene.identity("member")
    differs = next((key for key in here if here[key] != there.get(key)), None)
    if differs:
        why = f"{differs} = '{here[differs]}' here, '{there.get(differs)}' there" if earlier else "another version wrote it"
        raise SceneError(f"--resume: the scene differs from {file}: {why}. Give the same scene, or --overwrite.")


def _open(folder: Folder, scene: Any, seeds: Sequence[int], options: Options, inputs: list[tuple[str, str]]) -> None:
    """Prepares the folder and writes ensemble.prm. Members that stand there must be of the same scene."""
    if not _diptych.is_empty_folder(folder.directory):
        if options.overwrite:
            folder.set_aside(inputs)
        else:
            _demand_same_scene(scene)
            for seed in seeds:
                if os.path.exists(os.path.join(member_folder(folder.directory, seed), "scene.prm")):
                    _demand_member(scene, seed)
    write_text(os.path.join(folder.directory, "ensemble.prm"), scene.text())


def _finished(scene: Any, seeds: Sequence[int], options: Options) -> list[int]:
    """Members that need not run again. Raises, before anything changes, if a member is damaged."""
    if not options.resume:
        return []
    if not is_ensemble_folder(scene.directory):
        say(options, f"no ensemble in {scene.directory}: from the beginning")
    finished = [seed for seed in seeds if _is_finished(scene, seed)]
    _record(scene, finished, [], [])
    _histories(scene.directory, finished)
    return finished


def _conclude(record: dict[str, Any], directory: str, again: str) -> int:
    done = f"{len(record['done'])} of {len(record['seeds'])} seeds are done"
    failed = ", ".join(str(one["seed"]) for one in record["failed"])
    if failed:
        complain(f"failed: seed {failed}; {done}, kept in {directory}")
    if record["interrupted"]:
        complain(f"stopped on request; {done}, kept in {directory}; to go on: {again}")
    return NOT_CONVERGED if failed or record["interrupted"] else DONE


def _check(scene: str, seeds: str, words: Sequence[str], output: str, options: Options) -> int:
    """Asks the program whether scene and first sample can run, and for the resources that all need. Returns its exit code."""
    flags = [flag for flag, given in (("--resume", options.resume), ("--quiet", options.quiet)) if given]
    place = ["--output", output] if output else []
    return run_program([panels(), "run", scene, "--seeds", seeds, *words, *place, *flags, "--threads", str(options.threads),
                        "--check"])


def run_ensemble(scene_file: str, seed_list: str, output: str, changes: tuple[Sequence[str], Sequence[str]],
                 options: Options) -> int:
    """diptych run SCENE --seeds LIST. changes: texts of --set, files of --set-file. Returns the exit code."""
    seeds, (overrides, set_files) = read_seeds(seed_list), changes
    read = _diptych.read_changed_scene(scene_file, settings_of(overrides, set_files), True)
    directory = output or (read.directory + "_ensemble" if read.directory == f"results/{read.name}" else read.directory)
    scene = read.in_folder(directory, read.name, read.dict()["sample"]["seed"])
    words = [word for option, values in (("--set-file", set_files), ("--set", overrides)) for value in values
             for word in (option, value)]
    if os.path.isdir(directory):
        _diptych.require_usable(directory, options.resume, options.overwrite)
    code = _check(scene_file, seed_list, words, output, options)
    if code:
        return code
    with Folder(directory) as folder:
        timer = Timer("ensemble")
        _diptych.require_usable(directory, options.resume, options.overwrite)
        finished = _finished(scene, seeds, options)
        inputs = [("the scene", scene_file), *(("--set-file", file) for file in set_files), *scene.input_files()]
        _open(folder, scene, seeds, options, inputs)
        if finished:
            say(options, f"{len(finished)} of {len(seeds)} seeds are finished in {directory}: not run again")
        pending = [seed for seed in seeds if seed not in finished]
        tasks = [Run("run", scene_file, member_folder(directory, seed), member_folder(directory, seed) + ".log",
                     (*words, "--set", f"sample/seed={seed}", *["--resume"] * options.resume)) for seed in pending]
        outcomes = execute(tasks, options, noun="seeds", finished=len(finished))
        record = _record(scene, seeds, *_ends(pending, outcomes))
        _write(scene, record, options, timer)
        if scene.dict()["output"]["report"] and not record["interrupted"]:
            draw(options, "ensemble", directory)
        job = f"mpirun -np {n_processes()} " if n_processes() > 1 else ""
        return _conclude(record, directory, f"{job}diptych run {scene_file} --seeds {seed_list} --output {directory} --resume "
                         "(with the same --set)")


def _ends(seeds: Sequence[int], outcomes: Sequence[Outcome]) -> tuple[list[dict[str, Any]], list[int]]:
    """(failed, interrupted) members"""
    failed = [{"seed": seed, "exit_code": outcome.exit_code, "message": outcome.message}
              for seed, outcome in zip(seeds, outcomes) if outcome.exit_code and not outcome.interrupted]
    return failed, [seed for seed, outcome in zip(seeds, outcomes) if outcome.interrupted]


def compare_again(directory: str, changes: tuple[Sequence[str], Sequence[str]], options: Options) -> int:
    """diptych compare DIR of an ensemble: statistics and verdicts from the members' files; margins may be changed."""
    overrides = [f"{s.section}/{s.key}={s.value}" for s in settings_of(*changes)]
    for text in overrides:
        if not text.startswith(("comparison/margin_", "output/")):
            raise SceneError(f"--set {text}: only comparison/margin_* and output/ can be changed without running the "
                             "members again")
        if text.startswith("output/directory="):
            raise SceneError(f"--set {text}: a comparison stands in the folder that it is of")
    with Folder(directory):
        read = _diptych.read_computed_scene(os.path.join(directory, "ensemble.prm"), overrides)
        scene = read.in_folder(directory, _diptych.recorded_scene(directory) or read.name, read.dict()["sample"]["seed"])
        timer, path = Timer("statistics"), os.path.join(directory, "ensemble.json")
        _diptych.check_part(directory, "ensemble")
        earlier = read_json(path)
        try:
            seeds, failed, interrupted = earlier["seeds"], earlier.get("failed", []), earlier.get("interrupted", [])
            failed = [{key: one[key] for key in ("seed", "exit_code", "message")} for one in failed]
        except (KeyError, TypeError) as error:
            raise ValueError(f"{path}: was not written by this version: {error!r}") from error
        _write(scene, _record(scene, seeds, failed, interrupted), options, timer)
        if scene.dict()["output"]["report"]:
            draw(options, "ensemble", directory)
    return DONE
