# diptych: report.html of a calibration
# SPDX-License-Identifier: LGPL-2.1-or-later

from ..charts import calibration as figures
from ..charts import style
from ..data.calibration import load
from .writing import template, write
from ..tables import calibration as tables


def draw(folder):
    """Raises InputError if a file is missing, broken or has another format."""
    calibration = load(folder)
    style.set_up()
    write(folder, page(calibration))


def page(calibration):
    paths = []
    for path in calibration.paths:
        shown = [figures.curve(path, kind, calibration.model) for kind in figures.CURVES if any(o["kind"] == kind for o in path["observables"])]
        paths.append((path, shown + [figures.residuals(path)] + ([figures.discrepancy(path)] if path["use"] == "fit" else [])))
    return template("calibration.html").render(
        record=calibration.record, data=calibration.data, paths=paths, parameters=tables.parameters(calibration), predictions=tables.predictions(calibration),
        misfits=tables.misfits(calibration), minima=tables.minima(calibration), cost=tables.cost(calibration),
        corner=figures.corner(calibration))
