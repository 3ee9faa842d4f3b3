# diptych: report.html of a calibration
# SPDX-License-Identifier: LGPL-2.1-or-later

import os
import re
from types import SimpleNamespace

import numpy as np
from matplotlib.figure import Figure
from scipy.integrate import trapezoid

from ..arrays import ends_text, rms
from ..errors import InputError
from ..files import read_json
from .charts.by_matplotlib import legend_above, ruled, styled, svg
from .charts.style import CONTINUUM, FAINT, GRAINS, INK, signed
from .data.numbers import loading_variable_of
from .page.writing import write

CURVES = {"stress_ratio": ("stress_ratio", "stress ratio t/s", 1),
          "volumetric_strain": ("volume", "volumetric strain, %", 100)}
KINDS = {"stress_ratio": "t/s", "volumetric_strain": "volume", "ln_width": "ln width",
         "rotation_profile": "rotation profile", "angle": "inclination", "strip_profile": "strips along the band"}
MARKS = {"stress_ratio": "o", "volumetric_strain": "s", "ln_width": "D", "rotation_profile": "^", "angle": "v",
         "strip_profile": "<"}
COORDINATES = {"value": "", "logarithm": "", "share_of": "share of ", "drop_from": "drop from ",
               "above_least": "above the least value: "}
SHORT = {"share_of": ", share", "drop_from": ", drop", "above_least": ", above least"}


@styled()
def draw(folder):
    calibration, paths = load(folder), []
    for path in calibration.paths:
        shown = [curve(path, kind, calibration.model) for kind in CURVES if _known(path, kind, "mean")]
        shown += [residuals(path), None if calibration.record["no_intervals"] else discrepancy(path)]
        paths.append((path, [picture for picture in shown if picture]))
    write(folder, "calibration.html", record=calibration.record, data=calibration.data, paths=paths,
          parameters=parameters(calibration), predictions=predictions(calibration), misfits=misfits(calibration),
          minima=minima(calibration), cost=cost(calibration),
          corner=None if calibration.record["no_intervals"] else corner(calibration))


def load(folder):
    """record: calibration.json; cost: calibration_cost.json; model: "continuum" or "grains"; data: "measured" or
    "grains". Raises InputError if the calibration did not finish."""
    path = os.path.join(folder, "calibration.json")
    record = read_json(path, 2)
    if record["status"] != "finished":
        raise InputError(f"{path}: the calibration is not finished ({record['status']})")
    for one in record["paths"]:
        across = one["across"] = loading_variable_of(one["walk"])
        for observable in one["observables"]:
            observable["x"] = 0.5 * across.factor * (observable["from"] + observable["to"])  # middle of its bin
    return SimpleNamespace(record=record, cost=read_json(os.path.join(folder, "calibration_cost.json")),
                           model=record["model"], paths=record["paths"], parameters=record["parameters"],
                           data="measured" if all(path["curve"] for path in record["paths"]) else "grains")


def label(parameter):
    """The key of a parameter, and its targets if it is not common to all."""
    return parameter["key"] + (f" ({', '.join(parameter['targets'])})" if parameter["targets"] else "")


def numbers(values):
    """The values as an array; None becomes NaN."""
    return np.array(values, dtype=float)


def _known(path, kind, key):
    """The observables of a kind that have a value of `key`."""
    return [one for one in path["observables"] if one["kind"] == kind and one[key] is not None]


def _column(entries, key):
    return numbers([one[key] for one in entries])


def curve(path, kind, model):
    """Data, as mean of the grains or measured, and the model before and after, each with two deviations of one
    sample."""
    figure = Figure(figsize=(4.5, 3.1))
    axes = ruled(figure.add_axes([0.15, 0.16, 0.825, 0.8]))
    label = draw_curve(axes, path, kind, model)
    legend_above(axes, fontsize=7.5)
    return svg(figure, f"{label} of {path['name']}: data with their scatter, {model} before and after calibration.")


def draw_curve(axes, path, kind, model):
    """Draws a curve without a legend. Returns the label of its axis."""
    name, label, scale = CURVES[kind]
    x = path["across"].factor * numbers(path["progress"])
    low, high = scale * numbers(path[name + "_low"]), scale * numbers(path[name + "_high"])
    if np.isfinite(low).any():
        axes.fill_between(x, low, high, color=GRAINS, alpha=0.18, linewidth=0,
                          label="grains, ± 2 deviations of a sample")
    measured = _known(path, kind, "mean") if path["curve"] else []
    if measured:
        axes.errorbar(_column(measured, "x"), scale * _column(measured, "mean"),
                      2 * scale * _column(measured, "deviation"), fmt="none", ecolor=GRAINS,
                      label="measured, ± 2 deviations")
    axes.plot(x, scale * numbers(path[name]), color=GRAINS,
              label="measured" if path["curve"] else f"grains, mean of {len(path['seeds'])}")
    if f"{name}_after_low" in path:
        axes.fill_between(x, *(scale * numbers(path[f"{name}_after_{end}"]) for end in ("low", "high")),
                          color=CONTINUUM, alpha=0.15, linewidth=0, label="calibrated, ± 2 deviations of a sample")
    for when, look in (("before", dict(color=FAINT, linestyle=(0, (2, 1.5)))),
                       ("after", dict(color=CONTINUUM, linestyle=(0, (5, 1.5))))):
        y = scale * numbers(path[f"{name}_{when}"])
        if len(y) == len(x):
            axes.plot(x, y, label=f"{model}, before" if when == "before" else f"{model}, calibrated", **look)
    axes.set(xlabel=path["across"].label, ylabel=label, xlim=(0, x[-1]))
    if kind == "stress_ratio":
        axes.set_ylim(0, 1.3 * np.nanmax(scale * numbers(path[name])))
    return label


