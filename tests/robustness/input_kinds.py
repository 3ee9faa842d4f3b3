# diptych: scenes, keys and command lines that people and programs may write
# SPDX-License-Identifier: LGPL-2.1-or-later

import json
import os
import re

import bases
import damage
import keys
import special_files
from bases import BOTH, NODES, PROBLEM, TINY
from pair_kind import TABLE, TIMES
from running import QUICK, setting


def settings(*words):
    """The keys of `--set` words."""
    return dict(word.split("=", 1) for word in words if word != "--set")


def as_sections(values):
    sections = {}
    for name, value in values.items():
        section, key = name.split("/")
        sections.setdefault(section, {})[key] = value
    return sections


def as_prm(values):
    text = "# a scene\n"
    for section, items in as_sections(values).items():
        text += f"subsection {section}\n" + "".join(f"  set {key} = {value}\n" for key, value in items.items()) + "end\n"
    return text


def as_json(values):
    def number(text):
        try:
            return json.loads(text)
        except ValueError:
            return [float(part) for part in text.split(",")] if re.fullmatch(r"[\d., e-]+", text) else text
    return json.dumps({section: {key: number(value) for key, value in items.items()} for section, items in as_sections(values).items()},
                      indent=1)


def deep_json(dice):
    n, kind = dice.choice([60000, 300000]), dice.choice(["list", "object", "value", "open"])
    if kind == "object":
        return '{"a":' * n + "1" + "}" * n
    if kind == "value":
        return '{"sample": {"grains": ' + "[" * n + "]" * n + "}}"
    return "[" * n + ("]" * n if kind == "list" else "")


def odd_place(case):
    """A scene that is no text file: its name as it is given."""
    kind = case.dice.choice(["/dev/zero", "/dev/null", "/dev/full", "folder", "missing", "itself", "results"])
    name = case.dice.choice(["scene.prm", "scene.json"])
    if kind.startswith("/dev"):
        os.symlink(kind, case.path(name))
    elif kind == "folder":
        os.mkdir(case.path(name))
    elif kind == "itself":
        os.symlink(name, case.path(name))
    elif kind == "results":
        os.symlink(os.path.join(case.base("grains"), "out", "discrete.h5"), case.path(name))
    return name


def scene_file(case):
    dice = case.dice
    if dice.random() < 0.06:
        return odd_place(case)
    if dice.random() < 0.08:
        case.write("scene.json", deep_json(dice))
        return "scene.json"
    kind = dice.choice(["prm", "prm", "json", "echo"])
    if kind == "echo":
        with open(os.path.join(case.base("grains"), "out", "scene.prm"), "rb") as file:
            content = file.read()
    else:
        content = (as_prm if kind == "prm" else as_json)(settings(*NODES)).encode()
    name = "scene.json" if kind == "json" else "scene.prm"
    case.write(name, damage.damage_text(dice, content))
    return name


def scenes(case):
    name, out = scene_file(case), case.path("out")
    command = case.dice.choice(["discrete"] * 8 + ["material-point", "continuum"])
    words = ["--set-file", name] if case.dice.random() < 0.1 and name.endswith(".prm") else []
    expected = {"names": (name, *keys.names()), "patience": 2, **special_files.instead(case, name)}
    outcome = case.run(command, QUICK if words else name, *(TINY if words else []), *words, "--output", out, "--quiet", output=out, **expected)
    if outcome.code == 0 and case.dice.random() < 0.5:
        again = case.path("again")
        case.run(command, os.path.join(out, "scene.prm"), "--output", again, "--quiet", output=again, codes=(0,))
        expect_same_echo(case, out, again)


def expect_same_echo(case, one, other):
    """The echo of a scene is that scene: run again it says the same of every key but its own folder."""
    lines = []
    for folder in (one, other):
        path = os.path.join(folder, "scene.prm")
        with open(path, "rb") as file:
            lines.append([line for line in file.read().split(b"\n") if not re.match(rb"\s*(set directory|#)", line)])
    if lines[0] != lines[1]:
        wrong = [pair for pair in zip(*lines) if pair[0] != pair[1]]
        case.violate(f"the echo run again gives another echo: {wrong[0] if wrong else 'longer or shorter'}")


