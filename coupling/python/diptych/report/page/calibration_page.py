# diptych: report.html of a calibration
# SPDX-License-Identifier: LGPL-2.1-or-later

from ..charts import calibration as figures
from ..data.calibration import load
from .writing import template, write
from ..tables import calibration as tables


def draw(folder):
    write(folder, page(load(folder)))


def page(calibration):
    paths = []
    for path in calibration.paths:
        shown = [figures.curve(path, kind, calibration.model) for kind in figures.CURVES
                 if any(o["kind"] == kind for o in path["observables"])]
        paths.append((path, shown + [figures.residuals(path)]
                      + ([figures.discrepancy(path)] if path["use"] == "fit" else [])))
    return template("calibration.html").render(
        record=calibration.record, data=calibration.data, paths=paths, parameters=tables.parameters(calibration),
        predictions=tables.predictions(calibration), misfits=tables.misfits(calibration),
        minima=tables.minima(calibration), cost=tables.cost(calibration), corner=figures.corner(calibration))
