# diptych: studies, ensembles, plans and calibrations from Python scripts
# SPDX-License-Identifier: LGPL-2.1-or-later
"""run(), study(), ensemble(), plan() and calibrate() do what the commands do, and return their results."""

import itertools
import json
import os
import subprocess
import tempfile
import time
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from numbers import Integral
from typing import Any, Self, TypeVar

import pandas as pd

from .. import _diptych
from ..compiled import demand_continuum
from ..errors import NotConverged, SceneError, Stopped
from ..files import member_folders, read_ensemble
from ..results import Results, load
from ..scenes import SceneLike, changes, read, text_of
from ..summaries import Summary
from .commands import do
from .runs.engine import NOT_CONVERGED, WRONG_INPUT, environment, program, stop_signals
from .runs.folders import read_json

PathLike = str | os.PathLike[str]


@dataclass(repr=False)
class CampaignResult:
    """A folder with results. numbers: its JSON file, whose keys `diptych explain results` describes."""

    folder: str
    numbers: dict[str, Any]

    _files = ()

    @classmethod
    def load(cls, folder: PathLike) -> Self:
        """Reads a folder. Raises ValueError if it has no such results."""
        folder = os.fspath(folder)
        paths = [os.path.join(folder, name) for name in cls._files]
        return cls(folder, read_json(next(filter(os.path.exists, paths), paths[-1])))

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.folder!r})"


Result = TypeVar("Result", bound=CampaignResult)


class Campaign(CampaignResult):
    """Results of a study or an ensemble. Columns are those of `diptych explain results`, too.

    numbers  study.json or ensemble.json
    table    study.csv (a row per point and sample) or ensemble.csv (a row per quantity)
    cost     study_cost.json; empty for an ensemble
    """

    _files = ("study.json", "ensemble.json")

    def __init__(self, folder: str, numbers: dict[str, Any]) -> None:
        super().__init__(folder, numbers)
        is_study = "points" in numbers
        self.table = pd.read_csv(os.path.join(folder, "study.csv" if is_study else "ensemble.csv"),
                                 float_precision="round_trip")
        self.cost = read_json(os.path.join(folder, "study_cost.json")) if is_study else {}

    @property
    def points(self) -> pd.DataFrame:
        """A study with a reference: the points with class, certainty and the mean error of each quantity."""
        if "points" not in self.numbers:
            raise AttributeError("an ensemble has no points; use .verdicts or .table")
        if self.numbers.get("changes"):
            raise AttributeError("a study without a reference has no errors; use .effects, .changes or .table")
        names = [quantity["name"] for quantity in self.numbers["quantities"]]
        return pd.DataFrame([{"family": point["family"], "settings": "; ".join(point["settings"]),
                              "class": point["class"], "certain": point["certain"],
                              **{name: one["error"]["value"] for name, one in zip(names, point["quantities"])}}
                             for point in self.numbers["points"]])

    def summary(self) -> pd.DataFrame:
        """An ensemble: rows and columns of Results.summary(), with means over the samples and 95 % intervals."""
        if "summary" not in self.numbers:
            raise AttributeError("a study has no summary; use .points or .table")
        table = pd.json_normalize(self.numbers["summary"], sep="_")
        table = table.rename(columns=lambda name: name.removesuffix("_value"))
        numbers = [of + end for of in ("grains", "continuum", "difference") for end in ("", "_low", "_high")]
        return Summary(table.set_index("quantity")[["unit", *numbers, "verdict"]].astype(dict.fromkeys(numbers, float)))

    @property
    def effects(self) -> pd.DataFrame:
        """A study without a reference, effects.csv: a row per point, quantity and panel. The values of the parameters
        come first, then quantity, panel, unit, n, mean, low and high (95 % interval), deviation (of one sample)."""
        if not self.numbers.get("changes"):
            raise AttributeError("no effects of parameters here; a study has them if it has no reference")
        return pd.read_csv(os.path.join(self.folder, "effects.csv"), float_precision="round_trip")

    @property
    def sensitivity(self) -> pd.DataFrame:
        """A study with ranges, sensitivity.csv: a row per quantity, panel and parameter with first and total index, the
        ends of their 95 % intervals, q2 and the number of points used."""
        if "sensitivity" not in self.numbers:
            raise AttributeError("no sensitivity indices here; a study has them if its file has ranges")
        return pd.read_csv(os.path.join(self.folder, "sensitivity.csv"), float_precision="round_trip")

    @property
    def changes(self) -> pd.DataFrame:
        """A study without a reference: a row per parameter, quantity and panel with change.value, change.low,
        change.high, verdict and samples_needed."""
        return pd.json_normalize(self.numbers.get("changes", []))

    @property
    def folders(self) -> dict[int, str]:
        """An ensemble: the result folder of each seed, for diptych.load()."""
        if "verdicts" not in self.numbers:
            raise AttributeError("a study has no members; the column folder of .table names its runs")
        folders = member_folders(read_ensemble(self.folder))
        return {seed: os.path.join(self.folder, one) for seed, one in folders.items()}

    @property
    def verdicts(self) -> pd.DataFrame:
        """An ensemble: the differences continuum minus grains, with margins and verdicts."""
        if "verdicts" not in self.numbers:
            raise AttributeError("a study has no verdicts; use .points or .table")
        table = pd.json_normalize(self.numbers["verdicts"])
        first = ["quantity", "verdict", "difference.value", "difference.low", "difference.high"]
        return table[[*first, *table.columns.drop(first)]]


