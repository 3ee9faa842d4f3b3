#!/usr/bin/env python3
# diptych: grains and law on six paths of strains and stresses
# SPDX-License-Identifier: LGPL-2.1-or-later
"""check.py PROGRAM [--seeds 1-8] [--output DIR] [--reuse] [--figure figure.png] [--paths drained,cycle]

Runs `diptych element scene.prm` on every path and prints the root mean square of law - grains with the standard error
of the grains, and the largest error of a prescribed stress in any step. Exit code 1: a number is outside its interval;
2: a run failed."""
import argparse
import glob
import json
import os
import subprocess
import sys
import tempfile

import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
SCENE = os.path.join(HERE, "scene.prm")
TABLES = {"cycle": "cycle.csv", "rotation": "rotation.csv"}
# Path -> further settings. At constant volume rigid grains have no mean stress, so these have springs.
PATHS = {"drained": (), "constant_mean_stress": (), "simple_shear": (),
         "constant_volume": ("discrete/method=penalty", ), "cycle": (), "rotation": ("loading/inertial_number=1e-4", )}
COLUMNS = (("stress_ratio", 1, "t/s"), ("volumetric_strain", 100, "volumetric strain [%]"),
           ("fabric_anisotropy", 1, "anisotropy a of the fabric"), ("coordination", 1, "contacts per grain"))
CONTROLS = {"sxx": ("drive_sxx", ), "syy": ("drive_syy", ), "sxy": ("drive_sxy", ),
            "mean_stress": ("drive_sxx", "drive_syy")}
NAMED = {"drained": {"sxx": 1}, "constant_volume": {}, "constant_mean_stress": {"mean_stress": 1},
         "simple_shear": {"syy": 1}}
# Largest error of a prescribed stress in units of the pressure. A row of a table may begin within a step, over which
# the mean acts.
STRESS_ERROR = {"rotation": 1e-3}


def columns(path):
    rows = numpy.genfromtxt(path, delimiter=",", names=True)  # NaN where there is a text
    return {name: rows[name] for name in rows.dtype.names}


def run(options, path):
    """Folder of `diptych element` on a path."""
    folder = os.path.join(options.output, path)
    if options.reuse and os.path.exists(os.path.join(folder, "element.json")):
        return folder
    settings = ("loading/path=" + (os.path.join(HERE, TABLES[path]) if path in TABLES else path), *PATHS[path])
    words = [word for setting in settings for word in ("--set", setting)]
    words += ["--seeds", options.seeds, "--output", folder, "--overwrite", "--quiet"]
    done = subprocess.run([options.program, "element", SCENE, *words], capture_output=True, text=True)
    if done.returncode != 0:
        sys.stderr.write(f"check.py: {path} ended with exit code {done.returncode}: {done.stderr.strip()}\n")
        sys.exit(2)
    return folder


def stress_error(folder, path):
    """Largest difference of a prescribed stress from that which drives the cell, over all steps of all samples. It acts
    over the step, so that its value in the middle counts."""
    table = columns(os.path.join(HERE, TABLES[path])) if path in TABLES else {**NAMED[path], "progress": None}
    worst = 0.
    for file in glob.glob(os.path.join(folder, "runs", "*", "discrete.csv")):
        rows = columns(file)
        middle = rows["progress"] - 0.5 * numpy.diff(rows["progress"], prepend=0)
        for name in CONTROLS.keys() & table.keys():
            wanted = table[name] if path in NAMED else numpy.interp(middle, table["progress"], table[name])
            worst = max(worst, abs(numpy.mean([rows[c] for c in CONTROLS[name]], axis=0) - wanted)[1:].max())
    return worst


def draw(folders, figure_file):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as pyplot
    figure, axes = pyplot.subplots(len(folders), 4, figsize=(14, 2.5 * len(folders)), constrained_layout=True,
                                   squeeze=False)
    for row, (path, folder) in zip(axes, folders.items()):
        curves = columns(os.path.join(folder, "element.csv"))
        for axis, (name, factor, label) in zip(row, COLUMNS):
            if name == "volumetric_strain" and path == "constant_volume":
                name, factor, label = "mean_stress", 1, "mean stress s/P"
            mean, error = (factor * curves[f"grains_{name}{end}"] for end in ("", "_error"))
            axis.fill_between(curves["progress"], mean - error, mean + error, color="#0072b2", alpha=0.35, linewidth=0)
            axis.plot(curves["progress"], mean, color="#0072b2", linewidth=1.2, label="grains")
            if f"law_{name}" in curves:
                axis.plot(curves["progress"], factor * curves[f"law_{name}"], "--", color="#d55e00", linewidth=1.2,
                          label="law")
            axis.set(xlabel="progress of the path", ylabel=label)
            axis.grid(alpha=0.3)
        row[0].set_title(path.replace("_", " "), loc="left")
    axes[0, 0].legend(fontsize=8)
    figure.savefig(figure_file, dpi=90)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=os.path.abspath)
    parser.add_argument("--seeds", default="1-8")
    parser.add_argument("--output", help="folder for the results; default: a temporary one")
    parser.add_argument("--reuse", action="store_true", help="keep results that are already in --output")
    parser.add_argument("--figure")
    parser.add_argument("--paths", type=lambda text: text.split(","), default=list(PATHS))
    options = parser.parse_args()
    n_outside = 0
    with tempfile.TemporaryDirectory() as scratch:
        options.output = options.output or scratch
        folders = {path: run(options, path) for path in options.paths}
        for path, folder in folders.items():
            with open(os.path.join(folder, "element.json"), encoding="utf-8") as file:
                rms = json.load(file)["rms"]
            error = stress_error(folder, path)
            outside = error > STRESS_ERROR.get(path, 1e-12)
            n_outside += outside
            print(f"{path}: largest error of a prescribed stress {error:.1e} P" + ("   OUTSIDE" if outside else ""))
            for one in rms:
                print(f"    {one['quantity']:20}law - grains {one['value']:.4g} +- {one['error']:.2g}, "
                      f"standard error of the grains {one['noise']:.2g}")
        if options.figure:
            draw(folders, options.figure)
    return 1 if n_outside else 0


if __name__ == "__main__":
    sys.exit(main())
