# diptych: files that the program reads: tables, snapshots, contact problems, other codes' files, meshes
# SPDX-License-Identifier: LGPL-2.1-or-later

import os
import shutil

import bases
import damage
import keys
import same
import special_files
from bases import FORMATS, NODES, PROBLEM, TINY
from running import QUICK, bits, setting


def read(path):
    with open(path, "rb") as file:
        return file.read()


def tables(case):
    """Samples, drive tables and gradings as CSV."""
    name = case.dice.choice(["grains.csv", "grains.csv", "speed.csv", "radii.csv"])
    case.write(name, damage.damage_text(case.dice, read(os.path.join(case.base("grains"), name))))
    words = {
        "grains.csv": setting(sample_file=name),
        "speed.csv": setting(loading_mode="time", loading_duration=1, loading_stage_time=0.5, comparison_window_edges="0,1")
        + ["--set", f"discrete/drive_upper_y=velocity {name}"],
        "radii.csv": setting(sample_radius_distribution="table", sample_radius_table=name, sample_radius_min=0.3, sample_radius_max=0.7),
    }[name]
    out = case.path("out")
    expected = {"names": (name, *keys.names()), **special_files.instead(case, name)}
    case.run("discrete", QUICK, *TINY, *words, "--output", out, "--quiet", output=out, **expected)


def expect_same_as_whole(case, kind, make, found):
    """What the undamaged file gives; made once for each kind of use."""
    whole = os.path.join(case.keep, "bases", "whole_" + kind)
    if not os.path.isdir(whole):
        temporary = case.path("whole")
        make(temporary)
        shutil.copytree(temporary, whole, dirs_exist_ok=True)
        shutil.rmtree(temporary)
    wrong = same.differences(same.results(whole), same.results(found))
    if wrong:
        case.violate("exit code 0, but not the bits that the undamaged file gives: " + "; ".join(wrong[:4]))


def snapshots(case):
    """Our own snapshots as a sample. What is damaged is refused, or it is not read."""
    name, out = "snapshots.h5", case.path("out")
    shutil.copy(os.path.join(case.base("grains"), "out", "discrete.h5"), case.path(name))
    is_plain = True
    if case.dice.random() < 0.7:
        is_plain = case.damage_arrays(name, "grains/(position|radius|velocity|spin|rotation|fixed|mass)")
    else:
        case.write(name, damage.damage_bytes(case.dice, read(case.path(name))))
    words = ["discrete", QUICK, *TINY, *setting(sample_file=name), "--quiet"]
    outcome = case.run(*words, "--output", out, output=out, **{"names": (name,), **special_files.instead(case, name)})
    if outcome.code == 0 and is_plain:
        def make(folder):
            shutil.copy(os.path.join(case.base("grains"), "out", "discrete.h5"), case.path(name))
            bases.done(case.work, *words, "--output", folder)
        expect_same_as_whole(case, "snapshot", make, out)


def problems(case):
    """FCLIB files for `diptych solve`. What lacks something is refused, or it is not read."""
    name, out, is_plain = "problem.h5", case.path("solved.h5"), False
    shutil.copy(PROBLEM, case.path(name))
    if case.dice.random() < 0.7:
        is_plain = case.damage_arrays(name, "fclib|nscd")
    else:
        case.write(name, damage.damage_bytes(case.dice, read(PROBLEM)))
    form = case.dice.choice(["local", "body"])
    outcome = case.run("solve", name, "--form", form, "--max-sweeps", "20000", "--output", out, output=out,
                       **{"names": (name,), **special_files.instead(case, name)})
    # Without one of its groups it is a problem in the other form, and a whole one.
    if outcome.code == 0 and is_plain and not case.done[-1].startswith(name + ": group"):
        whole = case.path("whole.h5")
        bases.done(case.work, "solve", PROBLEM, "--form", form, "--max-sweeps", "20000", "--output", whole)
        one, other = ({key: value for key, value in bits(path).items() if key in ("solution/r", "solution/u")} for path in (whole, out))
        if one != other:
            case.violate("exit code 0, but not the solution of the undamaged problem")


