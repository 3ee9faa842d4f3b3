# diptych: report.html of a study
# SPDX-License-Identifier: LGPL-2.1-or-later

import numpy as np

from ..charts import study as figures
from ..data.study import CLASSES, load
from . import effects_page, sensitivity_page
from .writing import template, write
from ..tables import study as tables

CURVE_NAMES = {"stress_ratio": "stress ratio t/s", "volumetric_strain": "volumetric strain"}
PANEL_WORDS = {"discrete": "grains", "continuum": "continuum", "material_point": "material point"}


def draw(folder):
    study = load(folder)
    names = [f"{PANEL_WORDS[panel]}, {words}" for panel in study.curves for words in CURVE_NAMES.values()]
    if "sensitivity" in study.record:
        write(folder, sensitivity_page.page(study))
    else:
        write(folder, page(study, names) if study.has_reference else effects_page.page(study, curves(study), names))


def page(study, curve_names):
    charts = [(figures.error_against_cost(study, k, reference),
               ", ".join([q["name"], *study.points[reference]["labels"]]))
              for reference in study.references for k, q in enumerate(study.quantities)]
    judged = any(q["limit"] for q in study.quantities)  # else no point is right or wrong
    maps = [(family["name"], figures.class_maps(study, family))
            for family in study.record["families"]] if judged else []
    return template("study.html").render(
        record=study.record, judged=judged, n_points=len(study.points) - len(study.references),
        counts=tables.counts(study), cheapest=tables.cheapest(study), disturbed=tables.disturbed(study),
        charts=[chart for chart in charts if chart[0]], missing=[name for picture, name in charts if not picture],
        maps=[one for one in maps if one[1]], classes=CLASSES, orders=tables.orders(study), points=tables.points(study),
        curves=curves(study), curve_names=curve_names, provenance=tables.provenance(study))


def curves(study):
    """Progress and rows of every curve for the script of the page, with five digits; None: no value."""
    def row(values):
        return [None if not np.isfinite(v) else float(f"{v:.5g}") for v in values]
    return [{"title": f"{PANEL_WORDS[panel]}, {CURVE_NAMES[name]}", "progress": row(progress),
             "rows": [row(r) for r in rows[name]]}
            for panel, (progress, rows) in study.curves.items() for name in CURVE_NAMES]
