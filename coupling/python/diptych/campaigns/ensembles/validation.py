# diptych: validation of an ensemble as in ASME V&V 20: errors and their uncertainty
# SPDX-License-Identifier: LGPL-2.1-or-later
"""E = S - D is the continuum minus the grains, and u_val its standard uncertainty: u_val^2 = u_num^2 + u_input^2 +
u_D^2. Source: ASME V&V 20-2009.

Values are dicts by the names of member_of(). NaN marks a part that is not known: it does not count, and the record
names it.
"""

from __future__ import annotations

import math
import os
import shutil
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pandas as pd

from ... import _diptych
from ...files import number_name, read_ensemble, read_json
from ..runs.engine import Options
from ..runs.folders import Runs, SceneRun, run_on
from ..runs.histories import panel_table
from ..runs.input_file import Setting
from ..runs.key_numbers import OF_PANEL, QUANTITIES, panel_values
from ..runs.members import Member, member_of
from ..runs.statistics import Difference, line_statistics, line_turn, paired, statistics

DRAWS = 12  # of the parameters; their deviation is then known to a fifth
# 95 % bound / estimated numerical error, of which u_num is half. Roache (Verification and Validation in Computational
# Science and Engineering, 1998) takes 3 for an assumed order and 1.25 for an observed one. README.md compares estimates
# with errors.
SAFETY = 1.25
_PARTS = {"grains_step": "step of the grains", "mesh": "mesh", "load_step": "load step", "parameters": "parameters"}
_FOLDER = "validation"  # of the runs; it is removed after they have been read
NO_RUNS: dict[str, Any] = {"seed": None, "scenes": [], "quantities": [], "values": []}  # as respond() returns them


@dataclass(kw_only=True)
class Responses:
    """How the continuum answers to changes. coarse: values of every member on the coarse mesh. The others are values of
    one sample on that mesh. base: unchanged. half_step: with half the load step. draws: with draws of the
    parameters."""

    coarse: Sequence[Mapping[str, float]] = ()
    size_ratio: float = math.nan  # element size of the coarse mesh / that of the members
    base: Mapping[str, float] = field(default_factory=dict)
    half_step: Mapping[str, float] = field(default_factory=dict)
    draws: Sequence[Mapping[str, float]] = ()


def uncertainties(key: str, window: str, members: Sequence[Member], responses: Responses) -> dict[str, float]:
    """Standard uncertainties but that of the samples, in the unit of the quantity. window: of a band.

    Estimated errors: grains_step by the rule of the step; mesh and load_step by order 1 from a change d: d / (r - 1) by
    a mesh coarser by r, 2 d by half the step. parameters: deviation over the draws.
    """
    is_line, name = QUANTITIES[key]["difference"] == "line", number_name("continuum", key, window)
    minus, average = (line_turn, line_statistics) if is_line else (np.subtract, statistics)
    grains, fine = ([member.value(number_name(panel, key, window)) for member in members]
                    for panel in ("discrete", "continuum"))
    rules = ["strength"] + ["dilation"] * (key == "final_volumetric_strain")  # its two parts may cancel by chance
    expected = max(abs(statistics([member.value(f"discrete_summary expected_{rule}_error") for member in members]).mean)
                   for rule in rules)
    coarse = [values.get(name, math.nan) for values in responses.coarse] or [math.nan] * len(fine)
    half, base = (values.get(name, math.nan) for values in (responses.half_step, responses.base))
    has_rule = key in OF_PANEL and expected != 0  # 0: a flow that the rule does not describe
    errors = {"grains_step": expected * statistics(grains).mean if has_rule else math.nan,
              "mesh": statistics(minus(coarse, fine)).mean / (responses.size_ratio - 1),
              "load_step": 2 * float(minus(half, base))}
    return {**{name: SAFETY / 2 * abs(error) for name, error in errors.items()},
            "parameters": average([values.get(name, math.nan) for values in responses.draws]).deviation}


