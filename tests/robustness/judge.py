# diptych: the rules that every run must obey, whatever its input
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A rule takes an Outcome and what the case expects, and returns sentences about violations."""

import csv
import dataclasses
import hashlib
import json
import math
import os
import re
import signal

import h5py
import numpy

CODES = (0, 2, 3, 4)
# Texts of libraries that tell the user nothing.
NEVER = ("Traceback (most recent call last)", "terminate called", "what():", "HDF5-DIAG", "Segmentation fault",
         "AddressSanitizer", "runtime error: ",
         "std::bad_alloc", "bad_array_new_length", "std::exception", "basic_filebuf", "basic_ios::clear",
         "cannot create std::", "std::length_error",
         "vector::_M_", "basic_string::_M_", "basic_string: ", "_M_range_check")
NOT_ALONE = ("[json.exception", "regex_error", "stoi", "stod")  # allowed beside the name of a file or key
OWN_STATE = ("checkpoint.h5", "continuum_checkpoint.h5")  # no results
LOCK = re.compile(r"(^|[._-])lock$")
# "FILE NAME" of arrays and columns that may hold nan or inf.
NO_NUMBER = re.compile(r"""
    discrete[.]h5\ .*(stress_change|stress_error|error_over_residual|left_x|right_x)   # not estimated, or no wall
  | comparison[.]h5\ (histories/.*_mean|.*(cells|grid|profile|platens)/.*|.*discrete/stress_.*)  # no window or force
  | (discrete|continuum)[.](csv|h5)\ .*stress_ratio                                    # no stress
  | (ensemble|study)[.]h5\ .*                                                          # curves of different lengths
  | calibration[.]csv\ parameter_deviation                                             # no intervals
