#!/usr/bin/env python3
# diptych: random damaged files, full disks, kills and competing runs: nothing is lost, nothing silently wrong
# SPDX-License-Identifier: LGPL-2.1-or-later
"""DIPTYCH_PROGRAM=PROGRAM robustness.py [--cases N] [--seed S] [--kinds a,b] [--jobs J] [--keep DIR] [--case
KIND:SEED]"""

import argparse
import collections
import concurrent.futures
import os
import random
import shutil
import sys
import tempfile
import traceback

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "program"))

import cases  # noqa: E402 (the path above)
import input_kinds  # noqa: E402
import interruption_kinds  # noqa: E402
import machine_kinds  # noqa: E402
import result_kinds  # noqa: E402

KINDS = {**input_kinds.KINDS, **result_kinds.KINDS, **machine_kinds.KINDS, **interruption_kinds.KINDS}
ALL = {**KINDS, **interruption_kinds.EACH}
WEIGHTS = {"scenes": 20, "keys": 22, "csv": 6, "snapshots": 6, "problems": 6, "imports": 8, "checkpoints": 6,
           "results": 9, "disk": 8, "memory": 1, "kills": 4, "two_writers": 3}


def schedule(n_cases, seed, kinds):
    """(kind, seed) of every case, each kind as often as its weight says, with consecutive seeds."""
    weights = {kind: WEIGHTS.get(kind, 1) for kind in kinds}
    counts = {kind: max(1, round(n_cases * weight / sum(weights.values()))) for kind, weight in weights.items()}
    plan = [(kind, seed * cases.SEEDS + k) for kind in kinds for k in range(counts[kind])]
    random.Random(seed).shuffle(plan)
    return plan


def one(kind, seed, keep):
    """A fault of the harness counts as a violation."""
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


def table(counted):
    head = ("kind", "cases", "0", "2", "3", "4", "signal", "violations", "CPU s")
    counted["all"] = sum(counted.values(), collections.Counter())
    for row in [head, *([kind, *(f"{count[name]:.0f}" for name in head[1:])] for kind, count in counted.items())]:
        print("  ".join(f"{word:>12}" for word in row))


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cases", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kinds", default=",".join(KINDS),
                        help="with commas between; kills_BASE kills one sort of run")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--keep", help="folder for violated cases (default: a temporary one)")
    parser.add_argument("--case", action="append", metavar="KIND:SEED", help="runs this case; may be repeated")
    asked = parser.parse_args()
    asked.kinds = asked.kinds.split(",")
    unknown = [kind for kind in [*asked.kinds, *(case.split(":")[0] for case in asked.case or [])] if kind not in ALL]
    if unknown:
        parser.error(f"no kind {unknown[0]}; the kinds are " + ", ".join(ALL))
    return asked


def main():
    asked = arguments()
    keep = os.path.abspath(asked.keep or tempfile.mkdtemp(prefix="robustness_"))
    plan = schedule(asked.cases, asked.seed, asked.kinds)
    if asked.case:
        plan = [(case.split(":")[0], int(case.split(":")[1])) for case in asked.case]
    counted = collections.defaultdict(collections.Counter)
    for n, (kind, seed, made) in enumerate(all_cases(plan, keep, asked.jobs), 1):
        counted[kind].update({"cases": 1, "violations": int(bool(made.violations)), "CPU s": made.seconds})
        counted[kind].update(str(code) if code >= 0 else "signal" for code in made.codes)
        if made.violations:
            print("\n    ".join([f"--case {kind}:{seed}  in {keep}/{kind}_{seed}", *made.violations, *made.log]),
                  flush=True)
        if n % max(20, len(plan) // 50) == 0:
            print(f"{n} of {len(plan)} cases", file=sys.stderr, flush=True)
    table(counted)
    shutil.rmtree(os.path.join(keep, "bases"), ignore_errors=True)
    if not asked.keep and not counted["all"]["violations"]:
        shutil.rmtree(keep)
    return 1 if counted["all"]["violations"] else 0


if __name__ == "__main__":
    sys.exit(main())