# What a key needs to matter: by the beginning of its name.
CONTEXT = (
    ("discrete/penalty", setting(discrete_method="penalty")),
    ("discrete/side_", setting(discrete_lateral="rigid_walls", discrete_side_motion="velocity")),
    ("discrete/wall_", setting(discrete_lateral="rigid_walls")),
    ("loading/normal_pressure", setting(loading_mode="plane_shear")),
    ("loading/duration", TIMES), ("loading/stage_time", TIMES), ("discrete/drive_", TIMES),
    ("continuum/refinement_", setting(continuum_refinement="adaptive")),
    ("continuum/table_", TABLE),
    ("continuum/weak_spot_", setting(continuum_weak_spot_strain=0.1)),
    ("comparison/averaging_", setting(comparison_averaging="kernel")),
)
CRITICAL = ("critical_stress_ratio", "critical_solid_fraction", "strength_by_density", "dilatancy_ratio", "stress_ratio_start",
            "solid_fraction_start")


def context_of(name):
    words = [word for beginning, words in CONTEXT if name.startswith(beginning) for word in words]
    if name.split("/")[1] in CRITICAL:
        words = words + setting(continuum_hardening="critical_state", continuum_solid_fraction_start=0.82)
    return words


def command_of(case, name):
    section = name.split("/")[0]
    if section == "continuum":
        return case.dice.choice([("continuum", NODES), ("material-point", TINY)])
    if section == "comparison" and case.dice.random() < 0.5:
        return "run", BOTH
    return "discrete", TINY


def keys_kind(case):
    values = keys.all_values()
    key, value, must_fail, beside = values[case.seed % len(values)]
    command, words = command_of(case, key.name)
    if value == "true" and key.name == "output/report":
        command, words = "discrete", TINY  # alone it draws nothing
    out = case.path("out")
    if key.name == "output/directory":
        must_fail = False
    case.run(command, QUICK, *words, *context_of(key.name), *beside, "--set", f"{key.name}={value}", "--output", out, "--quiet", output=out,
             names=(key.name,) if must_fail else keys.names(), codes=(2,) if must_fail else (0, 2, 3, 4), patience=1.5)


OPTIONS = {
    "run": ["--output", "--set", "--set-file", "--threads", "--resume", "--seeds", "--jobs", "--quiet"],
    "study": ["--output", "--set", "--set-file", "--threads", "--jobs", "--resume", "--quiet"],
    "plan": ["--accuracy", "--for", "--run", "--output", "--set", "--jobs", "--resume"],
    "calibrate": ["--output", "--threads", "--jobs", "--resume", "--quiet"],
    "discrete": ["--output", "--set", "--set-file", "--threads", "--resume", "--study", "--quiet"],
    "continuum": ["--output", "--set", "--set-file", "--resume", "--quiet"],
    "material-point": ["--output", "--set", "--set-file", "--quiet"],
    "solve": ["--output", "--solver", "--tolerance", "--max-sweeps", "--form", "--threads"],
    "compare": ["--set", "--set-file", "--quiet"],
    "report": ["--quiet"],
    "import": ["--output", "--columns", "--thickness", "--timestep", "--density", "--pressure", "--mean-diameter", "--walls-touch"],
    "export": ["--format", "--output", "--stage", "--quiet"],
    "explain": ["--help"],
    "completion": ["--help"],
}
STRANGE = ["--frobnicate", "-x", "--", "--output=", "--set=", "--help=1", "--OUTPUT", "-", "--no-quiet", "---", "--threads=-1", "--quiet=2",
           "\udcff\udcfe", "", " ", "a" * 100000, "../..", "/dev/null", "/dev/full", "nan", "1e400", "-1", "99999999999999999999",
           "{}", "%s", "ä.prm", "discrete", "run", "*", "scene.prm/", "\n", "1-99999999999", "5-1", "1,,2", "sample/grains=", "=", "/=1"]


