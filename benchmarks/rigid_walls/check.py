#!/usr/bin/env python3
# diptych: a dense sample between four rigid smooth walls, in both panels
# SPDX-License-Identifier: LGPL-2.1-or-later
"""check.py PROGRAM [--seeds 1,2,3] [--output DIR] [--reuse] [--set section/key=value] [--figure figure.png]

Runs scene.prm for every seed and compares both panels with the claims of the README. Exit code 1: a number is outside
its interval; 2: a run failed. Needs h5py and numpy, the figure matplotlib."""
import os
import sys

import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))
import claims  # noqa: E402

SCENE = os.path.join(HERE, "scene.prm")

# Grains and prediction: mean and four standard deviations over ten seeds (1-6, 11-14). The mean forces on
# opposite walls differ by the grains' momentum at the end over the time: 0.3 % at the sides.
CLAIMS = [("grains: peak t/s", 0.356, 0.445), ("grains: t/s, 1.5-4 %", 0.339, 0.414),
          ("grains: t/s, 7-8 %", 0.266, 0.378),
          ("grains: volumetric strain at the end", -0.0373, -0.0214),
          ("right wall: mean force / (P height)", 0.999, 1.001),
          ("left / right wall: mean force", 1, 1.006), ("lower / upper wall: mean force", 0.999, 1.001),
          ("largest shear force on a wall / vertical force", 0, 0), ("continuum: bands in all windows", 0, 0),
          ("continuum: largest spread of t/s over the probes", 0, 1e-6),
          ("mean |t/s of the continuum / grains - 1|", 0, 0.16),
          ("largest |difference of volumetric strain|", 0, 0.0103)]


def wall_figures(result):
    """Checks of four smooth walls: pressure at the sides, no shear, equal mean forces on opposite walls."""
    history = result.grains
    height = result.prepared["upper_y"] * (1 - history["axial_strain"])
    vertical = numpy.abs(history["upper_fy"]).mean()
    shear = [numpy.abs(history[name]).max() for name in ("lower_fx", "upper_fx", "left_fy", "right_fy")]
    return {"right wall: mean force / (P height)": (-history["right_fx"] / height).mean(),
            "left / right wall: mean force": -history["left_fx"].mean() / history["right_fx"].mean(),
            "lower / upper wall: mean force": -history["lower_fy"].mean() / history["upper_fy"].mean(),
            "largest shear force on a wall / vertical force": max(shear) / vertical}


def continuum_figures(comparison):
    """Checks of a uniform continuum: no band, the same stress in every probe of a stage."""
    spread = []
    for stage in comparison["stages"]:
        ratios = [claims.value(probe["t_over_s"]) for probe in stage["continuum"]["probes"]]
        spread.append(numpy.ptp([ratio for ratio in ratios if ratio is not None]))  # None if no cell lies in a probe.
    return {"continuum: bands in all windows": sum(len(w["continuum"]["bands"]) for w in comparison["windows"]),
            "continuum: largest spread of t/s over the probes": max(spread)}


def measure(runs):
    result = runs.run("scene", "run", SCENE)
    comparison, history = result.comparison, result.grains
    strain, ratio = history["axial_strain"], history["stress_ratio"]
    grains, continuum = (claims.stage_means(comparison, panel) for panel in ("discrete", "continuum"))
    volume = [claims.stage_means(comparison, panel, "volumetric_strain") for panel in ("discrete", "continuum")]
    return {"grains: peak t/s": claims.running_mean(strain, ratio)[1].max(),
            "grains: t/s, 1.5-4 %": claims.between(strain, ratio, 0.015, 0.04),
            "grains: t/s, 7-8 %": claims.between(strain, ratio, 0.07, 0.08),
            "grains: volumetric strain at the end": volume[0][-1], **wall_figures(result),
            **continuum_figures(comparison),
            "continuum: peak t/s": comparison["continuum_summary"]["peak_stress_ratio"],
            "continuum: t/s at 8 %": continuum[-1],
            "mean |t/s of the continuum / grains - 1|": numpy.abs(continuum / grains - 1).mean(),
            "largest |difference of volumetric strain|": numpy.abs(volume[1] - volume[0]).max(),
            "grains: bands in all 4 windows": sum(len(w["discrete"]["bands"]) for w in comparison["windows"])}


def draw(folder, path):
    """Stress ratio and volumetric strain of both panels."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as pyplot
    result = claims.Result(os.path.join(folder, "scene"))
    grains, continuum = result.grains, result.continuum
    end, mean = claims.running_mean(grains["axial_strain"], grains["stress_ratio"])
    figure, axes = pyplot.subplots(1, 2, figsize=(9, 3.6), constrained_layout=True)
    axes[0].plot(100 * grains["axial_strain"], grains["stress_ratio"], color="#0072b2", alpha=0.25, linewidth=0.5)
    axes[0].plot(100 * (end - claims.PEAK_WINDOW / 2), mean, color="#0072b2", label="grains")
    axes[0].plot(100 * continuum["axial_strain"], continuum["stress_ratio"], "--", color="#d55e00",
                 label="continuum, predicted")
    axes[1].plot(100 * grains["axial_strain"], 100 * grains["volumetric_strain"], color="#0072b2")
    axes[1].plot(100 * continuum["axial_strain"], 100 * continuum["volumetric_strain"], "--", color="#d55e00")
    axes[0].set(xlabel="axial strain [%]", ylabel="t/s", ylim=(0, None))
    axes[1].set(xlabel="axial strain [%]", ylabel="volumetric strain [%]")
    axes[0].legend(loc="lower right")
    for axis in axes:
        axis.grid(alpha=0.3)
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    sys.exit(claims.main(__doc__, measure, CLAIMS, draw))