class CalibrationResult(CampaignResult):
    """Results of a calibration: calibration.json. The folder also holds calibrated.prm."""

    _files = ("calibration.json",)

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


class PlanResult(CampaignResult):
    """A plan: plan.json. The folder also holds planned.prm."""

    _files = ("plan.json",)

    @property
    def panels(self) -> pd.DataFrame:
        """A row per panel: command, seeds, CPU time of one sample [s], settings, whether it reaches the accuracy."""
        return pd.DataFrame(self.numbers["panels"])

    @property
    def errors(self) -> pd.DataFrame:
        """A row per panel, quantity and cause: error, bias and deviation, relative to the mean."""
        return pd.DataFrame([{"panel": panel["panel"], "quantity": q["name"], **part}
                             for panel in self.numbers["panels"] for q in panel["quantities"] for part in q["parts"]])


@contextmanager
def _file_of(command: str, holds_scene: bool, contents: Mapping[str, Any] | PathLike, output: str) -> Iterator[str]:
    """A path as it is. A dict is a file of the working directory during the call, called like the output folder."""
    if not isinstance(contents, Mapping):
        yield os.fspath(contents)
        return
    name, record = os.path.basename(os.path.normpath(output)), {}
    if not holds_scene:
        record = {"title": name, **contents} if command == "calibrate" or "reference" in contents else contents
    else:
        for section, key, text in changes(contents):
            record.setdefault(section, {})[key] = text
    text, names = json.dumps(record, indent=1, default=os.fspath), (f"{name}_{k}.json" for k in itertools.count(2))
    path = next(path for path in itertools.chain([name + ".json"], names) if not os.path.lexists(path))
    with open(path, "x", encoding="utf-8") as file:
        file.write(text)
    try:
        yield path
    finally:
        os.remove(path)


def _seeds(seeds: Any) -> str:
    """Seeds as on the command line. Refuses a number, which could be one seed or a number of samples."""
    if isinstance(seeds, Integral):
        raise SceneError(f"seeds = {seeds} is not allowed; give range(1, {seeds + 1}) for {seeds} samples, [{seeds}] "
                         f"for the sample with seed {seeds}", "seeds")
    text = text_of(seeds).replace(" ", "")
    return f"{text}-{text}" if text.isdigit() and not isinstance(seeds, str) else text


def _words(output: str, options: dict[str, Any]) -> list[str]:
    """Options of a call as those of the command line."""
    words = ["--output", output, "--quiet"]
    for name, value in options.items():
        if name in ("set", "vary"):
            words += [word for key, one in value.items() for word in ("--" + name, f"{key}={text_of(one)}")]
        elif value is not False:
            words += ["--" + name] + ([] if value is True else [_seeds(value) if name == "seeds" else str(value)])
    return words


def _result(kind: type[Result], command: str, contents: Mapping[str, Any] | PathLike, output: PathLike,
            options: dict[str, Any]) -> Result:
    """Does a command in this process. On Ctrl-C it keeps what is done and raises Stopped."""
    output, holds_scene = os.fspath(output), bool(options.get("vary")) or command not in ("study", "calibrate")
    words = _words(output, options)
    with _file_of(command, holds_scene, contents, output) as file, stop_signals():
        try:
            do([command, file, *words])
        except Stopped as stopped:
            raise Stopped(f"{stopped.why}; the same call with resume=True goes on") from None
        except NotConverged as error:
            raise NotConverged(f"{error}; {kind.__name__}.load('{output}') reads what is there") from None
    return kind.load(output)


