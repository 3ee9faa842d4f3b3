# diptych: report.html of grains and of the law's point along one path
# SPDX-License-Identifier: LGPL-2.1-or-later

from diptych_report.charts import element as figures
from diptych_report.charts import style
from diptych_report.data.element import load
from diptych_report.page.writing import template, write
from diptych_report.tables import element as tables


def draw(folder):
    """Raises InputError if a file is missing, broken or has another format."""
    style.set_up()
    element = load(folder)
    write(folder, template("element.html").render(record=element.record, charts=figures.figures(element),
                                                  numbers=tables.numbers(element.record), rms=tables.rms(element.record)))
