# diptych: runs that are killed and taken up, and two that want the same folder
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
from bases import BOTH, LONG, LONG_BOTH, LONG_NODES, TINY
from cases import wait_for
from folder_kinds import expect_same_as_base
from running import QUICK, setting

SIGNALS = (signal.SIGKILL, signal.SIGTERM, signal.SIGINT, signal.SIGHUP)
KILLED = {  # by base: the command line but for --output and --resume, and how long it takes at most, where nothing else runs
    "long_grains": (["discrete", QUICK, *LONG], 0.6),
    "long_nodes": (["continuum", QUICK, *LONG_NODES], 1.5),
    "long_both": (["run", QUICK, *LONG_BOTH], 2),
    "ensemble": (["run", QUICK, *BOTH, *bases.SEEDS], 2),
    "study": (["study", "steps.json", "--jobs", "1"], 1.5),
    "calibration": (["calibrate", "one.json", "--jobs", "1"], 4),
    "imported": (["import", "csv", *bases.foreign("csv")], 0.05),
}
MOST_BEGINNINGS = 20  # 0.7^20: a thousandth of the time that it takes
WEIGHTS = {"long_grains": 10, "long_nodes": 3, "long_both": 3, "ensemble": 1, "study": 1, "calibration": 1, "imported": 3}


def kills(case):
    """Signals at random moments, then the run to its end: the bits of one left alone."""
    base = case.dice.choices(list(WEIGHTS), list(WEIGHTS.values()))[0]
    killed_and_taken_up(case, base, [case.dice.choice(SIGNALS) for _ in range(case.dice.choice([1, 1, 2]))])


def killed_by(base, number):
    """A kind: one signal of one sort to one sort of run."""
    return lambda case: killed_and_taken_up(case, base, [number])


def killed_and_taken_up(case, base, numbers):
    line, length = KILLED[base]
    for name, content in (("steps.json", bases.STUDY), ("one.json", bases.CALIBRATION)):
        case.write(name, json.dumps(content))
    out, resume = case.path("out"), [] if base == "imported" else ["--resume"]
    for number in numbers:
        may_begin_again = MOST_BEGINNINGS if not os.path.exists(out) else 0
        while not killed_once(case, [*line, *resume, "--output", out, "--quiet"], case.dice.uniform(0, length), number) and may_begin_again:
            shutil.rmtree(out)  # done before the signal counted
            length *= 0.7
            may_begin_again -= 1
            if not may_begin_again:
                case.violate(f"the signal {number} did not end it, {MOST_BEGINNINGS} times")
                return
    case.run(*line, *resume, "--output", out, "--quiet", output=out, codes=(0,), patience=120)
    expect_same_as_base(case, base, out)
    left = [name for name in judge.digest(out) if name.endswith(".part") or judge.LOCK.search(os.path.basename(name))]
    if left:
        case.violate("left after the last run: " + ", ".join(left))


def killed_once(case, line, seconds, number):
    """It may end by itself before, by the signal, or, asked to stop, with code 3. Whether the signal ended it."""
    before = judge.digest(case.work)
    process = case.start(*line)
    time.sleep(seconds)
    if process.poll() is None:
        process.send_signal(number)
        process.sent = number
    is_hung = case.finish(process, cases.HANG)
    case.judge(case.outcome(process, before, case.path("out"), is_hung), codes=(0, 3))
    return process.returncode != 0


def two(case):
    """Two runs into one folder at once: one is refused, or waits; the folder holds the results of one of them, whole."""
    kind, command, words, base = case.dice.choice([("long", "discrete", LONG, "long_grains"), ("short", "discrete", TINY, "grains"),
                                                   ("both", "run", BOTH, "both")])
    out, other = case.path("out"), "other_" + base
    lines = [[command, QUICK, *words, *setting(sample_seed=seed), "--output", out, "--quiet"] for seed in (1, 2)]
    before = judge.digest(case.work)
    first = case.start(*lines[0])
    if case.dice.random() < 0.5:
        wait_for(os.path.join(out, "scene.prm"), first)
    time.sleep(case.dice.choice([0, 0, case.dice.uniform(0, 0.2)]))
    second = case.start(*lines[1])
    outcomes = [case.outcome(process, before, out, case.finish(process, cases.HANG)) for process in (first, second)]
    for outcome in outcomes:
        outcome.after = judge.digest(case.work)
        if outcome.code == 2:
            outcome.before = outcome.after  # the other one has changed the folder
        case.judge(outcome, names=(out,), codes=(0, 2, 4))
    if all(outcome.code != 0 for outcome in outcomes):
        case.violate("both were refused")
        return
    found = same.results(out)
    wholes = [same.results(os.path.join(case.base(name), "out")) for name in (base, other)]
    if all(same.differences(whole, found) for whole in wholes):
        case.violate(f"the {kind} runs' folder holds neither the one's results nor the other's: "
                     + "; ".join(same.differences(wholes[0], found)[:3]))


KINDS = {"kills": kills, "two": two}
# Each sort of run by each of two signals, for --kills: where a figure is wanted for each.
EACH = {f"{name}_{base}": killed_by(base, number) for base in KILLED for name, number in (("kill", signal.SIGKILL), ("term", signal.SIGTERM))}