def validated(kind: str, pairs: tuple[Sequence[float], Sequence[float]], parts: Mapping[str, float],
              n_draws: int) -> tuple[Difference, dict[str, Any]]:
    """The difference as paired() has it, with all known parts in its intervals, and a row of ensemble.json without key,
    name and verdict.

    Half widths add in squares. Each is a standard uncertainty times Student's factor: n - 1 degrees of freedom of the
    samples, n_draws - 1 of the parameters, infinitely many of the numerical parts.
    """
    first, second = np.array(pairs, float)[:, np.isfinite(pairs).all(axis=0)]
    average = line_statistics if kind == "line" else statistics
    found, error = paired(first, second, kind), average(line_turn(second, first) if kind == "line" else second - first)
    of_samples = error.deviation / math.sqrt(error.n) if error.n > 1 else math.nan
    grains = average(first).mean
    errors = [(u, n_draws - 1 if name == "parameters" else math.inf) for name, u in parts.items() if math.isfinite(u)]
    relative = [(u / abs(grains), f) for u, f in errors] if kind == "relative" else errors
    numerical = [parts[name] for name in ("grains_step", "mesh", "load_step") if math.isfinite(parts[name])]
    total = math.hypot(of_samples, *(u for u, _ in errors))
    row = {"n": error.n, "S": average(second).mean, "D": grains,
           "E": paired(first, second, "line" if kind == "line" else "absolute").with_errors(errors).difference,
           "u_num": math.hypot(*numerical) if numerical else math.nan, "u_input": parts["parameters"],
           "u_D": of_samples, "u_val": total, "ratio": abs(error.mean) / total if total > 0 else math.nan,
           "parts": {name: parts[name] for name in ("grains_step", "mesh", "load_step")},
           "not_known": [words for name, words in _PARTS.items() if not math.isfinite(parts[name])]}
    return found.with_errors(relative), row


def coarse_values(folder: str, scene: Any, member: Member) -> dict[str, float]:
    """Values of a member's continuum on the coarse mesh, by the names of the fine one; empty without that run."""
    table = panel_table(os.path.join(folder, "coarse"), "continuum")
    if table is None:
        return {}
    found = {number_name("continuum", key): value for key, value in panel_values(scene, table).items()}
    for window in member.windows:
        for key in set(QUANTITIES) - set(OF_PANEL):
            found[number_name("continuum", key, window)] = member.value(number_name("continuum_coarse", key, window))
    return found


def responses_of(scene: Any, folders: Mapping[int, str], members: Sequence[Member],
                 runs: Mapping[str, Any]) -> Responses:
    """The responses of the finished members. folders: their result folders by seed. runs: the record of respond()."""
    keys = scene.dict()
    ratio = keys["comparison"]["coarse_element_size"] / keys["continuum"]["element_size"]
    coarse = {seed: coarse_values(folder, scene, member) for (seed, folder), member in zip(folders.items(), members)}
    values = [{name: value for name, value in zip(runs["quantities"], row) if value is not None}
              for row in runs["values"]]
    half, *draws = values or [{}]
    return Responses(coarse=list(coarse.values()), size_ratio=ratio if ratio > 1 else math.nan,
                     base=coarse.get(runs["seed"], {}), half_step=half, draws=draws)


def draws_of(set_files: Sequence[str], settings: Sequence[Setting]) -> list[list[Setting]]:
    """Evenly chosen rows of the posterior of a calibration: posterior.csv beside a --set-file, with keys of the section
    continuum as columns. settings: those of --set, whose keys count as exact. [] without such a file."""
    beside = [os.path.join(os.path.dirname(file), "posterior.csv") for file in set_files]
    path = next(filter(os.path.isfile, beside), "")
    table = pd.read_csv(path, dtype=str, comment="#") if path else pd.DataFrame()
    exact = [one.key for one in settings if one.section == "continuum"]
    # "key (target)" is not in calibrated.prm
    table = table[[key for key in table if key.isidentifier() and key not in exact]]
    rows = np.unique(np.linspace(0, len(table) - 1, DRAWS).round().astype(int)) if table.size else ()
    return [[Setting("continuum", key, value, file=path) for key, value in table.iloc[row].items()] for row in rows]


