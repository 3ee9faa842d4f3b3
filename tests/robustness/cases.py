# diptych: one case of the robustness tests: its dice, its folder, the runs of the program in it
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A case is made again from its kind and seed alone."""

import collections
import dataclasses
import itertools
import os
import random
import resource
import shutil
import signal
import subprocess
import threading
import time

import bases
import damage
import judge
import special_files
from running import ENVIRONMENT, PROGRAM

MEMORY = 4 << 30  # bytes of address space that a run may have: no case may take the machine
PATIENCE = 4  # seconds until a run that goes on is asked to stop; ending by itself or then are both right
HANG = 60  # seconds from there to the end: hundreds of times what any case here needs
SEEDS = 364000  # from the first seed of a run to that of the next: whole sets of the kind `pairs`
SANITIZER = {}  # what a program that was built with sanitizers is told by its environment; empty: it was not


def expect_sanitizers():
    """Address sanitizer maps terabytes of which it uses little, so it is told the limit itself; what the libraries leave at their end is theirs."""
    global HANG
    HANG *= 5
    SANITIZER["ASAN_OPTIONS"] = f"detect_leaks=0:allocator_may_return_null=1:hard_rss_limit_mb={MEMORY >> 20}"
    SANITIZER["UBSAN_OPTIONS"] = "print_stacktrace=1"
    ENVIRONMENT.update(SANITIZER)


def limit(memory=MEMORY, **limits):
    """For preexec_fn: files that may not grow, little memory, few files. What a signal of the limit does is the program's affair, as in a shell."""
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    if not SANITIZER:
        resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
    for name, value in limits.items():
        resource.setrlimit(getattr(resource, name), (value, value))


def heard():
    """For preexec_fn: a signal that is to end the program does, also where the tests were begun with nohup or in the background, which is inherited."""
    for one in (signal.SIGHUP, signal.SIGINT):
        signal.signal(one, signal.SIG_DFL)


class Listener(threading.Thread):
    """Reads a pipe to its end. What outlives the program and holds the pipe is not waited for."""

    def __init__(self, pipe):
        super().__init__(daemon=True)
        self.pipe, self.pieces = pipe, []
        self.start()

    def run(self):
        with self.pipe:
            for piece in iter(lambda: self.pipe.read1(1 << 16), b""):
                self.pieces.append(piece)

    def text(self):
        self.join(10)
        return b"".join(self.pieces).decode("utf-8", "replace")


