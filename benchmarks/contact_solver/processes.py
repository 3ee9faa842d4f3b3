#!/usr/bin/env python3
# diptych: wall time of one sample on one process, on threads and on several processes
# SPDX-License-Identifier: LGPL-2.1-or-later
"""processes.py PROGRAM --output DIR [--grains 64000] [--processes 2] [--set KEY=VALUE]

Prepares and loads a sample of moreau_1997 for three units of time: one process, one with N threads, N processes. Their
histories must agree. Prints wall seconds and memory. In its model, processes repeat all work outside the solver and
divide the rest. What N processes take beyond that is waiting, printed per sweep. Needs mpirun."""
import argparse
import csv
import filecmp
import json
import os
import subprocess

SCENE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../moreau_1997/scene.prm")
STRAIN = 6e-4  # at I = 2e-4


def run(options, name, words, before=()):
    """provenance.json of a run."""
    folder = os.path.join(options.output, name)
    settings = [f"sample/grains={options.grains}", f"loading/axial_strain={STRAIN}", f"loading/stage_strain={STRAIN}",
                f"comparison/window_edges=0,{STRAIN}", "output/report=false", *options.set]
    subprocess.run([*before, options.program, "discrete", SCENE, "--output", folder, "--overwrite", "--quiet", *words,
                    *(word for setting in settings for word in ("--set", setting))], check=True)
    with open(os.path.join(folder, "provenance.json"), encoding="utf-8") as file:
        return json.load(file)


def phase_of(story, name):
    return next(phase for phase in story["phases"] if phase["name"] == name)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=os.path.abspath)
    parser.add_argument("--output", type=os.path.abspath, required=True)
    parser.add_argument("--grains", type=int, default=64000)
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--set", action="append", default=[])
    options = parser.parse_args()
    n = options.processes
    runs = {"one process": run(options, "one", []), f"{n} threads": run(options, "threads", ["--threads", str(n)]),
            f"{n} processes": run(options, "processes", [], ["mpirun", "--oversubscribe", "-np", str(n)])}
    for other in ("threads", "processes"):
        assert filecmp.cmp(*(os.path.join(options.output, name, "discrete.csv") for name in ("one", other)),
                           shallow=False), f"{other}: other results"
    print(f"{options.grains} grains: wall seconds of preparation and loading, memory of the first process (MB)")
    for name, story in runs.items():
        preparation, loading = (phase_of(story, phase) for phase in ("preparation", "discrete"))
        print(f"  {name:14} {preparation['wall_s']:8.1f} {loading['wall_s']:8.1f} {loading['peak_memory_mb']:8.0f}")
    alone, shared = (phase_of(runs[name], "discrete")["wall_s"] for name in ("one process", f"{n} processes"))
    solver = alone * runs["one process"]["discrete"]["solver_share_of_cpu"]
    with open(os.path.join(options.output, "one", "discrete.csv"), encoding="utf-8") as file:
        sweeps = sum(int(row["sweeps"]) for row in csv.DictReader(file))
    waiting = (shared - (alone - solver) - solver / n) / sweeps
    print(f"  {sweeps} sweeps of {1e6 * solver / sweeps:.0f} us; outside the solver {alone - solver:.1f} s; beyond the "
          f"model {1e6 * waiting:.0f} us a sweep")


if __name__ == "__main__":
    main()