def damage_one_of(case, names):
    """One of another code's files damaged; then perhaps not among `names` any more, or there twice. Its name, and whether it must be told."""
    victim, is_plain = case.dice.choice(names), False
    if victim.endswith(".h5"):
        if case.dice.random() < 0.6:
            is_plain = case.damage_arrays(victim)
        else:
            case.write(victim, damage.damage_bytes(case.dice, read(case.path(victim))))
    else:
        case.write(victim, damage.damage_text(case.dice, read(case.path(victim))))
    if case.dice.random() < 0.1:
        names.remove(victim)
    elif case.dice.random() < 0.05:
        names.append(victim)
    return victim, is_plain


def imports(case):
    """Another code's files, one of them damaged; now and then whole, in any order: then they are read."""
    kind = case.dice.choice(sorted(FORMATS))
    form, _, words = FORMATS[kind]
    os.mkdir(case.path("theirs"))
    names = ["theirs/" + os.path.basename(path) for path in bases.foreign(kind)]
    for path, name in zip(bases.foreign(kind), names):
        shutil.copy(path, case.path(name))
    out, expected, is_plain = case.path("mine"), {"patience": 20}, False
    if case.dice.random() < 0.05:
        expected["codes"] = (0,)
    else:
        victim, is_plain = damage_one_of(case, names)
        names = names or [victim]
        expected["names"] = (*names, victim, "the files", "--", "import " + form)
        if victim in names:
            expected.update(special_files.instead(case, victim))
    case.dice.shuffle(names)
    outcome = case.run("import", form, *names, *words, "--output", out, "--quiet", output=out, **expected)
    if outcome.code == 0 and is_plain and "warning" not in outcome.errors:
        def make(folder):
            bases.done(case.work, "import", form, *bases.foreign(kind), *words, "--output", folder, "--quiet")
        expect_same_as_whole(case, kind, make, out)


HOSTILE = ["Exit;", "Abort;", 'SystemCall "touch touched";', 'NonBlockingSystemCall "touch touched";', 'Merge "other.geo";',
           'Include "other.geo";', 'Save "touched.msh";', 'Printf("x") > "touched";', 'Printf("x") >> "touched";',
           "For i In {1:1000000000}\n  a = i;\nEndFor", "For i In {1:2:0}\n  a = i;\nEndFor", 'Delete All;', "OptimizeMesh \"x\";",
           'General.BuildOptions', 'Plugin("x").Run;', 'CreateDir "touched";', "a = Sqrt(-1);", "Mesh.CharacteristicLengthMin = -1;",
           "Mesh 2;", "Point(1) = {nan, 0, 0};", "Macro m\n  Call m;\nReturn\nCall m;", 'UnlinkFile "mesh.geo";', 'Error("x");',
           'a = GetString("x", "y");', 'SetFactory("OpenCASCADE");', "RenumberMeshNodes;", 'PrintScreen "touched.png";', 'Print "touched.png";',
           'General.ErrorFileName = "touched";', 'General.TmpFileName = "touched"; Printf("x") > Str(General.TmpFileName);',
           'Solver.Executable0 = "touch touched"; Solver.AutoCheck = 1;', "Mesh.SecondOrderLinear = 1; Mesh.ElementOrder = 9;",
           'Field[1] = ExternalProcess; Field[1].CommandLine = "touch touched"; Background Field = 1;', 'System "touch touched";',
           'z = GetValue("how much", 3);', 'x = 1SystemCall "touch touched";', '// a\rSystemCall "touch touched";',
           'For i In {1:2} /*\nSystemCall "touch touched"; */\nEndFor', 'a = "' + 1024 * "x" + '); SystemCall "touch touched"; //";',
           'S2N("SystemCall") "touch touched";', 'Field[1] = Structured; Field[1].FileName = "mesh.geo"; Background Field = 1;',
           'Field[1] = MathEval; Field[1].F = "Sin(x)/0"; Background Field = 1;', 'SetString("General.ErrorFileName", "touched");']


