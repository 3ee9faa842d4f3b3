# diptych: full disks, little memory, and surroundings that are not those of a developer
# SPDX-License-Identifier: LGPL-2.1-or-later

import contextlib
import ctypes
import functools
import os
import shutil
import subprocess
import threading

import bases
from bases import BOTH, NODES, TINY
from cases import SANITIZER, limit
from folder_kinds import expect_same_as_base
from running import ENVIRONMENT, QUICK, setting


@functools.lru_cache(maxsize=None)
def can_mount():
    """For root on Linux, in a name space of this process alone: whatever ends it, its mounts are gone with it."""
    new_mounts = 0x00020000  # CLONE_NEWNS
    return (os.geteuid() == 0 and bool(shutil.which("mount")) and hasattr(ctypes.CDLL(None), "unshare") and ctypes.CDLL(None).unshare(new_mounts) == 0
            and called("mount", "--make-rprivate", "/"))


def called(*words):
    return subprocess.run(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False).returncode == 0


@contextlib.contextmanager
def small_disk(case, room):
    """A file system of `room` kB at `disk`; afterwards a folder that holds what it held. Yields whether there is one."""
    folder, copied = case.path("disk"), case.path("disk_copied")
    is_one = can_mount() and called("mount", "-t", "tmpfs", "-o", f"size={room}k", "none", folder)
    try:
        yield is_one
    finally:
        if is_one:
            try:
                shutil.copytree(folder, copied, symlinks=True)
            finally:
                if not called("umount", folder):
                    called("umount", "-l", folder)
            os.rmdir(folder)
            os.rename(copied, folder)


