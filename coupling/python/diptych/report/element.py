# diptych: report.html of grains and of the law's point along one path
# SPDX-License-Identifier: LGPL-2.1-or-later

import os
from types import SimpleNamespace

import numpy as np

from ..files import read_json
from .charts.style import CONTINUUM, GRAINS, PANEL_LINES, THIRD, chart, limit_below, svg
from .data.files import read_csv
from .data.numbers import loading_variable_of
from .page.writing import write
from .tables.wording import ABSENT, rounded, suffix

# quantity -> factor, label, caption
CHARTS = {
    "stress_ratio": (1.0, "stress ratio t/s", "Stress ratio t/s of the mean stress."),
    "volumetric_strain": (100.0, "volumetric strain (%)", "Volumetric strain 1 − V/V₀; dilation is negative."),
    "fabric_anisotropy": (1.0, "anisotropy a of the fabric",
                          "Anisotropy a of the contact normals, in the density 1 + a cos 2(θ − θ₀)."),
    "coordination": (1.0, "contacts per grain",
                     "Mean number of force-carrying contacts per grain, without grains that have none."),
    "mean_stress": (1.0, "mean stress s/P", "Mean stress s = (σ₁ + σ₂)/2 over the pressure P of the start."),
}
DIRECTIONS = (("grains_stress_direction", GRAINS, "o", "grains, σ₁"),
              ("grains_fabric_direction", THIRD, "^", "grains, contact normals"),
              ("law_stress_direction", CONTINUUM, "s", "law, σ₁"))
NAMES = {"stress_ratio": "t/s", "mean_stress": "mean stress s", "volumetric_strain": "volumetric strain",
         "stress_direction": "direction of σ₁", "fabric_anisotropy": "anisotropy of the fabric",
         "fabric_direction": "direction of the fabric",
         "coordination": "contacts per grain", "solid_fraction": "solid fraction",
         **{"s" + c: "σ " + c for c in ("xx", "yy", "xy")}, **{"e" + c: "ε " + c for c in ("xx", "yy", "xy")}}

NAMES |= {f"{when} {name}": f"{when} {words}" for when in ("peak", "last") for name, words in NAMES.items()}
# strain of a loop -> its label and factor, and 2 t with the sign of the stress that drives it
LOOPS = {"eyy": ("axial strain ε yy (%)", 100, lambda of: of("syy") - of("sxx")),
         "exy": ("shear strain 2 ε xy (%)", 200, lambda of: 2 * of("sxy"))}
PER_CENT = ("volumetric_strain", "last volumetric_strain")


def draw(folder):
    record = read_json(os.path.join(folder, "element.json"), 2)
    element = SimpleNamespace(record=record, curves=read_csv(os.path.join(folder, "element.csv")),
                              loading_variable=loading_variable_of(record["walk"]))
    charts = [*(_chart(element, name, *look) for name, look in CHARTS.items()), _directions(element), *_loops(element)]
    write(folder, "element.html", record=record, charts=charts, numbers=_numbers(record), rms=_rms(record))


def _chart(element, name, factor, label, caption):
    """Mean of the samples, its standard error (dark), one standard deviation of a sample (light), and the law."""
    figure, axes = chart(element, label)
    across, n = element.loading_variable.factor * element.curves["progress"], len(element.record["done"])
    mean, error = (factor * element.curves[f"grains_{name}{end}"] for end in ("", "_error"))
    for width, opacity in ((np.sqrt(n), 0.15), (1, 0.35)):
        axes.fill_between(across, mean - width * error, mean + width * error, color=GRAINS, alpha=opacity)
    axes.plot(across, mean, color=GRAINS, label=f"grains, {n} sample{'s' if n > 1 else ''}")
    law = element.curves.get(f"law_{name}")
    if law is not None:
        axes.plot(across, factor * law, color=CONTINUUM, linestyle=PANEL_LINES["continuum"], label="law")
    limit_below(axes, name == "volumetric_strain")
    axes.set(xlim=(0, None))
    axes.legend()
    return svg(figure, f"{label} along the path, grains and law."), caption


def _loops(element):
    """t/s with its sign, and volume, over the larger strain. Empty if the progress is that strain."""
    if element.record["walk"] != "path":
        return []
    grains, law = (lambda name, of=of: element.curves.get(f"{of}_{name}") for of in ("grains", "law"))
    name = max(LOOPS, key=lambda name: LOOPS[name][1] * np.nanmax(np.abs(grains(name))))
    (words, factor, driven), found = LOOPS[name], []
    for label, value in (("signed stress ratio t/s", lambda of: driven(of) / (of("sxx") + of("syy"))),
                         ("volumetric strain (%)", lambda of: 100 * of("volumetric_strain"))):
        figure, axes = chart(element, label)
        for of, look in ((grains, {"color": GRAINS, "label": "grains"}),
                         (law, {"color": CONTINUUM, "linestyle": PANEL_LINES["continuum"], "label": "law"})):
            if of(name) is not None:
                axes.plot(factor * of(name), value(of), **look)
        axes.axhline(0, linewidth=0.6)
        axes.set(xlabel=words)
        axes.legend()
        found.append((svg(figure, f"{label} over {words}, grains and law."),
                      f"{label[0].upper()}{label[1:].removesuffix(' (%)')} over {words.removesuffix(' (%)')}."))
    return found


def _directions(element):
    """Directions as points, from -30 to 150 degrees, so that vertical, horizontal and both diagonals lie inside."""
    figure, axes = chart(element, "direction (degrees)")
    for name, colour, mark, label in DIRECTIONS:
        if name in element.curves:
            axes.plot(element.loading_variable.factor * element.curves["progress"],
                      (element.curves[name] + 30) % 180 - 30, mark, color=colour, markersize=2.5, label=label)
    axes.set(xlim=(0, None), ylim=(-30, 150), yticks=range(-30, 151, 30))
    axes.legend()
    return (svg(figure, "Directions along the path, grains and law."),
            "Directions from the horizontal: of the larger principal stress, and of most contact normals. They mean "
            "nothing where t/s or the anisotropy vanish.")


def _rows(entries, keys):
    """One row per quantity. A dash stands for a number that the law does not have."""
    units = ["%" if one["quantity"] in PER_CENT else suffix(one["unit"]) for one in entries]
    return [[NAMES.get(one["quantity"], one["quantity"]),
             *(rounded(one[key], unit).replace(ABSENT, "–") for key in keys)] for one, unit in zip(entries, units)]


def _numbers(record):
    """Grains and difference with their 95 % intervals."""
    return {"head": ["quantity", ("grains", "[95 %]"), "law", ("law − grains", "[95 %]")],
            "rows": _rows(record["quantities"], ("grains", "law", "difference"))}


def _rms(record):
    """Rms of law − grains, its standard error, and the standard error of the grains."""
    return {"head": ["quantity", ("law − grains", "rms"), ("its standard error", "jackknife"),
                     ("standard error of the grains", "rms")],
            "rows": _rows(record["rms"], ("value", "error", "noise"))}
