# diptych: studies, ensembles, plans and calibrations from Python scripts
# SPDX-License-Identifier: LGPL-2.1-or-later
"""study(), ensemble(), plan() and calibrate() run the program and return its tables as DataFrames."""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import pandas as pd

from ..errors import NotConverged, SceneError
from ..scenes import text_of
from .engine import DONE, NOT_CONVERGED, WRONG_INPUT, environment, program
from .folders import read_json


@dataclass(repr=False)
class Campaign:
    """Results of a campaign. The keys and columns are those of `diptych explain results`.

    numbers  study.json or ensemble.json
    table    study.csv (a row per point and sample) or ensemble.csv (a row per quantity)
    cost     study_cost.json; empty for an ensemble
    """

    folder: str
    numbers: dict[str, Any]
    table: pd.DataFrame
    cost: dict[str, Any]

    @staticmethod
    def load(folder: str | os.PathLike[str]) -> Campaign:
        """Reads the folder of a study or an ensemble. Raises ValueError if there is none."""
        folder = os.fspath(folder)
        kind = "study" if os.path.exists(os.path.join(folder, "study.json")) else "ensemble"
        path = os.path.join(folder, kind)
        return Campaign(folder, read_json(path + ".json"), pd.read_csv(path + ".csv", float_precision="round_trip"),
                        read_json(path + "_cost.json") if kind == "study" else {})

    @property
    def points(self) -> pd.DataFrame:
        """A study: the points with class, certainty and the mean error of each quantity."""
        names = [quantity["name"] for quantity in self.numbers["quantities"]]
        return pd.DataFrame([{"family": point["family"], "settings": "; ".join(point["settings"]), "class": point["class"],
                              "certain": point["certain"],
                              **{name: one["error"]["value"] for name, one in zip(names, point["quantities"])}}
                             for point in self.numbers["points"]])

    @property
    def verdicts(self) -> pd.DataFrame:
        """An ensemble: the differences continuum minus grains, with margins and verdicts."""
        return pd.json_normalize(self.numbers["verdicts"])

    def __repr__(self) -> str:
        return f"Campaign({self.folder!r}: {len(self.table)} rows)"


def _call(words: Sequence[str], output: str, options: Mapping[str, Any]) -> None:
    for name, value in options.items():
        if name == "set":
            words = [*words, *(word for key, to in value.items() for word in ("--set", f"{key}={text_of(to)}"))]
        elif value is True:
            words = [*words, "--" + name]
        elif value is not False:
            words = [*words, "--" + name, str(value)]
    done = subprocess.run([program(), *words, "--output", output, "--quiet"], env=environment(), stderr=subprocess.PIPE,
                          text=True, check=False)
    if done.returncode not in (DONE, NOT_CONVERGED) or not os.path.isdir(output):
        raise (SceneError if done.returncode == WRONG_INPUT else RuntimeError)(done.stderr.strip())
    if done.returncode == NOT_CONVERGED:
        raise NotConverged(f"{done.stderr.strip()}; load('{output}') of the result's class reads what is there")


def _call_with_file(command: str, contents: Mapping[str, Any] | str | os.PathLike[str], output: str,
                    options: Mapping[str, Any]) -> None:
    """Runs a command with a file, or with a file of these contents in the working directory, where their paths begin."""
    if not isinstance(contents, Mapping):
        return _call([command, os.fspath(contents)], output, options)
    with tempfile.NamedTemporaryFile("w", dir=".", prefix=command + "_", suffix=".json") as file:
        json.dump({"title": os.path.basename(os.path.normpath(output)), **contents}, file, indent=1, default=os.fspath)
        file.flush()
        return _call([command, file.name], output, options)


def study(contents: Mapping[str, Any] | str | os.PathLike[str], output: str | os.PathLike[str], **options: Any) -> Campaign:
    """Runs a study and returns its results.

    contents  path of a study file, or its contents as a dict, whose paths are relative to the working directory
    output    folder of the results
    options   those of `diptych study`: jobs=2, threads=1, resume=True, overwrite=True, set={"section/key": value}

    Raises SceneError for wrong input, NotConverged if runs were stopped or the system ended them, RuntimeError for
    failures of the system.
    """
    _call_with_file("study", contents, os.fspath(output), options)
    return Campaign.load(output)