def words(case):
    """A command line put together from what commands take and what none does; what it writes goes into the case's folder."""
    dice = case.dice
    case.copy("grains", "done")
    case.write("scene.prm", as_prm(settings(*NODES)))
    with open(PROBLEM, "rb") as file:
        case.write("problem.h5", file.read())
    if dice.random() < special_files.OFTEN:
        return special_words(case)
    if dice.random() < 0.4:
        return told_words(case)
    command = dice.choice(sorted(OPTIONS))
    target = {"compare": "done/out", "report": "done/out", "export": "done/out", "solve": "problem.h5", "explain": "sample",
              "completion": "bash", "import": "csv"}.get(command, "scene.prm")
    line = [command] + ([target] if dice.random() < 0.8 else [])
    if command == "import":
        line += ["done/grains.csv"]
    for _ in range(dice.randrange(4)):
        owner = command if dice.random() < 0.5 else dice.choice(sorted(OPTIONS))
        line.append(dice.choice(OPTIONS[owner] + STRANGE))
        if dice.random() < 0.6:
            line.append(dice.choice(STRANGE + ["2", "psor", "csv", "out", "sample/grains=60", "1-2", "step"]))
    if dice.random() < 0.5:
        line.insert(dice.randrange(len(line) + 1), dice.choice(STRANGE))
    line = [word for word in line if "\0" not in word]
    # Where it writes is its own business here: it may be anywhere below the case's folder.
    case.run(*[os.fsencode(word) for word in line], output=case.work, patience=2, cwd=case.work)


def special_words(case):
    """A pipe, socket or device where a command wants a file."""
    name = case.dice.choice(["one.json", "one.prm", "one.h5"])
    special_files.put(case, name)
    line = case.dice.choice({"one.json": [["study"], ["calibrate"], ["discrete"]], "one.h5": [["solve"]],
                             "one.prm": [["plan", "--accuracy", "5 %"], ["continuum"], ["material-point"], ["discrete", "scene.prm", "--set-file"]]}[name])
    case.run(*line, name, output=case.path("out"), all_names=(name,), codes=(2,), by_itself=True, patience=special_files.PATIENCE)


def told_words(case):
    """Lines of which it is known what must be said."""
    seed_list = case.dice.choice(["1-x", "5-1", "0x3", "1,,2", "1-99999999999"])
    lines = [
        (["discrete", "scene.prm", "--threads", "100000", "--output", "out"], ["--threads"]),
        (["discrete", "scene.prm", "--seeds", "1-2", "--output", "out"], ["--seeds"]),
        (["run", "scene.prm", "--seeds", seed_list, "--output", "out"], ["--seeds"]),
        (["run", "scene.prm", "--jobs", "2", "--output", "out"], ["--jobs"]),
        (["continuum", "scene.prm", "--threads", "2", "--output", "out"], ["--threads"]),
        (["solve", "problem.h5", "--output", "scene.prm"], ["scene.prm"]),
        (["solve", "problem.h5", "--tolerance", "2"], ["--tolerance"]),
        (["solve", "scene.prm"], ["scene.prm"]),
        (["compare", "done/out", "--output", "other"], ["--output"]),
        (["report", "done/out", "--set", "sample/grains=60"], ["--set"]),
        (["compare", "scene.prm"], ["scene.prm"]),
        (["export", "done/out", "--format", "csv", "--stage", "77"], ["77"]),
        (["import", "csv", "done/out/discrete.csv", "--output", "done/out"], ["done/out"]),
        (["discrete", "scene.prm", "--set", "sample/file=done/out/discrete.csv", "--output", "done/out"], ["discrete.csv"]),
        (["discrete", "scene.prm", "--set", "sample/grian=5", "--output", "out"], ["grian"]),
        (["discrete", "scene.prm", "--set-file", "problem.h5", "--output", "out"], ["problem.h5"]),
        (["discrete", "scene.prm", "--study", "grid", "--output", "out"], ["--study"]),
        (["plan", "scene.prm", "--accuracy", "nan", "--output", "out"], ["--accuracy"]),
        (["study", "scene.prm", "--output", "out"], ["scene.prm"]),
        (["calibrate", "scene.prm", "--output", "out"], ["scene.prm"]),
        (["material-point", "scene.prm", "--resume"], ["--resume"]),
        (["explain", "nothing"], ["nothing"]),
        (["discrete"], ["SCENE"]),
        (["discrete", "scene.prm", "again.prm"], ["again.prm"]),
    ]
    line, names = case.dice.choice(lines)
    case.run(*line, all_names=names, codes=(2,), output=case.path("out"), patience=2)


KINDS = {"scenes": scenes, "keys": keys_kind, "words": words}
