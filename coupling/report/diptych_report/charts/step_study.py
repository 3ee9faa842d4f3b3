#!/usr/bin/env python3
# diptych: figure of a study of the step; usage: step_study.py RESULT_DIR
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads study_step.csv and study_step.json, draws study_step.png. Exit codes: 0 done, 2 wrong input."""

import csv
import json
import os
import sys

sys.dont_write_bytecode = True

from matplotlib.backends.backend_agg import FigureCanvasAgg  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402

import style  # noqa: E402

COLOURS = ["#D55E00", "#0072B2", "#222222"]
DASHES = [(0, (5, 1.5)), (0, (1.5, 1)), "-"]
PANELS = [("stress_ratio", "stress ratio $t/s$, running mean [-]"), ("external_work", "work of platens and pressure [P d$^2$]"),
          ("friction_dissipation", "dissipated by friction [P d$^2$]"), ("impact_dissipation", "dissipated by impacts [P d$^2$]"),
          ("kinetic_energy", "kinetic energy [P d$^2$]"), ("max_penetration", "largest penetration [d]")]


def running_mean(x, y, width):
    """Mean over the rows whose strain lies within `width` before each row's."""
    out, first, total = [], 0, 0.0
    for k in range(len(x)):
        total += y[k]
        while x[k] - x[first] > width:
            total -= y[first]
            first += 1
        out.append(total / (k - first + 1))
    return out


def main(arguments):
    if len(arguments) != 1:
        print("usage: step_study.py RESULT_DIR", file=sys.stderr)
        return 2
    folder = arguments[0]
    try:
        with open(os.path.join(folder, "study_step.csv")) as file:
            rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
        with open(os.path.join(folder, "study_step.json")) as file:
            study = json.load(file)
    except (OSError, ValueError) as error:
        print(f"step_study: {error}", file=sys.stderr)
        return 2
    style.set_up()
    figure = Figure(figsize=(10, 6.4), constrained_layout=True)
    axes = figure.subplots(2, 3).ravel()
    for axis, (name, label) in zip(axes, PANELS):
        for k, step in enumerate(study["steps"]):
            run = [row for row in rows if row["step"] == step]
            x, y = [row["axial_strain"] for row in run], [row[name] for row in run]
            if name == "stress_ratio":
                y = running_mean(x, y, 0.005)
            axis.plot([row["time"] for row in run], y, color=COLOURS[k % 3], linestyle=DASHES[k % 3],
                      linewidth=1.5 if name in ("stress_ratio", "external_work", "friction_dissipation", "impact_dissipation") else 0.7,
                      label=f"h = {step:g}")
        axis.set_xlabel("time [d $\\sqrt{\\rho/P}$]")
        axis.set_ylabel(label)
        if name in ("kinetic_energy", "max_penetration"):
            axis.set_yscale("log" if min(row[name] for row in rows) > 0 else "linear")
    axes[0].legend()
    figure.suptitle(study["verdict"], fontsize=9)
    path = os.path.join(folder, "study_step.png")
    FigureCanvasAgg(figure)
    figure.savefig(path + ".part", format="png", dpi=120)
    os.replace(path + ".part", path)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
