# diptych: reads LMGC90: BODIES.DAT with DOF and Vloc_Rloc files, or with its HDF5 file
# SPDX-License-Identifier: LGPL-2.1-or-later
"""LMGC90, discs DISKx between walls JONCx."""

import os
import re
from typing import Callable

import numpy as np

from .frames import Frame, Options, refused
from .lmgc90_bodies import Bodies, contacts_with, field, place_bodies, read_bodies, read_bulk
from .text import int_of, read_lines
from .walls import sorted_files


def _instant(path: str, lines: list[str]) -> tuple[int, float]:
    """Step and time of "$steps N time= T"."""
    for k, line in enumerate(lines, 1):
        if line.startswith("$steps"):
            words = line.split()
            if len(words) < 3:
                raise refused(path, "expected '$steps N time= T'", k)
            return int_of(path, k, words[1], "the step"), field(path, k, line, r"time=")
    raise refused(path, "the file ends without '$steps'", len(lines))


def _motions(path: str, bodies: Bodies) -> tuple[int, float, np.ndarray, np.ndarray]:
    """Step, time, and (n, 3) displacement and velocity of every body, in the order of BODIES.DAT.

    The pre-processor writes into DOF.INI only the bodies that do not start from 0; there a body is found by its number.
    """
    lines = read_lines(path)
    x, v = (np.array([[field(path, k, line, rf"{name}\({axis}\)=") for axis in (1, 2, 3)]
                      for k, line in enumerate(lines, 1) if name + "(1)=" in line]).reshape(-1, 3) for name in "XV")
    if len(x) != len(v):
        raise refused(path, f"{len(x)} bodies have X, but {len(v)} have V; is the file truncated?", len(lines))
    if _tail(path) == "INI" and len(x) < len(bodies.number):
        given = [line.split()[1] for line in lines if re.fullmatch(r"\s*RBDY2\s+\d+\s*", line)]
        rows = [k for k, number in enumerate(bodies.number) if number in given]
        if not len(x) == len(given) == len(set(given)) == len(rows):
            raise refused(path, f"has {len(x)} of the {len(bodies.number)} bodies of {bodies.path}, and their numbers "
                          "do not tell which ones (each must occur once in both files)")
        by_number = {number: k for k, number in enumerate(given)}
        full = np.zeros((2, len(bodies.number), 3))
        full[:, rows] = np.array([x, v])[:, [by_number[bodies.number[k]] for k in rows]]
        x, v = full
    return *_instant(path, lines), x, v


def _contacts(path: str, frame: Frame, bodies: Bodies) -> None:
    """Blocks of eight lines that begin with $icdan."""
    lines = read_lines(path)
    step, time = _instant(path, lines)
    if step != frame.step or abs(time - frame.time) > 1e-9 * abs(frame.time):
        raise refused(path, f"step {step} differs from that of {frame.grain_file} ({frame.step}): the frames do not "
                      "match")
    numbers, values = [], []
    for k, line in enumerate(lines):
        if not line.startswith("$icdan"):
            continue
        if k + 7 >= len(lines):
            raise refused(path, "the file ends within a contact; is it truncated?", len(lines))
        words = lines[k + 2].split()
        if len(words) < 11 or words[0] != "RBDY2" or words[5] != "RBDY2":
            raise refused(path, "expected RBDY2 N DISKx K law RBDY2 N DISKx or JONCx K status", k + 3)
        numbers.append([int_of(path, k + 3, words[1], "the candidate"), int_of(path, k + 3, words[6], "the antagonist"),
                        words[9].startswith("sl"), k + 3])
        fields = ((3, "rlt/H"), (3, "rln/H"), (5, "gapTT"), (6, r"n\(1\)="), (6, r"n\(2\)="), (7, "coo1="),
                  (7, "coo2="))
        values.append([field(path, k + row + 1, lines[k + row], name) for row, name in fields])
    numbers, values = np.array(numbers, dtype=int).reshape(-1, 4), np.array(values).reshape(-1, 7)
    frame.contact_file = path
    frame.contacts = contacts_with(path, numbers[:, :2], values, numbers[:, 2], bodies, lines=numbers[:, 3])


