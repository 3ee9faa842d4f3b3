#!/usr/bin/env python3
# diptych: adds LAMMPS on the same samples to the charts of step_tolerance
# SPDX-License-Identifier: LGPL-2.1-or-later
"""with_lammps.py DIR FIGURE.png [--run]

DIR: folder of study.json or slow.json (`diptych study`). Draws error against CPU seconds like figure.py, with LAMMPS on
the same samples at kn/P of 1e3, 1e4 and 1e5, compared with the study's reference. Prints these errors with their 95 %
intervals. --run: runs `lmp` (Debian package lammps); otherwise reads the results in ../../rigid_limit/lammps.csv. Needs
the package diptych (PYTHONPATH)."""
import argparse
import csv
import os
import shutil
import sys
import tempfile

import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
sys.dont_write_bytecode = True
for folder in ("..", "../../rigid_limit"):
    sys.path.insert(0, os.path.join(HERE, folder))
import lammps  # noqa: E402
import rigid_limit  # noqa: E402
from diptych.report import study as charts  # noqa: E402
from diptych.report.charts.by_matplotlib import styled  # noqa: E402
from diptych.report.studies import load  # noqa: E402

from matplotlib.backends.backend_agg import FigureCanvasAgg  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402

LOADED = 0.015  # Strain of the study. The stored runs of LAMMPS go to rigid_limit.STRAIN.
WINDOWS = {"early strength": (0.002, 0.005), "strength": (0.005, 0.015)}
LOWEST = 0.05  # Per cent. Smaller errors are chance.
STUDENT = {6: 2.571, 8: 2.365}  # 97.5 % quantiles for the studies' numbers of samples.


def of_run(folder):
    """Columns of one run of the study in bins of strain."""
    with open(os.path.join(folder, "discrete.csv"), encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    history = {name: numpy.array([float(row[name]) for row in rows])
               for name in ("axial_strain", "volumetric_strain", "kinetic_energy", "sxx", "sxy", "syx", "syy")}
    history["t"] = numpy.hypot(0.5 * (history["syy"] - history["sxx"]), 0.5 * (history["sxy"] + history["syx"]))
    history["s"] = 0.5 * (history["sxx"] + history["syy"])
    edges = numpy.arange(0, LOADED + rigid_limit.BIN / 2, rigid_limit.BIN)
    means = {name: [history[name][(history["axial_strain"] > low) & (history["axial_strain"] <= high + 1e-9)].mean()
                    for low, high in zip(edges[:-1], edges[1:])] for name in ("t", "s")}
    return {"axial_strain": edges[1:], **{name: numpy.array(values) for name, values in means.items()},
            "volumetric_strain": numpy.interp(edges[1:], history["axial_strain"], history["volumetric_strain"])}


def of_lammps(inertial, stiffness, seed, runs_it):
    """(columns, CPU seconds to LOADED)."""
    if not runs_it:
        columns, seconds = rigid_limit.stored(inertial, stiffness, seed)
        return columns, seconds * LOADED / rigid_limit.STRAIN
    with tempfile.TemporaryDirectory() as folder:
        columns, seconds = lammps.run(rigid_limit.sample_file(seed), folder, stiffness, inertial, rigid_limit.STRAIN)
    return rigid_limit.binned(columns), seconds * LOADED / rigid_limit.STRAIN


def numbers(columns):
    found = {name: rigid_limit.strength(columns, *window) for name, window in WINDOWS.items()}
    found["dilation"] = columns["volumetric_strain"][numpy.argmin(abs(columns["axial_strain"] - LOADED))]
    return found


def errors(study, folder, inertial, stiffness, runs_it):
    """({quantity: (error, half a 95 % interval)}, CPU seconds)"""
    seeds = study.record["seeds"]
    references = [numbers(of_run(os.path.join(folder, one))) for one in study.points[study.references[0]]["folders"]]
    runs = [of_lammps(inertial, stiffness, seed, runs_it) for seed in seeds]
    found = {}
    for name in references[0]:
        base = numpy.array([one[name] for one in references])
        difference = (numpy.array([numbers(columns)[name] for columns, _ in runs]) - base) / abs(base.mean())
        difference *= numpy.sign(base.mean())  # Relative to the size: less dilation is negative.
        found[name] = difference.mean(), STUDENT[len(seeds)] * difference.std(ddof=1) / numpy.sqrt(len(seeds))
    return found, numpy.mean([seconds for _, seconds in runs])


@styled()
def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("figure")
    parser.add_argument("--run", action="store_true")
    options = parser.parse_args()
    if options.run and not shutil.which("lmp"):
        sys.exit("lmp is not installed (Debian package lammps); without --run its stored results are taken")
    study = load(options.folder)
    known = [value for value in rigid_limit.STIFFNESSES if f"{value:.2e}".replace("e-0", "e-") in study.record["title"]]
    if len(known) != 1 or len(study.record["seeds"]) not in STUDENT:
        sys.exit(f"{options.folder}: no study of step_tolerance: its title names no inertial number of "
                 f"{list(rigid_limit.STIFFNESSES)}, or it has other samples")
    inertial = known[0]
    table = {k: errors(study, options.folder, inertial, k, options.run) for k in rigid_limit.STIFFNESSES[inertial]}
    shown = [(k, q) for k, q in enumerate(study.quantities) if q["limit"]]
    figure = Figure(figsize=(4.6 * len(shown), 3.9), layout="constrained")
    figure.get_layout_engine().set(rect=(0, 0.08, 1, 0.92))
    FigureCanvasAgg(figure)
    for place, (k, quantity) in enumerate(shown):
        axes = figure.add_subplot(1, len(shown), place + 1)
        charts.draw_error_against_cost(axes, study, k, study.references[0])
        for stiffness, (by_name, seconds) in table.items():
            error, half = by_name[quantity["name"]]
            axes.errorbar(seconds, 100 * abs(error), 100 * half, marker="*", markersize=10, color="#8a1c7c",
                          elinewidth=0.8, capsize=2, label="LAMMPS" if stiffness == min(table) else None)
            axes.annotate(f"{stiffness:.0e}".replace("e+0", "e"), (seconds, 100 * abs(error)), xytext=(6, 4),
                          textcoords="offset points", fontsize=7, color="#8a1c7c")
        axes.autoscale(axis="x")
        axes.set_ylim(bottom=LOWEST)
        axes.get_legend().remove()
        axes.set_title(quantity["name"], fontsize=9.5)
    figure.legend(*axes.get_legend_handles_labels(), loc="lower center", ncols=8, fontsize=8, handlelength=1.6)
    figure.suptitle(study.record["title"] + "; LAMMPS: gran/hooke/history at kn/P as written", fontsize=9)
    figure.savefig(options.figure, dpi=80)
    for stiffness, (by_name, seconds) in table.items():
        print(f"LAMMPS, kn/P = {stiffness:g}: {seconds:.2f} CPU s;", "; ".join(
            f"{name} {100 * error:+.1f} +- {100 * half:.1f} %" for name, (error, half) in by_name.items()))


if __name__ == "__main__":
    main()
