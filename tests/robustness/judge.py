# diptych: what the program may do, whatever it is given: the one place where a run is judged
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rules. Each takes what happened (Outcome) and what the case expects (Expected) and returns sentences: what is violated."""

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
# Texts of libraries that say nothing to a user: never, whatever stands beside them, or not without a name of his in the line.
NEVER = ("Traceback (most recent call last)", "terminate called", "what():", "HDF5-DIAG", "Segmentation fault", "AddressSanitizer", "runtime error: ",
         "std::bad_alloc", "bad_array_new_length", "std::exception", "basic_filebuf", "basic_ios::clear", "cannot create std::", "std::length_error", "vector::_M_",
         "basic_string::_M_", "basic_string: ", "_M_range_check")
NOT_ALONE = ("[json.exception", "regex_error", "stoi", "stod")
OWN_STATE = ("checkpoint.h5", "continuum_checkpoint.h5")  # not results; of other runs
LOCK = re.compile(r"(^|[._-])lock$")

# Numbers that are no number by their meaning, beyond those of which `diptych explain results` says so.
NO_NUMBER = (
    (r"discrete\.h5", r"stage_\d+/stress_change", "as stress_error: not estimated"),
    (r"comparison\.h5", r"histories/\w+/\w+_mean", "running means have none before a whole averaging_strain"),
    (r"comparison\.h5", r"stage_\d+/discrete/(stress_ratio|stress_direction)", "grains without a force have no direction and no ratio"),
    (r"comparison\.h5", r"(stage|window)_\w+/(cells|grid)/\w+", "cells without a grain have no mean of grains"),
    (r"(ensemble|study)\.h5", r"\w+/(stress_ratio|volumetric_strain).*", "curves where a panel has no point within the running mean"),
    (r"discrete\.(csv|h5)", r".*", "imported: what the other code did not tell"),
    (r"comparison\.h5", r"(stage|window)_\d+/(velocity_unit|discrete/(rotation_increment|speed_over_platen))", "imported: without times and rotations there are none"),
)


@dataclasses.dataclass
class Outcome:
    words: list
    code: int  # of Popen: negative where a signal ended it
    out: str
    errors: str
    before: dict  # of every file that the case has: digest()
    after: dict
    output: str = ""  # the folder or file that it was told to write, "": none
    root: str = ""  # of the digests
    is_hung: bool = False
    sent: int = 0  # signal that the harness sent, 0: none


@dataclasses.dataclass
class Expected:
    names: tuple = ()  # one of these stands in the message of code 2
    all_names: tuple = ()  # and each of these
    codes: tuple = CODES
    documented: tuple = ()  # documented_no_numbers()
    by_itself: bool = False  # within the patience: without being asked to stop
    may_change: tuple = ()  # relative paths beside the output that it may write to


def digest(root):
    """Every file, folder and link below `root` by its relative path, with what it holds."""
    found = {}
    for folder, names, files in os.walk(root):
        for name in names + files:
            path = os.path.join(folder, name)
            if os.path.islink(path):
                found[os.path.relpath(path, root)] = "-> " + os.readlink(path)
            elif os.path.isdir(path):
                found[os.path.relpath(path, root)] = "folder"
            elif not os.path.isfile(path):
                found[os.path.relpath(path, root)] = "a pipe, socket or device"
            else:
                with open(path, "rb") as file:
                    found[os.path.relpath(path, root)] = hashlib.blake2b(file.read(), digest_size=16).hexdigest()
    return found


def documented_no_numbers(text):
    """(file name, name) of what `explain results` says may hold nan or inf."""
    files, name, found = [], "", set()
    for line in text.splitlines():
        if re.match(r"\S", line):
            files = re.findall(r"[\w/]+\.(?:csv|h5|json|vtu)", line)
        elif re.match(r"  \S", line):
            name = line.split()[0]
        elif re.search(r"\b(nan|inf)\b", line):
            found |= {(file, name) for file in files}
    return tuple(sorted(found))


def changes(outcome):
    names = sorted(set(outcome.before) | set(outcome.after))
    return [name for name in names if outcome.before.get(name) != outcome.after.get(name)]


def text_of_end(outcome):
    return signal.Signals(-outcome.code).name if outcome.code < 0 else str(outcome.code)


def ends_by_itself(outcome, _):
    if outcome.is_hung:
        return ["it hung" + (" after SIGTERM" if outcome.sent else "")]
    if outcome.code < 0 and -outcome.code != outcome.sent or outcome.code in (134, 135, 136, 137, 139):
        return ["it died of a signal: " + text_of_end(outcome)]
    return []


def ends_without_being_asked(outcome, expected):
    return ["it waited until it was told to stop"] if expected.by_itself and outcome.sent and not outcome.is_hung else []


def code_is_allowed(outcome, expected):
    if outcome.code < 0 or outcome.is_hung:
        return []
    allowed = set(expected.codes) | ({0, 3} if outcome.sent else set())
    return [] if outcome.code in allowed and outcome.code in CODES else [f"exit code {outcome.code}, not one of {sorted(allowed)}"]


def no_text_of_a_library(outcome, expected):
    wrong = [text for text in NEVER if text in outcome.errors]
    for line in outcome.errors.splitlines():
        named = "/" in line or any(name and name in line for name in expected.names + expected.all_names)
        wrong += [text for text in NOT_ALONE if text in line and not named]
    return [f"standard error holds '{text}'" for text in dict.fromkeys(wrong)]


def wrong_input_is_named(outcome, expected):
    if outcome.code != 2:
        return []
    told = outcome.errors + outcome.out
    found = []
    if expected.names and not any(name in told for name in expected.names):
        found.append("exit code 2 names none of " + ", ".join(expected.names[:8]))
    found += [f"exit code 2 does not name {name}" for name in expected.all_names if name not in told]
    if not outcome.errors.strip():
        found.append("exit code 2 without a word")
    return found


def wrong_input_changes_nothing(outcome, _):
    changed = changes(outcome) if outcome.code == 2 else []
    return ["exit code 2, but changed: " + ", ".join(changed[:6])] if changed else []


def nothing_beside_the_output_changes(outcome, expected):
    inside = os.path.relpath(outcome.output, outcome.root) if outcome.output else None

    def own(name):
        return name in expected.may_change or inside is not None and (
            name == inside or name.startswith(inside + os.sep) or inside.startswith(name + os.sep) or inside == ".")
    changed = [name for name in changes(outcome) if not own(name)]
    return ["changed beside the output: " + ", ".join(changed[:6])] if changed else []


def what_is_kept_is_said(outcome, expected):
    if outcome.code not in (3, 4):
        return []
    found = []
    if not re.search(r"\bkept\b|nothing was written|status: ", outcome.errors + outcome.out):
        found.append(f"exit code {outcome.code} says neither what is kept nor that nothing was written")
    if outcome.code == 4 and "/" not in outcome.errors and not any(name in outcome.errors for name in expected.names + expected.all_names):
        found.append("exit code 4 names nothing")
    return found


def nothing_half_done_is_left(outcome, _):
    if outcome.sent == signal.SIGKILL:
        return []
    left = [name for name in outcome.after if name not in outcome.before
            and (name.endswith(".part") or LOCK.search(os.path.basename(name)))]
    return ["left behind: " + ", ".join(sorted(left)[:6])] if left else []


def is_no_number(text):
    try:
        return not math.isfinite(float(text))
    except (TypeError, ValueError):
        return False


def in_table(path):
    """Names of the columns of a .csv that hold nan or inf."""
    with open(path, encoding="utf-8", errors="replace", newline="") as file:
        return {str(name) for row in csv.DictReader(file) for name, value in row.items() if is_no_number(value)}


def in_json(path):
    """nan and inf are no JSON: where they stand, as text."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    found = set()

    def number(word):
        if is_no_number(word):
            found.add(word)
        return word
    try:
        json.loads(text, parse_constant=number, parse_float=number)
    except (ValueError, RecursionError) as error:
        found.add("no JSON: " + str(error))
    return found


