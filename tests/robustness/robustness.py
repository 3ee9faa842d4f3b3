#!/usr/bin/env python3
# diptych: hostile input, damaged files, full disks, kills: nothing lost, nothing silently wrong
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: robustness.py PROGRAM SOURCE_DIR [--cases N] [--seed S] [--kinds a,b] [--jobs J] [--keep DIR] [--kills N] [--sanitized] [--case KIND:SEED]"""

import argparse
import collections
import concurrent.futures
import os
import random
import shutil
import sys
import tempfile
import time
import traceback

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "program"))

import again_kind  # noqa: E402 (the path above)
import cases  # noqa: E402 (the path above)
import file_kinds  # noqa: E402
import folder_kinds  # noqa: E402
import input_kinds  # noqa: E402
import interruption_kinds  # noqa: E402
import machine_kinds  # noqa: E402
import pair_kind  # noqa: E402

KINDS = {**input_kinds.KINDS, **pair_kind.KINDS, **file_kinds.KINDS, **folder_kinds.KINDS, **again_kind.KINDS, **machine_kinds.KINDS,
         **interruption_kinds.KINDS}
ALL = {**KINDS, **interruption_kinds.EACH}
# How often a kind comes in a hundred and thirty: what is quick, often.
WEIGHTS = {"scenes": 26, "keys": 38, "pairs": 6, "words": 22, "csv": 6, "snapshots": 6, "problems": 6, "imports": 5, "meshes": 3,
           "folders": 3, "checkpoints": 2, "flips": 3, "again": 3, "disk": 3, "surroundings": 2, "kills": 1, "two": 1}


def schedule(n_cases, seed, kinds):
    """(kind, seed) of every case: kinds in the shares of their weights, each with seeds one after the other from its own place."""
    total = sum(WEIGHTS[kind] for kind in kinds)
    counts = {kind: max(1, round(n_cases * WEIGHTS[kind] / total)) for kind in kinds}
    plan = [(kind, seed * cases.SEEDS + k) for kind in kinds for k in range(counts[kind])]
    random.Random(seed).shuffle(plan)
    return plan


def one(kind, seed, keep):
    """A fault of the harness is one, too."""
    try:
        return kind, seed, cases.run_case(kind, ALL[kind], seed, keep)
    except Exception:
        return kind, seed, cases.Made(["the harness failed:\n" + traceback.format_exc()])


def all_cases(plan, keep, jobs):
    if jobs == 1:
        for kind, seed in plan:
            yield one(kind, seed, keep)
        return
    with concurrent.futures.ProcessPoolExecutor(jobs) as pool:
        for future in concurrent.futures.as_completed([pool.submit(one, kind, seed, keep) for kind, seed in plan]):
            yield future.result()


def tell(kind, seed, violations, commands, folder):
    print(f"--case {kind}:{seed}  in {folder}")
    for sentence in violations:
        print("    " + sentence)
    if len(commands) > 2:
        print(f"    {len(commands) - 2} runs, told in case.txt, and then")
    for words in commands[-2:]:
        text = " ".join(map(repr, words))
        print("    " + (text if len(text) < 1500 else text[:700] + " ... " + text[-700:]))
    sys.stdout.flush()


class Progress:
    """Every ten seconds, on standard error: how far, and about how long still."""

    def __init__(self, n_cases):
        self.n_cases, self.done = n_cases, 0
        self.began = self.told = time.monotonic()

    def one_more(self):
        self.done += 1
        now = time.monotonic()
        if now - self.told < 10:
            return
        self.told = now
        left = (now - self.began) / self.done * (self.n_cases - self.done)
        print(f"{self.done} of {self.n_cases} cases, about {left / 60:.0f} min left", file=sys.stderr, flush=True)


def table(kinds, counted):
    head = ("kind", "cases", "with a result", "0", "2", "3", "4", "other", "violations", "CPU s")
    print("  ".join(f"{word:>16}" for word in head))
    total = collections.Counter()
    for kind in [*kinds, "all"]:
        count = total if kind == "all" else counted[kind]
        row = [kind, *(str(count[name]) for name in head[1:-1]), f"{count['CPU s']:.1f}"]
        print("  ".join(f"{word:>16}" for word in row))
        if kind != "all":
            total.update(count)
    return total


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("source")
    parser.add_argument("--cases", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kinds", help="some of them, with commas between (default: all)")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--keep", help="folder of violations (default: a temporary one, named)")
    parser.add_argument("--kills", type=int, help="instead: this many kills -9 and as many SIGTERM of each sort of run")
    parser.add_argument("--sanitized", action="store_true", help="PROGRAM was built with sanitizers: a report is a violation, more time is given")
    parser.add_argument("--case", action="append", metavar="KIND:SEED", help="this one alone; may be repeated")
    asked = parser.parse_args()
    asked.kinds = asked.kinds.split(",") if asked.kinds else list(interruption_kinds.EACH if asked.kills else KINDS)
    unknown = [kind for kind in [*asked.kinds, *(case.split(":")[0] for case in asked.case or [])] if kind not in ALL]
    if unknown:
        parser.error(f"no kind {unknown[0]}; the kinds are " + ", ".join(KINDS))
    return asked


def main():
    asked = arguments()
    if asked.sanitized:
        cases.expect_sanitizers()
    keep = os.path.abspath(asked.keep or tempfile.mkdtemp(prefix="robustness_"))
    os.makedirs(keep, exist_ok=True)
    if asked.case:
        plan = [(case.split(":")[0], int(case.split(":")[1])) for case in asked.case]
        asked.kinds = list(dict.fromkeys(kind for kind, _ in plan))
    elif asked.kills:
        plan = [(kind, asked.seed * cases.SEEDS + k) for kind in asked.kinds for k in range(asked.kills)]
    else:
        plan = schedule(asked.cases, asked.seed, asked.kinds)
    counted = collections.defaultdict(collections.Counter)
    found = collections.defaultdict(set)
    progress = Progress(len(plan))
    for kind, seed, made in all_cases(plan, keep, asked.jobs):
        progress.one_more()
        counted[kind].update({"cases": 1, "violations": int(bool(made.violations)), "CPU s": made.seconds,
                              "with a result": int(any(code in (0, 3) for code in made.codes))})
        counted[kind].update(str(code) if code in (0, 2, 3, 4) else "other" for code in made.codes)
        for name, things in made.found.items():
            found[name] |= things
        if made.violations:
            tell(kind, seed, made.violations, made.commands, os.path.join(keep, f"{kind}_{seed}"))
    total = table(asked.kinds, counted)
    if "pairs" in asked.kinds:
        print(pair_kind.told(found))
    if "disk" in asked.kinds:
        print(machine_kinds.told(found))
    shutil.rmtree(os.path.join(keep, "bases"), ignore_errors=True)
    if total["violations"]:
        print(f"{total['violations']} of {total['cases']} cases in violation; their files are in {keep}")
    elif not asked.keep:
        shutil.rmtree(keep)
    return 1 if total["violations"] else 0


if __name__ == "__main__":
    sys.exit(main())
