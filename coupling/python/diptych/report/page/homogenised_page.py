# diptych: report.html of homogenised grains
# SPDX-License-Identifier: LGPL-2.1-or-later

import os

from ..charts import homogenised as figures
from ..charts import resolution
from ..data.homogenised import load
from .writing import template, write
from ..tables import homogenised as tables


def draw(folder):
    result = load(folder)
    write(folder, template("homogenised.html").render(
        record=result.record, name=os.path.basename(os.path.abspath(folder)), command=result.provenance["command"],
        walk=result.loading_variable, frames=tables.frames(result), increments=tables.increments(result),
        maps=figures.maps(result), curves=figures.curves(result),
        scan=resolution.figures(result.resolution_study, "s / mean of the sample")))
