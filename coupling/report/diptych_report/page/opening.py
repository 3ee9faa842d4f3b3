# diptych: the instant at which a page opens
# SPDX-License-Identifier: LGPL-2.1-or-later

from diptych_report.charts import still
from diptych_report.charts.style import Pair
from diptych_report.data.panels import PANEL_NAMES
from diptych_report.page.limits import box, limits
from diptych_report.page.quantities import QUANTITIES


def end_of(increments):
    """Progress at which the page opens: the end of the last window, or of the last stage if there is no window."""
    windows = [i for i in increments if i.kind == "window"]
    return (windows or increments)[-1].end if increments else 0.0


def opens_at(increments, end):
    """The first increment that reaches `end`; windows come before stages. None without increments."""
    return next((i for i in increments if i.end >= end - 1e-9), increments[-1] if increments else None)


def still_pair(result):
    """Shear strain increment of the opening instant, for readers without JavaScript; None: nothing is stored."""
    drawn = [i for i in result.increments if i.arrays]
    quantity, frame, increment = QUANTITIES[0], box(drawn), opens_at(drawn, end_of(result.increments))
    rule = limits(quantity, "discs", drawn, result)
    if increment is None or frame is None or rule is None:
        return Pair(None, None)
    shown = [(panel, quantity.values(increment, result, "discs", panel)) for panel in PANEL_NAMES]
    return Pair(*[None if numbers is None else still.picture(
        still.StillMap(panel, quantity.label(result), quantity.colour_map, numbers, rule(increment), frame), increment)
        for panel, numbers in shown])
