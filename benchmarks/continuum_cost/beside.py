#!/usr/bin/env python3
# diptych: CPU time of the continuum panel beside another build of the program
# SPDX-License-Identifier: LGPL-2.1-or-later
"""beside.py OTHER_PROGRAM PROGRAM [--repeats 3] [--reference-blas]

Runs the continuum of moreau_1997 and of cosserat_band/oblique (elements of 1 d) alternately with both programs. Prints
CPU seconds by phase (least of the repeats), counts, and the relative difference of the last stress ratio.
--reference-blas: the other program uses the reference BLAS of Debian."""
import argparse
import csv
import os
import subprocess
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
SCENES = {"moreau_1997": ("moreau_1997/scene.prm", ["comparison/coarse_element_size=0"]),
          "moreau_1997, four times the unknowns": ("moreau_1997/scene.prm", ["comparison/coarse_element_size=0",
                                                                              "continuum/element_size=0.75"]),
          "oblique, h = 1": ("cosserat_band/oblique.prm", ["continuum/element_size=1", "continuum/internal_length=1"])}
PHASES = {"law and forces": "point_cpu_s", "tangent": "assembly_cpu_s", "geometry": "geometry_cpu_s",
          "linear solver": "solve_cpu_s"}
COUNTS = ["newton_iterations", "linear_iterations", "factorisations"]
REFERENCE = "/usr/lib/x86_64-linux-gnu/blas:/usr/lib/x86_64-linux-gnu/lapack"


def last_row(program, scene, settings, environment):
    """CPU seconds of the whole command, and the last row of continuum.csv."""
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "continuum", os.path.join(HERE, "..", scene), "--output", os.path.join(folder, "out")]
        for setting in settings:
            command += ["--set", setting]
        before = os.times()
        subprocess.run(command, check=True, capture_output=True, env={**os.environ, **environment})
        after = os.times()
        seconds = after.children_user + after.children_system - before.children_user - before.children_system
        with open(os.path.join(folder, "out", "continuum.csv"), encoding="utf-8") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        return seconds, {key: float(text) for key, text in rows[-1].items()
                         if key in [*PHASES.values(), *COUNTS, "stress_ratio"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", nargs=2, metavar="PROGRAM")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--reference-blas", action="store_true")
    options = parser.parse_args()
    environments = [{"LD_LIBRARY_PATH": REFERENCE} if options.reference_blas else {}, {}]
    print("| scene | program | " + " | ".join([*PHASES, "these", "whole command", *COUNTS]) + " |")
    print("|---" * (len(PHASES) + len(COUNTS) + 4) + "|")
    for name, (scene, settings) in SCENES.items():
        best = {}
        for _ in range(options.repeats):
            for k, program in enumerate(options.programs):
                run = last_row(program, scene, settings, environments[k])
                if k not in best or run[0] < best[k][0]:
                    best[k] = run
        for k, (seconds, row) in best.items():
            phases = [row[column] for column in PHASES.values()]
            numbers = [f"{value:.2f}" for value in [*phases, sum(phases), seconds]] + [f"{row[c]:.0f}" for c in COUNTS]
            print(f"| {name} | {'other' if k == 0 else 'this'} | " + " | ".join(numbers) + " |")
        (other, before), (this, now) = best[0], best[1]
        total = [sum(row[c] for c in PHASES.values()) for row in (before, now)]
        print(f"{name}: {total[0] / total[1]:.2f} times less CPU time in the phases, {other / this:.2f} in the whole "
              "command; " f"stress ratio {now['stress_ratio'] / before['stress_ratio'] - 1:+.2e}", flush=True)


if __name__ == "__main__":
    main()
