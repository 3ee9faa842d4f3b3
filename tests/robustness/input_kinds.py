# diptych: damaged input files, and every key at its bounds
# SPDX-License-Identifier: LGPL-2.1-or-later
import functools
import json
import os
import random
import re
import shutil

import bases
import damage
from bases import FORMATS, NODES, PROBLEM, QUICK, TIMES, TINY
from judge import read
from running import bits, setting


@functools.lru_cache(maxsize=None)
def explained_keys():
    """(section/key, allowed values) of all keys."""
    return tuple((f"{key['section']}/{key['key']}", key["allowed"])
                 for key in json.loads(bases.printed("explain", "--json"))["keys"])


def key_names():
    return tuple(name for name, _ in explained_keys())


def values_of(allowed):
    """Values that a key may accept, and values that it must refuse."""
    good, bad = ["-0", "0x10", "", "1e-320", "+1", "auto", "true", "0", "ä", "a b # c"], []
    bounds = re.search(r"(a whole number|a number|a list of numbers) from (\S+) to (\S+)", allowed)
    if bounds:
        low, high = float(bounds[2]), float(bounds[3])
        good += [bounds[2], bounds[3]]
        bad += ["nan", "inf", "1e400", "word", "1,2,x"]
        if bounds[1] == "a whole number":
            good += [str(int(low) + 1)]
            bad += [str(int(low) - 1), str(int(high) + 1), repr(low + 0.5)]
        else:
            good += [repr((low * high) ** 0.5 if low > 0 else (low + high) / 2)]
            bad += [repr(low - (abs(low) * 1e-6 or 1e-9)), repr(high + (abs(high) * 1e-6 or 1e-9))]
    elif allowed.startswith("one of ") or allowed == "true or false":
        words = re.split(", | or ", allowed.removeprefix("one of "))
        good += words
        bad += ["word", words[0].upper(), words[0] + "x", "nan"]
    return good, bad


@functools.lru_cache(maxsize=None)
def all_values():
    """(key, value, whether the program must refuse it) in a fixed order, so that consecutive seeds cover all keys."""
    found = [(name, value, k == 1) for name, allowed in explained_keys() for k,
             values in enumerate(values_of(allowed)) for value in values]
    random.Random("keys").shuffle(found)
    return tuple(found)


CONTEXT = (  # the keys without which other keys have no effect
    ("discrete/penalty", setting(discrete_method="penalty")),
    ("discrete/(side|wall)_", setting(discrete_lateral="rigid_walls")),
    ("loading/normal_pressure", setting(loading_mode="plane_shear")),
    ("loading/(duration|stage_time)|discrete/drive_", TIMES),
    ("continuum/refinement_", setting(continuum_refinement="adaptive")),
    ("continuum/weak_spot_", setting(continuum_weak_spot_strain=0.1)),
    ("comparison/averaging_", setting(comparison_averaging="kernel")),
    ("continuum/(critical_|strength_by|dilatancy_ratio|elastic_stress|.*_start)",
     setting(continuum_hardening="kinematic", continuum_solid_fraction_start=0.82)),
)


def keys(case):
    values = all_values()
    name, value, must_fail = values[case.seed % len(values)]
    command, words = {"continuum": case.dice.choice([("continuum", NODES), ("material-point", TINY)]),
                      "comparison": ("run", bases.BOTH)}.get(name.split("/")[0], ("discrete", TINY))
    for pattern, more in CONTEXT:
        words = words + (more if re.match(pattern, name) else [])
    out = case.path("out")
    case.run(command, QUICK, *words, "--set", f"{name}={value}", "--output", out, "--quiet", output=out, patience=1.5,
             names=(name,) if must_fail else key_names(), codes=(2,) if must_fail else (0, 2, 3, 4))


def as_prm(sections):
    return "".join(f"subsection {section}\n" + "".join(f"  set {key} = {value}\n" for key, value in items.items())
                   + "end\n"
                   for section, items in sections.items())


def scene_text(case, name):
    sections = {}
    for word in NODES[1::2]:
        section, key, value = re.fullmatch(r"(\w+)/(\w+)=(.*)", word).groups()
        is_text = name.endswith(".prm") or not re.fullmatch(r"[\d.e-]+", value)
        sections.setdefault(section, {})[key] = value if is_text else float(value)
    deep = case.dice.choice([60000, 300000])
    if name.endswith(".json") and case.dice.random() < 0.3:
        return case.dice.choice(["[" * deep + "]" * deep, '{"a":' * deep + "1" + "}" * deep, "[" * deep,
                                 '{"sample": {"grains": ' + "[" * deep]).encode()
    return damage.damage_text(case.dice,
                              (as_prm(sections) if name.endswith(".prm") else json.dumps(sections, indent=1)).encode())