def _columns(file: object, path: str, quantity: str, n: int) -> slice:
    """Columns of a quantity. Help counts them from 1, both ends included."""
    low, high = (int(bound) for bound in file[f"Help/{quantity}/bound"][()])
    if low < 1 or high - low + 1 < n:
        raise refused(path, f"Help/{quantity}/bound does not name {n} columns")
    return slice(low - 1, low - 1 + n)


def _hdf5_frames(path: str, bodies: Bodies, gravity: tuple[float, float] | None) -> list[Frame]:
    """Frames Evolution/ID_k. The file has no geometry."""
    import h5py  # type: ignore

    try:
        frames = []
        with h5py.File(path, "r") as file:
            for name, group in file["Evolution"].items():
                frame = Frame(name, {}, gravity=gravity, grain_file=path, contact_file=path)
                frame.time, frame.step = float(np.ravel(group["TPS"][()])[0]), int(np.ravel(group["NStep"][()])[0])
                tables = "RBDY2/rdata", "VlocRloc/rdata", "VlocRloc/idata"
                motion, real, whole = (group[table][()] for table in tables)
                if not np.all(np.isfinite(motion)) or not np.all(np.isfinite(real)) or len(real) != len(whole):
                    raise refused(path, f"Evolution/{name} has a number that is not finite, or tables of different "
                                  "lengths")
                place_bodies(frame, bodies, *(motion[:, _columns(file, path, "RBDY2/rdata/" + q, 3)] for q in "XV"))
                parts = [("rl", 2), ("gapTT", 1), ("uc", 2), ("coor", 2)]
                values = np.column_stack([real[:, _columns(file, path, "VlocRloc/rdata/" + q, n)] for q, n in parts])
                status = whole[:, _columns(file, path, "VlocRloc/idata/status", 1)][:, 0]
                numbers = whole[:, _columns(file, path, "VlocRloc/idata/ibdyty", 2)]
                slides = (status == 6) | (status == 7)  # either way
                frame.contacts = contacts_with(path, numbers, values, slides, bodies)
                frames.append(frame)
        return frames
    except (OSError, RuntimeError, KeyError, IndexError, TypeError, AttributeError, OverflowError) as error:
        raise refused(path, f"is no HDF5 file of LMGC90 that can be read: {error}") from error


def _tail(path: str) -> str:
    """OUT.1 of DOF.OUT.1 or DOF.OUT.1.gz."""
    return re.sub(r"\.gz$", "", os.path.basename(path)).partition(".")[2]


def _is_named(*kinds: str) -> Callable[[str], bool]:
    """LMGC90 prescribes the names of its files, which may be packed."""
    return lambda path: os.path.basename(path).split(".")[0] in kinds


def read(options: Options) -> list[Frame]:
    """Frames in the order of time. Raises SceneError."""
    files = sorted_files(options, BODIES=_is_named("BODIES"), BULK_BEHAV=_is_named("BULK_BEHAV"), DOF=_is_named("DOF"),
                         Vloc_Rloc=_is_named("Vloc_Rloc"), h5=lambda path: path.endswith(".h5"),
                         other=_is_named("DRV_DOF", "TACT_BEHAV"))
    for path in files["other"]:
        options.note(f"{path}: this file is not needed")
    if not files["BODIES"]:
        raise refused("import lmgc90", "BODIES.DAT is missing; it contains radii and walls")
    if not files["DOF"] and not files["h5"]:
        raise refused("import lmgc90", "DOF.OUT.* or a .h5 file is missing; they contain the positions of the bodies")
    densities, gravity = read_bulk(files["BULK_BEHAV"][0]) if files["BULK_BEHAV"] else ({}, None)
    bodies = read_bodies(files["BODIES"][0], densities, options)
    frames = [frame for path in files["h5"] for frame in _hdf5_frames(path, bodies, gravity)]
    contacts = {_tail(path): path for path in files["Vloc_Rloc"]}
    for path in files["DOF"]:
        step, time, x, v = _motions(path, bodies)
        frames.append(Frame(_tail(path), {}, step=step, time=time, gravity=gravity, grain_file=path))
        place_bodies(frames[-1], bodies, x, v)
        if _tail(path) in contacts:
            _contacts(contacts.pop(_tail(path)), frames[-1], bodies)
    for tail, path in contacts.items():
        raise refused(path, f"there is no DOF.{tail}: the frames do not match")
    return sorted(frames, key=lambda frame: frame.time)
