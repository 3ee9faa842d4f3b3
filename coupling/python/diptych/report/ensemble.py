# diptych: report.html of an ensemble of seeds
# SPDX-License-Identifier: LGPL-2.1-or-later

import os
import textwrap
from dataclasses import dataclass, field

import numpy as np
from matplotlib.figure import Figure

from ..files import member_folders, read_ensemble, read_json, read_provenance, stage_name, window_name
from .charts import by_matplotlib, profiles
from .charts.by_matplotlib import ruled, styled
from .charts.style import FAINT, INK, PANEL_COLOURS, PANEL_LINES, PANEL_MARKS, chart, svg
from .data.files import open_arrays, read_text, scene_value
from .data.numbers import Descriptions, LoadingVariable, loading_variable_of
from .data.panels import PANEL_NAMES
from .page.writing import write
from .tables import ensemble as tables
from .tables import summary

VERDICT_MARKS = {"equivalent": "o", "different": "s", "cannot tell": "D"}
BAND = 0.25  # opacity


@styled()
def draw(folder):
    results = load(folder)
    rows = tables.verdict_rows(results)
    labelled = [(row["text"], verdict) for row, verdict in zip(rows, results.record["verdicts"])]
    marks = [(dots(verdict, tables.panel_quantities(results, verdict), label, scale), caption)
            for verdict, label, scale, caption in tables.captions(results)]
    thin = tables.curve_caption(results)
    lines = [(_curve(results, "stress_ratio", "stress ratio t/s"), "Stress ratio of the whole sample." + thin),
             (_curve(results, "volumetric_strain", "volumetric strain (%)", 100),
              "Volumetric strain 1 − V/V₀; dilation is negative." + thin)]
    across = profiles.of_means(results.profile, "means over the samples") if results.profile else None
    write(folder, "ensemble.html", record=results.record, first=summary.first(results.record), verdicts=rows,
          validation=tables.validation_table(results), measured=tables.measured_table(results),
          differences=differences(labelled), dots=marks, curves=lines,
          across=across, bands=tables.band_table(results), members=tables.members(results),
          quantities=tables.quantity_table(results), provenance=tables.provenance(results),
          checks=tables.checks(results.record), regularised=_regularised(results.profile),
          fitted=scene_value(read_text(os.path.join(folder, "ensemble.prm")), "comparison", "parameters_from"))


@dataclass(kw_only=True)
class Ensemble:
    """quantities: by name. numbers: those of a member's comparison. places: windows and stages by name, such as
    {"window 0.01-0.02": ("window", "1–2 %")}. averaging: width of the running means; None: not stored.

    curves: {"discrete/stress_ratio": {"members": (m, n), "mean": (n), "low": (n), "high": (n)}} over progress (n); {}
    if absent. profile: {panel: {"distance": (k), name: (k, 3) mean, low, high}} of the last window in which both panels
    have one; {} without such a window.
    """

    folder: str
    record: dict
    quantities: dict
    numbers: Descriptions
    places: dict
    loading_variable: LoadingVariable
    provenance: dict
    progress: np.ndarray = None
    averaging: float = None
    curves: dict = field(default_factory=dict)
    profile: dict = field(default_factory=dict)


def load(folder):
    """The ensemble of a folder. Raises InputError if ensemble.json is missing, broken or has another format."""
    record = read_ensemble(folder, 1)
    arrays, provenance = (os.path.join(folder, name) for name in ("ensemble.h5", "provenance.json"))
    members = (os.path.join(folder, member, "comparison.json")
               for seed, member in member_folders(record).items() if seed in record["done"])
    member = next((read_json(path) for path in members if os.path.isfile(path)), {})
    across = loading_variable_of(record.get("walk", member.get("walk")))
    results = Ensemble(folder=folder, record=record, quantities={q["name"]: q for q in record["quantities"]},
                       numbers=Descriptions(member.get("numbers")), places=_places(member, across),
                       loading_variable=across,
                       provenance=read_provenance(provenance) if os.path.isfile(provenance) else {})
    if os.path.isfile(arrays):
        with open_arrays(arrays) as file:
            results.progress, results.averaging = file["progress"][()], file.attrs.get("averaging_width")
            results.curves = {f"{panel}/{name}": {key: item[()] for key, item in group.items()}
                              for panel in PANEL_NAMES for name, group in file.get(panel, {}).items()}
            results.profile = _profile(file, member)
    return results


def _regularised(profile):
    """The sentence on the couple stresses of the mean profiles, or ""."""
    curves = [profile[panel]["couple_stress"][:, 0] for panel in PANEL_NAMES] if profile else [np.empty(0)]
    known = all(np.isfinite(curve).any() for curve in curves)
    return profiles.regularisation([float(np.nanmax(np.abs(curve))) for curve in curves]) if known else ""


def _places(member, across):
    """member: a comparison.json, {} without one."""
    windows = {}
    for one in member.get("windows", []):
        words = f"{across.number(one['from'])}–{across.span(one['to'])}"
        windows[window_name(one["from"], one["to"])] = ("window", words)
    return windows | {stage_name(one["progress"]): ("stage", across.span(one["progress"]))
                      for one in member.get("stages", [])}


def _profile(file, member):
    both = [groups for k, _ in enumerate(member.get("windows", []))
            if len(groups := file.get(f"window_{k}/profile", ())) == len(PANEL_NAMES)]
    found = {panel: {name: item[()] if name == "distance"
                     else np.column_stack([item[key][()] for key in ("mean", "low", "high")])
                     for name, item in group.items()} for panel, group in (both[-1].items() if both else ())}
    for of_panel in found.values():
        of_panel["couple_stress"] /= member["pressure"] * member["mean_diameter"]
    return found


