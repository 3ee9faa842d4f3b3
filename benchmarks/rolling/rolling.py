#!/usr/bin/env python3
# diptych: strength, dilation, density and shear bands over the rolling resistance
# SPDX-License-Identifier: LGPL-2.1-or-later
"""rolling.py [PROGRAM --output DIR [--seeds 1,2,3,4]] [--figure FILE]

Prints and draws the results stored in critical.csv (steady plane shear) and band.csv (biaxial compression). With
PROGRAM it first makes the runs (those in DIR are kept) and stores them again. All values of mu_r load the same prepared
grains of a seed: differences from mu_r = 0 are paired. Needs h5py, numpy, pandas and the Python package diptych, the
figure matplotlib."""
import argparse
import os
import sys

import h5py
import numpy
import pandas

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.dirname(HERE), os.path.join(HERE, "../plane_shear")]
import claims  # noqa: E402
import plane_shear  # noqa: E402

ROLLING = (0., 0.02, 0.05, 0.1, 0.2, 0.3)
# Of the strength; nearly the same error for all mu_r, so that the differences are better.
ACCURACY = "discrete/accuracy=0.05"
# Loosely prepared, so that the steady state begins early. I = strain rate sqrt(m/P) = 0.005.
STEADY = ("loading/inertial_number=0.00564", "sample/box_solid_fraction=0.75", "sample/preparation_friction=1",
          "loading/axial_strain=2.5")
STEADY_FROM = 0.5  # Shear strain.
COLOURS = {0.1: "#0072B2", 0.4: "#D55E00", 0.8: "#007A5E"}  # Of the frictions between grains.
BAND = ("loading/axial_strain=0.06", "loading/stage_strain=0.02", "comparison/window_edges=0,0.02,0.04,0.06")
RESIDUAL = (0.04, 0.06)
WINDOW = (1, 2)  # Stages: the band is sought in the displacements from 2 to 4 %.
STUDIES = {"critical": tuple(COLOURS), "band": (0.4,)}  # Frictions.
COLUMNS = {"critical": {"t_over_s": "t/s", "platen": "shear / normal force", "solid_fraction": "solid fraction",
                        "coordination": "contacts per grain"},
           "band": {"peak": "peak t/s", "residual": "t/s, 4-6 %", "dilation": "dilation at 6 % [%]",
                    "solid_fraction": "solid fraction at 6 %", "width": "10-90 % width [d]",
                    "sheared": "sheared share of area", "coordination": "contacts per grain"}}


def coordination(history, late):
    """Contacts per grain that carries force."""
    return (2 * history["contacts"][late] / (history["n"] - history["rattlers"][late])).mean()


def strength(history, late):
    """T/S: ratio of the means of t = (s1 - s2)/2 and s = (s1 + s2)/2."""
    t = numpy.hypot(history["syy"] - history["sxx"], history["sxy"] + history["syx"]) / 2
    return t[late].mean() / ((history["sxx"] + history["syy"])[late].mean() / 2)


def critical(runs, name, *settings):
    """{quantity: number} of one steady plane shear."""
    result = runs.run(name, "discrete", plane_shear.SCENE, *STEADY, *settings)
    history = {**result.grains, "n": len(result.prepared["radius"])}
    late = history["shear_strain"] > STEADY_FROM
    with h5py.File(os.path.join(result.folder, "discrete.h5"), "r") as file:
        stages = [stage for stage in file.values() if stage.attrs.get("shear_strain", 0) > STEADY_FROM]
        fraction = numpy.mean([plane_shear.middle(stage)[1] for stage in stages])
    return {"t_over_s": strength(history, late), "platen": -history["upper_fx"][late].mean()
            / history["upper_fy"][late].mean(),
            "solid_fraction": fraction, "coordination": coordination(history, late),
            "cpu_s": result.seconds("discrete")}