class Case:
    """`work` is all that the program sees; beside it lies what was run and said, where something is violated."""

    def __init__(self, kind, seed, keep):
        self.kind, self.seed = kind, seed
        self.dice = random.Random(f"{kind}:{seed}")
        self.keep = keep
        self.folder = os.path.join(keep, f"{kind}_{seed}")
        self.work = os.path.join(self.folder, "work")
        self.violations, self.codes, self.commands, self.said, self.done = [], [], [], [], []
        self.found = collections.defaultdict(set)  # what is told of all cases together, by a name
        shutil.rmtree(self.folder, ignore_errors=True)
        os.makedirs(self.work)

    def path(self, *names):
        return os.path.join(self.work, *names)

    def write(self, name, content):
        with open(self.path(name), "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode("utf-8", "surrogateescape"))
        return self.path(name)

    def damage_arrays(self, name, often=""):
        """True where it can be told from a whole file."""
        what, is_plain = damage.damage_arrays(self.dice, self.path(name), often)
        self.done.append(f"{name}: {what}")
        return is_plain

    def base(self, name):
        """A folder that was made once, not to be changed."""
        return bases.prepared(self.keep, name)

    def copy(self, name, to):
        shutil.copytree(self.base(name), self.path(to), dirs_exist_ok=True, symlinks=True)
        return self.path(to)

    def violate(self, sentence):
        self.violations.append(sentence)

    def start(self, *words, env=None, cwd=None, preexec=limit, stdout=subprocess.PIPE, stderr=subprocess.PIPE):
        """The process; its texts come through pipes, which no limit of files ends, and are not waited for longer than it runs."""
        def begin():
            heard()
            preexec()

        self.commands.append([os.fsdecode(word) for word in words])
        process = subprocess.Popen([PROGRAM, *words], env={**(env or ENVIRONMENT), **SANITIZER}, cwd=cwd or self.work, stdin=subprocess.DEVNULL, stdout=stdout,
                                   stderr=stderr, preexec_fn=begin, start_new_session=True)
        process.words, process.sent = self.commands[-1], 0
        process.told = {name: Listener(pipe) for name, pipe in (("out", process.stdout), ("errors", process.stderr)) if pipe}
        return process

    def finish(self, process, patience=PATIENCE):
        """Waits; asks to stop after `patience` seconds. True where it hung and had to be killed."""
        patience = patience if not SANITIZER else 5 * patience
        for wait, number in ((patience, signal.SIGTERM), (HANG, signal.SIGKILL)):
            try:
                process.wait(wait)
                return False
            except subprocess.TimeoutExpired:
                try:
                    os.killpg(process.pid, number)
                except ProcessLookupError:
                    pass
                process.sent = process.sent or number
        process.wait()
        return True

    def outcome(self, process, before, output, is_hung=False):
        texts = {name: process.told[name].text() if name in process.told else "" for name in ("out", "errors")}
        self.said.append(texts["out"][-3000:] + texts["errors"][-3000:])
        return judge.Outcome(words=process.words, code=process.returncode, out=texts["out"], errors=texts["errors"], before=before,
                             after=judge.digest(self.work), output=output, root=self.work, is_hung=is_hung, sent=process.sent)

    def judge(self, outcome, **expected):
        expected.setdefault("documented", bases.documented(self.keep))
        self.codes.append(outcome.code)
        for sentence in judge.judge(outcome, judge.Expected(**expected)):
            self.violate(sentence)
        return outcome

    def run(self, *words, output="", patience=PATIENCE, names=(), **options):
        """Runs the program and judges it. `names`, `all_names`, `codes`, `may_change`, `by_itself`: of judge.Expected; others of start()."""
        expected = {key: tuple(options.pop(key)) for key in ("all_names", "codes", "may_change") if key in options}
        expected["by_itself"] = options.pop("by_itself", False)
        if not self.commands:
            shutil.copytree(self.work, os.path.join(self.folder, "input"), symlinks=True, copy_function=special_files.copy)  # what it begins with, to be run again
        before = judge.digest(self.work)
        process = self.start(*words, **options)
        is_hung = self.finish(process, patience)
        return self.judge(self.outcome(process, before, output, is_hung), names=tuple(names), **expected)

    def close(self):
        """Removes the folder of a case without a violation; else says in it what was run."""
        if not self.violations:
            shutil.rmtree(self.folder, ignore_errors=True)
            return
        with open(os.path.join(self.folder, "case.txt"), "w", encoding="utf-8", errors="surrogateescape") as file:
            file.write(f"{self.kind}:{self.seed}\n" + "\n".join(self.violations + self.done) + "\n")
            for words, said in itertools.zip_longest(self.commands, self.said):
                file.write("\n" + " ".join(map(repr, words)) + f"\n{said}\n")


@dataclasses.dataclass
class Made:
    """What is left of a case."""
    violations: list
    codes: list = dataclasses.field(default_factory=list)
    commands: list = dataclasses.field(default_factory=list)
    seconds: float = 0.0  # of CPU
    found: dict = dataclasses.field(default_factory=dict)


def run_case(kind, function, seed, keep):
    began = resource.getrusage(resource.RUSAGE_CHILDREN)
    case = Case(kind, seed, keep)
    function(case)
    ended = resource.getrusage(resource.RUSAGE_CHILDREN)
    case.close()
    seconds = ended.ru_utime + ended.ru_stime - began.ru_utime - began.ru_stime
    return Made(case.violations + (case.done if case.violations else []), case.codes, case.commands, seconds, case.found)


def wait_for(path, process, seconds=60):
    """Until a file is there. False where the process ended without, or never wrote it."""
    end = time.monotonic() + seconds
    while process.poll() is None and time.monotonic() < end:
        if os.path.exists(path):
            return True
        time.sleep(0.002)
    return os.path.exists(path)
