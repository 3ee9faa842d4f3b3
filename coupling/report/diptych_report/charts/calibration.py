# diptych: charts of a calibration: curves before and after, residuals, correlation, profiles
# SPDX-License-Identifier: LGPL-2.1-or-later

import numpy as np
from matplotlib.figure import Figure

from diptych_report.charts.style import CONTINUUM, FAINT, GRAINS, INK, ruled, svg
from diptych_report.data.calibration import label, numbers

CURVES = {"stress_ratio": ("stress_ratio", "stress ratio t/s", 1), "volumetric_strain": ("volume", "volumetric strain, %", 100)}
KINDS = {"stress_ratio": "t/s", "volumetric_strain": "volume", "ln_width": "ln width"}
MARKS = {"stress_ratio": "o", "volumetric_strain": "s", "ln_width": "D"}


def curve(path, kind, model):
    """Data, as mean of the grains or measured, and the model before and after, each with two deviations of one sample."""
    figure = Figure(figsize=(4.5, 3.1))
    axes = ruled(figure.add_axes([0.15, 0.16, 0.825, 0.8]))
    label = draw_curve(axes, path, kind, model)
    axes.legend(loc="lower right" if kind == "stress_ratio" else "best")
    return svg(figure, f"{label} of {path['name']}: data with their scatter, {model} before and after calibration.")


def draw_curve(axes, path, kind, model):
    """Draws a curve without a legend. Returns the label of its axis."""
    name, label, scale = CURVES[kind]
    x = 100 * numbers(path["progress"])
    low, high = scale * numbers(path[name + "_low"]), scale * numbers(path[name + "_high"])
    if np.isfinite(low).any():
        axes.fill_between(x, low, high, color=GRAINS, alpha=0.18, linewidth=0, label="grains, ± 2 deviations of a sample")
    measured = [o for o in path["observables"] if path["curve"] and o["kind"] == kind and o["mean"] is not None]
    if measured:
        middle, mean, deviation = (numbers(column) for column in zip(*[(50 * (o["from"] + o["to"]), o["mean"], o["deviation"]) for o in measured]))
        axes.errorbar(middle, scale * mean, 2 * scale * deviation, fmt="none", ecolor=GRAINS, label="measured, ± 2 deviations")
    axes.plot(x, scale * numbers(path[name]), color=GRAINS, label="measured" if path["curve"] else f"grains, mean of {len(path['seeds'])}")
    if f"{name}_after_low" in path:
        axes.fill_between(x, *(scale * numbers(path[f"{name}_after_{end}"]) for end in ("low", "high")), color=CONTINUUM, alpha=0.15, linewidth=0,
                          label="calibrated, ± 2 deviations of a sample")
    for when, look in (("before", dict(color=FAINT, linestyle=(0, (2, 1.5)))), ("after", dict(color=CONTINUUM, linestyle=(0, (5, 1.5))))):
        y = scale * numbers(path[f"{name}_{when}"])
        if len(y) == len(x):
            axes.plot(x, y, label=f"{model}, before" if when == "before" else f"{model}, calibrated", **look)
    axes.set(xlabel="axial strain, %", ylabel=label, xlim=(0, x[-1]))
    if kind == "stress_ratio":
        axes.set_ylim(0, 1.3 * np.nanmax(scale * numbers(path[name])))
    return label


def residuals(path):
    """(model - data) / standard deviation of the means."""
    entries = [o for o in path["observables"] if o["after"] is not None and o["mean"] is not None and o["deviation_of_mean"]]
    if not entries:
        return None
    figure = Figure(figsize=(4.5, 3.1))
    axes = ruled(figure.add_axes([0.13, 0.16, 0.845, 0.8]))
    axes.axhspan(-2, 2, color="#e3eef5", linewidth=0)
    axes.axhline(0, color=FAINT, linewidth=0.8)
    for kind, mark in MARKS.items():
        of_kind = [o for o in entries if o["kind"] == kind]
        for counts in (True, False):
            points = [(50 * (o["from"] + o["to"]), (o["after"] - o["mean"]) / o["deviation_of_mean"]) for o in of_kind if o["counts"] == counts]
            if points:
                axes.plot(*zip(*points), mark, color=INK, markersize=5, markerfacecolor=INK if counts else "white",
                          label=KINDS[kind] + ("" if counts else ", not fitted"))
    axes.set(xlabel="axial strain, %", ylabel="difference / deviation")
    axes.legend(loc="best")
    return svg(figure, f"Residuals of {path['name']} for each bin, over the standard deviation of the means.")


def correlation(calibration):
    names, matrix = calibration.names(), np.array(calibration.record["correlation"], dtype=float)
    n = len(names)
    figure = Figure(figsize=(3.2 + 0.42 * n, 1.5 + 0.42 * n))
    width, height = figure.get_size_inches()
    axes = figure.add_axes([2.1 / width, 1.45 / height, 0.42 * n / width, 0.42 * n / height])
    axes.imshow(matrix, cmap="RdBu_r", vmin=-1, vmax=1)
    for i in range(n):
        for j in range(n):
            axes.text(j, i, f"{matrix[i, j]:.1f}".replace("-", "−"), ha="center", va="center", fontsize=7,
                      color="white" if abs(matrix[i, j]) > 0.6 else INK)
    axes.set(xticks=range(n), yticks=range(n), yticklabels=names)
    axes.set_xticklabels(names, rotation=50, ha="right")
    axes.tick_params(length=0)
    return svg(figure, "Correlation of the parameters, in the coordinates of the search.")


def parabola(x, y, logarithm):
    """The parabola through three points: chi squared of a linear model in the coordinate of the search. Fewer points stay points."""
    at = np.log(x) if logarithm else x
    if not np.isfinite(y).all() or len(set(at)) < 3:
        return x, y
    fine = np.linspace(at[0], at[-1], 60)
    return np.exp(fine) if logarithm else fine, np.polyval(np.polyfit(at - at[1], y, 2), fine - at[1])


def profiles(calibration):
    """chi^2 at 1.5 standard deviations to both sides of the minimum, computed and predicted by the linear model."""
    entries = [p for p in calibration.parameters if None not in p["profile_number"]]
    columns = 3
    rows = -(-len(entries) // columns)
    figure = Figure(figsize=(7.6, 2.1 * rows + 0.2))
    for k, p in enumerate(entries):
        axes = ruled(figure.add_subplot(rows, columns, k + 1))
        x = numbers(p["profile_number"])
        axes.plot(*parabola(x, numbers(p["profile_expected"]), p["coordinate"] == "logarithm"), color=FAINT, label="linear model")
        axes.plot(x, numbers(p["profile_chi2"]), "o", color=CONTINUUM, markersize=4.5, label="computed")
        axes.set_xlabel(label(p) + {"share_of": ", share", "drop_from": ", drop"}.get(p["coordinate"], ""))
        axes.locator_params(nbins=4)
        if k % columns == 0:
            axes.set_ylabel("χ²")
        if k == 0:
            axes.legend(loc="upper center")
    figure.tight_layout()
    return svg(figure, "Profiles of chi squared over every parameter, with the others adjusted.")
