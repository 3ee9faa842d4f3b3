#!/usr/bin/env python3
# diptych: the penalty method beside NSCD on the dense biaxial sample
# SPDX-License-Identifier: LGPL-2.1-or-later
"""penalty.py PROGRAM [--seeds 1,2,3] [--figure figure.png] [--no-blow-up]

Both methods load the same samples (benchmarks/dense_biaxial: relaxed, 1000 discs) to 4 % strain. The penalty method
first presses its springs. A second part finds the step at which the penalty method blows up. The figure needs
matplotlib."""
import argparse
import csv
import json
import os
import statistics
import subprocess
import sys
import tempfile

BIAXIAL = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../dense_biaxial")
STRAIN = 0.04
STIFFNESSES = (1e2, 1e3, 1e4)
STEPS = (0.4, 0.2, 0.1, 0.05)  # Steps of NSCD [d sqrt(rho/P)].
FRACTIONS = (0.2, 0.4, 0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.9, 1.0, 1.05, 1.1, 1.2)
NSCD = ["discrete/tolerance=1e-4"]
PENALTY = ["discrete/method=penalty", "discrete/penalty_preload=0", "sample/allowed_overlap=0.5"]
# Name, friction between grains, penalty_damping, inertial number.
CASES = (("frictionless, undamped", 0, 0, 1.13e-3), ("sticking, undamped", 100, 0, 1.13e-3),
         ("friction 0.4, damping 0.2", 0.4, 0.2, 1.13e-3), ("the same, ten times slower", 0.4, 0.2, 1.13e-4))


def run(program, scene, folder, settings):
    """(exit code, CPU seconds of the discrete panel, history rows as floats)."""
    words = [word for setting in settings for word in ("--set", setting)]
    done = subprocess.run([program, "discrete", os.path.join(BIAXIAL, scene), "--output", folder, "--overwrite",
                           "--quiet", *words],
                          capture_output=True, text=True)
    if done.returncode not in (0, 3):
        sys.exit(f"penalty.py: {folder}: {done.stderr.strip()}")
    history = os.path.join(folder, "discrete.csv")
    rows = []
    if os.path.exists(history):
        with open(history) as file:
            rows = [{key: float(value) for key, value in row.items() if key != "walk"} for row in csv.DictReader(file)]
    with open(os.path.join(folder, "provenance.json")) as file:
        phases = json.load(file)["phases"]
    return done.returncode, sum(p["cpu_s"] for p in phases if p["name"] == "discrete"), rows


def load(program, folder, sample, settings):
    to_strain = [f"sample/file={sample}", f"loading/axial_strain={STRAIN}", "discrete/snapshot_max_sweeps=0"]
    code, seconds, rows = run(program, "scene.prm", folder, to_strain + settings)
    if code != 0:
        return None
    late = [row for row in rows if row["axial_strain"] > 0.015]
    return {"seconds": seconds, "ratio": statistics.fmean(row["stress_ratio"] for row in late),
            "overlap": statistics.median(row["max_penetration"] for row in late),
            "kinetic": statistics.median(row["kinetic_energy_ratio"] for row in late)}


def sample_under_springs(program, folder, sample, stiffness):
    """Snapshot file of the sample after its springs have been pressed without friction."""
    settings = [f"sample/file={sample}", f"discrete/penalty_stiffness={stiffness:g}", *PENALTY]
    code, _, _ = run(program, "relax.prm", folder, settings)
    if code != 0:
        sys.exit(f"penalty.py: springs of kn/P = {stiffness:g} did not come to rest")
    return os.path.join(folder, "discrete.h5")


def mean_and_half_range(values):
    return statistics.fmean(values), 0.5 * (max(values) - min(values))


def compare(options, scratch, samples):
    """{name: [numbers of each seed]}; None for a run that did not finish."""
    figures = {}
    for seed, sample in samples.items():
        for step in STEPS:
            folder = os.path.join(scratch, f"nscd_{step}_{seed}")
            figures.setdefault(f"NSCD h = {step:g}", []).append(load(options.program, folder, sample,
                                                                     [f"discrete/step={step}", *NSCD]))
        for stiffness in STIFFNESSES:
            folder = os.path.join(scratch, f"penalty_{stiffness:g}_{seed}")
            compressed = sample_under_springs(options.program, folder + "_springs", sample, stiffness)
            figures.setdefault(f"kn/P = {stiffness:g}", []).append(
                load(options.program, folder, compressed, PENALTY + [f"discrete/penalty_stiffness={stiffness:g}"]))
    print("method          mean t/s 1.5-4 % (half range)  median of the largest overlap [% d]  K/(M V^2/4)  CPU s")
    for name, runs in figures.items():
        ended = [r for r in runs if r]
        if not ended:
            print(f"{name:15} no run ended")
            continue
        ratio, half = mean_and_half_range([r["ratio"] for r in ended])
        print(f"{name:15} {ratio:16.3f} +- {half:.3f} {100 * statistics.fmean(r['overlap'] for r in ended):30.4f}"
              f" {statistics.fmean(r['kinetic'] for r in ended):20.2f} "
              f"{statistics.fmean(r['seconds'] for r in ended):10.2f}"
              + ("" if len(ended) == len(runs) else f"  {len(runs) - len(ended)} of {len(runs)} did not end"),
              flush=True)
    return figures