def residuals(path):
    """(model - data) / standard deviation of the means."""
    entries = [o for o in path["observables"] if o["after"] is not None and o["mean"] is not None
               and o["deviation_of_mean"]]
    if not entries:
        return None
    figure = Figure(figsize=(4.5, 3.1))
    axes = ruled(figure.add_axes([0.13, 0.16, 0.845, 0.8]))
    axes.axhspan(-2, 2, color="#e3eef5", linewidth=0)
    axes.axhline(0, color=FAINT, linewidth=0.8)
    for kind, mark in MARKS.items():
        for counts in (True, False):
            points = [(o["x"], (o["after"] - o["mean"]) / o["deviation_of_mean"]) for o in entries
                      if o["kind"] == kind and o["counts"] == counts]
            if points:
                axes.plot(*zip(*points), mark, color=INK, markersize=5, markerfacecolor=INK if counts else "white",
                          label=KINDS[kind] + ("" if counts else ", not fitted"))
    axes.set(xlabel=path["across"].label, ylabel="difference / deviation")
    legend_above(axes)
    return svg(figure, f"Residuals of {path['name']} for each bin, over the standard deviation of the means.")


def discrepancy(path):
    """model - data of t/s and volume with two deviations of the means, and the estimated discrepancy as a band."""
    kinds = [kind for kind in CURVES if _known(path, kind, "discrepancy")]
    if not kinds:
        return None
    figure = Figure(figsize=(4.5, 0.5 + 1.9 * len(kinds)), layout="constrained")
    for axes, kind in zip(np.atleast_1d(figure.subplots(len(kinds), 1, sharex=True)), kinds):
        scale = CURVES[kind][2]
        entries = _known(path, kind, "discrepancy")
        x = _column(entries, "x")
        after, mean, deviation, middle, spread = (scale * _column(entries, key) for key in (
            "after", "mean", "deviation_of_mean", "discrepancy", "discrepancy_deviation"))
        ruled(axes).axhline(0, color=FAINT, linewidth=0.8)
        axes.fill_between(x, middle - 1.96 * spread, middle + 1.96 * spread, color=CONTINUUM, alpha=0.2, linewidth=0,
                          label="discrepancy, 95 %")
        axes.plot(x, middle, color=CONTINUUM, label="discrepancy, mean")
        axes.errorbar(x, after - mean, 2 * deviation, fmt="o", color=INK, markersize=3.5, linewidth=0.8,
                      label="model − data, ± 2 deviations")
        axes.set_ylabel(KINDS[kind] + (", %" if scale == 100 else ""))
    axes.set_xlabel(path["across"].label)
    figure.axes[0].legend(loc="lower center", bbox_to_anchor=(0.5, 1), ncol=3, fontsize=7, columnspacing=1)
    return svg(figure, f"Discrepancy of the law over strain on {path['name']}: estimate with its band, and the "
               "residuals.")


def corner(calibration):
    """The posterior: a histogram of each parameter with its prior, draws of each pair, and their correlation."""
    entries, n = calibration.parameters, len(calibration.parameters)
    scales = [np.log10 if p["coordinate"] in ("logarithm", "above_least") else numbers for p in entries]
    draws = [scale(p["draws"]) for scale, p in zip(scales, entries)]
    ends = [scale([p["low"], p["start"], p["high"]]) for scale, p in zip(scales, entries)]
    size = 1.45 * n + 1.2
    figure = Figure(figsize=(size, size))
    grid = figure.subplots(n, n, squeeze=False)
    figure.subplots_adjust(left=1.05 / size, bottom=0.8 / size, right=0.99, top=0.99, wspace=0.08, hspace=0.08)
    for i, j in np.ndindex(n, n):
        axes = grid[i, j]
        low, start, high = ends[j]
        if i == j:
            at = np.linspace(low, high, 100)
            axes.hist(draws[j], bins=np.linspace(low, high, 41), density=True, color=CONTINUUM, alpha=0.6)
            prior = np.exp(-0.5 * ((at - start) / (0.25 * (high - low))) ** 2)
            axes.plot(at, prior / trapezoid(prior, at), color=FAINT, linewidth=1)
        elif i > j:
            axes.plot(draws[j], draws[i], ".", color=CONTINUUM, markersize=1.6, alpha=0.6)
            axes.set_ylim(ends[i][0], ends[i][2])
        else:
            axes.text(0.5, 0.5, signed(f"{np.corrcoef(draws[i], draws[j])[0, 1]:.1f}"), ha="center", va="center",
                      transform=axes.transAxes)
        axes.set(xlim=(low, high), xticks=[], yticks=[])
        for edge in ("top", "right") if i >= j else ("top", "right", "left", "bottom"):
            axes.spines[edge].set_visible(False)
        for axis, k, shown in ((axes.xaxis, j, i == n - 1), (axes.yaxis, i, j == 0 and i > 0)):
            if shown:
                name = re.sub(" (?=angle|length|modulus|strain)", "\n", label(entries[k]).replace("_", " "))
                kind = SHORT.get(entries[k]["coordinate"], "")
                axis.set_label_text(name + kind)
                axis.set_ticks([ends[k][0], ends[k][2]], [f"{entries[k][end]:g}" for end in ("low", "high")])
                for text, side in zip(axis.get_ticklabels(),
                                      (("left", "right"), ("bottom", "top"))[axis is axes.yaxis]):
                    text.set(**{"verticalalignment" if axis is axes.yaxis else "horizontalalignment": side})
    return svg(figure, "Posterior of the parameters: histograms with the prior, draws of every pair, correlations.")


