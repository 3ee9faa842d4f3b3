# diptych: the command calibrate: parameters of a continuum from grains or curves, or of grains from curves
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Four phases: reading.py checks and takes the data, trials.py searches, posterior.py samples the posterior of the
parameters, findings.py computes the effect of load steps half as long and predictions on paths that were not fitted."""

from __future__ import annotations

import argparse
import json
from typing import Any

import numpy as np
import pandas as pd

from ...errors import NotConverged, Stopped
from ..runs.engine import Options, say, tell
from ..runs.folders import Folder, draw
from .calibration_file import read_calibration
from .calibration_runs import CalibrationRuns
from .findings import posterior_table, predict, report, summary, write_calibration
from .grains import GrainRuns
from .posterior import sample_posterior
from .reading import check_data, checked, inputs_of, standard_contents
from .trials import Trials, search


def empty_record(title: str, model: str = "continuum") -> dict[str, Any]:
    """calibration.json before the search. model: "grains" if their keys are fitted."""
    return {"format": 1, "title": title, "model": model, "status": "started", "settings": [], "own": [],
            "chi2_before": np.nan,
            "chi2_coarse": np.nan, "chi2": np.nan, "n_observables": 0, "coarse_runs": 0, "fine_runs": 0,
            "failed_runs": 0, "other_runs": 0, "noise": {}, "words": [], "parameters": [], "correlation": [],
            "emulator": {}, "discrepancy": {}, "minima": [], "paths": []}


def calibrate(trials: Trials) -> pd.DataFrame:
    """Fills the record; returns the draws of the posterior. Raises NotConverged if no start has a run."""
    fine, coarse = search(trials)
    draws = sample_posterior(trials, fine)
    report(trials, fine, coarse, draws)
    predict(trials, fine.point, fine.jacobian, draws)
    trials.record["status"] = "finished"
    return posterior_table(trials.coordinates, draws.points)


def run_calibration(line: argparse.Namespace, options: Options) -> None:
    """The command `diptych calibrate FILE`, or SCENE with --seeds. line: target, seeds, set, set_file and output.
    Raises Stopped or NotConverged, with the best point so far in the folder."""
    contents = standard_contents(line)
    text = json.dumps(contents, indent=1) + "\n" if contents else ""
    calibration = read_calibration(line.target, contents)
    coordinates = checked(calibration)
    directory = line.output or f"results/{calibration.name}_calibration"
    record, posterior = empty_record(calibration.title, "grains" if calibration.of_grains else "continuum"), None
    ended: Stopped | NotConverged | None = None
    with Folder(directory) as folder:
        folder.open_runs("calibration", line.target, options, lambda: inputs_of(calibration), text)
        if contents:
            say(options, f"standard parameters: {directory}/calibration_input.json")
        runs = (GrainRuns if calibration.of_grains else CalibrationRuns)(calibration, directory, options)
        try:
            paths = runs.paths()
            check_data(calibration, paths, runs, record)
            posterior = calibrate(Trials(calibration, coordinates, paths, runs.evaluate, record))
        except (Stopped, NotConverged) as error:
            record["status"], ended = str(error), error
        write_calibration(directory, record, runs.cpu_s, posterior)
        if not ended:
            tell(summary(record, runs.cpu_s["discrete" if calibration.of_grains else "continuum"]))
            draw(options, directory, "calibration")
            say(options, f"{directory}/calibrated.prm, calibration.json, calibration.csv")
    if ended:
        raise type(ended)(f"{ended}; what was found is kept in {directory}; to go on: {options.again}")