def blow_up(options, scratch, sample):
    """Median kinetic energy over 0.25-0.5 % strain, relative to that of the smallest step fraction; inf: the run blew
    up."""
    print("\nkinetic energy relative to that at step fraction 0.2, kn/P = 1000, to 0.5 % strain\nstep / sqrt(m_min/kn) "
          "     "
          + "".join(f"{f:8g}" for f in FRACTIONS))
    compressed = sample_under_springs(options.program, os.path.join(scratch, "blow_springs"), sample, 1000)
    for name, friction, damping, inertial_number in CASES:
        energies = []
        for fraction in FRACTIONS:
            folder = os.path.join(scratch, f"blow_{name}_{fraction}")
            code, _, rows = run(options.program, "scene.prm", folder, PENALTY + [
                f"sample/file={compressed}", "loading/axial_strain=0.005", "loading/stage_strain=0.005",
                "comparison/window_edges=0,0.005", f"loading/inertial_number={inertial_number}",
                f"discrete/friction={friction}",
                f"discrete/penalty_damping={damping}", f"discrete/penalty_step_fraction={fraction}",
                "discrete/penalty_stiffness=1000"])
            energies.append(float("inf") if code == 3 else
                            statistics.median(row["kinetic_energy"] for row in rows if row["axial_strain"] > 0.0025))
        print(f"{name:27}" + "".join(f"{e / energies[0]:8.3g}" for e in energies), flush=True)


def draw(figures, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as pyplot
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(9, 3.8), constrained_layout=True)
    for prefix, label, colour, marker in (("NSCD", "NSCD, step h", "tab:blue", "o"),
                                          ("kn/P", "penalty, stiffness kn/P", "tab:red", "s")):
        names = [name for name, runs in figures.items() if name.startswith(prefix) and all(runs)]
        seconds = [statistics.fmean(r["seconds"] for r in figures[name]) for name in names]
        overlap = [100 * statistics.fmean(r["overlap"] for r in figures[name]) for name in names]
        ratio = [mean_and_half_range([r["ratio"] for r in figures[name]]) for name in names]
        left.loglog(seconds, overlap, marker + "-", color=colour, label=label)
        right.errorbar(seconds, [r[0] for r in ratio], [r[1] for r in ratio], fmt=marker + "-", color=colour, capsize=3)
        for name, x, y in zip(names, seconds, overlap):
            left.annotate(name.split("= ")[1], (x, y), textcoords="offset points", xytext=(6, 5), fontsize=8)
        right_label = (-26, -13) if prefix == "NSCD" else (5, -12)
        for name, x, y in zip(names, seconds, ratio):
            right.annotate(name.split("= ")[1], (x, y[0]), textcoords="offset points", xytext=right_label, fontsize=8)
    left.set(xlabel="CPU seconds to 4 % strain, 1000 discs", ylabel="largest overlap [% d], median over time")
    left.margins(0.18)
    right.set(xscale="log", xlabel="CPU seconds to 4 % strain, 1000 discs", ylabel="mean t/s, 1.5-4 % strain")
    right.margins(0.18)
    left.set_ylim(bottom=1e-3)
    left.legend(loc="lower left")
    for axes in (left, right):
        axes.grid(alpha=0.3, which="major")
        axes.set_xticks([0.5, 1, 2, 5], ["0.5", "1", "2", "5"])
        axes.minorticks_off()
    figure.savefig(path, dpi=120)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--seeds", default="1,2,3")
    parser.add_argument("--figure")
    parser.add_argument("--no-blow-up", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        samples = {}
        for seed in options.seeds.split(","):
            folder = os.path.join(scratch, f"sample_{seed}")
            if run(options.program, "relax.prm", folder, [f"sample/seed={seed}"])[0] != 0:
                sys.exit(f"penalty.py: the sample of seed {seed} did not relax")
            samples[seed] = os.path.join(folder, "discrete.h5")
        figures = compare(options, scratch, samples)
        if options.figure:
            draw(figures, options.figure)
        if not options.no_blow_up:
            blow_up(options, scratch, next(iter(samples.values())))


if __name__ == "__main__":
    main()
