# diptych: the runs of a plan or a calibration in their folder: each is named by what it computes, and done once
# SPDX-License-Identifier: LGPL-2.1-or-later
"""DIR/runs/NAME is the result folder of a run. Beside it are its scene NAME.prm, its log NAME.log and its end NAME.json."""

from __future__ import annotations

import json
import math
import os
import shutil
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import _diptych
from ..errors import SceneError, Stopped
from . import engine
from .input_file import Setting

LAST_CODE_OF_A_RESULT = 3  # higher codes: the system failed, or a signal came


def plain(value: Any) -> Any:
    """A value for JSON: NaN and infinities become null, tuples and arrays lists."""
    if isinstance(value, dict):
        return {key: plain(entry) for key, entry in value.items()}
    if hasattr(value, "_asdict"):
        return plain(value._asdict())
    if isinstance(value, (list, tuple, np.ndarray)):
        return [plain(entry) for entry in value]
    if isinstance(value, np.generic):
        value = value.item()
    return None if isinstance(value, float) and not math.isfinite(value) else value


def write_text(path: str, text: str) -> None:
    """Writes path.part, then renames it."""
    with open(path + ".part", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(path + ".part", path)


def write_json(path: str, record: Any) -> None:
    write_text(path, json.dumps(plain(record), indent=1, sort_keys=True, ensure_ascii=False, allow_nan=False) + "\n")


def read_json(path: str) -> Any:
    """The contents of a JSON file; None if it is missing or damaged."""
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError):
        return None


def run_name(scene: _diptych.Scene, command: str) -> str:
    """The digest of command and of all values on which its results depend."""
    identity = scene.identity({"discrete": "sample", "run": "member"}.get(command, "continuum"))
    if command == "run":
        identity["sample/seed"] = str(scene.dict()["sample"]["seed"])
    return _diptych.digest(command + "\n" + "".join(f"{key} = {identity[key]}\n" for key in sorted(identity)))


@dataclass(frozen=True)
class PlannedRun:
    """A run with its scene, or the reason why the scene is refused."""

    command: str
    name: str = ""
    scene: Any = None
    refusal: str = ""


