# diptych: commands begun again over results: of the same scene or another, beside somebody's files, with an input that lies there
# SPDX-License-Identifier: LGPL-2.1-or-later

import os
import shutil

import bases
from bases import BOTH, NODES, SEEDS, TINY
from cases import limit
from file_kinds import expect_same_as_whole, read
from running import QUICK, bound_by_permissions, setting

LINES = {  # of a base: what is begun over it, but for --output
    "grains": [["discrete", QUICK, *TINY], ["discrete", QUICK, *TINY, *setting(sample_seed=3)], ["material-point", QUICK, *TINY]],
    "nodes": [["continuum", QUICK, *NODES], ["continuum", QUICK, *NODES, *setting(continuum_friction_angle_peak=30)]],
    "both": [["run", QUICK, *BOTH], ["discrete", QUICK, *BOTH, *setting(discrete_friction=0.3)], ["continuum", QUICK, *BOTH]],
    "ensemble": [["run", QUICK, *BOTH, *SEEDS], ["run", QUICK, *BOTH, *setting(discrete_friction=0.3), *SEEDS]],
    "study": [["study", "steps.json", "--jobs", "1"]],
    "calibration": [["calibrate", "one.json", "--jobs", "1"]],
    "plan": [bases.PLAN],
}
CHANGES = (setting(continuum_friction_angle_peak=30), setting(comparison_max_bands=1), setting(continuum_checkpoint_minutes=7))


def again(case):
    case.dice.choice((beside_somebodys, beside_somebodys, beside_its_input, over_another_scene, over_a_changed_echo, where_nothing_can_be_removed))(case)


def taken(case):
    """A base with the files that its command reads; its name and its folder."""
    base = case.dice.choice(sorted(LINES))
    case.copy(base, ".")
    return base, case.path("out")


def beside_somebodys(case):
    """A file or folder that no run wrote, anywhere among what it did: there behind every run, whatever it says."""
    base, folder = taken(case)
    place = case.dice.choice(sorted([folder, *(os.path.join(root, name) for root, names, _ in os.walk(folder) for name in names)]))
    mine = os.path.join(place, case.dice.choice(["notes.txt", "mine", "mine.json", "my.prm"]))
    if case.dice.random() < 0.3:
        os.mkdir(mine)
        mine = os.path.join(mine, "notes")
    with open(mine, "w", encoding="utf-8") as file:
        file.write("mine\n")
    resume = ["--resume"] if case.dice.random() < 0.4 and base != "grains" else []
    case.run(*case.dice.choice(LINES[base]), *resume, "--output", folder, "--quiet", output=folder, names=(place, folder), patience=30)
    if not os.path.exists(mine) or read(mine) != b"mine\n":
        case.violate(f"{os.path.relpath(mine, case.work)} was somebody's, and is gone")


def beside_its_input(case):
    """What the command reads is a file of the folder that it writes to: refused, or read and left."""
    base, folder = taken(case)
    files = sorted(os.path.join(root, name) for root, _, names in os.walk(folder) for name in names)
    line, told = list(case.dice.choice(LINES[base])), None
    if base in ("study", "calibration", "plan") and case.dice.random() < 0.5:
        told = case.dice.choice(files)
        if case.dice.random() < 0.7:
            shutil.copy(os.path.join(case.work, line[1]) if base != "plan" else QUICK, told)
        line[1] = told
    else:
        key, ending = case.dice.choice([("sample/file", ".h5"), ("sample/file", ".csv"), ("continuum/mesh", ".msh"), ("sample/radius_table", ".csv")])
        told = case.dice.choice([name for name in files if name.endswith(ending)] or files)
        line += ["--set", f"{key}={told}"] if base != "calibration" else []
    before = read(told)
    case.run(*line, "--output", folder, "--quiet", output=folder, patience=30,
             names=(told, os.path.basename(told), folder, "sample/", "continuum/", "--set", line[1]))
    is_replaced = any(f"{told}" in word for word in line) and (not os.path.exists(told) or read(told) != before)
    if is_replaced and os.path.basename(told) not in ("scene.prm", "ensemble.prm"):
        case.violate(f"{os.path.relpath(told, case.work)} was read, and is not what it was")