def ensemble(scene: str | os.PathLike[str], seeds: str, output: str | os.PathLike[str], **options: Any) -> Campaign:
    """Runs a scene file with several seeds ("1-8") and returns the statistics. Options and errors are as in study()."""
    _call(["run", os.fspath(scene), "--seeds", seeds], os.fspath(output), options)
    return Campaign.load(output)


@dataclass(repr=False)
class CalibrationResult:
    """Results of a calibration. numbers: calibration.json, whose keys `diptych explain results` describes."""

    folder: str
    numbers: dict[str, Any]

    @staticmethod
    def load(folder: str | os.PathLike[str]) -> CalibrationResult:
        """Reads the folder of a calibration. Raises ValueError if there is none."""
        return CalibrationResult(os.fspath(folder), read_json(os.path.join(folder, "calibration.json")))

    def _of_paths(self, name: str) -> pd.DataFrame:
        return pd.DataFrame([{"path": path["name"], "use": path["use"], **one} for path in self.numbers["paths"]
                             for one in path[name]])

    @property
    def parameters(self) -> pd.DataFrame:
        """A row per parameter: key, value, number with its 95 % interval, share_known, is_identified, ..."""
        return pd.DataFrame(self.numbers["parameters"])

    @property
    def observables(self) -> pd.DataFrame:
        """A row per path and observable: mean of the grains, before, after, deviations."""
        return self._of_paths("observables")

    @property
    def predictions(self) -> pd.DataFrame:
        """A row per path and quantity, with the verdict."""
        return self._of_paths("predictions")

    def __repr__(self) -> str:
        return f"CalibrationResult({self.folder!r}: {self.numbers['status']}, chi2 = {self.numbers['chi2']})"


def calibrate(contents: Mapping[str, Any] | str | os.PathLike[str], output: str | os.PathLike[str],
              **options: Any) -> CalibrationResult:
    """Runs a calibration file, or its contents as a dict, and returns its results. Options and errors are as in study()."""
    _call_with_file("calibrate", contents, os.fspath(output), options)
    return CalibrationResult.load(output)


@dataclass(repr=False)
class PlanResult:
    """A plan. numbers: plan.json, whose keys `diptych explain results` describes. The folder also holds planned.prm."""

    folder: str
    numbers: dict[str, Any]

    @staticmethod
    def load(folder: str | os.PathLike[str]) -> PlanResult:
        """Reads the folder of a plan. Raises ValueError if there is none."""
        return PlanResult(os.fspath(folder), read_json(os.path.join(folder, "plan.json")))

    @property
    def panels(self) -> pd.DataFrame:
        """A row per panel: command, seeds, CPU time of one sample [s], settings, whether it reaches the accuracy."""
        return pd.DataFrame(self.numbers["panels"])

    @property
    def errors(self) -> pd.DataFrame:
        """A row per panel, quantity and cause: error, bias and deviation, relative to the mean."""
        return pd.DataFrame([{"panel": panel["panel"], "quantity": q["name"], **part}
                             for panel in self.numbers["panels"] for q in panel["quantities"] for part in q["parts"]])

    def __repr__(self) -> str:
        return f"PlanResult({self.folder!r}: {len(self.numbers['panels'])} panels, accuracy {self.numbers['accuracy']:g})"


def plan(scene: str | os.PathLike[str], accuracy: float, output: str | os.PathLike[str], **options: Any) -> PlanResult:
    """Plans a scene file for a relative accuracy of the mean, 0.001 to 0.5.

    Options and errors are as in study(), with run=True for the planned samples and **{"for": "strength,angle"} for the
    quantities. Raises NotConverged if the accuracy is not reached; PlanResult.load() then reads the plan."""
    _call(["plan", os.fspath(scene), "--accuracy", repr(float(accuracy))], os.fspath(output), options)
    return PlanResult.load(output)
