# diptych: damaged results and checkpoints
# SPDX-License-Identifier: LGPL-2.1-or-later
import os

import bases
import damage
from bases import BOTH, LONG, LONG_NODES, QUICK, TINY
from judge import OWN_STATE, digest

CHECKPOINTS = (  # base, the same run without interruption, damaged files, a command that reads them
    ("stopped_grains", "long_grains", ("checkpoint.h5", "checkpoint.h5", "discrete.h5", "discrete.csv"),
     ["discrete", QUICK, *LONG, "--resume"]),
    ("stopped_nodes", "long_nodes", ("continuum_checkpoint.h5", "continuum.csv"),
     ["continuum", QUICK, *LONG_NODES, "--resume"]),
)
RESULTS = (  # base, damaged files, commands that read them; OUT is the folder of the base
    ("both", ("discrete.h5", "discrete.csv", "continuum.h5", "continuum.csv", "comparison.h5", "comparison.json",
              "provenance.json"),
     (["compare", "OUT"], ["compare", "OUT"], ["report", "OUT"], ["run", QUICK, *BOTH, "--resume", "--output", "OUT"],
      ["export", "OUT", "--format", "csv", "--output", "theirs"])),
    ("grains", ("discrete.h5", "discrete.csv", "provenance.json"),
     (["discrete", QUICK, *TINY, "--resume", "--output", "OUT"],
      ["export", "OUT", "--format", "lammps", "--output", "theirs"])),
    ("ensemble", (".h5", ".csv", ".json"), (["compare", "OUT"],
                                            ["run", QUICK, *BOTH, *bases.SEEDS, "--resume", "--output", "OUT"])),
    ("study", (".h5", ".csv", ".json"), (["study", "steps.json", "--resume", "--output", "OUT", "--jobs", "1"],)),
    ("calibration", (".h5", ".csv", ".json"), (["calibrate", "one.json", "--resume", "--output", "OUT", "--jobs", "1"],
                                               )),
)


def checkpoints(case):
    """An interrupted run with a damaged file is refused, or it ends with the bits of an undisturbed run."""
    base, whole, files, words = case.dice.choice(CHECKPOINTS)
    out, name = case.copy(base), case.dice.choice(files)
    case.damage(os.path.join(out, name), damage.BYTES)
    outcome = case.run(*words, "--output", out, "--quiet", output=out, names=(name,), codes=(0, 2), patience=20)
    if outcome.code == 0:
        case.expect_same(os.path.join(case.base(whole), "out"), out)


def results(case):
    """A finished folder with a damaged file is refused, or the command gives the bits that it gives from undamaged
    files. provenance.json has no checksum, so numbers that come from it are not compared."""
    base, endings, commands = case.dice.choices(RESULTS, (10, 4, 1, 1, 1))[0]
    out, command = case.copy(base), case.dice.choice(commands)
    words = ["out" if word == "OUT" else word for word in command] + ["--quiet"]
    name = case.dice.choice(sorted(path for path in digest(out) if path.endswith(endings) and os.path.basename(path)
                                   not in OWN_STATE))
    case.damage(os.path.join(out, name), (damage.flip_bit,) * 12 + damage.BYTES)
    to = "theirs" if "theirs" in words else "out"
    outcome = case.run(*words, output=case.path(to), patience=60, names=(os.path.basename(name), "out"), codes=(0, 2))
    if outcome.code == 0:
        whole = bases.whole(case.keep, f"{base}_{commands.index(command)}", lambda _: words, base, to)
        is_untouched = outcome.before.get("out/" + name) == outcome.after.get("out/" + name)
        copies = ("comparison.json", "comparison.csv", "summary.csv") if name == "provenance.json" else ()
        case.expect_same(whole, case.path(to), without=(*copies, name) if is_untouched else copies)


KINDS = {"checkpoints": checkpoints, "results": results}
