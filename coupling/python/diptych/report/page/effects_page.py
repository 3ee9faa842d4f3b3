# diptych: report.html of a study without a reference
# SPDX-License-Identifier: LGPL-2.1-or-later

from ..charts import effects as figures
from .writing import template
from ..tables import effects as tables
from ..tables import study as study_tables

MOST_CURVES = 6  # ticked when the page opens


def page(study, curves, curve_names):
    """The text of the page. curves, curve_names: see study_page."""
    parts = [(family["name"], [_part(study, family, name, places) for name, places in _by_name(study).items()])
             for family in study.record["families"] if family["axes"]]
    n_samples = len(study.record["seeds"]) or 1
    return template("effects.html").render(
        record=study.record, n_samples=n_samples, changes=tables.changes(study), families=parts,
        disturbed=study_tables.disturbed(study), points=study_tables.points(study), n_ticked=MOST_CURVES, curves=curves,
        curve_names=curve_names, provenance=study_tables.provenance(study))


def _by_name(study):
    """{name: {panel: index of the quantity}}"""
    found = {}
    for k, quantity in enumerate(study.quantities):
        found.setdefault(quantity["name"], {})[quantity["source"]] = k
    return found


def _part(study, family, name, places):
    """Title, charts (panels, difference) and table of one quantity; charts without values are left out."""
    quantity = study.quantities[next(iter(places.values()))]
    label = tables.typeset(name) + tables.unit_of(quantity)
    panels = {panel: k for panel, k in places.items() if panel != "difference"}
    charts = [figures.over_parameter(study, family, panels, label)]
    if "difference" in places:
        charts.append(figures.over_parameter(study, family, {"difference": places["difference"]},
                                             "continuum − grains" + tables.unit_of(quantity)))
    return {"title": tables.typeset(name), "charts": [chart for chart in charts if chart],
            "means": tables.means(study, family, places)}
