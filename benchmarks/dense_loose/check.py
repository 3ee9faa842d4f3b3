#!/usr/bin/env python3
# diptych: the same grains packed densely (peak and dilation) and loosely (neither)
# SPDX-License-Identifier: LGPL-2.1-or-later
"""check.py PROGRAM [--seeds 1,2,3] [--output DIR] [--reuse] [--set section/key=value] [--figure figure.png]

Runs dense.prm and loose.prm for every seed and compares both panels with the claims of the README. Exit code 1: a
number is outside its interval; 2: a run failed. Needs h5py and numpy, the figure matplotlib."""
import os
import sys

import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))
import claims  # noqa: E402

STATES = ("dense", "loose")

# Mean and four standard deviations over seeds of the README, narrower where the claim is stricter. The
# claim: the same grains have a peak of more than 11 % in the dense sample and of less in the loose one.
CLAIMS = [("largest difference of the sorted radii", 0, 0), ("dense: solid fraction", 0.845, 0.85),
          ("loose: solid fraction", 0.8, 0.814), ("loose / dense: t/s, first 1 %", 0.09, 0.32),
          ("dense: peak t/s", 0.293, 0.447), ("dense: strain at the peak", 0.002, 0.036),
          ("dense: peak / last 2 %", 1.11, 1.7),
          ("loose: peak / last 2 %", 1, 1.16), ("loose / dense: t/s, last 2 %", 0.66, 1.39),
          ("dense: volumetric strain at the end", -0.0314, -0.0188),
          ("loose: volumetric strain at the end", 0.0064, 0.0269),
          ("dense, continuum: peak / end", 1.26, 1.329), ("loose, continuum: peak / end", 1, 1.04),
          ("dense: mean |t/s of the continuum / grains - 1|", 0, 0.12),
          ("loose: mean |t/s of the continuum / grains - 1|", 0, 0.16),
          ("dense: largest |difference of volumetric strain|", 0, 0.0076),
          ("loose: largest |difference of volumetric strain|", 0, 0.007)]


def state_figures(name, result):
    """Strength and volume of one state, in both panels."""
    comparison, history = result.comparison, result.grains
    strain, ratio = history["axial_strain"], history["stress_ratio"]
    end, mean = claims.running_mean(strain, ratio)
    grains, continuum = (claims.stage_means(comparison, panel) for panel in ("discrete", "continuum"))
    volume = [claims.stage_means(comparison, panel, "volumetric_strain") for panel in ("discrete", "continuum")]
    last = claims.between(strain, ratio, strain[-1] - 0.02, strain[-1])
    prepared = result.prepared
    return {f"{name}: solid fraction": numpy.pi * (prepared["radius"]**2).sum() / prepared["area"],
            f"{name}: t/s, first 1 %": claims.between(strain, ratio, 0, 0.01), f"{name}: peak t/s": mean.max(),
            f"{name}: strain at the peak": end[mean.argmax()], f"{name}: t/s, last 2 %": last,
            f"{name}: peak / last 2 %": mean.max() / last, f"{name}: volumetric strain at the end": volume[0][-1],
            f"{name}: solid fraction at the end": history["solid_fraction"][-1],
            f"{name}, continuum: peak / end": result.continuum["stress_ratio"].max()
            / result.continuum["stress_ratio"][-1], f"{name}, continuum: volumetric strain at the end": volume[1][-1],
            f"{name}: mean |t/s of the continuum / grains - 1|": numpy.abs(continuum / grains - 1).mean(),
            f"{name}: largest |difference of volumetric strain|": numpy.abs(volume[1] - volume[0]).max()}


def measure(runs):
    results = {name: runs.run(name, "run", os.path.join(HERE, f"{name}.prm")) for name in STATES}
    figures = {}
    for name, result in results.items():
        figures.update(state_figures(name, result))
    radii = [numpy.sort(result.prepared["radius"]) for result in results.values()]
    figures["largest difference of the sorted radii"] = numpy.abs(radii[0] - radii[1]).max()
    figures["loose / dense: t/s, first 1 %"] = figures["loose: t/s, first 1 %"] / figures["dense: t/s, first 1 %"]
    figures["loose / dense: t/s, last 2 %"] = figures["loose: t/s, last 2 %"] / figures["dense: t/s, last 2 %"]
    return figures


def draw(folder, path):
    """Stress ratio and volumetric strain of both states: every step and running means of the grains, and the
    continuum."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as pyplot
    figure, axes = pyplot.subplots(1, 2, figsize=(9, 3.8), constrained_layout=True)
    for name, colour in zip(STATES, ("#0072b2", "#d55e00")):
        result = claims.Result(os.path.join(folder, name))
        grains, continuum = result.grains, result.continuum
        end, mean = claims.running_mean(grains["axial_strain"], grains["stress_ratio"])
        axes[0].plot(100 * grains["axial_strain"], grains["stress_ratio"], color=colour, alpha=0.25, linewidth=0.5)
        axes[0].plot(100 * (end - claims.PEAK_WINDOW / 2), mean, color=colour, label=f"{name}, grains")
        axes[1].plot(100 * grains["axial_strain"], 100 * grains["volumetric_strain"], color=colour)
        for axis, column, scale in ((axes[0], "stress_ratio", 1), (axes[1], "volumetric_strain", 100)):
            axis.plot(100 * continuum["axial_strain"], scale * continuum[column], color=colour, linestyle="--",
                      label=f"{name}, continuum")
    axes[0].set(xlabel="axial strain [%]", ylabel="t/s", ylim=(0, None))
    axes[1].set(xlabel="axial strain [%]", ylabel="volumetric strain [%]")
    axes[0].legend(loc="lower right", fontsize=8)
    for axis in axes:
        axis.grid(alpha=0.3)
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    sys.exit(claims.main(__doc__, measure, CLAIMS, draw))