def variations(scene_file: str, settings: Sequence[Setting], draws: Sequence[Sequence[Setting]]) -> list[Any]:
    """Scenes of short runs of the continuum on the coarse mesh: half the load step, then the draws. [] without such a
    mesh.

    Raises SceneError, with posterior.csv, for a draw that the scene refuses.
    """
    keys = _diptych.read_changed_scene(scene_file, list(settings), True).dict()
    coarse, steps = keys["comparison"]["coarse_element_size"], keys["continuum"]
    if not coarse:
        return []
    common = [Setting(section, key, value, file="validation") for section, key, value in (
        ("continuum", "element_size", repr(coarse)), ("comparison", "coarse_element_size", "0"),
        ("output", "report", "false"), ("comparison", "band_resamples", "0"), ("comparison", "probe_resamples", "0"))]
    halves = [Setting("continuum", key, repr(steps[key] / 2), file="validation")
              for key in ("min_step", "initial_step", "max_step")]
    return [_diptych.read_changed_scene(scene_file, [*settings, *common, *more], True) for more in (halves, *draws)]


def respond(members: Runs, member: SceneRun, scenes: Sequence[Any], is_new: bool, options: Options) -> dict[str, Any]:
    """Runs the variations on the grains of a finished member. Returns its seed, hashes of the scenes, and values of
    quantities, a row per run, None after a failure. is_new: the member has just run; else its earlier values count.

    Raises Stopped after a stop signal."""
    source = members.path(member)
    directory = os.path.join(members.directory, _FOLDER)
    runs = Runs(directory, members.crew, "runs of the continuum for the validation")
    if not scenes or not os.path.isdir(os.path.join(source, "coarse")):
        return NO_RUNS
    seed = member.scene.dict()["sample"]["seed"]
    changed = [run_on(scene, seed) for scene in scenes]
    names = [run.name for run in changed]
    if not is_new and os.path.exists(os.path.join(members.directory, "ensemble.json")):
        earlier = read_ensemble(members.directory)["continuum_runs"]
        if earlier["scenes"] == names:
            return earlier
    for run in changed:
        if not os.path.isdir(runs.path(run)):
            _copy_grains(source, runs.path(run))
            runs.begin(run)
    outcomes = runs.finish(changed, options, "stopped on request; the seeds are done")
    found = [{} if outcomes[run.name].exit_code else
             _compared(member_of(read_json(runs.path(run, "/comparison.json")), run.scene.is_mirror_symmetric()))
             for run in changed]
    if all(found):
        shutil.rmtree(runs.directory)
    quantities = sorted(set().union(*found))
    return {"seed": seed, "scenes": names, "quantities": quantities,
            "values": [[values.get(name) for name in quantities] for values in found]}


def _copy_grains(source: str, folder: str) -> None:
    """A result folder with the grains of another, for --resume. A finished file is never written again, so links
    suffice."""
    part = folder + ".part"
    shutil.rmtree(part, ignore_errors=True)
    os.makedirs(part)
    for name in ("discrete.h5", "discrete.csv", "scene.prm"):
        os.link(os.path.join(source, name), os.path.join(part, name))
    _diptych.copy_record(source, part)
    for name in ("continuum", "continuum_coarse", "comparison"):
        _diptych.forget_fact(part, name)
    os.rename(part, folder)


def _compared(member: Member) -> dict[str, float]:
    """The numbers of the continuum that verdicts compare."""
    compared = [number_name("continuum", key, window) for key, window in compared_by(member.windows)]
    return {name: member.value(name) for name in compared if name in member.numbers}


def compared_by(windows: Sequence[str]) -> list[tuple[str, str]]:
    """(key, window) of every compared quantity; those of a panel's whole run have no window."""
    of_bands = [(key, window) for window in windows for key in QUANTITIES if key not in OF_PANEL]
    return [*((key, "") for key in OF_PANEL), *of_bands]
