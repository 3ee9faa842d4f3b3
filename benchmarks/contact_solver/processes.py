#!/usr/bin/env python3
# diptych: wall time of one sample on one process, on threads and on several processes
# SPDX-License-Identifier: LGPL-2.1-or-later
"""processes.py PROGRAM --output DIR [--grains 64000] [--processes 2,4] [--set KEY=VALUE]

Prepares a sample of moreau_1997 and loads it for three units of time. It does so on one process, on one thread for each
core, and on each number of processes. Their histories must agree. Prints wall seconds, memory, and the time by a model.
`outside` and `sweeps` are the seconds of one process. c threads take outside + sweeps / c. N processes on c cores take
(N outside + sweeps) / min(N, c). The excess over the model is printed per sweep. Needs mpirun."""
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
    parser.add_argument("--processes", type=lambda text: [int(n) for n in text.split(",")], default=[2])
    parser.add_argument("--set", action="append", default=[])
    options = parser.parse_args()
    cores = os.cpu_count()
    one = run(options, "one", [])
    stories = {f"{cores} threads": run(options, "threads", ["--threads", str(cores)])}
    for n in options.processes:
        stories[f"{n} processes"] = run(options, f"processes_{n}", [], ["mpirun", "--oversubscribe", "-np", str(n)])
    histories = [os.path.join(options.output, name, "discrete.csv")
                 for name in ("one", "threads", *(f"processes_{n}" for n in options.processes))]
    for history in histories[1:]:
        assert filecmp.cmp(histories[0], history, shallow=False), f"{history}: other results"

    alone = phase_of(one, "discrete")["wall_s"]
    solver = alone * one["discrete"]["solver_share_of_cpu"]
    outside = alone - solver
    with open(histories[0], encoding="utf-8") as file:
        sweeps = sum(int(row["sweeps"]) for row in csv.DictReader(file))
    print(f"{options.grains} grains: wall seconds of preparation and loading, loading by the model, excess per sweep "
          "(us), memory of the first process (MB)")
    for name, story in {"one process": one, **stories}.items():
        preparation, loading = (phase_of(story, phase) for phase in ("preparation", "discrete"))
        n = int(name.split()[0]) if "processes" in name else 1
        model = outside + solver / cores if "threads" in name else (n * outside + solver) / min(n, cores)
        excess = 1e6 * (loading["wall_s"] - model) / sweeps
        print(f"  {name:14} {preparation['wall_s']:8.1f} {loading['wall_s']:8.1f} {model:8.1f} {excess:8.0f} "
              f"{loading['peak_memory_mb']:8.0f}")
    print(f"  {sweeps} sweeps of {1e6 * solver / sweeps:.0f} us; outside the sweeps {outside:.1f} s")


if __name__ == "__main__":
    main()