def over_another_scene(case):
    """One panel alone with other keys, then the whole with --resume: what the whole gives in a new folder."""
    case.copy("both", ".")
    folder, change = case.path("out"), case.dice.randrange(len(CHANGES))
    first = case.dice.choice([["discrete"], ["discrete", "--resume"], ["continuum"], ["continuum", "--resume"], ["material-point"]])
    case.run(first[0], QUICK, *BOTH, *CHANGES[change], *first[1:], "--output", folder, "--quiet", output=folder, codes=(0,), patience=30)
    words = ["run", QUICK, *BOTH, *CHANGES[change]]
    if os.path.exists(os.path.join(folder, "comparison.json")) and change < 2:
        case.violate("a comparison of other keys stands beside the echo")
    case.run(*words, "--resume", "--output", folder, "--quiet", output=folder, codes=(0,), patience=30)
    for name in ("material_point.csv", "report.html"):
        if os.path.exists(os.path.join(folder, name)):
            os.remove(os.path.join(folder, name))
    expect_same_as_whole(case, f"changed_{change}", lambda other: bases.done(case.work, *words, "--output", other, "--quiet"), folder)


def over_a_changed_echo(case):
    """A value in scene.prm, a comment, or another run's: whatever reads the results or adds to them refuses it."""
    base = case.dice.choice(["grains", "nodes", "both"])
    case.copy(base, ".")
    folder, echo = case.path("out"), case.path("out", "scene.prm")
    lines = read(echo).splitlines(keepends=True)
    values = [k for k, line in enumerate(lines) if line.lstrip().startswith(b"set ")]
    how = case.dice.choice(["value", "value", "comment", "another's"])
    if how == "value":
        k = case.dice.choice(values)
        lines[k] = lines[k].split(b"=")[0] + b"= " + case.dice.choice([b"0.123", b"7", b"true", b"none", b"nan"]) + b"\n"
    elif how == "comment":
        lines.insert(case.dice.randrange(1, len(lines)), b"# mine\n")
    else:
        lines = [read(os.path.join(case.base(case.dice.choice([b for b in ("grains", "nodes", "both") if b != base])), "out", "scene.prm"))]
    if b"".join(lines) == read(echo):
        return
    case.write("out/scene.prm", b"".join(lines))
    case.done.append(f"scene.prm: {how}")
    line = case.dice.choice([["compare"], ["report"], ["export"], *LINES[base]])
    words = [line[0], folder, *(["--format", "csv"] if line[0] == "export" else [])] if len(line) == 1 else \
        [*line, *(["--resume"] if case.dice.random() < 0.5 and line[0] != "material-point" else []), "--output", folder]
    case.run(*words, *(["--quiet"] if line[0] != "export" else []), output=folder, codes=(2,), names=(folder, "out/scene.prm"), patience=30)


def where_nothing_can_be_removed(case):
    """A folder among the results that nobody may write to: ended as ever, or refused while everything stands."""
    base, folder = taken(case)
    for name in ("discrete", "continuum"):
        if base in ("grains", "nodes", "both") and case.dice.random() < 0.5:
            os.makedirs(os.path.join(folder, name), exist_ok=True)
            case.write(f"out/{name}/stage_0000.vtu", "")
    places = sorted([folder, *(os.path.join(root, name) for root, names, _ in os.walk(folder) for name in names)])
    place = case.dice.choice(places)
    os.chmod(place, 0o555)

    def bound():
        limit()
        bound_by_permissions()
    resume = ["--resume"] if case.dice.random() < 0.4 and base != "grains" else []
    outcome = case.run(*case.dice.choice(LINES[base]), *resume, "--output", folder, "--quiet", output=folder, names=(place, folder), patience=30, preexec=bound)
    os.chmod(place, 0o755)
    if outcome.code == 4 and outcome.after != outcome.before:
        case.violate(f"{os.path.relpath(place, case.work)} cannot be written to, and others are changed: " +
                     ", ".join(sorted(set(outcome.before) ^ set(outcome.after)) or ["their bytes"])[:300])


KINDS = {"again": again}
