# diptych: what the page's maps are drawn from, as one JSON object
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The browser draws the maps (draw.js): a map of 4000 grains is 8 kB a quantity, and sharp on every screen and on paper."""

import json

import matplotlib
import matplotlib.colors
import numpy as np

from increments import plain
from quantities import PLACES, QUANTITIES, grain_stress, limits, platen_unit, velocity
from store import Store
from style import NO_VALUE, PANEL_COLOURS, PANEL_NAMES

SPACING = 2.5     # d, of the grid near whose points an arrow is drawn, in both panels
MOST_DRAWN = 12000  # crosses or forces of one map; the weakest are left out beyond it
MARGIN = 2.0      # d, round the sample


def box(increments):
    """(x0, x1, y0, y1) [d] holding every grain and cell of every increment: stepping does not move the axes."""
    low, high = [], []
    for increment in increments:
        position, radius = increment.arrays.get("discrete/position"), increment.arrays.get("discrete/radius")
        if position is not None and radius is not None and len(position):
            low.append((position[:, :2] - radius[:, None]).min(axis=0))
            high.append((position[:, :2] + radius[:, None]).max(axis=0))
        corners = increment.arrays.get("cells/corners")
        if corners is not None and len(corners):
            low.append(corners.min(axis=(0, 1)))
            high.append(corners.max(axis=(0, 1)))
    if not low:
        return None
    (x0, y0), (x1, y1) = np.min(low, axis=0) - MARGIN, np.max(high, axis=0) + MARGIN
    return x0, x1, y0, y1


def data(result):
    """The object; None where no increment has arrays. Its "arrays" are entries of a Store, all else refers to them."""
    drawn = [i for i in result.increments if i.arrays]
    if not drawn:
        return None
    store = Store()
    rules = {(q.key, place): limits(q, place, drawn, result) for q in QUANTITIES for place in PLACES}
    used = [q for q in QUANTITIES if any(rules[q.key, place] for place in PLACES)]
    increments = [{**_frame(i, store), "values": {q.key: _values(q, i, result, rules, store) for q in used},
                   "arrows": _arrows(i, result, store), "crosses": _crosses(i, result, store),
                   "forces": _forces(i, store), "probes": _probes(i)} for i in drawn]
    return {"box": _short(box(drawn)), "panels": PANEL_NAMES, "colours": PANEL_COLOURS, "no_value": NO_VALUE,
            "maps": {name: _table(name) for name in sorted({q.colour_map for q in used})},
            "quantities": [{"key": q.key, "group": q.group, "title": q.title, "label": q.label, "map": q.colour_map,
                            "home": q.home if rules[q.key, q.home] else next(p for p in PLACES if rules[q.key, p]),
                            "places": [p for p in PLACES if rules[q.key, p]]} for q in used],
            "cross_unit": _cross_unit(drawn), "force_unit": _force_unit(drawn),
            "increments": increments, "arrays": store.entries}


def as_json(value):
    """Text that may stand inside a <script> of HTML."""
    return json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")


def _short(values):
    """Nested lists of numbers with five digits."""
    if isinstance(values, (list, tuple, np.ndarray)):
        return [_short(value) for value in values]
    return float(f"{values:.5g}")


def _table(name):
    return [matplotlib.colors.to_hex(colour) for colour in matplotlib.colormaps[name](np.arange(256))]


def _frame(increment, store):
    """Where things are: grains, cells, outline, bands."""
    arrays, state = increment.arrays, increment.state
    position, radius = arrays.get("discrete/position"), arrays.get("discrete/radius")
    grains = position is not None and radius is not None
    corners = {place: arrays.get(place + "/corners", state.get(place + "/corners")) for place in ("cells", "grid")}
    return {"key": increment.key, "kind": increment.kind, "label": increment.label, "title": increment.title,
            "end": f"{increment.end:.9g}",
            "discs": {"x": store.add(position[:, 0]), "y": store.add(position[:, 1]),
                      "r": store.add(radius)} if grains else None,
            "cells": store.add(corners["cells"]), "grid": store.add(corners["grid"]),
            "centre": None if increment.centre is None else _short(increment.centre),
            "outline": [_short(state[side]) for side in ("outline/left", "outline/right") if len(state.get(side, ()))],
            "bands": {panel: [[_or_none(plain(band.get(key))) for key in ("angle_deg", "offset_d", "width_10_90_d", "jump")]
                              for band in increment.bands(panel)] if "bands" in increment.panel(panel) else None
                      for panel in PANEL_NAMES}}


def _or_none(number):
    return None if number is None else _short(number)


def _values(quantity, increment, result, rules, store):
    """place -> {"limits", "discrete", "continuum"}; only places where one panel has numbers."""
    found = {}
    for place in quantity_places(quantity, rules):
        values = {panel: quantity.values(increment, result, place, panel) for panel in PANEL_NAMES}
        if any(v is not None for v in values.values()):
            found[place] = {"limits": rules[quantity.key, place](increment),
                            **{panel: store.add(v) for panel, v in values.items()}}
    return found


def quantity_places(quantity, rules):
    return [place for place in PLACES if rules[quantity.key, place]]


def thinned(position):
    """Indices of the point nearest to each point of a regular grid, one a square."""
    low = position.min(axis=0)
    column = np.floor((position - low) / SPACING).astype(int)
    distance = np.linalg.norm(position - (low + (column + 0.5) * SPACING), axis=1)
    order = np.lexsort((distance, column[:, 0], column[:, 1]))
    first = np.ones(len(order), dtype=bool)
    first[1:] = (np.diff(column[order], axis=0) != 0).any(axis=1)
    return order[first]


def _arrows(increment, result, store):
    """Moreau 1997, figure 1: displacement increments and, of the grains, velocities; in units of the platen's."""
    unit = platen_unit(increment)
    found = {"unit": f"{unit:.3g}"}
    for panel, group in (("discrete", "discrete"), ("continuum", "nodes")):
        position = increment.arrays.get(group + "/position")
        moved = increment.arrays.get(group + "/displacement_increment")
        if position is None or moved is None or not len(position):
            continue
        position, moved = position[:, :2], moved[:, :2] / unit
        found[panel] = {"increment": _field(store, position, moved, thinned(position))}
        speed = velocity(increment, result) if panel == "discrete" else moved
        if speed is not None and len(speed) == len(position):
            chosen = thinned(position)
            found[panel]["velocity"] = _field(store, position, speed, chosen)
    return found


