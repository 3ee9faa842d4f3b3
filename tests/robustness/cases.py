# diptych: one random case: its dice, its folder, and the runs of the program in it
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The kind and the seed of a case determine its random numbers."""

import dataclasses
import os
import random
import resource
import shutil
import signal
import subprocess

import bases
import damage
import judge
import same
from running import ENVIRONMENT, PROGRAM

MEMORY = 4 << 30  # bytes of address space of a run
PATIENCE = 4  # seconds until a long run gets SIGTERM
HANG = 60  # seconds from there to SIGKILL: hundreds of times what any case needs
SEEDS = 100000  # from the first seed of a run of the harness to that of the next


def limit(memory=MEMORY, **limits):
    """For preexec_fn. The signals end a program also under nohup. Address sanitizer maps more addresses than any limit
    leaves."""
    for one in (signal.SIGHUP, signal.SIGINT):
        signal.signal(one, signal.SIG_DFL)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    if "ASAN_OPTIONS" not in os.environ:
        resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
    for name, value in limits.items():
        resource.setrlimit(getattr(resource, name), (value, value))


def text_of(pipe):
    """The text that a pipe holds. Workers of a killed run may keep the pipe open, so this does not wait for its end."""
    os.set_blocking(pipe.fileno(), False)
    with pipe:
        return (pipe.read() or b"").decode("utf-8", "replace")


class Case:
    """The program sees the folder `work`. A violated case keeps it, with case.txt beside it."""

    def __init__(self, kind, seed, keep):
        self.kind, self.seed, self.keep = kind, seed, keep
        self.dice = random.Random(f"{kind}:{seed}")
        self.folder = os.path.join(keep, f"{kind}_{seed}")
        self.work = os.path.join(self.folder, "work")
        self.violations, self.codes, self.log = [], [], []
        shutil.rmtree(self.folder, ignore_errors=True)
        os.makedirs(self.work)

    def path(self, *names):
        return os.path.join(self.work, *names)

    def write(self, name, content):
        with open(self.path(name), "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())
        return self.path(name)

    def base(self, name):
        """A folder that is made once and that no case changes."""
        return bases.prepared(self.keep, name)

    def copy(self, name):
        """Copies a base into `work` and returns the folder of its results."""
        shutil.copytree(self.base(name), self.work, dirs_exist_ok=True)
        return self.path("out")

    def damage(self, path, changes):
        """Changes the bytes of a file by one of the functions."""
        change = self.dice.choice(changes)
        self.log.append(f"{os.path.relpath(path, self.work)}: {change.__name__}")
        self.write(path, change(self.dice, judge.read(path)))

    def damage_arrays(self, name, often=""):
        """Changes a file by the HDF5 library. True if the change is more than another number."""
        what, is_plain = damage.damage_arrays(self.dice, self.path(name), often)
        self.log.append(f"{name}: {what}")
        return is_plain

    def start(self, *words, preexec=limit):
        self.log.append(" ".join(map(repr, words)))
        process = subprocess.Popen([PROGRAM, *words], env=ENVIRONMENT, cwd=self.work, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, pipesize=1 << 20, preexec_fn=preexec, start_new_session=True)
        process.sent = 0
        return process

    def finish(self, process, patience):
        """Waits, and sends SIGTERM after `patience` seconds. True if the program had to be killed."""
        for wait, number in ((patience, signal.SIGTERM), (HANG, signal.SIGKILL)):
            try:
                process.wait(wait)
                return False
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, number)
                process.sent = process.sent or number
        process.wait()
        return True

    def end(self, process, before, output, patience=HANG, **expected):
        """Waits for the end of the process and judges it. `expected`: of judge.Expected."""
        is_hung = self.finish(process, patience)
        out, errors = text_of(process.stdout), text_of(process.stderr)
        self.log.append(f"exit code {process.returncode}\n{out[-3000:]}{errors[-3000:]}")
        outcome = judge.Outcome(code=process.returncode, out=out, errors=errors, before=before,
                                after=judge.digest(self.work), output=output,
                                root=self.work, is_hung=is_hung, sent=process.sent)
        self.codes.append(outcome.code)
        self.violations += judge.judge(outcome, judge.Expected(**expected))
        return outcome

    def run(self, *words, output, patience=PATIENCE, preexec=limit, **expected):
        before = judge.digest(self.work)
        return self.end(self.start(*words, preexec=preexec), before, output, patience, **expected)

    def expect_same(self, whole, found, without=()):
        """Compares the results of two folders bit by bit."""
        wrong = [name for name in same.differences(same.results(whole), same.results(found, without))
                 if not name.startswith(tuple(without))]
        if wrong:
            self.violations.append("other results than with undamaged files: " + "; ".join(wrong[:4]))

    def close(self):
        """Removes the folder of a case without violation."""
        if not self.violations:
            shutil.rmtree(self.folder, ignore_errors=True)
            return
        with open(os.path.join(self.folder, "case.txt"), "w", encoding="utf-8", errors="surrogateescape") as file:
            file.write(f"{self.kind}:{self.seed}\n" + "\n".join(self.violations + self.log) + "\n")


@dataclasses.dataclass
class Made:
    """What remains of a case."""
    violations: list
    codes: list = dataclasses.field(default_factory=list)
    log: list = dataclasses.field(default_factory=list)
    seconds: float = 0.0  # of CPU


def run_case(kind, function, seed, keep):
    began = resource.getrusage(resource.RUSAGE_CHILDREN)
    case = Case(kind, seed, keep)
    function(case)
    case.close()
    ended = resource.getrusage(resource.RUSAGE_CHILDREN)
    return Made(case.violations, case.codes, case.log, ended.ru_utime + ended.ru_stime - began.ru_utime
                - began.ru_stime)