def band(runs, name, *settings):
    """{quantity: number} of one biaxial compression. Sheared share: (sum A g)^2 / (sum A sum A g^2) with the shear
    strains g of the grains and their areas A, 1 for an even shear."""
    import diptych
    result = runs.run(name, "discrete", os.path.join(HERE, "../moreau_quick/scene.prm"), *BAND, *settings)
    history = {**result.grains, "n": len(result.prepared["radius"])}
    late = (history["axial_strain"] > RESIDUAL[0]) & (history["axial_strain"] <= RESIDUAL[1] + 1e-9)
    snapshots = diptych.load(result.folder).discrete.snapshots
    moved = diptych.increment(snapshots[WINDOW[0]], snapshots[WINDOW[1]])
    bands = diptych.find_bands(**moved, band_resamples=0).bands
    shear = diptych.shear_strain(moved.points, moved.displacement, radius=2.5 * moved.mean_diameter,
                                 weight=moved.weight)
    area = numpy.where(numpy.isnan(shear), 0, moved.weight)
    shear = numpy.nan_to_num(shear)
    return {"peak": claims.running_mean(history["axial_strain"], history["stress_ratio"])[1].max(),
            "residual": strength(history, late), "dilation": -100 * history["volumetric_strain"][-1],
            "solid_fraction": history["solid_fraction"][-1], "bands": len(bands),
            "width": bands[0].width_10_90 / moved.mean_diameter if bands else numpy.nan,
            "sheared": (area @ shear) ** 2 / (area.sum() * (area @ shear ** 2)),
            "coordination": coordination(history, late), "cpu_s": result.seconds("discrete")}


def measured(study, options):
    """Table: one row per friction, mu_r and seed."""
    measure, rows = {"critical": critical, "band": band}[study], []
    for seed in options.seeds:
        folder = os.path.join(options.output, study)
        runs = claims.Runs(argparse.Namespace(program=options.program, reuse=True, set=[]), seed, folder)
        for friction in STUDIES[study]:
            for rolling in ROLLING:
                found = measure(runs, f"{friction:g}_{rolling:g}_{seed}", ACCURACY, f"discrete/friction={friction:g}",
                                f"discrete/rolling_friction={rolling:g}")
                rows.append({"friction": friction, "rolling_friction": rolling, "seed": seed, **found})
                print(study, rows[-1], flush=True)
    return pandas.DataFrame(rows)


def paired(table, column):
    """Table over friction and mu_r: mean, its standard error; mean difference from mu_r = 0 on the same grains, its
    error."""
    wide = table.pivot(index=["friction", "rolling_friction"], columns="seed", values=column)
    base = wide.xs(0., level="rolling_friction").reindex(wide.index.get_level_values("friction"))
    change = wide - base.to_numpy()
    return pandas.DataFrame({"mean": wide.mean(axis=1), "error": wide.sem(axis=1), "change": change.mean(axis=1),
                             "change_error": change.sem(axis=1)})


def show(study, table):
    for column, label in {**COLUMNS[study], "cpu_s": "CPU s"}.items():
        print(f"\n{study}: {label}\n{paired(table, column).to_string(float_format='%.4f')}")


def draw(tables, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(2, 3, figsize=(11, 6.4), constrained_layout=True)
    for axis, name in zip(axes[0], ("t_over_s", "solid_fraction", "coordination")):
        found = paired(tables["critical"], name)
        for friction, part in found.groupby(level="friction"):
            part = part.droplevel("friction")
            axis.errorbar(part.index, part["mean"], part["error"], fmt="o-", color=COLOURS[friction], capsize=3,
                          label=f"mu = {friction:g}")
        axis.set(ylabel="steady shear: " + COLUMNS["critical"][name])
    for axis, names in zip(axes[1], (("peak", "residual"), ("dilation",), ("width",))):
        for name, mark in zip(names, ("o-", "s--")):
            part = paired(tables["band"], name).loc[0.4]
            axis.errorbar(part.index, part["mean"], part["error"], fmt=mark, color=COLOURS[0.4], capsize=3,
                          label=COLUMNS["band"][name])
        axis.set(ylabel="compression: " + ("t/s" if len(names) > 1 else COLUMNS["band"][names[0]]))
    for axis in axes.flat:
        axis.set(xlabel="rolling friction mu_r")
        axis.grid(alpha=0.3)
    axes[0, 0].legend(fontsize=8)
    axes[1, 0].legend(fontsize=8)
    figure.savefig(path, dpi=100)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=os.path.abspath, nargs="?")
    parser.add_argument("--output", type=os.path.abspath)
    parser.add_argument("--seeds", type=lambda text: [int(word) for word in text.split(",")], default=[1, 2, 3, 4])
    parser.add_argument("--figure")
    options = parser.parse_args()
    tables = {}
    for study in STUDIES:
        stored = os.path.join(HERE, study + ".csv")
        if options.program:
            measured(study, options).to_csv(stored, index=False, float_format="%.6g")
        tables[study] = pandas.read_csv(stored)
        show(study, tables[study])
    if options.figure:
        draw(tables, options.figure)


if __name__ == "__main__":
    main()