def _field(store, position, vectors, chosen):
    return {name: store.add(values[chosen]) for name, values in (
        ("x", position[:, 0]), ("y", position[:, 1]), ("u", vectors[:, 0]), ("v", vectors[:, 1]))}


def principal(tensor):
    """(s1, s2, angle of s1 [rad]) of the symmetric parts of tensors (N, 2, 2)."""
    xx, yy, xy = tensor[:, 0, 0], tensor[:, 1, 1], (tensor[:, 0, 1] + tensor[:, 1, 0]) / 2
    mean, radius = (xx + yy) / 2, np.hypot((xx - yy) / 2, xy)
    return mean + radius, mean - radius, np.arctan2(2 * xy, xx - yy) / 2


def _crosses(increment, result, store):
    """Moreau 1997, figure 2: principal stresses of each grain; of each cell of the continuum."""
    found = {}
    stress, position = grain_stress(increment, result), increment.state.get("discrete/position")
    if stress is not None and position is not None:
        found["discrete"] = _cross_field(store, position[:, :2], stress)
    stress, corners = _continuum_stress(increment)
    if stress is not None:
        found["continuum"] = _cross_field(store, corners.mean(axis=1), stress)
    return found


def _continuum_stress(increment):
    stress, corners = increment.state.get("cells/continuum_stress"), increment.state.get("cells/corners")
    return (None, None) if stress is None or corners is None else (stress, corners)


def _cross_field(store, centre, stress):
    major, minor, angle = principal(stress)
    chosen = np.sort(np.argsort(-np.abs(major), kind="stable")[:MOST_DRAWN])
    return {name: store.add(values[chosen]) for name, values in (
        ("x", centre[:, 0]), ("y", centre[:, 1]), ("s1", major), ("s2", minor), ("a", angle))}


def _cross_unit(increments):
    """Half length of the line of a stress of 1 P [d]: the continuum's crosses just fill their cells."""
    units = []
    for increment in increments:
        stress, corners = _continuum_stress(increment)
        if stress is not None and len(stress):
            side = np.sqrt(np.ptp(corners, axis=1).prod(axis=1).mean())
            units.append(0.5 * side / max(np.percentile(principal(stress)[0], 98), 1e-9))
    return _short(np.median(units)) if units else 0.5


def _forces(increment, store):
    """Moreau 1997, figure 3: forces at the contacts, mean over the window [P d]."""
    point, force = increment.state.get("contacts/point"), increment.state.get("contacts/force")
    if point is None or force is None:
        return None
    size = np.linalg.norm(force[:, :2], axis=1)
    chosen = np.sort(np.argsort(-size, kind="stable")[:MOST_DRAWN])
    chosen = chosen[size[chosen] > 0]
    return {name: store.add(values[chosen]) for name, values in (
        ("x", point[:, 0]), ("y", point[:, 1]), ("f", size), ("a", np.arctan2(force[:, 1], force[:, 0])))}


def _force_unit(increments):
    """Thickness of the line of a force of 1 P d [d]: the strongest hundredth is drawn 0.7 d thick or more."""
    forces = [increment.state.get("contacts/force") for increment in increments]
    largest = [np.percentile(np.linalg.norm(f[:, :2], axis=1), 99) for f in forces if f is not None and len(f)]
    return _short(0.7 / max(np.median(largest), 1e-9)) if largest else 0.1


def _probes(increment):
    """Rectangles with their principal stresses, and the circle; of the stage that ends here."""
    found = {}
    for panel in PANEL_NAMES:
        record = increment.end_panel(panel)
        rectangles = [{"name": p.get("name", ""), "polygon": _short(p["polygon"]),
                       **{key: _or_none(plain(p.get(key))) for key in ("s1", "s2", "direction_deg", "t_over_s")}}
                      for p in record.get("probes") or [] if p.get("polygon")]
        circle = record.get("circular_probe") or {}
        found[panel] = {"rectangles": rectangles,
                        "circle": _short([*circle["centre"], circle["radius"]]) if circle.get("radius") else None}
    return found
