# diptych: the data of the maps as one JSON object
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The browser draws the maps (draw.js). So a map of 4000 grains takes 8 kB per quantity and is sharp on screens and on
paper."""

import matplotlib
import matplotlib.colors
import numpy as np

from ..charts.style import NO_VALUE, PANEL_COLOURS
from ..data.numbers import plain
from ..data.panels import PANEL_NAMES
from . import glyphs
from .glyphs import Store, short
from .quantities import PLACES, QUANTITIES, box, corners, limits


def data(result):
    """The object. Its "arrays" are entries of a Store; the rest refers to them by index."""
    drawn, store = result.increments, Store()
    rules = {(q.key, place): limits(q, place, drawn, result) for q in QUANTITIES for place in PLACES}
    places = {q.key: [place for place in PLACES if rules[q.key, place]] for q in QUANTITIES}
    used = [q for q in QUANTITIES if places[q.key]]
    increments = [{**_frame(i, store), "values": {q.key: _values(q, i, result, rules, store) for q in used},
                   "arrows": glyphs.arrows(i, store), "crosses": glyphs.crosses(i, store),
                   "forces": glyphs.forces(i, store), "probes": glyphs.probes(i)} for i in drawn]
    return {"box": short(box(drawn)), "panels": PANEL_NAMES, "colours": PANEL_COLOURS, "no_value": NO_VALUE,
            "maps": {name: _table(name) for name in sorted({q.colour_map for q in used} | {"RdBu_r"})},
            "quantities": [_quantity(q, places[q.key], result) for q in used],
            "cross_unit": glyphs.cross_unit(drawn), "force_unit": glyphs.force_unit(drawn),
            "increments": increments, "arrays": store.entries}


def _quantity(quantity, places, result):
    return {"key": quantity.key, "group": quantity.group, "title": quantity.full_title(result),
            "label": quantity.label(result), "map": quantity.colour_map,
            "home": quantity.home if quantity.home in places else places[0], "places": places,
            "meaning": {place: quantity.meaning(result, place) for place in places}}


def _table(name):
    return [matplotlib.colors.to_hex(colour) for colour in matplotlib.colormaps[name](np.arange(256))]


def _frame(increment, store):
    """Places of grains, cells, outline and bands."""
    position, state = increment.arrays["discrete/position"], increment.state
    return {"key": increment.key, "kind": increment.kind, "label": increment.label, "title": increment.title,
            "end": f"{increment.end:.9g}",
            "discs": {"x": store.add(position[:, 0]), "y": store.add(position[:, 1]),
                      "r": store.add(increment.arrays["discrete/radius"])},
            "cells": store.add(corners(increment, "cells")), "grid": store.add(corners(increment, "grid")),
            "centre": short(increment.centre),
            "outline": [short(state[side]) for side in ("outline/left", "outline/right") if len(state.get(side, ()))],
            "bands": {panel: [[short(plain(band.get(key)))
                               for key in ("angle_deg", "offset_d", "width_10_90_d", "jump")]
                              for band in increment.bands(panel)] for panel in PANEL_NAMES}}


def _values(quantity, increment, result, rules, store):
    """place -> {"limits", "discrete", "continuum"}, for the places where at least one panel has numbers."""
    found = {}
    for place in PLACES:
        if not rules[quantity.key, place]:
            continue
        values = {panel: quantity.values(increment, result, place, panel) for panel in PANEL_NAMES}
        if any(v is not None for v in values.values()):
            found[place] = {"limits": rules[quantity.key, place](increment),
                            **{panel: store.add(v) for panel, v in values.items()}}
    return found