def size_of(folder):
    """kB that a file system needs for its files: whole pages, one for a folder, too."""
    return sum(4 * (1 + len(names) + sum(os.path.getsize(os.path.join(top, name)) // 4096 + 1 for name in files)) for top, names, files in os.walk(folder))


def disk(case):
    """A full disk: a small file system where the machine gives one, else, and in half of the cases, no file grows beyond a random size."""
    dice = case.dice
    room = dice.choice([0, 100, 4096]) if dice.random() < 0.2 else int(10 ** dice.uniform(2, 6))
    space, is_small = int(2 ** dice.uniform(6, 11)), dice.random() < 0.5
    command = dice.choice(["discrete"] * 5 + ["run", "continuum", "compare", "compare", "import", "import", "export", "export", "solve"])
    os.mkdir(case.path("disk"))
    if dice.random() < 0.4 and can_mount():
        return filling_disk(case)
    if not is_small:
        return on_disk(case, command, functools.partial(limit, RLIMIT_FSIZE=room))
    held = size_of(os.path.join(case.base("both"), "out")) if command == "compare" else 0
    with small_disk(case, held + space) as is_one:
        on_disk(case, command, limit if is_one else functools.partial(limit, RLIMIT_FSIZE=room))
        case.found["on a small file system" if is_one else "no small file system"].add(case.seed)


def filling_disk(case):
    """A disk that becomes full while the command runs: what was whole stays, nothing half written does."""
    dice, out = case.dice, case.path("disk", "out")
    command = dice.choice(["run", "run", "discrete", "continuum", "report", "report", "compare"])
    line = [command, QUICK, *{"run": [*BOTH, *setting(output_report="true")], "discrete": TINY, "continuum": NODES}[command], "--output",
            out] if command in ("run", "discrete", "continuum") else [command, out]
    with small_disk(case, 16000) as is_one:
        if not is_one:
            return
        if command in ("report", "compare"):
            shutil.copytree(os.path.join(case.base("both"), "out"), out)
        process_room, wait = dice.choice([0, 4, 40, 200, 400]), dice.choice([0, 0, dice.uniform(0, 0.3), dice.uniform(0, 1.5)])
        filler = threading.Timer(wait, fill, (case.path("disk"), process_room))
        filler.start()
        try:
            case.run(*line, "--quiet", output=out, names=(out, "TMPDIR"), codes=(0, 4), patience=30, may_change=("disk/fill",))
        finally:
            filler.join()
            case.found["on a disk that fills"].add(case.seed)
            with contextlib.suppress(FileNotFoundError):
                os.remove(case.path("disk", "fill"))


def fill(folder, left):
    """All but `left` kB."""
    with open(os.path.join(folder, "fill"), "wb") as file:
        place = os.statvfs(folder)
        for _ in range(max(0, place.f_bavail * place.f_frsize // 1024 - left)):
            try:
                os.write(file.fileno(), bytes(1024))
            except OSError:  # the program was quicker
                return


def on_disk(case, command, preexec):
    """One command that writes below `disk`."""
    out, whole = case.path("disk", "out"), os.path.join(case.base("both"), "out")
    if command == "compare":
        shutil.copytree(whole, out)
        line = [command, out]
    elif command == "export":
        line = [command, whole, "--format", case.dice.choice(["csv", "yade", "lammps", "lmgc90"]), "--output", out]
    elif command == "import":
        line = [command, "csv", *bases.foreign("csv"), "--output", out]
    elif command == "solve":
        out = case.path("disk", "solved.h5")
        line = [command, bases.PROBLEM, "--output", out]
    else:
        line = [command, QUICK, *{"discrete": TINY, "run": BOTH, "continuum": NODES}[command], "--output", out]
    line += ["--quiet"] if command != "solve" else []
    case.run(*line, output=out, names=(out, "TMPDIR", "TMP"), codes=(0, 4), patience=30, preexec=preexec)


def told(found):
    """Where the cases of `disk` were full, as a line below the table."""
    return (f"disk: {len(found['on a small file system'])} cases on a small file system, {len(found['on a disk that fills'])} on one that fills "
            "while the program runs") + (
        f"; {len(found['no small file system'])} should be and had a limit for their files instead: tmpfs cannot be mounted here"
        if found["no small file system"] else "")


def changed_environment(**values):
    environment = dict(ENVIRONMENT, **{name: value for name, value in values.items() if value is not None})
    for name, value in values.items():
        if value is None:
            environment.pop(name, None)
    return environment


def without_h5py(case):
    """A folder for PYTHONPATH whose h5py cannot be imported."""
    os.makedirs(case.path("modules", "h5py"))
    case.write("modules/h5py/__init__.py", "raise ImportError('No module named h5py')\n")
    return case.path("modules")


def odd_environment(case):
    kind = case.dice.choice(["home", "locale", "tmp", "threads", "empty", "columns", "blanks"])
    os.mkdir(case.path("no home"))
    return {
        "home": changed_environment(HOME=None),
        "locale": changed_environment(LANG=case.dice.choice(["tr_TR.UTF-8", "de_DE.UTF-8", "xx_XX", "C"]), LC_ALL=case.dice.choice(
            ["tr_TR.UTF-8", "de_DE.UTF-8", "nonsense", ""]), LC_NUMERIC="de_DE.UTF-8"),
        "tmp": changed_environment(TMPDIR=case.path("nowhere")),
        "threads": changed_environment(OMP_NUM_THREADS=case.dice.choice(["abc", "-1", "0", "", "99999999999", "1,2"])),
        "empty": {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"},
        "columns": changed_environment(COLUMNS="-1", TERM="", TZ="Nowhere/Land", PYTHONHASHSEED="x"),
        "blanks": changed_environment(HOME=case.path("no home"), XDG_CACHE_HOME="/dev/null", HDF5_PLUGIN_PATH="/dev/null", HDF5_USE_FILE_LOCKING="x"),
    }[kind]


def surroundings(case):
    way = case.dice.choice((in_odd_environment, in_odd_environment, with_no_reader, in_little, in_little, in_a_locked_folder, without_python))
    way(case)


def some_command(case):
    command = case.dice.choice(["discrete"] * 3 + ["continuum", "run"])
    return [command, QUICK, *{"discrete": TINY, "run": BOTH, "continuum": NODES}[command]]


def in_odd_environment(case):
    out = case.path("out")
    line = some_command(case)
    outcome = case.run(*line, "--output", out, "--quiet", output=out, env=odd_environment(case), names=("TMPDIR", "OMP_NUM_THREADS", "HOME"),
                       codes=(0, 2, 4), patience=30)
    if outcome.code == 0:
        base = {"discrete": "grains", "continuum": "nodes", "run": "both"}[line[0]]
        expect_same_as_base(case, base, out)


RESULTS_ELSEWHERE = (["discrete", QUICK, *TINY], ["run", QUICK, *BOTH], ["continuum", QUICK, *NODES], ["run", QUICK, *BOTH, *bases.SEEDS],
                     ["material-point", QUICK, *TINY])
RESULTS_SAID = (["explain"], ["explain", "results"], ["--help"], ["--version"], ["completion", "bash"], ["solve", bases.PROBLEM])


def with_no_reader(case):
    """Standard output, and often errors with it, closed, full, or of nobody any more: the results do not care. What is said and nowhere else is lost on a
    full disk, and that is told."""
    out, dice = case.path("out"), case.dice
    kind, is_said = dice.choice(["full", "closed", "pipe", "pipe"]), dice.random() < 0.5
    line = [*dice.choice(RESULTS_SAID)] if is_said else [*dice.choice(RESULTS_ELSEWHERE), "--output", out]
    codes = (4,) if kind == "full" and is_said else (0,)
    stderr = subprocess.STDOUT if dice.random() < 0.5 and kind == "pipe" else subprocess.PIPE
    if kind == "full":
        with open("/dev/full", "wb") as full:
            case.run(*line, output=out, stdout=full, names=("output",), codes=codes, patience=30)
    elif kind == "pipe":
        reader, writer = os.pipe()
        os.close(reader)
        with open(writer, "wb") as pipe:
            case.run(*line, output=out, stdout=pipe, stderr=stderr, names=("output",), codes=codes, patience=30)
    else:
        def closed():
            limit()
            os.close(1)
        case.run(*line, output=out, preexec=closed, names=("output",), codes=codes, patience=30)


def in_little(case):
    """Few files or little memory. Below 200 MB not even the libraries load, which is not the program's to tell."""
    out, line = case.path("out"), some_command(case)
    if case.dice.random() < 0.4 or SANITIZER:
        preexec = functools.partial(limit, RLIMIT_NOFILE=case.dice.choice([8, 12, 16, 32]))
    else:
        preexec = functools.partial(limit, memory=case.dice.randrange(400, 1500) << 20)
    if line[0] != "continuum":
        line += ["--threads", case.dice.choice(["1", "1", "2", "64", "1024"])]
    case.run(*line, "--output", out, "--quiet", output=out, preexec=preexec, names=(out, "memory", "file", "TMPDIR", "--threads"), codes=(0, 3, 4), patience=30)


def in_a_locked_folder(case):
    """A folder that is gone, a mask that denies all, or, for users who are not root, a folder that is read alone."""
    kind = case.dice.choice(["gone", "mask"] if os.geteuid() == 0 else ["gone", "mask", "read"])
    out = case.path("out")
    line = ["discrete", QUICK, *TINY, "--quiet"]
    if kind == "gone":
        os.mkdir(case.path("gone"))

        def leave():
            limit()
            os.rmdir(case.path("gone"))
        case.run(*line, "--output", case.dice.choice([out, "relative"]), output=case.work, cwd=case.path("gone"), preexec=leave,
                 names=("relative", "folder", "director"), codes=(0, 2, 4))
    elif kind == "mask":
        def mask():
            limit()
            os.umask(0o777)
        case.run(*line, "--output", out, output=out, preexec=mask, names=(out,), codes=(0, 4))
    else:
        os.mkdir(out, 0o500)
        case.run(*line, "--output", out, output=out, names=(out,), codes=(4,))


def without_python(case):
    """The report cannot be drawn: what was computed stays, and that is said."""
    folder = os.path.join(case.copy("both", "done"), "out")
    os.mkdir(case.path("empty"))
    environment, codes = case.dice.choice([(changed_environment(PATH=case.path("empty")), (0,)),  # its python3 has a place
                                           (changed_environment(PYTHONPATH=without_h5py(case)), (4,)),
                                           (changed_environment(PYTHONHOME=case.path("empty")), (4,))])
    if case.dice.random() < 0.7:
        case.run("report", folder, "--quiet", output=folder, env=environment, names=(folder,), codes=codes, patience=30)
        return
    out = case.path("out")
    case.run("run", QUICK, *BOTH, *setting(output_report="true"), "--output", out, "--quiet", output=out, env=environment, names=(out,),
             codes=codes, patience=30)
    if not os.path.exists(os.path.join(out, "comparison.json")):
        case.violate("the comparison is not kept")


KINDS = {"disk": disk, "surroundings": surroundings}
