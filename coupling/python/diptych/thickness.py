# diptych: the thickness of a band by several conventions
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Authors measure the thickness of a shear band in different ways. For u = (jump / 2) tanh(x / delta), the shape of
find_bands(), each convention is a multiple of delta. Here it is taken from the measured profile itself."""

import math
from typing import Any

import numpy as np
from scipy.optimize import least_squares
from scipy.special import erf

from .arrays import Array, Band

THRESHOLD = 0.2  # of the largest strain above the background
# key -> (title, definition, thickness of a tanh profile over delta)
CONVENTIONS: dict[str, tuple[str, str, float]] = {
    "width_10_90": ("10–90 %", "of the jump between 10 and 90 % of the fitted tanh profile", math.log(9)),
    "half_height": ("half height", "strain above half of its largest value; the background is taken off",
                    2 * math.acosh(2**0.5)),
    "threshold": ("threshold", f"strain above {100 * THRESHOLD:g} % of its largest value; the background is taken off",
                  2 * math.acosh(THRESHOLD**-0.5)),
    "tangent": ("tangent", "jump over largest strain: the tangent in the middle meets both sides", 2.0),
    "error_function": ("error function", "four standard deviations of the fitted error function: 95 % of its jump",
                       3.337)}  # fitted over two 10-90 % widths to both sides


def across(points: Array, displacement: Array, band: Band, breadth: float) -> tuple[Array, Array, float]:
    """The profile of a band over twice its 10-90 % width to both sides, and its jump [length]: distances from its
    middle (m) and mean displacements along it (m), in bins of `breadth` [length]. The linear part of the displacement
    is taken off, and bins without a point are left out."""
    along = displacement @ np.array([np.cos(angle := np.radians(band.angle_deg)), np.sin(angle)])
    away = points - band.centre
    x = away @ band.normal - band.offset
    shape = np.column_stack([np.tanh(x / band.half_width), away, np.ones(len(x))])
    fitted = np.linalg.lstsq(shape, along, rcond=None)[0]
    u = along - shape[:, 1:] @ fitted[1:]
    n = math.ceil(2 * band.width_10_90 / breadth)
    edges = breadth * np.arange(-n, n + 1)
    count, total, place = (np.histogram(x, edges, weights=w)[0] for w in (np.ones(len(x)), u, x))
    full = count > 0
    return place[full] / count[full], total[full] / count[full], 2 * abs(float(fitted[0]))


def _breadth(x: Array, strain: Array, share: float) -> float:
    """Length of the part around the largest strain that is above a share of it; NaN if it reaches an end."""
    level, top = share * strain.max(), int(strain.argmax())

    def end(places: Array, strains: Array) -> float:  # from the largest strain outwards
        for k in np.flatnonzero(strains < level)[:1]:
            return float(np.interp(level, strains[[k, k - 1]], places[[k, k - 1]]))
        return math.nan

    return end(x[top:], strain[top:]) - end(x[top::-1], strain[top::-1])


def thicknesses(points: Array, displacement: Array, band: Band, breadth: float) -> dict[str, Any]:
    """The thickness of a band by every convention [length]; NaN where the profile does not give it. breadth: of the
    bins, about the spacing of the points [length]."""
    x, u, jump = across(points, displacement, band, breadth)
    found = dict.fromkeys(CONVENTIONS, math.nan) | {"width_10_90": band.width_10_90}
    if len(x) < 8:
        return found
    strain, middle = abs(np.diff(u) / np.diff(x)), 0.5 * (x[1:] + x[:-1])
    # half jump, place, standard deviation, level
    fitted = least_squares(lambda p: p[3] + p[0] * erf((x - p[1]) / (math.sqrt(2) * p[2])) - u,
                           (0.5 * (u[-1] - u[0]), 0, 0.4 * band.width_10_90, 0))
    return found | {"half_height": _breadth(middle, strain, 0.5), "threshold": _breadth(middle, strain, THRESHOLD),
                    "tangent": jump / float(strain.max()),
                    "error_function": 4 * abs(float(fitted.x[2])) if fitted.success else math.nan}
