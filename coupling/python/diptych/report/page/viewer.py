# diptych: the data of the maps as one JSON object: arrays, arrows, crosses, forces and probes
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The browser draws the maps (draw.js). So a map of 4000 grains takes 8 kB per quantity and is sharp on screens and on
paper. Glyphs are entries of a Store; {} or None: nothing is stored."""

import base64

import numpy as np

from ..charts import colour_maps
from ..charts.style import NO_VALUE, PANEL_COLOURS
from ..data.numbers import plain
from ..data.panels import PANE_NAMES, PANEL_NAMES
from .quantities import PLACES, QUANTITIES, box, corners, limits

SPACING = 2.5       # d, of the grid with one arrow per square, in both panels
MOST_DRAWN = 12000  # crosses or forces of one map; the weakest are left out
LARGEST = 65534     # code of the largest value of an array; 65535 is NaN
PRINCIPAL = ("major_stress", "minor_stress", "stress_direction")


def data(result):
    """The object. Its "arrays" are entries of a Store; the rest refers to them by index."""
    drawn, store = result.increments, Store()
    rules = {(q.key, place): limits(q, place, drawn, result) for q in QUANTITIES for place in PLACES}
    places = {q.key: [place for place in PLACES if rules[q.key, place]] for q in QUANTITIES}
    used = [q for q in QUANTITIES if places[q.key]]
    increments = [{**_frame(i, store), "values": {q.key: _values(q, i, result, rules, store) for q in used},
                   "arrows": arrows(i, store), "crosses": crosses(i, store),
                   "forces": forces(i, store), "probes": probes(i)} for i in drawn]
    return {"box": short(box(drawn)), "panels": PANE_NAMES if result.levelled else PANEL_NAMES,
            "colours": PANEL_COLOURS, "no_value": NO_VALUE,
            "maps": {name: colour_maps.table(name) for name in sorted({q.colour_map for q in used} | {"RdBu_r"})},
            "quantities": [_quantity(q, places[q.key], result) for q in used],
            "cross_unit": cross_unit(drawn), "force_unit": force_unit(drawn),
            "increments": increments, "arrays": store.entries}


def _quantity(quantity, places, result):
    return {"key": quantity.key, "group": quantity.group, "title": quantity.full_title(result),
            "label": quantity.label(result), "map": quantity.colour_map,
            "home": quantity.home if quantity.home in places else places[0], "places": places,
            "meaning": {place: quantity.meaning(result, place) for place in places}}


def _frame(increment, store):
    """Places of grains, cells, outline and bands."""
    state = increment.state
    return {"key": increment.key, "kind": increment.kind, "label": increment.label, "title": increment.title,
            "end": f"{increment.end:.9g}",
            "discs": _discs(increment, "discrete", store), "points": _discs(increment, "points", store),
            "cells": store.add(corners(increment, "cells")), "grid": store.add(corners(increment, "grid")),
            "centre": short(increment.centre),
            "outline": [short(state[side]) for side in ("outline/left", "outline/right") if len(state.get(side, ()))],
            # a diffuse zone has no angle, so the map draws no line
            "bands": {panel: [[None if key == "angle_deg" and band.get("diffuse") else short(plain(band.get(key)))
                               for key in ("angle_deg", "offset_d", "width_10_90_d", "jump")]
                              for band in increment.bands(panel)] for panel in PANE_NAMES}}


def _discs(increment, name, store):
    """Grains, or points of a measurement; None: nothing was measured."""
    position = increment.arrays.get(name + "/position")
    return None if position is None else {"x": store.add(position[:, 0]), "y": store.add(position[:, 1]),
                                          "r": store.add(increment.arrays[name + "/radius"])}


def _values(quantity, increment, result, rules, store):
    """place -> {"limits", "discrete", "continuum"}, for the places where at least one panel has numbers."""
    found = {}
    for place in PLACES:
        if not rules[quantity.key, place]:
            continue
        values = {panel: quantity.values(increment, result, place, panel) for panel in PANE_NAMES}
        if any(v is not None for v in values.values()):
            found[place] = {"limits": rules[quantity.key, place](increment),
                            **{panel: store.add(v) for panel, v in values.items()}}
    return found


class Store:
    """Arrays as {"low", "high", "data"}: value = low + code (high - low)/65534, codes of 16 bits, low byte first, in
    base64.

    Equal arrays share one entry, such as the positions of grains at the end of a window and of the stage that ends
    there.
    """

    def __init__(self):
        self.entries = []
        self._known = {}

    def add(self, values):
        """Index of the entry of an array of any shape, which is stored flat. None for None."""
        if values is None:
            return None
        values = np.asarray(values, dtype=float).ravel()
        finite = values[np.isfinite(values)]
        low, high = (float(finite.min()), float(finite.max())) if len(finite) else (0.0, 0.0)
        scale = LARGEST / (high - low) if high > low else 0.0
        codes = np.where(np.isfinite(values), np.rint((np.nan_to_num(values) - low) * scale), LARGEST + 1).astype("<u2")
        data = base64.b64encode(codes).decode("ascii")
        key = (low, high, data)
        if key not in self._known:
            self._known[key] = len(self.entries)
            self.entries.append({"low": low, "high": high, "data": data})
        return self._known[key]


def short(values):
    """Nested lists of numbers with five digits; None stays."""
    if isinstance(values, (list, tuple, np.ndarray)):
        return [short(value) for value in values]
    return None if values is None else float(f"{values:.5g}")


def thinned(position):
    """For each square of a regular grid, the index of the point nearest to its centre."""
    low = position.min(axis=0)
    column = np.floor((position - low) / SPACING).astype(int)
    distance = np.linalg.norm(position - (low + (column + 0.5) * SPACING), axis=1)
    order = np.lexsort((distance, column[:, 0], column[:, 1]))
    first = np.ones(len(order), dtype=bool)
    first[1:] = (np.diff(column[order], axis=0) != 0).any(axis=1)
    return order[first]


def arrows(increment, store):
    """Moreau 1997, figure 1: displacement increments, for grains also velocities, in units of those of the platen."""
    found = {}
    if increment.displacement_unit is None:
        return found
    for panel, group in (("discrete", "discrete"), ("continuum", "nodes")):
        position = increment.arrays[group + "/position"]
        moved = increment.arrays[group + "/displacement_increment"] / increment.displacement_unit
        chosen = thinned(position)
        found[panel] = {"increment": _field(store, position, moved, chosen)}
        speed = _velocity(increment) if panel == "discrete" else moved
        if speed is not None and len(speed) == len(position):
            found[panel]["velocity"] = _field(store, position, speed, chosen)
    return found


def _velocity(increment):
    """Velocity of the grains at the end of the increment over that of the platen, (N, 2)."""
    values = increment.state.get("discrete/velocity")
    return None if values is None or increment.velocity_unit is None else values / increment.velocity_unit


def _stored(store, chosen, **columns):
    return {name: store.add(values[chosen]) for name, values in columns.items()}


def _field(store, position, vectors, chosen):
    return _stored(store, chosen, x=position[:, 0], y=position[:, 1], u=vectors[:, 0], v=vectors[:, 1])


def crosses(increment, store):
    """Moreau 1997, figure 2: principal stresses of each grain and of each cell of the continuum."""
    state, found = increment.state, {}
    if not state:
        return found
    places = {"discrete": ("discrete/", state["discrete/position"]),
              "continuum": ("cells/continuum_", state["cells/corners"].mean(axis=1))}
    for panel, (prefix, centre) in places.items():
        major, minor, angle = (state[prefix + name] for name in PRINCIPAL)
        known = np.flatnonzero(np.isfinite(major) & np.isfinite(minor) & np.isfinite(angle))
        chosen = np.sort(known[np.argsort(-np.abs(major[known]), kind="stable")[:MOST_DRAWN]])
        found[panel] = _stored(store, chosen, x=centre[:, 0], y=centre[:, 1], s1=major, s2=minor, a=angle)
    return found


def cross_unit(increments):
    """Half length of the line of a stress of 1 P [d], so that the crosses of the continuum fill their cells."""
    units = []
    for state in (i.state for i in increments if i.state):
        side = np.sqrt(np.ptp(state["cells/corners"], axis=1).prod(axis=1).mean())
        units.append(0.5 * side / max(np.nanpercentile(state["cells/continuum_major_stress"], 98), 1e-9))
    return short(np.median(units)) if units else 0.5


def forces(increment, store):
    """Moreau 1997, figure 3: contact forces, averaged over the stage [P d]."""
    if not increment.state:
        return None
    point, force = increment.state["window/point"], increment.state["window/force"]
    size = np.linalg.norm(force, axis=1)
    chosen = np.sort(np.argsort(-size, kind="stable")[:MOST_DRAWN])
    chosen = chosen[size[chosen] > 0]
    return _stored(store, chosen, x=point[:, 0], y=point[:, 1], f=size, a=np.arctan2(force[:, 1], force[:, 0]))


def force_unit(increments):
    """Thickness of the line of a force of 1 P d [d], so that the largest 1 % are at least 0.7 d thick."""
    found = [i.state["window/force"] for i in increments if i.state]
    largest = [np.percentile(np.linalg.norm(force, axis=1), 99) for force in found if len(force)]
    return short(0.7 / max(np.median(largest), 1e-9)) if largest else 0.1


def probes(increment):
    """Rectangles with their principal stresses, and the circle, of the stage that ends here."""
    found = {}
    for panel in PANEL_NAMES:
        record = increment.end_record.get(panel) or {}
        rectangles = [{"name": p["name"], "polygon": short(p["polygon"]),
                       **{key: short(plain(p[key])) for key in ("s1", "s2", "direction_deg", "t_over_s")}}
                      for p in record.get("probes") or [] if p["polygon"]]
        circle = record.get("circular_probe")
        found[panel] = {"rectangles": rectangles,
                        "circle": short([*circle["centre"], circle["radius"]]) if circle else None}
    return found