def scenes(case):
    """A scene that is damaged, or a folder or device in its place."""
    name, out = case.dice.choice(["scene.prm", "scene.prm", "scene.json"]), case.path("out")
    place = case.dice.choice([".", name, "/dev/zero", "/dev/null",
                              os.path.join(case.base("grains"), "out", "discrete.h5")])
    if case.dice.random() < 0.06:
        os.symlink(place, case.path(name))
    else:
        case.write(name, scene_text(case, name))
    command = case.dice.choice(["discrete"] * 8 + ["material-point", "continuum"])
    case.run(command, name, "--output", out, "--quiet", output=out, names=(name, *key_names()), patience=2)


def csv(case):
    """Samples, drive tables and gradings."""
    name, words = case.dice.choice([
        ("grains.csv", setting(sample_file="grains.csv")), ("grains.csv", setting(sample_file="grains.csv")),
        ("speed.csv", TIMES + ["--set", "discrete/drive_upper_y=velocity speed.csv"]),
        ("radii.csv", setting(sample_radius_distribution="table", sample_radius_table="radii.csv",
                              sample_radius_min=0.3, sample_radius_max=0.7))])
    case.write(name, damage.damage_text(case.dice, read(os.path.join(case.base("grains"), name))))
    out = case.path("out")
    case.run("discrete", QUICK, *TINY, *words, "--output", out, "--quiet", output=out, names=(name, *key_names()))


def damage_hdf5(case, name, often=""):
    """True if the program must notice the damage where it reads the item."""
    if case.dice.random() < 0.7:
        return case.damage_arrays(name, often)
    case.damage(case.path(name), damage.BYTES)
    return False


def snapshots(case):
    """Snapshots of an earlier run as a sample."""
    name, out, whole = "snapshots.h5", case.path("out"), os.path.join(case.base("grains"), "out", "discrete.h5")
    shutil.copy(whole, case.path(name))
    is_plain = damage_hdf5(case, name, "grains/(position|radius|velocity|spin|rotation|fixed|mass)")
    words = ["discrete", QUICK, *TINY, "--quiet"]
    outcome = case.run(*words, *setting(sample_file=name), "--output", out, output=out, names=(name,))
    if outcome.code == 0 and is_plain:
        case.expect_same(bases.whole(case.keep, "snapshots",
                                     lambda to: [*words, *setting(sample_file=whole), "--output", to]), out)


def problems(case):
    """FCLIB files for `diptych solve`."""
    name, out = "problem.h5", case.path("solved.h5")
    shutil.copy(PROBLEM, case.path(name))
    is_plain = damage_hdf5(case, name, "fclib|nscd")
    words = ["--form", case.dice.choice(["local", "body"]), "--max-sweeps", "20000", "--output"]
    outcome = case.run("solve", name, *words, out, output=out, names=(name,))
    # without one group it is a whole problem in the other form
    if outcome.code == 0 and is_plain and ": group" not in case.log[0]:
        whole = bases.whole(case.keep, "problem_" + words[1], lambda to: ["solve", PROBLEM, *words, to])
        if any(bits(whole)[key] != bits(out)[key] for key in ("solution/r", "solution/u")):
            case.violations.append("another solution than that of the undamaged problem")


def imports(case):
    """Files of another code, in any order. In most cases one of them is damaged."""
    kind = case.dice.choice(sorted(FORMATS))
    form, _, words = FORMATS[kind]
    names, out, is_plain = [os.path.basename(path) for path in bases.foreign(kind)], case.path("mine"), False
    for path in bases.foreign(kind):
        shutil.copy(path, case.work)
    case.dice.shuffle(names)
    is_whole = case.dice.random() < 0.05
    if not is_whole and names[0].endswith(".h5"):
        is_plain = damage_hdf5(case, names[0])
    elif not is_whole:
        case.write(names[0], damage.damage_text(case.dice, read(case.path(names[0]))))
    case.dice.shuffle(names)
    outcome = case.run("import", form, *names, *words, "--output", out, "--quiet", output=out,
                       names=(*names, "the files", "--", "import " + form),
                       codes=(0,) if is_whole else (0, 2, 3, 4), patience=20, has_numbers=False)
    if outcome.code == 0 and (is_plain or is_whole) and "warning" not in outcome.errors:
        case.expect_same(bases.whole(case.keep, kind, lambda to: ["import", form, *bases.foreign(kind), *words,
                                                                  "--output", to, "--quiet"]), out)


KINDS = {"scenes": scenes, "keys": keys, "csv": csv, "snapshots": snapshots, "problems": problems, "imports": imports}
