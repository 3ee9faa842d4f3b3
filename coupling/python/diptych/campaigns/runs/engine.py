# diptych: many runs, on workers of this machine and of the other processes of mpirun
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A worker is a process of worker.py that does one run after another. It receives a line of JSON and answers with the
exit code on a line. The workers of a campaign are its crew; under mpirun each other process has a worker, too. Results
depend neither on the number of workers nor on the order of the runs.
"""

import functools
import json
import os
import queue
import select
import shlex
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import timedelta
from typing import Any, TypeVar

from ... import _diptych
from ...errors import NotConverged, Stopped

DONE, WRONG_INPUT, NOT_CONVERGED, SYSTEM_FAILURE = 0, 2, 3, 4  # exit codes of the program
Item = TypeVar("Item")
_JOB_VARIABLES = ("OMPI_", "PMIX_", "PMI_", "PRTE_", "ORTE_")


def code_and_text(error: Exception) -> tuple[int, str]:
    """Exit code and message of what ended a command."""
    if isinstance(error, (Stopped, NotConverged)):
        return NOT_CONVERGED, str(error)
    return WRONG_INPUT if isinstance(error, ValueError) else SYSTEM_FAILURE, str(error) or "out of memory"


@dataclass(kw_only=True)
class Options:
    """Options that all campaigns share, with the meaning of `diptych study --help`."""

    jobs: int = 0  # runs at once; 0: as many as the cores allow, under mpirun 1
    threads: int = 1  # of the contact solver of each run
    quiet: bool = False
    resume: bool = False
    overwrite: bool = False
    words: Sequence[str] = ()  # the command line
    pool: Any = None  # mpi4py's executor on the other processes of mpirun

    @property
    def again(self) -> str:
        """The command that goes on with this one."""
        job = f"mpirun -np {n_processes()} " if n_processes() > 1 else ""
        words = [word for word in self.words if word not in ("--overwrite", "--resume")]
        return f"{job}diptych {shlex.join(words)} --resume"


@dataclass(frozen=True, kw_only=True)
class Run:
    """One run of a scene."""

    command: str
    scene: str  # path of its file
    name: str  # of the scene, for its results
    label: str  # of the run, for messages: "seed 3"
    folder: str  # result folder
    log: str  # output and errors are appended to this file
    resume: bool = False

    def line(self, threads: int) -> str:
        """The run as a worker reads it."""
        text = shlex.join(["diptych", self.command, self.scene, "--output", self.folder])
        options = {"file": self.scene, "text": text, "threads": threads, "resume": self.resume}
        return json.dumps({**vars(self), "options": options}) + "\n"


@dataclass(kw_only=True)
class Outcome:
    """The end of one run. Exit code 128 + signal: a signal ended its worker."""

    exit_code: int = 0
    interrupted: bool = True  # asked to stop, or never started
    seconds: float = 0.0  # 0: it had ended before
    message: str = ""  # last line of the log of a run that failed


def _write(stream: str, text: str) -> None:
    try:
        print(text, end="", file=getattr(sys, stream), flush=True)
    except OSError:  # a closed or full output must not stop the runs
        setattr(sys, stream, open(os.devnull, "w", encoding="utf-8"))


def tell(text: str) -> None:
    """Prints a line to standard output."""
    _write("stdout", text + "\n")


def say(options: Options, text: str) -> None:
    """Prints a line to standard output, unless --quiet."""
    if not options.quiet:
        tell(text)


def complain(text: str) -> None:
    """Prints a line to standard error."""
    _write("stderr", text + "\n")


def columns_text(rows: Sequence[Sequence[str]]) -> str:
    """Rows of cells as a table for a terminal."""
    widths = [max(map(len, column)) for column in zip(*rows)]
    return "\n".join("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in rows)


def last_words(log: str) -> str:
    """The last line of a log that is not blank; empty if there is none."""
    if not os.path.exists(log):
        return ""
    with open(log, encoding="utf-8", errors="replace") as file:
        return ([""] + [line.rstrip("\r\n") for line in file if line.strip()])[-1]


def program() -> str:
    """Path of the program `diptych`: that which started this process, or the one of the package."""
    package = os.path.abspath(os.path.join(os.path.dirname(__file__), *[".."] * 3))  # the folder that holds it
    built, installed = os.path.join(package, "..", "diptych"), os.path.join(package, *[".."] * 3, "bin", "diptych")
    for place in filter(os.path.isfile, [os.environ.get("DIPTYCH_PROGRAM", ""), built, installed]):
        return os.path.realpath(place)
    raise FileNotFoundError(f"the program diptych is neither {built} nor {installed}; set DIPTYCH_PROGRAM to its path")


def environment() -> dict[str, str]:
    """For a process of this package, without an MPI job, which would make a program one of its ranks."""
    package = os.path.dirname(os.path.dirname(os.path.abspath(_diptych.__file__)))
    path = os.pathsep.join(filter(None, [package, os.environ.get("PYTHONPATH")]))
    own = {"DIPTYCH_PROGRAM": program(), "PYTHONPATH": path, "PYTHONSAFEPATH": "1"}  # safe: not the working directory
    return own | {name: value for name, value in os.environ.items() if name not in own and
                  (name.startswith("OMPI_ALLOW_RUN_AS_ROOT") or not name.startswith(_JOB_VARIABLES))}


@contextmanager
def stops_raised(text: str) -> Iterator[None]:
    """Stop signals raise Stopped meanwhile, in Python code that does not ask for them; only in the main thread."""

    def stop(*_: Any) -> None:
        raise Stopped(text)

    if _diptych.stop_requested():
        stop()
    here = threading.current_thread() is threading.main_thread()
    before = {one: signal.signal(one, stop) for one in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
              if here and signal.getsignal(one) is not signal.SIG_IGN}
    try:
        yield
    finally:
        for one, handler in before.items():
            signal.signal(one, handler)
        _diptych.install_signals()


class Worker:
    """A process that does one run after another. It starts with the first run, and again if it died. kept: descriptors
    that it inherits."""

    def __init__(self, *kept: int) -> None:
        self._kept = kept
        self._process: subprocess.Popen[bytes] | None = None

    def run(self, line: str) -> tuple[int, bool]:
        """Does a task; returns (exit code, whether it was asked to stop). 4: the worker ended without an answer."""
        if self._process is None or not self._send(line):
            self.close()
            # Its own process group: Ctrl-C reaches only this process, which then asks.
            words = [sys.executable, "-m", __package__ + ".worker", str(os.getpid())]
            self._process = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0,
                                             env=environment(), process_group=0, pass_fds=self._kept)
            self._send(line)
        asked = False
        while not select.select([self._process.stdout], [], [], 0.05)[0]:
            if not asked and _diptych.stop_requested():
                asked = True
                self._process.terminate()
        answer = self._process.stdout.readline()
        ended = self.close() if asked or not answer else 0  # the request would stop the next run, too
        return (int(answer) if answer else ended or SYSTEM_FAILURE), asked

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


_one_worker = functools.cache(Worker)


def _remote(line: str) -> tuple[int, bool]:
    """Does a task on another process of mpirun, by its one worker."""
    return _one_worker().run(line)


@contextmanager
def stop_signals() -> Iterator[None]:
    """Ctrl-C and the other stop signals are requests meanwhile, as in the program; then they are the caller's again."""
    taken = _diptych.TakenSignals()
    try:
        yield
    finally:
        del taken


