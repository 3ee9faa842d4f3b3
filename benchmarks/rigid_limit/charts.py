# diptych: figures of the rigid limit
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Curves of all methods. Needs matplotlib."""
import os

import matplotlib
import numpy

import claims

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot  # noqa: E402

COLOURS = {"NSCD h =": "#0072B2", "NSCD accuracy": "#56B4E9", "penalty kn/P =": "#D55E00", "LAMMPS kn/P =": "#007A5E"}
QUANTITIES = (("t", "T/S, running over 0.3 %"), ("volumetric_strain", "dilation (%)"),
              ("kinetic_energy", "kinetic energy (P d²)"))


def curve(columns, name):
    """Curve of one run at the ends of its bins."""
    if name == "volumetric_strain":
        return -100 * columns[name]
    if name == "kinetic_energy":
        return columns[name]
    three = numpy.ones(3) / 3
    t, s = (numpy.convolve(columns[key], three, "same") for key in ("t", "s"))
    return t / s


def draw_curves(by_method, inertial, path):
    """The finest method of every family, and the softest springs."""
    figure, axes = pyplot.subplots(1, 3, figsize=(13, 4), constrained_layout=True)
    shown = {}
    for method in by_method:
        shown.setdefault(method.family, []).append(method)
    for family, methods in shown.items():
        if family not in COLOURS:
            continue
        for method, line in ((methods[0], ":"), (methods[-1], "-")) if len(methods) > 1 else ((methods[0], "--"),):
            for axis, (name, label) in zip(axes, QUANTITIES):
                curves = [curve(columns, name) for columns, _ in by_method[method].values()]
                end = 100 * next(iter(by_method[method].values()))[0]["axial_strain"]
                mean, error = claims.mean_and_error(curves)
                axis.plot(end, mean, line, color=COLOURS[family], linewidth=1.4, label=method.name)
                if line != ":":
                    axis.fill_between(end, mean - error, mean + error, color=COLOURS[family], alpha=0.12, linewidth=0)
                axis.set(xlabel="axial strain (%)", ylabel=label)
                axis.grid(alpha=0.3)
    axes[0].set_ylim(bottom=0.2)
    axes[2].set_yscale("log")
    axes[1].legend(fontsize=8)
    seeds = len(next(iter(by_method.values())))
    figure.suptitle(f"I = {inertial:g}, means over {seeds} samples; bands: standard error of the mean (samples differ; "
                    "the differences are paired)", fontsize=9.5)
    figure.savefig(path, dpi=110)
    pyplot.close(figure)


def draw(found, folder):
    os.makedirs(folder, exist_ok=True)
    for inertial, by_method in found.items():
        draw_curves(by_method, inertial, os.path.join(folder, f"curves_{inertial:g}.png"))
