# diptych: many runs of the program, on workers of this machine and of the other processes of mpirun
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A seat is a thread that takes one run after another.

A local seat holds a worker: a process of `diptych-panels` that does one command after another. A worker receives a line of JSON
and answers with the exit code on a line. Under mpirun each other process has a worker, and a seat here hands runs to it.
Results depend neither on the number of seats nor on the order of the runs.
"""

from __future__ import annotations

import json
import os
import queue
import select
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import Any

from .. import _diptych
from ..errors import Stopped

DONE, WRONG_INPUT, NOT_CONVERGED, SYSTEM_FAILURE = 0, 2, 3, 4  # exit codes of the program
THREADED = ("discrete", "run")  # commands with --threads
KEPT_OPEN: set[int] = set()  # descriptors that workers inherit: locks, which then hold until the last worker has ended
_JOB_VARIABLES = ("OMPI_", "PMIX_", "PMI_", "PRTE_", "ORTE_")


@dataclass
class Options:
    """Options that all campaigns share, with the meaning of `diptych study --help`."""

    jobs: int = 0  # runs at once; 0: as many as the cores allow, under mpirun 1
    threads: int = 1  # of the contact solver of each run
    quiet: bool = False
    resume: bool = False
    overwrite: bool = False
    command: str = ""  # the command line, for provenance.json


@dataclass(frozen=True)
class Run:
    """One run of the program."""

    command: str
    scene: str  # path of a .prm file
    folder: str  # result folder
    log: str  # output and errors are appended to this file
    extra: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """The name in messages: "seed 3"."""
        return os.path.basename(self.folder).replace("_", " ")

    def line(self, threads: int) -> str:
        """The task as a worker reads it."""
        words = [self.command, self.scene, "--quiet", "--output", self.folder, *self.extra]
        if self.command in THREADED:
            words += ["--threads", str(threads)]
        return json.dumps({"words": words, "log": self.log}) + "\n"


@dataclass
class Outcome:
    """The end of one run. Exit code 128 + signal: a signal ended its worker."""

    exit_code: int = 0
    interrupted: bool = True  # asked to stop, or never started
    seconds: float = 0.0
    message: str = ""  # last line of the log of a run that failed


def leave_if_stopped(phase: str) -> None:
    """Raises Stopped after Ctrl-C, SIGTERM or a closed terminal."""
    if _diptych.stop_requested():
        raise Stopped(f"{phase}: stopped on request")


def _write(stream: str, text: str) -> None:
    try:
        print(text, end="", file=getattr(sys, stream), flush=True)
    except OSError:  # a closed or full output must not stop the runs
        setattr(sys, stream, open(os.devnull, "w", encoding="utf-8"))


def say(options: Options, text: str) -> None:
    """Prints a line to standard output, unless --quiet."""
    if not options.quiet:
        _write("stdout", text + "\n")


def complain(text: str) -> None:
    """Prints a line to standard error."""
    _write("stderr", text + "\n")


def last_words(log: str) -> str:
    """The last line of a log that is not blank; empty if there is none."""
    if not os.path.exists(log):
        return ""
    with open(log, encoding="utf-8", errors="replace") as file:
        return ([""] + [line.rstrip("\r\n") for line in file if line.strip()])[-1]


def program() -> str:
    """Path of the program `diptych`: that which started this process, or the one of the package."""
    package = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))  # the folder that holds it
    places = [os.environ.get("DIPTYCH_PROGRAM", ""), os.path.join(package, "..", "diptych"),
              os.path.join(package, *[".."] * 3, "bin", "diptych")]
    for place in filter(os.path.isfile, places):
        return os.path.realpath(place)
    raise FileNotFoundError(f"the program diptych is neither {places[1]} nor {places[2]}; set DIPTYCH_PROGRAM to its path")


def panels() -> str:
    """Path of `diptych-panels`, beside the program or in PREFIX/libexec."""
    folder = os.path.dirname(program())
    places = [os.path.join(folder, "diptych-panels"), os.path.join(folder, "..", "libexec", "diptych", "diptych-panels")]
    for place in filter(os.path.isfile, places):
        return place
    raise FileNotFoundError(f"diptych-panels is not beside {program()}; the installation is broken")


def environment() -> dict[str, str]:
    """The environment without that of an MPI job, which would make a program one of its ranks."""
    return {name: value for name, value in os.environ.items()
            if name.startswith("OMPI_ALLOW_RUN_AS_ROOT") or not name.startswith(_JOB_VARIABLES)}


def run_program(words: Sequence[str]) -> int:
    """Runs a program with the output of this process; returns its exit code. On a stop request kills it and raises Stopped."""
    process = subprocess.Popen(words, env=environment(), stdin=subprocess.DEVNULL, process_group=0)
    while True:
        try:
            code = process.wait(0.02)
            leave_if_stopped(os.path.basename(words[0]))
            return code if code >= 0 else 128 - code
        except subprocess.TimeoutExpired:
            if _diptych.stop_requested():
                process.kill()


class Worker:
    """A process that does one run after another. It starts with the first run, and again if it died."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None

    def run(self, line: str) -> tuple[int, bool]:
        """Does a task; returns (exit code, whether it was asked to stop). 4: the worker ended without an answer."""
        if self._process is None or not self._send(line):
            self.close()
            # Its own process group: Ctrl-C reaches only this process, which then asks.
            self._process = subprocess.Popen([panels(), "--worker"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0,
                                             env=environment(), process_group=0, pass_fds=tuple(KEPT_OPEN))
            self._send(line)
        asked = False
        while not select.select([self._process.stdout], [], [], 0.05)[0]:
            if not asked and _diptych.stop_requested():
                asked = True
                self._process.terminate()
        answer = self._process.stdout.readline()
        return (int(answer) if answer else self.close() or SYSTEM_FAILURE), asked

    def _send(self, line: str) -> bool:
        try:
            self._process.stdin.write(line.encode())
            return True
        except BrokenPipeError:
            return False

    def close(self) -> int:
        """Lets the process end. Returns its exit code, 128 + signal if a signal ended it, 0 without a process."""
        if self._process is None:
            return 0
        self._process.stdin.close()
        self._process.stdout.close()
        code, self._process = self._process.wait(), None
        return code if code >= 0 else 128 - code


_pool: Any = None  # mpi4py's executor on the other processes of mpirun
_remote_worker = Worker()


def _remote(line: str) -> tuple[int, bool]:
    return _remote_worker.run(line)


def on_first_process(work: Callable[[], int]) -> int:
    """Does the work on the first process of mpirun; returns its exit code. The others do runs for it and return 0."""
    global _pool
    if n_processes() == 1:
        return work()
    from mpi4py import MPI  # needs an MPI job
    from mpi4py.futures import MPICommExecutor

    _diptych.install_signals()  # once more: MPI changes some
    with MPICommExecutor(MPI.COMM_WORLD, root=0, main=False) as _pool:
        return work() if _pool is not None else DONE


def n_processes() -> int:
    """Number of processes of mpirun; 1 without it."""
    return int(os.environ.get("OMPI_COMM_WORLD_SIZE") or os.environ.get("PMI_SIZE") or 1)


class _Progress:
    """One line on a terminal; in a log one line for every twentieth of the runs."""

    def __init__(self, noun: str, quiet: bool, total: int, done: int) -> None:
        self.noun, self.quiet, self.total, self.done = noun, quiet, total, done
        self.failed, self.seconds, self.known = 0, 0.0, 0
        self.terminal, self.shown, self.last_part = sys.stderr.isatty(), 0.0, -1

    def ended(self, outcome: Outcome) -> None:
        if outcome.exit_code == 0:
            self.done += 1
        else:
            self.failed += 1
        self.seconds, self.known = self.seconds + outcome.seconds, self.known + 1

    def show(self, started: Iterable[float], seats: int) -> None:
        """started: when each run at work began [s of time.monotonic()]."""
        now, ended = time.monotonic(), self.done + self.failed
        part = 20 * ended // max(1, self.total)
        if self.quiet or (now - self.shown < 0.2 if self.terminal else part == self.last_part):
            return
        at_work = [now - since for since in started]
        waiting = self.total - ended
        left = (self.seconds / max(1, self.known) * waiting - sum(at_work)) / max(1, min(seats, waiting))
        remaining = f", {duration(left)} remaining" if self.known else ""
        text = f"{self.done} of {self.total} {self.noun} done, {len(at_work)} running, {self.failed} failed{remaining}"
        _write("stderr", f"\r\033[K{text}" if self.terminal else text + "\n")
        self.shown, self.last_part = now, part

    def clear(self) -> None:
        if self.terminal and not self.quiet:
            _write("stderr", "\r\033[K")


def duration(seconds: float) -> str:
    """ "1 h 02 min", "3 min 20 s", "12 s" """
    s = round(max(0.0, seconds))
    if s >= 3600:
        return f"{s // 3600} h {s // 60 % 60:02d} min"
    return f"{s // 60} min {s % 60:02d} s" if s >= 60 else f"{s} s"


@dataclass
class _Work:
    """What the seats share."""

    lines: list[str]
    waiting: queue.SimpleQueue[int] = field(default_factory=queue.SimpleQueue)
    ended: queue.SimpleQueue[tuple[int, Outcome]] = field(default_factory=queue.SimpleQueue)
    started: dict[int, float] = field(default_factory=dict)

    def sit(self, serve: Callable[[str], tuple[int, bool]], close: Callable[[], object]) -> None:
        """The loop of one seat. Its worker ends with it: the system ends a worker whose starting thread has ended."""
        try:
            while not _diptych.stop_requested():
                k = self.waiting.get_nowait()
                begun = self.started[k] = time.monotonic()
                code, asked = serve(self.lines[k])
                del self.started[k]
                self.ended.put((k, Outcome(code, asked and code != 0, time.monotonic() - begun)))
        except queue.Empty:
            pass
        finally:
            close()


def n_seats(options: Options) -> int:
    """Number of runs at once: --jobs on this process, and one on every other process of mpirun."""
    others = n_processes() - 1
    return (options.jobs or (1 if others else max(1, len(os.sched_getaffinity(0)) // options.threads))) + others


def execute(runs: Sequence[Run], options: Options, *, noun: str = "runs", finished: int = 0,
            on_ended: Callable[[int, Outcome], None] = lambda k, outcome: None) -> list[Outcome]:
    """Does the runs and returns their outcomes in the order of `runs`.

    noun      name of the runs in the progress: "seeds"
    finished  runs that were finished before; they count in the progress
    on_ended  is called with index and outcome as runs end; if it raises OSError, the run has failed with exit code 4

    On a stop request (SIGINT, SIGTERM, SIGHUP) workers are asked to stop, and no further run starts. Failures are reported on
    standard error. A worker that was killed is one failed run; a new worker takes its seat.
    """
    _diptych.install_signals()
    outcomes = [Outcome() for _ in runs]
    work = _Work([run.line(options.threads) for run in runs])
    for k in range(len(runs)):
        work.waiting.put(k)
    progress = _Progress(noun, options.quiet, len(runs) + finished, finished)
    seats, others = n_seats(options), n_processes() - 1
    with ThreadPoolExecutor(seats) as threads:
        sitting = []
        for _ in range(min(len(runs), seats - others)):
            worker = Worker()
            sitting.append(threads.submit(work.sit, worker.run, worker.close))
        if others and len(runs) > len(sitting):
            sitting += [threads.submit(work.sit, lambda line: _pool.submit(_remote, line).result(), lambda: None)
                        for _ in range(others)]
        while any(not seat.done() for seat in sitting) or not work.ended.empty():
            try:
                k, outcomes[k] = work.ended.get(timeout=0.05)
                _note_end(runs[k], outcomes[k], progress, lambda: on_ended(k, outcomes[k]))
            except queue.Empty:
                pass
            progress.show(list(work.started.values()), seats)
        progress.clear()
        for seat in sitting:
            seat.result()  # raises what ended a seat
    return outcomes


def _note_end(run: Run, outcome: Outcome, progress: _Progress, on_ended: Callable[[], None]) -> None:
    if outcome.exit_code:
        outcome.message = last_words(run.log)
    try:
        on_ended()
    except OSError as error:  # a full disk must not end the other runs
        progress.clear()
        complain(f"{run.name}: {error}")
        outcome.exit_code = SYSTEM_FAILURE
    if outcome.interrupted:
        return
    progress.ended(outcome)
    if outcome.exit_code:
        progress.clear()
        why = outcome.message or ("ended by a signal, without a message" if outcome.exit_code > 128 else "without a message")
        complain(f"{run.name} failed with exit code {outcome.exit_code}: {why} (log: {run.log})")