def on_first_process(work: Callable[[Any], int]) -> int:
    """Does the work on the first process of mpirun; returns its exit code. The others do runs for it and return 0."""
    if n_processes() == 1:
        return work(None)
    from mpi4py import MPI  # needs an MPI job
    from mpi4py.futures import MPICommExecutor

    _diptych.install_signals()  # once more: MPI changes some
    with MPICommExecutor(MPI.COMM_WORLD, root=0, main=False) as pool:
        return work(pool) if pool is not None else DONE


def n_processes() -> int:
    """Number of processes of mpirun; 1 without it."""
    return int(os.environ.get("OMPI_COMM_WORLD_SIZE") or os.environ.get("PMI_SIZE") or 1)


class _Progress:
    """One line on a terminal; in a log one line for every twentieth of the runs."""

    def __init__(self, quiet: bool, noun: str, total: int, done: int) -> None:
        self.quiet, self.noun, self.total, self.done = quiet, noun, total, done
        self.failed, self.seconds, self.known = 0, 0.0, 0
        self.terminal, self.shown, self.last_part = sys.stderr.isatty(), 0.0, -1

    def ended(self, outcome: Outcome) -> None:
        self.done, self.failed = self.done + (outcome.exit_code == 0), self.failed + (outcome.exit_code != 0)
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
        remaining = f", {timedelta(seconds=round(max(0.0, left)))} remaining" if self.known else ""
        text = f"{self.done} of {self.total} {self.noun} done, {len(at_work)} running, {self.failed} failed{remaining}"
        _write("stderr", f"\r\033[K{text}" if self.terminal else text + "\n")
        self.shown, self.last_part = now, part

    def clear(self) -> None:
        if self.terminal and not self.quiet:
            _write("stderr", "\r\033[K")