class RunStore:
    """The runs of one folder. What is finished there is not run again."""

    def __init__(self, directory: str, options: engine.Options) -> None:
        self.directory, self.options, self.counted = directory, options, set()

    def path(self, run: PlannedRun, ending: str = "") -> str:
        return f"{self.directory}/runs/{run.name}{ending}"

    def plan(self, command: str, scene_file: str, settings: Sequence[Setting]) -> PlannedRun:
        """A run of a scene with settings, of which the last of a key counts."""
        try:
            changes = [*settings, Setting("output", "report", "false", "")]
            scene = _diptych.read_changed_scene(scene_file, [tuple(one) for one in changes], command == "run")
            return PlannedRun(command, run_name(scene, command), scene)
        except SceneError as error:
            return PlannedRun(command, refusal=str(error))

    def end_of(self, run: PlannedRun) -> dict[str, Any] | None:
        """How the run ended; None if it must be done (again): it has not ended, a signal or the system ended it, program or scene
        differ, or its files have changed since."""
        end, scene_prm = read_json(self.path(run, ".json")), self.path(run, "/scene.prm")
        if not isinstance(end, dict) or end.get("revision") != _diptych.git_revision or end["exit_code"] > LAST_CODE_OF_A_RESULT:
            return None
        if not os.path.exists(scene_prm):
            return end if end["exit_code"] == engine.WRONG_INPUT else None  # refused before it wrote
        names = [run_name(found, run.command) if found else None
                 for found in map(_diptych.resolved_scene, (scene_prm, self.path(run, ".prm")))]
        try:
            _diptych.check_part(self.path(run), "")
            _diptych.check_part(self.path(run), "comparison")
        except ValueError:
            return None
        return end if names[0] is not None and names[0] == names[1] else None

    def failure(self, run: PlannedRun) -> str:
        """Why a run has no result; empty: it has one."""
        if run.refusal:
            return run.refusal
        end = self.end_of(run)
        if end is not None and end["exit_code"] == 0:
            return ""
        words = engine.last_words(self.path(run, ".log")) if end else ""
        return words.replace(self.directory + "/", "") or "the run was lost"

    def _prepare(self, run: PlannedRun) -> bool:
        """Writes the scene and removes an old log. The folder stays only if this revision of the program was interrupted in it. True
        if the run can be resumed."""
        begun = read_json(self.path(run, ".json"))
        if not isinstance(begun, dict) or begun.get("begun") != _diptych.git_revision:
            shutil.rmtree(self.path(run), ignore_errors=True)
        if os.path.exists(self.path(run, ".log")):
            os.remove(self.path(run, ".log"))
        write_text(self.path(run, ".prm"), run.scene.text())
        write_text(self.path(run, ".json"), json.dumps({"begun": _diptych.git_revision}) + "\n")
        return os.path.exists(self.path(run))

    def _execute(self, pending: Sequence[tuple[PlannedRun, bool]], finished: int) -> list[PlannedRun]:
        """Returns the runs whose checkpoint was refused. Raises Stopped after a stop request."""
        seats, damaged = engine.n_seats(self.options), []

        def on_ended(k: int, outcome: engine.Outcome) -> None:
            run, resumes = pending[k]
            if resumes and outcome.exit_code == engine.WRONG_INPUT:
                damaged.append(run)
            elif not outcome.interrupted:
                write_text(self.path(run, ".json"),
                           json.dumps({"exit_code": outcome.exit_code, "revision": _diptych.git_revision,
                                       "load": os.getloadavg()[0], "at_once": seats}) + "\n")

        runs = [engine.Run(run.command, self.path(run, ".prm"), self.path(run), self.path(run, ".log"),
                           ("--resume",) if resumes else ()) for run, resumes in pending]
        outcomes = engine.execute(runs, self.options, finished=finished, on_ended=on_ended)
        if any(outcome.interrupted for outcome in outcomes):
            raise Stopped("stopped on request")
        return damaged

    def do(self, asked: Sequence[PlannedRun]) -> None:
        """Does those runs that are not finished. Two of them may be the same. Raises Stopped after a stop request."""
        runs = list({run.name: run for run in asked if run.scene is not None}.values())
        missing = [run for run in runs if self.end_of(run) is None]
        damaged = self._execute([(run, self._prepare(run)) for run in missing], len(runs) - len(missing))
        for run in damaged:
            os.remove(self.path(run, ".json"))  # begins anew
        if damaged:
            self._execute([(run, self._prepare(run)) for run in damaged], len(runs) - len(damaged))

    def facts(self, run: PlannedRun) -> dict[str, Any]:
        """provenance.json of the run."""
        return read_json(self.path(run, "/provenance.json")) or {}

    def new_cpu_s(self, run: PlannedRun) -> float:
        """CPU time of all phases of the run [s]; 0 if it was counted before."""
        if run.name in self.counted:
            return 0.0
        self.counted.add(run.name)
        return sum(phase["cpu_s"] for phase in self.facts(run).get("phases") or [])


def in_folder(directory: str, noun: str, file: str, input_name: str, inputs: Sequence[tuple[str, str]], options: engine.Options,
              work: Callable[[], int]) -> int:
    """Locks and opens the folder of a `noun` ("plan"), copies its input `file` there as `input_name`, and does the work. Raises
    SceneError for a folder with other contents."""
    with open(file, encoding="utf-8") as source:
        text = source.read()
    lock = _diptych.FolderLock(directory)
    try:
        _diptych.require_usable(directory, options.resume, options.overwrite)
        if options.overwrite and not _diptych.is_empty_folder(directory):
            lock.set_aside(list(inputs))
        if not _diptych.is_empty_folder(directory) and not os.path.exists(f"{directory}/{input_name}"):
            raise SceneError(f"the folder '{directory}' holds other results and no {noun}. Name another folder.")
        write_text(f"{directory}/{input_name}", text)
        os.makedirs(directory + "/runs", exist_ok=True)
        engine.KEPT_OPEN.add(lock.descriptor)
        return work()
    finally:
        engine.KEPT_OPEN.discard(lock.descriptor)
        lock.release()
