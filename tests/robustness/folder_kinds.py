# diptych: result folders and checkpoints that lost something, and single bits flipped in files
# SPDX-License-Identifier: LGPL-2.1-or-later

import os
import shutil

import bases
import damage
import same
import special_files
from bases import BOTH, LONG, LONG_NODES, NODES, PROBLEM, TINY
from file_kinds import expect_same_as_whole, read
from running import QUICK, setting

FOREIGN_JSON = (b"[]", b"{}", b"null", b"1", b'{"program": "other"}', b'{"discrete": []}', b'{"stages": 3}', b'{"stages": [null]}',
                b'{"windows": {}, "stages": [{}]}', b"NaN", b'{"discrete": {"status": 5}, "version": []}', b'"text"', b"[" * 60000)


def of_another_version(case, path):
    """Files that were right once, or elsewhere."""
    name = os.path.basename(path)
    if name.endswith(".json"):
        return case.dice.choice(FOREIGN_JSON)
    content = read(path)
    if name.endswith(".csv"):
        head, _, rest = content.partition(b"\n")
        columns = head.split(b",")
        kind = case.dice.choice(["head", "renamed", "shuffled", "short", "none"])
        if kind == "renamed":
            columns[case.dice.randrange(len(columns))] = b"other"
        elif kind == "shuffled":
            case.dice.shuffle(columns)
        elif kind == "short":
            columns = columns[:len(columns) // 2]
        elif kind == "head":
            return head
        return rest if kind == "none" else b",".join(columns) + b"\n" + rest
    if name.endswith(".prm"):
        return content.replace(b"set ", b"set old_", 1)
    return damage.damage_bytes(case.dice, content)


def damage_folder(case, folder):
    """Changes one file of a result folder; its relative name."""
    files = sorted(name for name in same_files(folder) if not name.endswith((".vtu", ".xdmf", ".pvd", ".html")))
    name = case.dice.choice(files)
    path = os.path.join(folder, name)
    kind = case.dice.choice(["gone", "empty", "cut", "folder", "version", "version", "version", "arrays", "bytes", "loop", "special"])
    if kind == "arrays" and name.endswith(".h5"):
        case.damage_arrays(path)
        return name
    content = {"empty": lambda: b"", "cut": lambda: damage.cut(case.dice, read(path)), "version": lambda: of_another_version(case, path),
               }.get(kind, lambda: damage.damage_bytes(case.dice, read(path)))()
    os.remove(path)
    if kind == "folder":
        os.mkdir(path)
    elif kind == "special":
        special_files.put(case, os.path.relpath(path, case.work))
    elif kind == "loop":
        os.symlink(os.path.basename(path), path)
    elif kind != "gone":
        with open(path, "wb") as file:
            file.write(content)
    return name


def same_files(folder):
    return [os.path.relpath(os.path.join(root, name), folder) for root, _, names in os.walk(folder) for name in names]


USES = {  # of a base: words that read or continue it; {out} is its folder
    "both": [["compare", "{out}", "--quiet"], ["compare", "{out}", "--quiet"], ["export", "{out}", "--format", "csv", "--output", "theirs"],
             ["run", QUICK, *BOTH, "--output", "{out}", "--resume", "--quiet"], ["report", "{out}", "--quiet"]],
    "grains": [["export", "{out}", "--format", "yade", "--output", "theirs"], ["export", "{out}", "--format", "lammps", "--output", "theirs"],
               ["discrete", QUICK, *TINY, "--output", "{out}", "--resume", "--quiet"], ["compare", "{out}", "--quiet"]],
    "nodes": [["continuum", QUICK, *NODES, "--output", "{out}", "--resume", "--quiet"], ["compare", "{out}", "--quiet"]],
    "imported": [["export", "{out}", "--format", "csv", "--output", "theirs"], ["discrete", "{out}/scene.prm", "--output", "theirs", "--quiet"],
                 ["compare", "{out}", "--quiet"]],
    "ensemble": [["compare", "{out}", "--quiet"], ["run", QUICK, *BOTH, *bases.SEEDS, "--output", "{out}", "--resume", "--quiet"]],
    "study": [["study", "{out}/../steps.json", "--output", "{out}", "--resume", "--quiet", "--jobs", "1"]],
    "calibration": [["calibrate", "{out}/../one.json", "--output", "{out}", "--resume", "--quiet", "--jobs", "1"]],
}
OFTEN = ["both"] * 10 + ["grains"] * 5 + ["nodes"] * 2 + ["imported"] * 4 + ["ensemble", "study", "calibration"]


def folders(case):
    """Something of a finished folder is missing, cut, foreign or of another version."""
    base = case.dice.choice(OFTEN)
    folder = os.path.join(case.copy(base, "done"), "out")
    victim = damage_folder(case, folder)
    line = [word.replace("{out}", folder) for word in case.dice.choice(USES[base])]
    output = case.path("theirs") if "theirs" in line else folder
    line = [case.path(word) if word == "theirs" else word for word in line]
    is_special = bool(case.done) and case.done[-1].endswith(special_files.KINDS)
    expected = {"codes": (2,)} if is_special and victim == "discrete.h5" and line[0] in ("compare", "export") else {}
    case.run(*line, output=output, names=(os.path.basename(victim), folder), patience=30, by_itself=is_special, **expected)


def checkpoints(case):
    """A run interrupted for real, its checkpoint damaged: refused by name, or the bits of the run left alone."""
    kind, command, words, checkpoint = case.dice.choice([("grains", "discrete", LONG, "checkpoint.h5")] * 3
                                                        + [("nodes", "continuum", LONG_NODES, "continuum_checkpoint.h5")])
    folder = os.path.join(case.copy("stopped_" + kind, "done"), "out")
    name = checkpoint if case.dice.random() < 0.75 else case.dice.choice(
        [name for name in sorted(os.listdir(folder)) if name.endswith(".h5") and name != checkpoint])
    path = os.path.join(folder, name)
    way, can_be_told = case.dice.random(), True
    if way < 0.5:
        can_be_told = case.damage_arrays(path)
    else:
        with open(path, "rb") as file:
            content = damage.damage_bytes(case.dice, file.read())
        with open(path, "wb") as file:
            file.write(content)
    outcome = case.run(command, QUICK, *words, "--output", folder, "--resume", "--quiet", output=folder, names=(name,), patience=20)
    if outcome.code == 0 and can_be_told:  # one number of the kind that stands there, with its checksum, is a checkpoint of another state
        expect_same_as_base(case, "long_" + kind, folder)


def expect_same_as_base(case, base, folder):
    wrong = same.differences(same.results(os.path.join(case.base(base), "out")), same.results(folder))
    if wrong:
        case.violate("not the bits of the run left alone: " + "; ".join(wrong[:4]))


def flip_in(case, path):
    with open(path, "rb") as file:
        content = file.read()
    flipped = (damage.flip_bit if case.dice.random() < 0.8 else damage.flip_bytes)(case.dice, content)
    with open(path, "wb") as file:
        file.write(flipped)


def flips(case):
    """One bit or byte of an HDF5 file: refused by name, or the bits that the whole file gives."""
    case.dice.choice((flip_checkpoint, flip_checkpoint, flip_snapshot, flip_snapshot, flip_problem, flip_result, flip_export, flip_comparison))(case)


def flip_checkpoint(case):
    kind, command, words, name = case.dice.choice([("grains", "discrete", LONG, "checkpoint.h5"), ("grains", "discrete", LONG, "discrete.h5"),
                                                   ("nodes", "continuum", LONG_NODES, "continuum_checkpoint.h5")])
    folder = os.path.join(case.copy("stopped_" + kind, "done"), "out")
    flip_in(case, os.path.join(folder, name))
    outcome = case.run(command, QUICK, *words, "--output", folder, "--resume", "--quiet", output=folder, names=(name,), codes=(0, 2),
                       patience=20)
    if outcome.code == 0:
        expect_same_as_base(case, "long_" + kind, folder)


def flip_snapshot(case):
    name, out, whole = "snapshots.h5", case.path("out"), os.path.join(case.base("grains"), "out", "discrete.h5")
    shutil.copy(whole, case.path(name))
    flip_in(case, case.path(name))
    words = ["discrete", QUICK, *TINY, *setting(sample_file=name), "--quiet"]
    outcome = case.run(*words, "--output", out, output=out, names=(name,), codes=(0, 2))
    if outcome.code == 0:
        def make(folder):
            shutil.copy(whole, case.path(name))
            bases.done(case.work, *words, "--output", folder)
        expect_same_as_whole(case, "snapshot", make, out)


def flip_problem(case):
    name, solved = "problem.h5", case.path("out", "solved.h5")
    os.mkdir(case.path("out"))
    shutil.copy(PROBLEM, case.path(name))
    flip_in(case, case.path(name))
    words = ["solve", name, "--max-sweeps", "20000"]
    # A file of others has no checksums: what it says is solved, if it can be.
    case.run(*words, "--output", solved, output=case.path("out"), names=(name,), codes=(0, 2, 3))


def flip_result(case):
    folder = os.path.join(case.copy("both", "done"), "out")
    name = case.dice.choice(["discrete.h5", "continuum.h5"])
    flip_in(case, os.path.join(folder, name))
    outcome = case.run("compare", folder, "--quiet", output=folder, names=(name,), codes=(0, 2), patience=20)
    if outcome.code == 0:
        def make(other):
            shutil.copytree(os.path.join(case.base("both"), "out"), other)
            bases.done(case.work, "compare", other, "--quiet")
        read_again = ["comparison.h5", "comparison.json", "comparison.csv"]
        expect_same_as_whole(case, "comparison", make, only(case, folder, read_again))


def only(case, folder, names):
    """The folder with its files that are results of this run; the others as they were."""
    shown = case.path("shown")
    shutil.copytree(os.path.join(case.base("both"), "out"), shown)
    for name in names:
        shutil.copy(os.path.join(folder, name), shown)
    return shown


def flip_export(case):
    folder = os.path.join(case.copy("grains", "done"), "out")
    flip_in(case, os.path.join(folder, "discrete.h5"))
    out = case.path("theirs")
    line = ["export", "--format", "csv", "--quiet"]
    outcome = case.run(*line, folder, "--output", out, output=out, names=("discrete.h5",), codes=(0, 2))
    if outcome.code == 0:
        expect_same_as_whole(case, "export", lambda other: bases.done(case.work, *line, os.path.join(case.base("grains"), "out"),
                                                                     "--output", other), out)


def flip_comparison(case):
    """What a report draws: the same report, or none."""
    folder = os.path.join(case.copy("report", "done"), "out")
    os.remove(os.path.join(folder, "report.html"))
    flip_in(case, os.path.join(folder, "comparison.h5"))
    outcome = case.run("report", folder, "--quiet", output=folder, names=("comparison.h5",), codes=(0, 2), patience=30)
    if outcome.code == 0 and read(os.path.join(folder, "report.html")) != read(os.path.join(case.base("report"), "out", "report.html")):
        case.violate("the report is not that of the whole comparison.h5")


KINDS = {"folders": folders, "checkpoints": checkpoints, "flips": flips}
