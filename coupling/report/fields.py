# diptych: pairs of maps, grains left and continuum right, on one colour scale
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A new quantity is one entry of STRAIN, STRAIN_ON_CELLS or STRESS: how it is read, drawn and labelled."""

from dataclasses import dataclass
from typing import Callable

import matplotlib
import numpy as np

import maps
from style import DIFFUSE, PANEL_NAMES, png


@dataclass(frozen=True)
class Quantity:
    """values(arrays, panel): one number a grain or a cell, or None if not stored. discs: the grains' map shows grains.

    from_zero: the scale starts at 0. per_strain: an increment, whose limits grow with the axial strain it spans.
    """

    name: str
    label: str
    colour_map: str
    values: Callable
    discs: bool
    from_zero: bool
    per_strain: bool


@dataclass(frozen=True)
class Pair:
    """Left and right picture of one instant; a picture is None where its data are not stored."""

    left: object
    right: object
    caption: str = ""
    extra: object = None


def _strain(arrays, panel):
    name = "discrete/shear_strain_increment" if panel == "discrete" else "cells/continuum_shear_strain_increment"
    return _in_percent(arrays.get(name))


def _strain_on_cells(arrays, panel):
    return _in_percent(arrays.get(f"cells/{panel}_shear_strain_increment"))


def _in_percent(values):
    return None if values is None else 100 * np.asarray(values, dtype=float)


def _mean_and_deviator(arrays, panel):
    """s = (s1 + s2)/2 and t = (s1 - s2)/2 of the symmetric part of the stress, positive in compression [P]."""
    stress = arrays.get(f"cells/{panel}_stress")
    if stress is None:
        return None, None
    xx, yy, xy = stress[:, 0, 0], stress[:, 1, 1], (stress[:, 0, 1] + stress[:, 1, 0]) / 2
    return (xx + yy) / 2, np.hypot((xx - yy) / 2, xy)


def _mean_stress(arrays, panel):
    return _mean_and_deviator(arrays, panel)[0]


def _stress_ratio(arrays, panel):
    s, t = _mean_and_deviator(arrays, panel)
    # A cell in tension has no mobilised friction angle: it carries no value.
    return None if s is None else np.divide(t, s, out=np.full_like(s, np.nan), where=s > 0)


STRAIN_LABEL = "shear strain increment ε₁ − ε₂  (%)"
STRAIN = Quantity("shear strain increment", STRAIN_LABEL, "viridis", _strain,
                  discs=True, from_zero=True, per_strain=True)
STRAIN_ON_CELLS = Quantity("shear strain increment on the mesh's cells", STRAIN_LABEL, "viridis", _strain_on_cells,
                           discs=False, from_zero=True, per_strain=True)
STRESS = (Quantity("mean stress s", "mean stress s = (σ₁ + σ₂)/2  (P)", "cividis", _mean_stress,
                   discs=False, from_zero=False, per_strain=False),
          Quantity("stress ratio t/s", "stress ratio t/s = (σ₁ − σ₂)/(σ₁ + σ₂)", "magma", _stress_ratio,
                   discs=False, from_zero=True, per_strain=False))


def limits(quantity, increments):
    """Function increment -> (low, high): one rule for both panels and for every instant of a series.

    Limits are medians over the increments of 2nd and 98th percentiles, so that one instant does not set the scale of
    all. A strain increment is scaled by the axial strain it spans, and of the two panels' percentiles the lower counts:
    a band one element thick saturates, which the bar's arrow says, instead of hiding the wider band of the grains.
    """
    lows, highs = [], []
    for increment in increments:
        sets = [quantity.values(increment.arrays, panel) for panel in PANEL_NAMES]
        sets = [values[np.isfinite(values)] / _scale(quantity, increment) for values in sets if values is not None]
        sets = [values for values in sets if len(values)]
        if sets:
            # One percentile a panel, so that each weighs the same whatever its number of grains or cells.
            join = np.min if quantity.per_strain else np.mean
            lows.append(join([np.percentile(values, 2) for values in sets]))
            highs.append(join([np.percentile(values, 98) for values in sets]))
    if not highs:
        return lambda increment: (0.0, 1.0)
    low = 0.0 if quantity.from_zero else float(np.median(lows))
    high = float(np.median(highs))
    if not high > low:
        high = low + 1.0
    return lambda increment: (_round(low * _scale(quantity, increment)), _round(high * _scale(quantity, increment)))


def _scale(quantity, increment):
    return max(increment.end - increment.start, 1e-12) if quantity.per_strain else 1.0


def _round(value):
    return float(f"{value:.2g}")


def pair(quantity, increment, box, limits_of):
    """Both panels of one increment; bands drawn in each."""
    pictures = [_panel(quantity, increment, box, limits_of(increment), panel) for panel in PANEL_NAMES]
    return Pair(*pictures, caption=f"{quantity.name[0].upper()}{quantity.name[1:]}, {increment.title}.")


def _panel(quantity, increment, box, colour_limits, panel):
    values = quantity.values(increment.arrays, panel)
    if values is None or box is None:
        return None
    arrays, colour_map = increment.arrays, matplotlib.colormaps[quantity.colour_map]
    bands = increment.bands(panel)
    figure, axes, bar = maps.map_axes(box, PANEL_NAMES[panel], bar=True)
    if not bands and increment.panel(panel).get("bands") is not None:
        axes.set_title(DIFFUSE, loc="right")
    if quantity.discs and panel == "discrete":
        drawn = maps.draw_discs(axes, arrays["discrete/position"], arrays["discrete/radius"], values, colour_map,
                                colour_limits)
        what = f"{len(values)} grains as discs"
    else:
        drawn = maps.draw_cells(axes, arrays["cells/corners"], values, colour_map, colour_limits)
        what = f"{len(values)} mesh cells"
    maps.draw_bands(axes, bands, increment.centre)
    maps.draw_colour_bar(figure, bar, drawn, quantity.label)
    text = "; ".join(f"band at {maps.plain(band['angle_deg']):.0f} degrees" for band in bands) or "no band detected"
    alt = f"{PANEL_NAMES[panel]}: {quantity.name}, {increment.title}, {what}; {text}."
    return png(figure, alt, drawn.get_clim())
