# diptych: the quantities that the maps can show, with the axes and colour limits that all maps of a page share
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A new quantity is one entry of QUANTITIES with its datasets and colours. Titles, units and meanings come from the
datasets."""

from dataclasses import dataclass

import numpy as np

from ..data.panels import PANEL_NAMES
from ..tables.wording import suffix, typeset

# The grains are shown as discs, or as means on the cells of the mesh or of a regular grid. At the points of a
# measurement all panels are levelled.
PLACES = ("discs", "cells", "grid", "points")
BOTH = "{panel}_"                    # prefix of a dataset on cells that both panels may have
DEGREES = 180 / np.pi
MARGIN = 2.0                         # d, around the sample


@dataclass(frozen=True, kw_only=True)
class Quantity:
    """name: dataset of the grains, and with `prefix` that of the cells. continuum: dataset of the continuum, if it
    differs.

    component: (row, column) of a tensor. home: the place shown first. Limits: from_zero, or signed (symmetric about 0),
    or percentiles at both ends. per_progress: an increment, whose limits grow with its range of progress. of_state:
    only stages store it; a window shows the stage that ends with it. per_cent: shown times 100.
    """

    key: str
    group: str
    name: str
    continuum: str = ""
    prefix: str = BOTH
    component: tuple = ()
    title: str = ""
    colour_map: str = "viridis"
    home: str = "cells"
    from_zero: bool = False
    signed: bool = False
    per_progress: bool = False
    of_state: bool = False
    per_cent: bool = False
    grains_only: bool = False

    def path(self, place, panel):
        """Path of the dataset in the group of an increment."""
        if place == "discs" and panel == "discrete":
            return "discrete/" + self.name
        if place == "points" or panel == "measured":
            return f"points/{panel}_{self.name}"
        name = self.continuum or self.name if panel == "continuum" else self.name
        return f"{'grid' if place == 'grid' else 'cells'}/{self.prefix.format(panel=panel)}{name}"

    def values(self, increment, result, place, panel):
        """One number per grain or cell; None: not stored. With the place "discs" the continuum shows its cells."""
        if self.grains_only and panel == "continuum":
            return None
        path = self.path(place, panel)
        values = (increment.state if self.of_state else increment.arrays).get(path)
        if values is None or not np.isfinite(values).any():
            return None
        values = np.asarray(values, dtype=float)
        return self.factor(result) * (values[(slice(None), *self.component)] if self.component else values)

    def described(self, result):
        """Description of the first stored dataset, or None."""
        paths = [self.path(place, panel) for place in PLACES for panel in PANEL_NAMES]
        return next((result.arrays[path] for path in paths if path in result.arrays), None)

    def factor(self, result):
        found = self.described(result)
        return 100.0 if self.per_cent else DEGREES if found and found.unit == "rad" else 1.0

    def full_title(self, result):
        return self.title or getattr(self.described(result), "title", "") or self.key

    def label(self, result):
        """Title and unit for a colour bar."""
        found = self.described(result)
        unit = suffix(found.unit if found else "").strip()
        unit = "%" if self.per_cent else "degrees" if unit == "rad" else unit
        return self.full_title(result) + (f" ({unit})" if unit else "")

    def meaning(self, result, place):
        """Meaning of the datasets of a place: "grains: ...; continuum: ..."."""
        parts = []
        for panel, name in PANEL_NAMES.items():
            text = getattr(result.arrays.get(self.path(place, panel)), "meaning", "")
            if text and not (self.grains_only and panel == "continuum"):
                parts.append(text if text.startswith(name.lower()) else f"{name.lower()}: {text}")
        sentence = typeset("; ".join(parts))
        return sentence[:1].upper() + sentence[1:] + ("." if sentence else "")


def corners(increment, mesh):
    """(C, 4, 2) [d]: corners of the mesh of an increment, or of the stage that ends with it."""
    own = increment.arrays.get(mesh + "/corners")
    return increment.state.get(mesh + "/corners") if own is None else own


MOTION = {"group": "Motion"}
TURN = {"group": "Motion", "colour_map": "RdBu_r", "signed": True, "per_progress": True}
STRESS = {"group": "Stress", "colour_map": "cividis", "of_state": True}
GRAINS_ONLY = {"group": "Grains only", "of_state": True, "grains_only": True}
QUANTITIES = (
    Quantity(key="shear", name="shear_strain_increment", title="shear strain increment ε₁ − ε₂", home="discs",
             from_zero=True, per_progress=True, per_cent=True, **MOTION),
    Quantity(key="displacement", name="displacement_over_platen", home="discs", from_zero=True, **MOTION),
    # The continuum is quasi-static: relative to the platen, its velocity equals its displacement increment.
    Quantity(key="velocity", name="speed_over_platen", continuum="displacement_over_platen", home="discs",
             from_zero=True, of_state=True, **MOTION),
    Quantity(key="rotation", name="rotation_increment", **TURN),
    Quantity(key="spin", name="spin_increment", **TURN),
    Quantity(key="turn", name="relative_rotation", **TURN),
    Quantity(key="s", name="mean_stress", **STRESS),
    Quantity(key="t_over_s", name="stress_ratio", from_zero=True, **STRESS),
    Quantity(key="xx", name="stress", component=(0, 0), title="stress σ_xx", **STRESS),
    Quantity(key="yy", name="stress", component=(1, 1), title="stress σ_yy", **STRESS),
    Quantity(key="xy", name="stress", component=(0, 1), title="stress σ_xy", signed=True,
             **{**STRESS, "colour_map": "RdBu_r"}),
    Quantity(key="yx", name="stress", component=(1, 0), title="stress σ_yx", signed=True,
             **{**STRESS, "colour_map": "RdBu_r"}),
    Quantity(key="couple", name="couple_stress_size", from_zero=True, **STRESS),
    Quantity(key="dissipation", name="dissipation", from_zero=True, **{**STRESS, "colour_map": "viridis"}),
    Quantity(key="solid_fraction", name="solid_fraction", prefix="", **GRAINS_ONLY),
    Quantity(key="coordination", name="coordination_number", **GRAINS_ONLY),
    Quantity(key="temperature", name="granular_temperature", from_zero=True, **GRAINS_ONLY),
    Quantity(key="error", name="standard_error", from_zero=True, **GRAINS_ONLY),
)


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
    and means over the panels. A strain increment is scaled by its range of progress, and the percentile of the grains
    counts. A band of one element then saturates: the arrow of the bar shows it. The wider band of the grains stays
    visible. Without a band, the grains scatter about the strain of the continuum, and keep their colours.
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
            used = sets[:1] if quantity.per_progress and quantity.from_zero else sets
            low, high = np.mean([np.percentile(values, (2, 98)) for values in used], axis=0)
            lows.append(low)
            highs.append(high)
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