def differences(rows):
    """Each difference over its margin, with both intervals. rows: [(label, verdict record)]. None without
    differences."""
    rows = [(label, v) for label, v in rows if v["difference"]["value"] is not None]
    if not rows:
        return None
    height = 0.75 + 0.4 * len(rows)
    figure = Figure(figsize=(5.4, height))
    axes = figure.add_axes([0.38, 0.5 / height, 0.6, 1 - 0.6 / height])
    axes.axvspan(-1, 1, color="#e3eef5", linewidth=0)
    axes.axvline(0, color=FAINT, linewidth=0.8)
    for k, (_, verdict) in enumerate(rows):
        scale = 1 / verdict["margin"]
        for key, width in (("difference", 1.2), ("difference_90", 4.0)):
            ends = [verdict[key]["low"], verdict[key]["high"]]
            if None not in ends:
                axes.plot([scale * x for x in ends], [k, k], color=INK, linewidth=width, solid_capstyle="butt")
        filled = verdict["verdict"] != "cannot tell"
        axes.plot(scale * verdict["difference"]["value"], k, VERDICT_MARKS[verdict["verdict"]], color=INK,
                  markersize=6.5, markerfacecolor=INK if filled else "white", markeredgewidth=1.2)
    axes.set(yticks=range(len(rows)), yticklabels=[textwrap.fill(label, 28) for label, _ in rows],
             ylim=(len(rows) - 0.4, -0.6), xlabel="(continuum − grains) / margin")
    axes.set_xlim(*_limits(rows))
    axes.tick_params(axis="y", length=0)
    return by_matplotlib.svg(figure,
               "Difference of the panels in units of its margin, with 90 % and 95 % intervals, one row per quantity: "
               + "; ".join(f"{label}: {verdict['verdict']}" for label, verdict in rows) + ".")


def _limits(rows):
    """Symmetric limits that include every value. An interval far wider than the others may be cut."""
    ends = [abs(v["difference"][key]) / v["margin"] for _, v in rows for key in ("low", "high")
            if v["difference"][key] is not None]
    values = [abs(v["difference"]["value"]) / v["margin"] for _, v in rows]
    reach = max(1.5, 1.15 * max(values), min(1.1 * max(ends, default=0), 4 * float(np.median(ends)) if ends else 0))
    return -reach, reach


def dots(verdict, quantities, label, scale=1.0):
    """Every seed in both panels, pairs joined by lines, with mean and 95 % interval. None without values."""
    panels = list(PANEL_NAMES)
    values = {panel: np.array(verdict[panel], dtype=float) for panel in panels}
    if not any(np.isfinite(v).any() for v in values.values()):
        return None
    figure = Figure(figsize=(3.4, 2.9))
    axes = figure.add_axes([0.25, 0.11, 0.73, 0.84])
    pairs = np.column_stack([values[panel] for panel in panels]) * scale
    axes.plot([0, 1], pairs.T, color=FAINT, linewidth=0.6, alpha=0.7, zorder=1)
    for k, panel in enumerate(panels):
        colour, side = PANEL_COLOURS[panel], -0.2 if k == 0 else 0.2
        known = pairs[np.isfinite(pairs[:, k]), k]
        axes.plot(np.full(len(known), k), known, PANEL_MARKS[panel], color=colour, markersize=5, alpha=0.75,
                  markeredgewidth=0, zorder=2)
        mean = quantities[panel]
        if mean is None or mean["mean"] is None:
            continue
        if mean["low"] is not None:
            axes.plot([k + side] * 2, [scale * mean["low"], scale * mean["high"]], color=colour, linewidth=2, zorder=3)
        axes.plot(k + side, scale * mean["mean"], "_", color=colour, markersize=13, markeredgewidth=2, zorder=3)
    axes.set(xlim=(-0.5, 1.5), xticks=[0, 1], xticklabels=[PANEL_NAMES[panel] for panel in panels],
             ylabel=textwrap.fill(label, 32))
    ruled(axes)
    axes.grid(False, axis="x")
    return by_matplotlib.svg(figure, f"{label}: every seed in both panels, pairs joined, with the mean and its 95 % "
                             "interval.")


def _curve(results, name, label, scale=1.0):
    """Running mean of every seed, their mean and its 95 % interval, both panels. None if nothing is stored."""
    figure, axes = chart(results, label)
    for panel, colour in PANEL_COLOURS.items():
        curve = results.curves.get(f"{panel}/{name}")
        if curve is None or not np.size(curve["members"]):
            continue
        across, members = results.loading_variable.factor * results.progress, curve["members"][:tables.MOST_CURVES]
        for member in members:
            axes.plot(across, scale * member, color=colour, linewidth=0.5, alpha=min(0.5, 8 / len(members)))
        axes.fill_between(across, scale * curve["low"], scale * curve["high"], color=colour, alpha=BAND)
        axes.plot(across, scale * curve["mean"], color=colour, linewidth=1.8, linestyle=PANEL_LINES[panel],
                  label=PANEL_NAMES[panel])
    if axes.is_empty:
        return None
    axes.set(xlim=(0, None), ylim=(0 if name == "stress_ratio" else None, None))
    axes.legend()
    return svg(figure, f"{label} of every seed, their mean and its 95 % interval, both panels.")