def hostile_lines(case, content):
    lines = content.split(b"\n")
    for _ in range(case.dice.choice([1, 1, 2])):
        lines.insert(case.dice.randrange(len(lines) + 1), case.dice.choice(HOSTILE).encode())
    case.write("other.geo", 'SystemCall "touch touched";\n')
    return b"\n".join(lines)


def hostile_mesh(dice, content):
    """A .msh 2.2 file whose numbers cannot be: tags, coordinates, counts, elements inverted, twice or of no node."""
    lines = content.decode().split("\n")
    nodes, elements = lines.index("$Nodes"), lines.index("$Elements")
    kind = dice.choice(["tag", "coordinate", "count", "inverted", "twice", "no_node", "physical", "type", "order", "node_twice",
                        "commands", "version", "cut", "attributes", "renamed"])
    node = dice.randrange(nodes + 2, lines.index("$EndNodes"))
    quads = [k for k in range(elements + 2, lines.index("$EndElements")) if lines[k].split()[1] == "3"]
    k = dice.choice(quads)
    words = (lines[node] if kind in ("tag", "coordinate", "node_twice") else lines[k]).split()
    huge = dice.choice(["2147483648", "4294967297", "9223372036854775807", "18446744073709551617", "nan", "-1", "0", "1e9", "x"])
    if kind == "tag":
        words[0] = huge
    elif kind == "coordinate":
        words[dice.choice([1, 2, 3])] = dice.choice(["nan", "inf", "1e308", "-1e308", "x", "1e400", ""])
    elif kind == "count":
        lines[dice.choice([nodes, elements]) + 1] = huge
    elif kind == "inverted":
        words[-4:] = words[:-5:-1]
    elif kind == "twice":
        lines.insert(k, lines[k])
    elif kind == "no_node":
        words[dice.choice([-1, -2])] = huge
    elif kind == "physical":
        words[3] = huge
    elif kind == "type":
        words[1] = dice.choice(["2", "1", "16", "99", "-3", huge])
    elif kind == "order":
        words[-2], words[-1] = words[-1], words[-2]
    elif kind == "node_twice":
        lines.insert(node, lines[node])
    elif kind == "commands":
        lines.insert(dice.choice([0, 0, nodes, len(lines)]), 'SystemCall "touch touched";')
    elif kind == "version":
        lines[1] = dice.choice(["2.2 1 8", "4.1 0 8", "4.1 1 8", "9.9 0 8", "2.2", "nan 0 8"])
    elif kind == "cut":
        del lines[dice.randrange(1, len(lines) - 1):]
    elif kind == "attributes":
        words[2] = dice.choice(["1000000000", "-1", "0", "9"])
    else:  # the same element under another tag
        lines.insert(k, " ".join(["90000", *words[1:]]))
        lines[elements + 1] = str(int(lines[elements + 1]) + 1)
    place = node if kind in ("tag", "coordinate") else k
    if kind not in ("count", "twice", "node_twice", "commands", "version", "cut", "renamed"):
        lines[place] = " ".join(words)
    return "\n".join(lines).encode()


def meshes(case):
    dice = case.dice
    if dice.random() < 0.5:
        name, content = "mesh.geo", read(os.path.join(bases.SOURCE, "meshes", "sample.geo"))
        content = content.replace(b"width = 52, height = 75, size = 2", b"width = 12, height = 18, size = 3")
        content = hostile_lines(case, content) if dice.random() < 0.6 else damage.damage_text(dice, content)
    else:
        name, content = "mesh.msh", read(os.path.join(case.base("nodes"), "out", "sample.msh"))
        content = hostile_mesh(dice, content) if dice.random() < 0.6 else damage.damage_text(dice, content)
    case.write(name, content)
    if dice.random() < 0.3:
        case.write(name + ".opt", 'SystemCall "touch touched";\nExit;\n')
    out = case.path("out")
    expected = {"names": (name,), "patience": 8, **special_files.instead(case, name)}
    case.run("continuum", QUICK, *NODES, *setting(continuum_mesh=name), "--output", out, "--quiet", output=out, **expected)


KINDS = {"csv": tables, "snapshots": snapshots, "problems": problems, "imports": imports, "meshes": meshes}
