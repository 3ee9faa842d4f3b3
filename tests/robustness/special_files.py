# diptych: what stands where a file is wanted and is none: pipes, sockets, devices
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whoever opens a pipe waits for a writer that never comes; a device has no end. All are refused by name before anything waits."""

import os
import shutil
import stat

KINDS = ("fifo", "fifo", "fifo", "socket", "/dev/zero", "/dev/full", "/dev/null", "/dev/random")
OFTEN = 0.06  # of the cases of a kind
PATIENCE = 15  # seconds: a right program needs none of them


def put(case, name):
    """In the place of a file of the case, if there is one."""
    path, kind = case.path(name), case.dice.choice(KINDS)
    if os.path.lexists(path):
        (os.rmdir if os.path.isdir(path) and not os.path.islink(path) else os.remove)(path)
    if kind in ("fifo", "socket"):
        os.mknod(path, 0o600 | {"fifo": stat.S_IFIFO, "socket": stat.S_IFSOCK}[kind])
    else:
        os.symlink(kind, path)
    case.done.append(f"{name}: {kind}")


def instead(case, name):
    """Now and then: what run() is to expect then; else nothing, and the case goes on as it is."""
    if case.dice.random() >= OFTEN:
        return {}
    put(case, name)
    return {"names": (os.path.basename(name),), "codes": (2,), "by_itself": True, "patience": PATIENCE}


def copy(source, target):
    """For copytree: a special file again, as what it is."""
    mode = os.lstat(source).st_mode
    if stat.S_ISREG(mode):
        shutil.copy2(source, target)
    else:
        os.mknod(target, mode)
