# diptych: the command element: grains and the law's point along one path
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the grains of every seed and the law's point, and writes element.csv, element.json and report.html."""

import argparse
import math
import os
import shlex
from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd

from ... import _diptych
from ...arrays import Interval
from ...compiled import continuum
from ...entries import describe
from ...errors import NotConverged, SceneError
from .curves import key_numbers, observed, rms_differences, table_of
from ..runs.engine import WRONG_INPUT, Options, columns_text, complain, say
from ..runs.folders import Folder, Runs, SceneRun, draw, write_json, write_text
from ..runs.histories import panel_table
from ..runs.input_file import Setting, seeds_of_line, settings_of
from ..studies.points import on_sample, scene_run

describe("element.json", """\
format: version of this file's format
scene (text): name of the scene
revision (text): revision of the program
command (text): command line
bins: parts of the path over which the curves are averaged
parameters_from (text): origin of the law's parameters; empty: the scene sets the law and says nothing
warning (text): reason why the law cannot follow the path; empty: none is known
seeds (list): requested samples
done (list): samples with results
walk (text): loading variable: path, axial_strain, shear_strain or time
failed/: samples that ended before the end of the path
    seed: seed of the sample
    message (text): reason
law/: the law's point
    failure (text): reason why it ended before the end of the path; empty: it did not
quantities/: key numbers, each with its unit
    quantity (text): peak stress_ratio: largest mean over comparison/averaging_strain; friction angle of the peak: its \
        arcsine; last NAME: in the last row of the histories, NAME as in element.csv
    unit (text): unit of the numbers; P: pressure of the start
    grains (interval) [as unit says]: mean over the samples (Student)
    law [as unit says]: of the law; null where it has none
    difference (interval) [as unit says]: law minus grains
rms/: differences over the whole path
    quantity (text): a NAME of element.csv
    unit (text): unit of the numbers
    value [as unit says]: root mean square of law minus mean of the grains
    error [as unit says]: its standard error, jackknife over the samples
    noise [as unit says]: root mean square of the standard errors of the grains
""")

describe("element.csv", """\
progress [strain or time]: middle of the part of the path to which the row belongs; parts end at the rows of the path
grains_NAME [as in both panels' tables]: mean over the samples. NAME: stress_ratio, mean_stress [P], \
    volumetric_strain, stress_direction, fabric_anisotropy, fabric_direction, coordination, solid_fraction, sxx, syy, \
    sxy, exx, eyy, exy
grains_NAME_error [as grains_NAME]: standard error of this mean; nan for one sample
law_NAME [as grains_NAME]: of the law's point, which has no fabric and no contacts
""")


def _run(scene: str, command: str, settings: Sequence[Setting]) -> SceneRun:
    run = scene_run(scene, command, settings)
    if run.refusal:
        raise SceneError(run.refusal)
    return run


def _done(runs: Runs, wanted: Sequence[SceneRun], options: Options) -> list[str]:
    """Does the runs and returns why each ended early; empty: it did not. Raises SceneError (wrong input) or Stopped."""
    outcomes = runs.finish(wanted, options)
    for run in wanted:
        if outcomes[run.name].exit_code == WRONG_INPUT:
            raise SceneError(runs.last_words(run))
    return [runs.failure(run) for run in wanted]


def _law_settings(settings: Sequence[Setting], scene: Any, tables: Sequence[pd.DataFrame]) -> list[Setting]:
    """With the mean solid fraction of the samples, if the law needs one and the scene leaves it to the grains."""
    law = scene.dict()["continuum"]
    if law["solid_fraction_start"] != "auto" or not continuum("element").follows_solid_fraction(law["hardening"]):
        return list(settings)
    start = sum(float(table["solid_fraction"].iloc[0]) for table in tables) / len(tables)
    return [*settings, Setting("continuum", "solid_fraction_start", repr(start), file="the grains")]


def _text(numbers: Sequence[Mapping[str, Any]]) -> str:
    """The table of a terminal."""
    return columns_text([["", "grains [95 %]", "law", "law - grains [95 %]"],
                         *([one["quantity"], one["grains"].text(), Interval(one["law"], math.nan, math.nan).text(),
                            one["difference"].text()] for one in numbers)])


def run_element(line: argparse.Namespace, options: Options) -> None:
    """diptych element SCENE. line: target, seeds, output, set, set_file. Raises NotConverged if a run ended before the
    end of the path, or Stopped."""
    settings = settings_of(line.set, line.set_file)
    scene = _diptych.read_changed_scene(line.target, settings, False)
    if scene.dict()["discrete"]["lateral"] != "cell":
        raise SceneError(f"{line.target}: discrete/lateral = {scene.dict()['discrete']['lateral']}; an element test "
                         "needs discrete/lateral = cell and loading/mode = path")
    if scene.dict()["continuum"]["k0"] != 1:
        raise SceneError(f"{line.target}: continuum/k0 = {scene.dict()['continuum']['k0']}: the grains start at the "
                         "isotropic pressure; `diptych material-point` runs the law alone")
    seeds = seeds_of_line(line.seeds) if line.seeds else [scene.dict()["sample"]["seed"]]
    grains = [_run(line.target, "discrete", on_sample(settings, seed, line.target)) for seed in seeds]
    _run(line.target, "material-point", settings)  # a wrong law is refused before the grains run
    if warning := scene.reversal_warning():
        complain(f"diptych: warning: {scene.dict()['loading']['path']}: {warning}")
    directory = line.output or f"results/{scene.name}_element"
    with Folder(directory) as folder:
        runs = folder.open_runs("element", line.target, options,
                                lambda: [("the scene", line.target), *scene.input_files()])
        failures = _done(runs, grains, options)
        found = {seed: panel_table(runs.path(run), "discrete") for seed, run in zip(seeds, grains)}
        tables = {seed: table for seed, table in found.items() if table is not None}
        if not tables:
            raise NotConverged(f"{failures[0]}; to go on: {options.again}")
        law = _run(line.target, "material-point", _law_settings(settings, scene, list(tables.values())))
        [failure] = _done(runs, [law], options)
        point = panel_table(runs.path(law), "material_point")
        curves, origin = observed(scene, list(tables.values()), point), scene.dict()["comparison"]["parameters_from"]
        record = {"format": 2, "scene": scene.name, "revision": _diptych.git_revision, "bins": len(curves.progress),
                  "seeds": seeds, "done": list(tables), "walk": scene.loading_variable(), "law": {"failure": failure},
                  "parameters_from": origin, "warning": warning,
                  "failed": [{"seed": seed, "message": text} for seed, text in zip(seeds, failures) if text],
                  "quantities": key_numbers(curves), "rms": rms_differences(curves),
                  "command": shlex.join(["diptych", *options.words])}
        write_text(os.path.join(directory, "element.csv"), table_of(curves).to_csv(index=False, float_format="%.10g"))
        write_json(os.path.join(directory, "element.json"), record)
        draw(options, directory, "element")
        say(options, _text(record["quantities"]))
        say(options, _diptych.origin_of_law(origin))
    ends = [f"{name} ended before the end of the path: {text}" for name, text in
            [*((f"seed {one['seed']}", one["message"]) for one in record["failed"]), ("the law", failure)] if text]
    if ends:
        raise NotConverged("; ".join(ends))
