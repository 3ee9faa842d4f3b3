# diptych: report.html of grains and of the law's point along one path
# SPDX-License-Identifier: LGPL-2.1-or-later

from ..charts import element as figures
from ..data.element import load
from .writing import template, write
from ..tables import element as tables


def draw(folder):
    element = load(folder)
    write(folder, template("element.html").render(record=element.record, charts=figures.figures(element),
                                                  numbers=tables.numbers(element.record),
                                                  rms=tables.rms(element.record)))