def counted(items: Sequence[Item], noun: str, quiet: bool) -> Iterator[Item]:
    """The items one after another, with progress and time left. noun: of the items."""
    progress = _Progress(quiet, noun, len(items), 0)
    for item in items:
        began = time.monotonic()
        progress.show([began], 1)
        yield item
        progress.ended(Outcome(seconds=time.monotonic() - began))
    progress.clear()


def n_seats(options: Options) -> int:
    """Number of runs at once: --jobs on this process, and one on every other process of mpirun."""
    others = n_processes() - 1
    return (options.jobs or (1 if others else max(1, len(os.sched_getaffinity(0)) // options.threads))) + others


class Crew:
    """The workers of a campaign, and threads that hand them runs. All live until close(): a worker's start takes longer
    than many a run, and the system ends a worker when the thread that started it ends."""

    def __init__(self, options: Options, lock: int) -> None:
        """lock: descriptor of a lock, which then holds until the last worker has ended."""
        seats, others = n_seats(options), n_processes() - 1
        self.threads = ThreadPoolExecutor(seats)
        self._workers = [Worker(lock) for _ in range(seats - others)]
        # the last one first, for it has started
        self.free: queue.LifoQueue[Callable[[str], tuple[int, bool]]] = queue.LifoQueue()
        of_others = [lambda line: options.pool.submit(_remote, line).result()] * others
        for serve in [*of_others, *(worker.run for worker in self._workers)]:
            self.free.put(serve)

    def close(self) -> None:
        """Waits until the workers have ended; then CPU times of this process include theirs."""
        self.threads.shutdown(cancel_futures=True)
        for worker in self._workers:
            worker.close()


def execute(runs: Sequence[Run], options: Options, crew: Crew, *, finished: int = 0, noun: str = "runs",
            on_ended: Callable[[int, Outcome], None] = lambda k, outcome: None) -> list[Outcome]:
    """Does the runs and returns their outcomes in the order of `runs`.

    finished  runs that were finished before; they count in the progress
    noun      of the runs in the line of progress
    on_ended  is called with index and outcome as runs end; if it raises OSError, the run has failed with exit code 4

    On a stop request (SIGINT, SIGTERM, SIGHUP) workers are asked to stop, and no further run starts. Failures are
    reported on standard error. A worker that was killed is one failed run; a new process takes its place.
    """
    _diptych.install_signals()
    ended: queue.SimpleQueue[tuple[int, Future[Outcome]]] = queue.SimpleQueue()
    started: dict[int, float] = {}

    def do(k: int) -> Outcome:
        if _diptych.stop_requested():
            return Outcome()
        serve, started[k] = crew.free.get(), time.monotonic()
        try:
            code, asked = serve(runs[k].line(options.threads))
        finally:
            crew.free.put(serve)
        return Outcome(exit_code=code, interrupted=asked and code != 0, seconds=time.monotonic() - started.pop(k))

    outcomes, left = [Outcome() for _ in runs], len(runs)
    progress = _Progress(options.quiet, noun, len(runs) + finished, finished)
    for k in range(len(runs)):
        crew.threads.submit(do, k).add_done_callback(lambda future, k=k: ended.put((k, future)))
    while left:
        try:
            k, future = ended.get(timeout=0.05)
            left, outcomes[k] = left - 1, future.result()
            _note_end(runs[k], outcomes[k], progress, lambda: on_ended(k, outcomes[k]))
        except queue.Empty:
            pass
        progress.show(list(started.values()), n_seats(options))
    progress.clear()
    return outcomes


def _note_end(run: Run, outcome: Outcome, progress: _Progress, on_ended: Callable[[], None]) -> None:
    outcome.message = last_words(run.log) if outcome.exit_code else ""
    try:
        on_ended()
    except OSError as error:  # a full disk must not end the other runs
        progress.clear()
        complain(f"{run.label}: {error}")
        outcome.exit_code = SYSTEM_FAILURE
    if outcome.interrupted:
        return
    progress.ended(outcome)
    if outcome.exit_code:
        progress.clear()
        why = outcome.message or ("ended by a signal, without a message" if outcome.exit_code > 128
                                  else "without a message")
        complain(f"{run.label} failed with exit code {outcome.exit_code}: {why} (log: {run.log})")
