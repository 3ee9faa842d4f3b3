# diptych: folders of campaigns: lock, result files, and the runs in them
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A campaign writes one folder at a time. Its runs are in DIR/runs/NAME, with NAME.prm, NAME.log and NAME.json beside
it."""

from __future__ import annotations

import json
import os
import resource
import shlex
import shutil
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import h5py
import numpy as np

from ... import _diptych
from ...arrays import plain
from ...errors import NotConverged, SceneError, Stopped
from ...files import part_of, read_json
from .engine import (DONE, WRONG_INPUT, Crew, Options, Outcome, Run, complain, execute, last_words, n_seats, say,
                     stops_raised)

LAST_CODE_OF_A_RESULT = 3  # higher codes: the system failed, or a signal came


class Folder:
    """A folder locked for this process and its workers. Errors that are neither wrong input nor our own say what is
    kept."""

    crew: Crew | None = None  # of open_runs(); it ends before the lock

    def __init__(self, directory: str) -> None:
        self.directory = directory
        self._lock = _diptych.FolderLock(directory)

    def __enter__(self) -> Folder:
        return self

    def __exit__(self, kind: Any, error: BaseException | None, trace: Any) -> None:
        if self.crew:
            self.crew.close()
        kept = _diptych.kept_in(self.directory) if isinstance(error, (OSError, RuntimeError)) else ""
        self._lock.release()
        if kept:
            kind = type(error) if isinstance(error, (Stopped, NotConverged)) else RuntimeError
            raise kind(f"{error}; {kept}") from error

    def set_aside(self, inputs: Iterable[tuple[str, str]]) -> None:
        """Renames the results to DIRECTORY.1. Refuses to move one of the inputs: (what it is, path)."""
        self._lock.set_aside(list(inputs))

    def open_runs(self, noun: str, input_file: str, options: Options, inputs: Callable[[], list[tuple[str, str]]],
                  text: str = "", *, copy: str = "") -> Runs:
        """Prepares the folder for runs; writes text, or a copy of the input file, there as `copy`; without it as
        NOUN_input.json (with text) or with the ending of the file. Raises SceneError for other results."""
        ending = ".json" if text else os.path.splitext(input_file)[1]
        copy = os.path.join(self.directory, copy or f"{noun}_input{ending}")
        _diptych.require_usable(self.directory, options.resume, options.overwrite)
        if not text:
            with open(input_file, encoding="utf-8") as file:
                text = file.read()
        if options.overwrite and not _diptych.is_empty_folder(self.directory):
            self.set_aside(inputs())
        if not _diptych.is_empty_folder(self.directory) and not os.path.exists(copy):
            raise SceneError(f"the folder '{self.directory}' holds other results and no {noun}. Name another folder.")
        write_text(copy, text)
        os.makedirs(os.path.join(self.directory, "runs"), exist_ok=True)
        self.crew = Crew(options, self._lock.descriptor)
        return Runs(self.directory, self.crew)


def write_text(path: str, text: str) -> None:
    """Writes PATH.part and renames it."""
    with part_of(path) as part, open(part, "w", encoding="utf-8") as file:
        file.write(text)


def write_json(path: str, record: Mapping[str, Any], indent: int | None = 1) -> None:
    """Writes a record with sorted keys."""
    write_text(path, json.dumps(plain(record), indent=indent, sort_keys=True, ensure_ascii=False) + "\n")


def write_arrays(path: str, arrays: Mapping[str, tuple[Any, str, str, str]],
                 attributes: Mapping[str, Mapping[str, float]]) -> None:
    """Writes HDF5 with checksums. arrays: name -> (values, title, unit, meaning); attributes: group -> name ->
    value."""
    with part_of(path) as part, h5py.File(part, "w", libver=("v110", "v110")) as file:
        for name, (values, *words) in arrays.items():
            data = file.create_dataset(name, data=values, fletcher32=np.size(values) > 0 or None)
            data.attrs.update(zip(("title", "unit", "meaning"), map(np.bytes_, words)))
        for group, numbers in attributes.items():
            file.require_group(group).attrs.update(numbers)


def record_phase(folder: str, phase: str, began: os.times_result, origin: tuple[str, list[int]],
                 options: Options) -> None:
    """Adds a phase with its costs to provenance.json. began: os.times() at its start. origin: scene and seeds."""
    end = os.times()
    cost = (phase, end.elapsed - began.elapsed, sum(end[:4]) - sum(began[:4]),  # with the CPU time of the workers
            resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)
    _diptych.record_phase(folder, (*origin, shlex.join(["diptych", *options.words])), cost)


def draw(options: Options, directory: str, *pages: str) -> None:
    """Draws report.html of a folder, and more: DRAWINGS of diptych.report. Raises ValueError, OSError, ImportError or
    Stopped."""
    from ... import report  # matplotlib loads only now

    try:
        with stops_raised(f"drawing the report: stopped on request; to draw it: diptych report {directory}"):
            for page in pages:
                report.draw(page, directory)
    except (ValueError, OSError, ImportError) as error:
        raise type(error)(f"{directory}: the report could not be drawn: {error}") from error
    say(options, f"report: {os.path.abspath(directory)}/report.html")


@dataclass(kw_only=True)
class SceneRun:
    """One scene that a command runs. Without a scene its settings contradict each other, and `refusal` is the
    message."""

    command: str
    name: str
    scene: Any = None
    refusal: str = ""
    label: str = ""  # in messages instead of the name


def run_name(scene: Any, command: str) -> str:
    """A hash of scene and command. It omits keys that change no result, and depends on no folder of the scene's
    files."""
    if command == "run":
        identity = {**scene.identity("member"), "sample/seed": str(scene.dict()["sample"]["seed"])}
    else:
        identity = scene.identity("sample" if command == "discrete" else "continuum")
    return _diptych.digest(command + "\n" + "".join(f"{key} = {identity[key]}\n" for key in sorted(identity)))


def run_on(scene: Any, seed: int, label: str = "") -> SceneRun:
    """Both panels of a scene on the sample with a seed."""
    own = scene.in_folder(scene.directory, scene.name, seed)
    return SceneRun(command="run", name=run_name(own, "run"), scene=own, label=label)


class Runs:
    """The runs in a campaign's folder, or in a folder within it. noun: for the line of progress."""

    def __init__(self, directory: str, crew: Crew, noun: str = "runs") -> None:
        self.directory, self.crew, self.noun = directory, crew, noun

    def path(self, run: SceneRun, ending: str = "") -> str:
        """The result folder of a run; with an ending a file beside it: ".prm", ".log", ".json"."""
        return os.path.join(self.directory, "runs", run.name + ending)

    def last_words(self, run: SceneRun) -> str:
        """The last line of its log, without the folder of the campaign."""
        return last_words(self.path(run, ".log")).replace(f" {self.directory}/", " ")

    def failure(self, run: SceneRun) -> str:
        """The reason why a run that was done has no result; empty: it has one."""
        end = self.found_end(run) if run.scene is not None else None
        if end and end["exit_code"] == DONE:
            return ""
        return run.refusal or (self.last_words(run) if end else "") or "the run was lost"

    def found_end(self, run: SceneRun) -> dict[str, Any] | None:
        """exit_code, load and at_once of a run that need not be done again.

        None: it has not ended; a signal or the system ended it; program, scene or files differ. The user may have run
        another scene in this folder, or copied another run there.
        """
        try:
            end, file = read_json(self.path(run, ".json")), os.path.join(self.path(run), "scene.prm")
            if os.path.exists(file):
                found, asked = _diptych.resolved_scene(file), _diptych.resolved_scene(self.path(run, ".prm"))
                is_same = found and asked and run_name(found, run.command) == run_name(asked, run.command)
            else:
                is_same = end["exit_code"] == WRONG_INPUT  # refused before it wrote
            for part in ("", "comparison") if is_same else ():
                _diptych.check_part(self.path(run), part)
            good = is_same and end["exit_code"] <= LAST_CODE_OF_A_RESULT and end["revision"] == _diptych.git_revision
            return {"exit_code": end["exit_code"], "load": end["load"], "at_once": end["at_once"]} if good else None
        except (ValueError, KeyError, TypeError, RuntimeError):  # damaged or of another version: run it again
            return None

    def prepare(self, run: SceneRun, anew: bool = False) -> tuple[bool, str]:
        """Writes the scene of a run and removes an old log. Returns True if an earlier run in the folder can be
        resumed.

        Only a folder in which this revision of the program was interrupted stays, and not if `anew`. Another one is
        renamed to NAME.1, in the place of an older one, since the user may have files in it. The second value is then
        its revision. Raises RuntimeError if another process writes to it.
        """
        try:
            earlier = read_json(self.path(run, ".json"))
        except ValueError:
            earlier = {}
        folder, revision = self.path(run), ""
        if os.path.exists(folder) and (anew or "exit_code" in earlier or earlier.get("begun") != _diptych.git_revision):
            _diptych.require_unlocked(folder)
            if os.path.exists(folder + ".1"):
                shutil.rmtree(folder + ".1")
            os.rename(folder, folder + ".1")
            revision = earlier.get("revision", earlier.get("begun", "unknown"))
        if os.path.exists(self.path(run, ".log")):
            os.remove(self.path(run, ".log"))
        write_text(self.path(run, ".prm"), run.scene.text())
        self.begin(run)
        return os.path.exists(folder), revision

    def begin(self, run: SceneRun) -> None:
        """Notes that this revision began the run, whose folder can then be resumed."""
        write_json(self.path(run, ".json"), {"begun": _diptych.git_revision}, None)

    def do(self, runs: Sequence[SceneRun], options: Options) -> dict[str, Outcome]:
        """Does the runs that are not finished, each name once. Runs whose checkpoint is damaged begin anew. Returns the
        outcomes by name, also of those that were finished."""
        different = {run.name: run for run in runs if run.scene is not None}
        ends = {name: self.found_end(run) for name, run in different.items()}
        finished = {name: Outcome(exit_code=end["exit_code"], interrupted=False) for name, end in ends.items() if end}
        if options.resume and finished:
            say(options, f"{len(finished)} of {len(ends)} runs are finished in {self.directory}: not run again")
        pending = [run for name, run in different.items() if name not in finished]
        return finished | self._execute(pending, options, len(ends))

    def finish(self, runs: Sequence[SceneRun], options: Options, why: str = "stopped on request") -> dict[str, Outcome]:
        """Does the runs like do(). Raises Stopped with this reason after a stop request."""
        outcomes = self.do(runs, options)
        if any(outcome.interrupted for outcome in outcomes.values()):
            raise Stopped(why, options.again)
        return outcomes

    def _execute(self, runs: Sequence[SceneRun], options: Options, total: int,
                 anew: bool = False) -> dict[str, Outcome]:
        prepared, seats = [self.prepare(run, anew) for run in runs], n_seats(options)
        resumes = [goes_on for goes_on, _ in prepared]
        for revision, n in Counter(revision for _, revision in prepared if revision).items():
            why = "damaged or failed" if revision == _diptych.git_revision else f"of revision {revision}"
            complain(f"repeated runs ({why}): {n}; their folders {self.directory}/runs/NAME are kept as NAME.1")

        def is_damaged(k: int, outcome: Outcome) -> bool:
            return resumes[k] and not outcome.interrupted and outcome.exit_code == WRONG_INPUT

        def on_ended(k: int, outcome: Outcome) -> None:
            # load: processes ready to run, mean of the last minute
            if not outcome.interrupted and not is_damaged(k, outcome):
                write_json(self.path(runs[k], ".json"), {"exit_code": outcome.exit_code,
                                                         "revision": _diptych.git_revision,
                                                         "load": os.getloadavg()[0], "at_once": seats}, None)

        tasks = [Run(command=run.command, scene=self.path(run, ".prm"), name=run.scene.name,
                     label=run.label or run.name, folder=self.path(run), log=self.path(run, ".log"),
                     resume=goes_on and run.command != "material-point")
                 for run, goes_on in zip(runs, resumes)]
        outcomes = execute(tasks, options, self.crew, finished=total - len(runs), noun=self.noun, on_ended=on_ended)
        ended = {run.name: outcome for run, outcome in zip(runs, outcomes)}
        damaged = [run for k, run in enumerate(runs) if is_damaged(k, outcomes[k])]
        if damaged:
            complain(f"{len(damaged)} runs begin anew: their checkpoints are damaged")
            ended |= self._execute(damaged, options, total, anew=True)
        return ended
