# diptych: axes and colour limits that all maps of a page share
# SPDX-License-Identifier: LGPL-2.1-or-later

import numpy as np

from ..data.panels import PANEL_NAMES
from .quantities import PLACES

MARGIN = 2.0      # d, around the sample


def box(increments):
    """(x0, x1, y0, y1) [d] around all grains and cells of all increments, so that stepping does not move the axes."""
    low, high = [], []
    for arrays in (i.arrays for i in increments):
        position, radius = arrays["discrete/position"], arrays["discrete/radius"][:, None]
        corners = arrays["cells/corners"]
        low += [(position - radius).min(axis=0), corners.min(axis=(0, 1))]
        high += [(position + radius).max(axis=0), corners.max(axis=(0, 1))]
    (x0, y0), (x1, y1) = np.min(low, axis=0) - MARGIN, np.max(high, axis=0) + MARGIN
    return x0, x1, y0, y1


def limits(quantity, place, increments, result):
    """Function increment -> (low, high), the same rule for both panels and all instants; None: nothing is stored.

    Limits are medians over the increments of the 2nd and 98th percentiles, so that no single instant sets the scale,
    and means over the panels. A strain increment is scaled by its range of progress, and the lower percentile of the
    two panels counts. A band of one element then saturates, which the arrow of the bar shows, and does not hide the
    wider band of the grains.
    """
    if not _offered(quantity, place, increments, result):
        return None
    lows, highs = [], []
    for increment in increments:
        sets = [quantity.values(increment, result, place, panel) for panel in PANEL_NAMES]
        sets = [values[np.isfinite(values)] / _scale(quantity, increment) for values in sets if values is not None]
        sets = [np.abs(values) if quantity.signed else values for values in sets if len(values)]
        if sets:
            # One percentile per panel: both weigh the same for any number of grains or cells.
            join = np.min if quantity.per_progress and quantity.from_zero else np.mean
            lows.append(join([np.percentile(values, 2) for values in sets]))
            highs.append(join([np.percentile(values, 98) for values in sets]))
    if not highs:
        return None
    high = float(np.median(highs))
    low = -high if quantity.signed else 0.0 if quantity.from_zero else float(np.median(lows))
    if not high > low:
        high, low = low + 1.0, low - (1.0 if quantity.signed else 0.0)
    return lambda increment: tuple(_round(end * _scale(quantity, increment)) for end in (low, high))


def _offered(quantity, place, increments, result):
    """A quantity is shown at the places where the grains have it; if only the continuum has it, on its cells."""
    def has(panel, at):
        return any(quantity.values(i, result, at, panel) is not None for i in increments)
    if has("discrete", place):
        return True
    return place == "cells" and has("continuum", place) and not any(has("discrete", at) for at in PLACES)


def _scale(quantity, increment):
    return max(increment.end - increment.start, 1e-12) if quantity.per_progress else 1.0


def _round(value):
    return float(f"{value:.2g}")
