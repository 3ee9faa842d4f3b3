# diptych: full disks and little memory
# SPDX-License-Identifier: LGPL-2.1-or-later
import contextlib
import ctypes
import functools
import os
import shutil
import subprocess
import threading

import bases
from bases import BOTH, NODES, QUICK, TINY
from cases import limit
from running import setting

COMMANDS = {"discrete": [QUICK, *TINY], "run": [QUICK, *BOTH], "continuum": [QUICK, *NODES]}
REPLACING = (  # commands on a folder with results of both panels, and the files that they do not compute anew
    (["compare", "OUT"], ("discrete.", "continuum.")), (["report", "OUT"],
                                                        ("discrete.", "continuum.", "comparison.", "scene.prm")),
    (["run", QUICK, *BOTH, *setting(comparison_max_bands=1), "--resume", "--output", "OUT"],
     ("discrete.", "continuum.")),
    (["run", QUICK, *BOTH, *setting(continuum_friction_angle_peak=30), "--resume", "--output", "OUT"], ("discrete.",)),
    (["continuum", QUICK, *BOTH, *setting(continuum_friction_angle_peak=30), "--output", "OUT"], ("discrete.",)),
    (["run", QUICK, *BOTH, "--overwrite", "--output", "OUT"], ("discrete.", "continuum.", "comparison.", "scene.prm")),
)


def called(*words):
    return subprocess.run(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False).returncode == 0


@functools.lru_cache(maxsize=None)
def can_mount():
    """Root can, in a name space of this process: its mounts end with it."""
    new_mounts = 0x00020000  # CLONE_NEWNS
    return (os.geteuid() == 0 and bool(shutil.which("mount")) and hasattr(ctypes.CDLL(None), "unshare")
            and ctypes.CDLL(None).unshare(new_mounts) == 0
            and called("mount", "--make-rprivate", "/"))


@contextlib.contextmanager
def small_disk(case):
    """A file system of 16 MB at `disk`, replaced in the end by a folder with the same files. Yields whether it could be
    mounted."""
    folder = case.path("disk")
    os.mkdir(folder)
    is_one = can_mount() and called("mount", "-t", "tmpfs", "-o", "size=16000k", "none", folder)
    try:
        yield is_one
    finally:
        if is_one:
            shutil.copytree(folder, case.path("copy"), ignore=shutil.ignore_patterns("fill"))
            called("umount", folder) or called("umount", "-l", folder)
            os.rmdir(folder)
            os.rename(case.path("copy"), folder)


def fill(folder, left):
    """Leaves `left` kB."""
    with open(os.path.join(folder, "fill"), "wb") as file:
        place = os.statvfs(folder)
        with contextlib.suppress(OSError):  # the program was faster
            for _ in range(place.f_bavail * place.f_frsize // 1024 - left):
                os.write(file.fileno(), bytes(1024))


def disk(case):
    """A disk that is full or becomes full. Without tmpfs, the system limits the size of files."""
    dice, keeps = case.dice, ()
    out = case.path("disk", "out")
    room = dice.choice([0, 4, 100]) if dice.random() < 0.3 else int(10 ** dice.uniform(0, 3.3))  # kB
    with small_disk(case) as is_one:
        way = dice.choice(["new", "new", "replace", "replace", "other"])
        if way == "new":
            command = dice.choice(sorted(COMMANDS))
            line = [command, *COMMANDS[command], "--output", out]
        elif way == "replace":
            shutil.copytree(os.path.join(case.base("both"), "out"), out)
            line, kept = dice.choice(REPLACING)
            line, keeps = [out if word == "OUT" else word for word in line], tuple("disk/out/" + name
                                                                                   for name in os.listdir(out)
                                                                                   if name.startswith(kept))
        else:
            line = dice.choice([["import", "csv", *bases.foreign("csv"), "--output", out],
                                ["export", os.path.join(case.base("both"), "out"), "--format",
                                 dice.choice(["csv", "lammps"]), "--output", out]])
        filler = threading.Timer(dice.choice([0, 0, dice.uniform(0, 0.3), dice.uniform(0, 1.5)]), fill,
                                 (case.path("disk"), room))
        if is_one:
            filler.start()
        case.run(*line, "--quiet", output=case.path("disk"), names=(out, "TMPDIR"), codes=(0, 4), keeps=keeps,
                 may_change=("disk/fill",), patience=30,
                 has_numbers=way != "other", preexec=limit if is_one
                 else functools.partial(limit, RLIMIT_FSIZE=1024 * room))
        if is_one:
            filler.join()


def memory(case):
    """Little memory. Below 490 MB the libraries do not load."""
    command, out = case.dice.choice(sorted(COMMANDS)), case.path("out")
    words = ["--threads", case.dice.choice(["1", "2", "64", "1024"])] if command != "continuum" else []
    case.run(command, *COMMANDS[command], *words, "--output", out, "--quiet", output=out,
             names=(out, "memory", "TMPDIR", "--threads"), codes=(0, 3, 4),
             patience=30, preexec=functools.partial(limit, memory=case.dice.randrange(520, 1500) << 20))


KINDS = {"disk": disk, "memory": memory}