""", re.VERBOSE)


@dataclasses.dataclass
class Outcome:
    code: int  # of Popen: negative if a signal ended it
    out: str
    errors: str
    before: dict  # digest() of the files of the case
    after: dict
    output: str  # the folder or file that the program writes
    root: str  # of the digests
    is_hung: bool = False
    sent: int = 0  # signal that the harness sent, 0: none


@dataclasses.dataclass
class Expected:
    names: tuple = ()  # a message of code 2 contains one of these
    codes: tuple = CODES
    may_change: tuple = ()  # relative paths that the harness or a shell changes
    keeps: tuple = ()  # relative paths that keep their bytes, in their place or in a renamed folder
    has_numbers: bool = True  # imported results lack what the other code did not write


def read(path):
    with open(path, "rb") as file:
        return file.read()


def digest(root):
    """The contents of every file, folder and link below `root` by its relative path."""
    found = {}
    for folder, names, files in os.walk(root):
        for name in names + files:
            path = os.path.join(folder, name)
            try:
                is_link, place = os.path.islink(path), os.path.relpath(path, root)
                found[place] = "-> " + os.readlink(path) if is_link else "folder" if os.path.isdir(
                    path) else hashlib.blake2b(read(path), digest_size=16).hexdigest()
            except FileNotFoundError:
                if not LOCK.search(name) and not name.endswith(".part"):
                    raise  # a worker of a killed run removes its lock and renames its last file while it ends
    return found


def changes(outcome):
    return [name for name in sorted(set(outcome.before) | set(outcome.after))
            if outcome.before.get(name) != outcome.after.get(name)]


def ends_by_itself(outcome, _):
    if outcome.is_hung:
        return ["it hung" + (" after SIGTERM" if outcome.sent else "")]
    if outcome.code < 0 and -outcome.code != outcome.sent or outcome.code in (134, 135, 136, 137, 139):
        return ["it died of a signal: " + (signal.Signals(-outcome.code).name if outcome.code < 0
                                           else str(outcome.code))]
    return []


def code_is_allowed(outcome, expected):
    allowed = set(expected.codes) | ({0, 3} if outcome.sent else set())
    is_right = outcome.code < 0 or outcome.is_hung or outcome.code in allowed & set(CODES)
    return [] if is_right else [f"exit code {outcome.code}, not one of {sorted(allowed)}"]


def message_is_the_programs_own(outcome, expected):
    wrong = [text for text in NEVER if text in outcome.errors]
    for line in outcome.errors.splitlines():
        if "/" not in line and not any(name in line for name in expected.names):
            wrong += [text for text in NOT_ALONE if text in line]
    return [f"standard error holds '{text}'" for text in dict.fromkeys(wrong)]


def wrong_input_is_named(outcome, expected):
    if outcome.code != 2:
        return []
    if not outcome.errors.strip():
        return ["exit code 2 without a message"]
    is_named = not expected.names or any(name in outcome.errors + outcome.out for name in expected.names)
    return [] if is_named else ["exit code 2 names none of " + ", ".join(expected.names[:8])]


def wrong_input_changes_nothing(outcome, _):
    changed = changes(outcome) if outcome.code == 2 else []
    return ["exit code 2, but changed: " + ", ".join(changed[:6])] if changed else []


def nothing_beside_the_output_changes(outcome, expected):
    inside = os.path.relpath(outcome.output, outcome.root)

    def own(name):
        return (name in expected.may_change or inside in (name, ".") or name.startswith(inside + os.sep)
                or inside.startswith(name + os.sep))
    changed = [name for name in changes(outcome) if not own(name)]
    return ["changed beside the output: " + ", ".join(changed[:6])] if changed else []


def message_says_what_is_kept(outcome, expected):
    found, written = [], set(changes(outcome)) - set(expected.may_change)
    if outcome.code in (3, 4) and written and not re.search(r"\bkept\b|nothing was written|status: ",
                                                            outcome.errors + outcome.out):
        found.append(f"exit code {outcome.code} does not say what is kept")
    if outcome.code == 4 and "/" not in outcome.errors and not any(name in outcome.errors for name in expected.names):
        found.append("exit code 4 names nothing")
    return found


def no_temporary_file_is_left(outcome, _):
    left = [] if outcome.sent == signal.SIGKILL else [name for name in outcome.after if name not in outcome.before and
                                                      (name.endswith(".part") or LOCK.search(os.path.basename(name)))]
    return ["left behind: " + ", ".join(sorted(left)[:6])] if left else []


def nothing_is_lost(outcome, expected):
    def is_kept(name):
        renamed = re.sub(r"(^|/)out(?=/|$)", r"\1out.1", name, count=1)
        return outcome.before[name] in (outcome.after.get(name), outcome.after.get(renamed))
    lost = [name for name in expected.keeps if not is_kept(name)]
    return ["lost: " + ", ".join(lost)] if lost else []


def is_no_number(text):
    try:
        return not math.isfinite(float(text))
    except (TypeError, ValueError):
        return False


def in_table(path):
    """The columns of a .csv that hold nan or inf."""
    with open(path, encoding="utf-8", newline="") as file:
        return {str(name) for row in csv.DictReader(file) for name, value in row.items() if is_no_number(value)}


def in_json(path):
    found = set()

    def number(word):
        if is_no_number(word):
            found.add(word)
    try:
        json.loads(read(path), parse_constant=number, parse_float=number)
    except (ValueError, RecursionError) as error:
        found.add("no JSON: " + str(error))
    return found


def in_arrays(path):
    """The datasets and attributes that hold nan or inf."""
    found = set()

    def look(name, item):
        for key, value in [*item.attrs.items(), *([("", item[()])] if isinstance(item, h5py.Dataset) else [])]:
            value = numpy.asarray(value)
            if value.dtype.kind == "f" and not numpy.isfinite(value).all():
                found.add(name + "/" + key if key else name)
    with h5py.File(path, "r") as file:
        file.visititems(look)
    return found


def results_hold_numbers(outcome, expected):
    found = []
    for relative in changes(outcome) if outcome.code == 0 and expected.has_numbers else ():
        path, name = os.path.join(outcome.root, relative), os.path.basename(relative)
        look = {".csv": in_table, ".json": in_json, ".h5": in_arrays}.get(os.path.splitext(name)[1])
        if look is None or not os.path.isfile(path) or name in OWN_STATE or os.path.dirname(path).endswith(".1"):
            continue
        try:
            wrong = sorted(item for item in look(path) if not NO_NUMBER.fullmatch(f"{name} {item}"))
        except (OSError, RuntimeError, UnicodeDecodeError) as error:
            wrong = [str(error)]
        if wrong:
            found.append(f"exit code 0, but no numbers in {relative}: " + ", ".join(wrong[:6]))
    return found


RULES = (ends_by_itself, code_is_allowed, message_is_the_programs_own, wrong_input_is_named,
         wrong_input_changes_nothing,
         nothing_beside_the_output_changes, message_says_what_is_kept, no_temporary_file_is_left, nothing_is_lost,
         results_hold_numbers)


def judge(outcome, expected):
    return [sentence for rule in RULES for sentence in rule(outcome, expected)]
