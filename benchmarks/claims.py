# diptych: runs of a scene over one or several seeds, compared with its claims
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Common part of the check.py scripts: runs of the program, their results, a table of numbers against their intervals.

A check.py passes a function that makes its runs for one seed and returns {name: number}, and a list of (name, low,
high)."""
import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile

import h5py
import numpy

ENVIRONMENT = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
PEAK_WINDOW = 0.005  # Axial or shear strain over which the running mean is taken.


class RunFailed(Exception):
    """The program ended with an exit code other than 0."""


def is_finished(folder, command):
    """Whether the folder holds a run of `command` whose panels came to their end."""
    try:
        record = Result(folder).provenance
    except FileNotFoundError:
        return False
    return all(record.get(panel, {}).get("finished") for panel in
               (("discrete", "continuum") if command == "run" else (command,)))


class Runs:
    """Runs of one seed, each in its own folder below `folder`, with the seed and the settings of the command line."""

    def __init__(self, options, seed, folder):
        self.options, self.folder = options, folder
        self.settings = [f"sample/seed={seed}", "output/report=false", *options.set]

    def run(self, name, command, scene, *settings):
        """Result of `PROGRAM command scene`. With --reuse a finished result is read instead. Throws RunFailed."""
        folder = os.path.join(self.folder, name)
        if not (self.options.reuse and is_finished(folder, command)):
            words = [word for setting in (*self.settings, *settings) for word in ("--set", setting)]
            done = subprocess.run([self.options.program, command, scene, "--output", folder, "--overwrite", "--quiet",
                                   *words], env=ENVIRONMENT,
                                  capture_output=True, text=True)
            if done.returncode != 0:
                raise RunFailed(f"{folder} ended with exit code {done.returncode}: {done.stderr.strip()}")
        return Result(folder)


class Result:
    """Results of one run. The columns of both histories are arrays, by name."""

    def __init__(self, folder):
        self.folder = folder

    def columns(self, name):
        with open(os.path.join(self.folder, name)) as file:
            rows = list(csv.DictReader(file))
        return {key: numpy.array([row[key] if key == "walk" else float(row[key]) for row in rows]) for key in rows[0]}

    @property
    def grains(self):
        return self.columns("discrete.csv")

    @property
    def continuum(self):
        return self.columns("continuum.csv")

    def json(self, name):
        with open(os.path.join(self.folder, name)) as file:
            return json.load(file)

    @property
    def comparison(self):
        return self.json("comparison.json")

    @property
    def provenance(self):
        return self.json("provenance.json")

    def seconds(self, *phases):
        """CPU seconds of these phases; of all without names."""
        return sum(phase["cpu_s"] for phase in self.provenance["phases"] if not phases or phase["name"] in phases)

    @property
    def prepared(self):
        """Grains and walls before the first step: datasets and attributes by name."""
        with h5py.File(os.path.join(self.folder, "discrete.h5"), "r") as file:
            group = file["stage_0000"]
            return {**{name: group[f"grains/{name}"][()] for name in ("position", "radius")}, **group.attrs}


def value(number):
    """A number of comparison.json, with or without its interval."""
    return number["value"] if isinstance(number, dict) else number


def angles(bands):
    return [value(band["angle_deg"]) for band in bands]


def running_mean(strain, quantity):
    """(strain at the end, mean) of every PEAK_WINDOW of strain. The steps must be equal."""
    n_steps = max(1, round(PEAK_WINDOW / (strain[1] - strain[0])))
    return strain[n_steps - 1:], numpy.convolve(quantity, numpy.ones(n_steps) / n_steps, "valid")


def between(strain, quantity, low, high):
    """Mean over the steps with low < strain <= high."""
    return quantity[(strain > low) & (strain <= high + 1e-9)].mean()


def mean_and_error(values):
    """(mean, standard error of the mean) over the first axis. The error of a single value is 0."""
    values = numpy.array(values)
    return values.mean(axis=0), values.std(axis=0,
                                           ddof=1) / numpy.sqrt(len(values)) if len(values) > 1 else 0 * values[0]


def platen_difference(columns):
    """|F_upper + F_lower| / mean size of both vertical platen forces, for every step: zero in statics, at most 2."""
    lower, upper = columns["lower_fy"], columns["upper_fy"]
    size = 0.5 * (numpy.abs(lower) + numpy.abs(upper))
    return numpy.divide(numpy.abs(lower + upper), size, out=numpy.zeros_like(size), where=size > 0)


def stage_means(comparison, panel, name="stress_ratio"):
    return numpy.array([value(stage[panel][name]) for stage in comparison["stages"]])


def judge(seeds, figures, claims):
    """Prints one row per number, claimed ones first. Returns how many claimed numbers lie outside their interval."""
    n_outside = 0
    width = max(len(name) for name in figures[0]) + 2
    print(f"{'seed':{width}}" + "".join(f"{seed:>10}" for seed in seeds) + "   claimed")
    for name, low, high in claims:
        values = [f[name] for f in figures]
        outside = [not low <= v <= high for v in values]
        n_outside += sum(outside)
        print(f"{name:{width}}" + "".join(f"{v:10.4g}" for v in values) + f"   {low:g} to {high:g}"
              + ("   OUTSIDE" if any(outside) else ""))
    claimed = {name for name, _, _ in claims}
    for name in figures[0]:
        if name not in claimed:
            print(f"{name:{width}}" + "".join(f"{f[name]:10.4g}" for f in figures))
    return n_outside


def main(doc, measure, claims, draw, switches=None):
    """Entry point of a check.py.

    measure(runs) returns {name: number} of one seed. draw(folder, path) draws the runs of the first seed. switches:
    {word: help} of further options, which measure reads from runs.options."""
    parser = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--seeds", default="1", help="default: 1")
    parser.add_argument("--output", help="folder for the result folders; default: a temporary one")
    parser.add_argument("--reuse", action="store_true", help="keep runs that are already in --output")
    parser.add_argument("--set", action="append", default=[], help="section/key=value, passed to every run")
    parser.add_argument("--figure", help="file for the figure of the first seed (matplotlib)")
    for word, meaning in (switches or {}).items():
        parser.add_argument(f"--{word}", action="store_true", help=meaning)
    options = parser.parse_args()
    options.program = os.path.abspath(options.program)
    seeds = [int(word) for word in options.seeds.split(",")]
    with tempfile.TemporaryDirectory() as scratch:
        folders = [os.path.join(options.output or scratch, f"seed_{seed}") for seed in seeds]
        try:
            figures = [measure(Runs(options, seed, folder)) for seed, folder in zip(seeds, folders)]
        except RunFailed as failure:
            sys.stderr.write(f"{os.path.basename(sys.argv[0])}: {failure}\n")
            return 2
        n_outside = judge(seeds, figures, claims)
        if options.figure:
            draw(folders[0], options.figure)
    return 1 if n_outside else 0