def run(scene: SceneLike, output: PathLike = "", **options: Any) -> Results:
    """Computes grains and continuum of one sample, compares them, writes a folder and returns its Results.

    scene    path of a scene file, or a dict as in diptych.scene()
    output   folder of the results; default: as `diptych run`, results/NAME of NAME.prm
    options  those of `diptych run`: threads=2, resume=True, overwrite=True, set={"section/key": value}

    Many samples: ensemble(). Raises SceneError for wrong input, Stopped on Ctrl-C (resume=True then goes on),
    NotConverged if a panel does not converge, RuntimeError for failures of the system.

    >>> run("mine.prm", set={"discrete/friction": 0.3}).summary()
    """
    if "seeds" in options:
        raise SceneError("run: computes one sample; diptych.ensemble(scene, seeds, output) computes many", "seeds")
    demand_continuum("diptych.run")
    checked = read(scene, options.get("set", {}), True)
    folder = os.fspath(output) or checked.directory
    with _file_of("run", True, scene, folder) as file, stop_signals(), tempfile.TemporaryFile("w+") as errors:
        process = subprocess.Popen([program(), "run", file, *_words(folder, options)], process_group=0,
                                   stdout=subprocess.DEVNULL, stderr=errors, env=environment())
        while process.poll() is None:
            time.sleep(0.05)
            if _diptych.stop_requested():
                process.terminate()
        errors.seek(0)
        text = errors.read().strip().removeprefix("diptych: ")
        if process.returncode == WRONG_INPUT:
            raise SceneError(text)
        if process.returncode and _diptych.stop_requested():  # without a text: a signal killed it as it started
            raise Stopped(text or f"run: stopped on request; {folder} keeps what was written, and resume=True goes on")
        if process.returncode:
            raise (NotConverged if process.returncode == NOT_CONVERGED else RuntimeError)(text)
    return load(folder)


def study(contents: Mapping[str, Any] | PathLike, output: PathLike, **options: Any) -> Campaign:
    """Runs a study and returns its results.

    contents  path of a study file, or its contents as a dict, whose paths are relative to the working directory
              Seeds are a text such as "1-8", a list or a range
    output    folder of the results
    options   those of `diptych study`: jobs=2, threads=1, resume=True, overwrite=True, set={"section/key": value}
              With vary={"discrete/friction": [0.2, 0.3]} the contents are a scene: a path, or a dict as in
              diptych.scene(). seeds=range(1, 4) are then the samples of each point, panels="discrete" runs one panel
              levels="auto" adds means of the grains in the limit of short steps

    A dict is a file of the working directory during the call, OUTPUT.json; messages name it with its lines. They also
    name the options of the command line: for --resume add resume=True to the same call.

    Raises SceneError for wrong input, Stopped on Ctrl-C (resume=True then goes on), NotConverged if runs were stopped
    or the system ended them, RuntimeError for failures of the system.
    """
    if isinstance(contents, Mapping) and "seeds" in contents:
        contents = {**contents, "seeds": _seeds(contents["seeds"])}
    return _result(Campaign, "study", contents, output, options)


def ensemble(scene: SceneLike, seeds: str | Iterable[int], output: PathLike, **options: Any) -> Campaign:
    """Runs a scene with several seeds and returns the statistics. Options and errors are as in study().

    scene  path of a scene file, or a dict as in diptych.scene()
    seeds  range(1, 9), a list of numbers, or a text such as "1-8" or "1,3,5-7"
    """
    return _result(Campaign, "run", scene, output, {"seeds": seeds, **options})


def calibrate(contents: Mapping[str, Any] | PathLike, output: PathLike, **options: Any) -> CalibrationResult:
    """Runs a calibration file, or its contents as a dict, and returns its results. Options and errors: see study().

    A scene file (.prm) with seeds=range(1, 5) takes the standard parameters."""
    return _result(CalibrationResult, "calibrate", contents, output, options)


def plan(scene: SceneLike, accuracy: float | str, output: PathLike, **options: Any) -> PlanResult:
    """Plans a scene, a path or a dict, for a relative accuracy of the mean: 0.001 to 0.5, or a text such as "3 %".

    Options and errors are as in study(), with run=True for the planned samples and **{"for": "strength,angle"} for the
    quantities. Raises NotConverged if the accuracy is not reached; PlanResult.load() then reads the plan."""
    return _result(PlanResult, "plan", scene, output, {"accuracy": text_of(accuracy), **options})
