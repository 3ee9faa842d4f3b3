# diptych: killed runs that go on, and two runs that write to the same folder
# SPDX-License-Identifier: LGPL-2.1-or-later
import json
import os
import shutil
import signal
import time

import bases
import cases
import judge
import same
from bases import BOTH, LONG, LONG_BOTH, LONG_NODES, OTHER_BOTH, QUICK, TINY
from running import setting

SIGNALS = (signal.SIGKILL, signal.SIGKILL, signal.SIGTERM, signal.SIGTERM, signal.SIGINT, signal.SIGHUP)
KILLED = {  # by base: weight, typical duration in s, and the command but for --output
    "long_grains": (6, 0.6, ["discrete", QUICK, *LONG, "--resume"]),
    "long_nodes": (3, 1.5, ["continuum", QUICK, *LONG_NODES, "--resume"]),
    "long_both": (3, 2, ["run", QUICK, *LONG_BOTH, "--resume"]),
    "other_nodes": (2, 1.5, ["run", QUICK, *OTHER_BOTH, "--resume"]),  # another continuum takes the place of the first
    "ensemble": (1, 2, ["run", QUICK, *BOTH, *bases.SEEDS, "--resume"]),
    "study": (1, 1.5, ["study", "steps.json", "--jobs", "1", "--resume"]),
    "calibration": (1, 12, ["calibrate", "one.json", "--jobs", "1", "--resume"]),
    "imported": (2, 0.05, ["import", "csv", *bases.foreign("csv"), "--overwrite"]),  # an import begins again
}
MOST_BEGINNINGS = 20


def kills(case, base=""):
    """Signals at random moments, then the run to its end: the bits of an undisturbed run."""
    base = base or case.dice.choices(list(KILLED), [weight for weight, *_ in KILLED.values()])[0]
    _, length, line = KILLED[base]
    case.write("steps.json", json.dumps(bases.STUDY))
    case.write("one.json", json.dumps(bases.CALIBRATION))
    line = [*line, "--output", "out", "--quiet"]
    for k in range(case.dice.choice([1, 1, 2])):
        for _ in range(MOST_BEGINNINGS):
            if base == "other_nodes" and not os.path.exists(case.path("out")):
                case.copy("long_both")
            if killed_once(case, line, case.dice.uniform(0, length), case.dice.choice(SIGNALS)) or k > 0:
                break
            shutil.rmtree(case.path("out"))  # it ended before the signal
            length *= 0.7
    case.run(*line, output=case.work, codes=(0,), patience=600, has_numbers=base != "imported")
    case.expect_same(os.path.join(case.base(base), "out"), case.path("out"))
    left = [name for name in judge.digest(case.path("out")) if name.endswith(".part")
            or judge.LOCK.search(os.path.basename(name))]
    if left:
        case.violations.append("left after the last run: " + ", ".join(left))


def killed_once(case, line, seconds, number):
    """Whether the signal ended the run."""
    before = judge.digest(case.work)
    process = case.start(*line)
    time.sleep(seconds)
    if process.poll() is None:
        process.send_signal(number)
        process.sent = number
    return case.end(process, before, case.work, codes=(0, 3), has_numbers=False).code != 0


def two_writers(case):
    """Two runs into one folder at once: the folder holds the complete results of one of them."""
    command, words, base = case.dice.choice([("discrete", LONG, "long_grains"), ("discrete", TINY, "grains"),
                                             ("run", BOTH, "both")])
    out, more = case.path("out"), case.dice.choice([[], [], ["--resume"], ["--overwrite"]])
    before = judge.digest(case.work)
    first = case.start(command, QUICK, *words, "--output", "out", "--quiet")
    time.sleep(case.dice.choice([0, case.dice.uniform(0, 0.2), case.dice.uniform(0, 1)]))
    second = case.start(command, QUICK, *words, *setting(sample_seed=2), *more, "--output", "out", "--quiet")
    for process in (first, second):
        process.wait(cases.HANG)
    after = judge.digest(case.work)
    outcomes = [case.end(process, before if process.returncode == 0 else after, case.work, codes=(0, 2, 4),
                         names=(out, "out")) for process in (first, second)]
    if all(outcome.code != 0 for outcome in outcomes):
        case.violations.append("both runs were refused")
        return
    wholes = {name: same.results(os.path.join(case.base(name), "out")) for name in (base, "other_" + base)}
    folders = [name for name in ("out", "out.1") if os.path.isdir(case.path(name))]
    found = [[name for name, whole in wholes.items() if not same.differences(whole, same.results(case.path(folder)))]
             for folder in folders]
    if [] in found or len(folders) != sum(outcome.code == 0
                                          for outcome in outcomes) or len({name for names in found
                                                                           for name in names}) != len(folders):
        case.violations.append(f"the folders {folders} hold the whole results of {found}")


KINDS = {"kills": kills, "two_writers": two_writers}
EACH = {f"kills_{base}": lambda case, base=base: kills(case, base) for base in KILLED}