def in_arrays(path):
    """Names of datasets and attributes that hold nan or inf."""
    found = set()

    def look(name, item):
        for key, value in [*item.attrs.items(), *([("", item[()])] if isinstance(item, h5py.Dataset) else [])]:
            value = numpy.asarray(value)
            if value.dtype.kind == "f" and not numpy.isfinite(value).all():
                found.add(name + "/" + key if key else name)
    with h5py.File(path, "r") as file:
        file.visititems(look)
    return found


def is_of_another_code(folder):
    """Imported, or computed on what was."""
    if os.path.exists(os.path.join(folder, "import.json")):
        return True
    scene = os.path.join(folder, "scene.prm")
    if not os.path.isfile(scene):
        return False
    with open(scene, "rb") as file:
        return re.search(rb"set method\s*= imported", file.read()) is not None


def is_documented(name, inside, expected, imported):
    short = re.sub(r"^(stage|window)_\d+/", "", inside)
    if any(name == os.path.basename(file) and (inside == item or short == item) for file, item in expected.documented):
        return True
    return any(re.fullmatch(file, name) and re.fullmatch(item, inside) and (imported or not why.startswith("imported"))
               for file, item, why in NO_NUMBER)


def results_hold_numbers(outcome, expected):
    if outcome.code != 0 or not os.path.exists(outcome.output):
        return []
    found, changed = [], changes(outcome)
    for relative in changed:
        path, name = os.path.join(outcome.root, relative), os.path.basename(relative)
        if relative not in outcome.after or not os.path.isfile(path) or name in OWN_STATE:
            continue
        look = {".csv": in_table, ".json": in_json, ".h5": in_arrays}.get(os.path.splitext(name)[1])
        if look is None:
            continue
        try:
            inside = look(path)
        except (OSError, RuntimeError, UnicodeDecodeError) as error:
            found.append(f"{relative} cannot be read: {error}")
            continue
        imported = bool(inside) and is_of_another_code(os.path.dirname(path))
        wrong = sorted(item for item in inside if not is_documented(name, item, expected, imported))
        if wrong:
            found.append(f"exit code 0, but no numbers in {relative}: " + ", ".join(wrong[:6]))
    return found


RULES = (ends_by_itself, ends_without_being_asked, code_is_allowed, no_text_of_a_library, wrong_input_is_named, wrong_input_changes_nothing,
         nothing_beside_the_output_changes, what_is_kept_is_said, nothing_half_done_is_left, results_hold_numbers)


def judge(outcome, expected):
    return [sentence for rule in RULES for sentence in rule(outcome, expected)]