def text(value, digits=4):
    """A number with some significant digits and without an exponent below a million."""
    return "–" if value is None or not np.isfinite(value) else signed(f"{float(f'{value:.{digits}g}'):g}")


def parameters(calibration):
    rows = []
    for p in calibration.parameters:
        ratio = COORDINATES[p["coordinate"]]
        number = text(p["number"], 3) if ratio else ""
        interval, left, is_known = "none", f"{100 * p['share_known']:.0f} %", "not identified"
        if p["is_identified"]:
            interval, is_known = f"{text(p['value_low'], 3)} … {text(p['value_high'], 3)}", "yes"
        if calibration.record["no_intervals"]:
            left = is_known = "none"
        of = p["of"] + ": " if p["of"] else ""
        rows.append([label(p), text(p["value"]), f"{ratio}{of}{number}" if ratio else "", interval,
                     f"{text(p['low'], 3)} … {text(p['high'], 3)}", left, is_known])
    return {"head": ["continuum/" if calibration.model == "continuum" else "", "value", "fitted as", "95 %", "bounds",
                     "deviation left", "identified"], "rows": rows}


def predictions(calibration):
    rows = []
    for path in calibration.paths:
        for one in path["predictions"]:
            difference = one["difference"]
            ends = ends_text(difference["low"], difference["high"], lambda end: text(end, 2))
            rows.append([f"{path['name']} ({one['use']})",
                         one["name"], *(text(one[of], 3) for of in ("data", "before", "after")),
                         text(difference["value"], 2) + ends, text(one["margin"], 2), one["verdict"]])
    return {"head": ["path", "", calibration.data, "before", "calibrated", "difference [95 %]", "margin", "verdict"],
            "rows": rows}


def misfits(calibration):
    """Root mean squares over the bins, before and after, and those from the standard deviation of the parameters."""
    rows = []
    for path in calibration.paths:
        for kind, words in KINDS.items():
            entries = _known(path, kind, "mean")
            if entries:
                rows.append([path["name"], "rms of " + words,
                             *(_rms(_column(entries, when) - _column(entries, "mean")) for when in ("before", "after")),
                             *(_rms(_column(entries, key))
                               for key in ("deviation_of_mean", "parameter_deviation", "half_step"))])
    return {"head": ["path", "", "before", "calibrated", "deviation of the means",
                     "from the deviation of the parameters", "change with half the step"],
            "rows": rows}


def _rms(values):
    return text(rms(values), 2)


def minima(calibration):
    found = calibration.record["minima"]
    rows = [["χ² of the data", *(text(m["chi2"], 3) for m in found)],
            ["χ² with prior", *(text(m["total"], 3) for m in found)], ["runs", *(str(m["runs"]) for m in found)],
            *([label(p), *(text(m["numbers"][k], 3) for m in found)] for k, p in enumerate(calibration.parameters))]
    return {"head": ["", *(f"start {k + 1}" + " (best)" * m["is_best"] for k, m in enumerate(found))], "rows": rows}


def cost(calibration):
    r = calibration.record
    rows = [["runs on the coarse mesh (search and emulator)", str(r["coarse_runs"])],
            ["runs on the fine mesh", str(r["fine_runs"])], ["runs for predictions", str(r["other_runs"])],
            ["CPU time of the continuum, s", text(calibration.cost["continuum_cpu_s"], 3)]]
    if calibration.model == "grains":
        rows = [["points of search and emulator, each with all seeds", str(r["coarse_runs"])],
                ["points of the comparison", str(r["other_runs"])]]
    rows += [["CPU time of the grains, s", text(calibration.cost["grains_cpu_s"], 3)],
             ["CPU time of the command with its workers, s", text(calibration.cost["total_cpu_s"], 3)]]
    return {"head": ["", ""], "rows": rows}
