# diptych: arrows, crosses, forces and probes of one increment, for the browser
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every function returns entries of a Store; {} or None: nothing is stored."""

import numpy as np

from diptych_report.data.numbers import plain
from diptych_report.data.panels import PANEL_NAMES

SPACING = 2.5       # d, of the grid with one arrow per square, in both panels
MOST_DRAWN = 12000  # crosses or forces of one map; the weakest are left out
PRINCIPAL = ("major_stress", "minor_stress", "stress_direction")


def short(values):
    """Nested lists of numbers with five digits."""
    if isinstance(values, (list, tuple, np.ndarray)):
        return [short(value) for value in values]
    return float(f"{values:.5g}")


def or_none(number):
    return None if number is None else short(number)


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
    found, unit = {}, increment.displacement_unit
    for panel, group in (("discrete", "discrete"), ("continuum", "nodes")):
        position = increment.arrays.get(group + "/position")
        moved = increment.arrays.get(group + "/displacement_increment")
        if position is None or moved is None or not len(position) or unit is None:
            continue
        position, moved = position[:, :2], moved[:, :2] / unit
        chosen = thinned(position)
        found[panel] = {"increment": _field(store, position, moved, chosen)}
        speed = _velocity(increment) if panel == "discrete" else moved
        if speed is not None and len(speed) == len(position):
            found[panel]["velocity"] = _field(store, position, speed, chosen)
    return found


def _velocity(increment):
    """Velocity of the grains at the end of the increment over that of the platen, (N, 2)."""
    values = increment.state.get("discrete/velocity")
    return None if values is None or increment.velocity_unit is None else values[:, :2] / increment.velocity_unit


def _field(store, position, vectors, chosen):
    return {name: store.add(values[chosen]) for name, values in (
        ("x", position[:, 0]), ("y", position[:, 1]), ("u", vectors[:, 0]), ("v", vectors[:, 1]))}


def crosses(increment, store):
    """Moreau 1997, figure 2: principal stresses of each grain and of each cell of the continuum."""
    state, found = increment.state, {}
    position, corners = state.get("discrete/position"), state.get("cells/corners")
    places = {"discrete": ("discrete/", position), "continuum": ("cells/continuum_", None if corners is None else
                                                                 corners.mean(axis=1))}
    for panel, (prefix, centre) in places.items():
        major, minor, angle = (state.get(prefix + name) for name in PRINCIPAL)
        if centre is None or major is None or minor is None or angle is None:
            continue
        known = np.flatnonzero(np.isfinite(major) & np.isfinite(minor) & np.isfinite(angle))
        chosen = np.sort(known[np.argsort(-np.abs(major[known]), kind="stable")[:MOST_DRAWN]])
        found[panel] = {name: store.add(values[chosen]) for name, values in (
            ("x", centre[:, 0]), ("y", centre[:, 1]), ("s1", major), ("s2", minor), ("a", angle))}
    return found


def cross_unit(increments):
    """Half length of the line of a stress of 1 P [d], so that the crosses of the continuum fill their cells."""
    units = []
    for increment in increments:
        major, corners = increment.state.get("cells/continuum_major_stress"), increment.state.get("cells/corners")
        if major is not None and corners is not None and np.isfinite(major).any():
            side = np.sqrt(np.ptp(corners, axis=1).prod(axis=1).mean())
            units.append(0.5 * side / max(np.nanpercentile(major, 98), 1e-9))
    return short(np.median(units)) if units else 0.5


def forces(increment, store):
    """Moreau 1997, figure 3: contact forces, averaged over the stage [P d]."""
    point, force = increment.state.get("window/point"), increment.state.get("window/force")
    if point is None or force is None:
        return None
    size = np.linalg.norm(force[:, :2], axis=1)
    chosen = np.sort(np.argsort(-size, kind="stable")[:MOST_DRAWN])
    chosen = chosen[size[chosen] > 0]
    return {name: store.add(values[chosen]) for name, values in (
        ("x", point[:, 0]), ("y", point[:, 1]), ("f", size), ("a", np.arctan2(force[:, 1], force[:, 0])))}


def force_unit(increments):
    """Thickness of the line of a force of 1 P d [d], so that the largest 1 % are at least 0.7 d thick."""
    found = [increment.state.get("window/force") for increment in increments]
    largest = [np.percentile(np.linalg.norm(f[:, :2], axis=1), 99) for f in found if f is not None and len(f)]
    return short(0.7 / max(np.median(largest), 1e-9)) if largest else 0.1


def probes(increment):
    """Rectangles with their principal stresses, and the circle, of the stage that ends here."""
    found = {}
    for panel in PANEL_NAMES:
        record = increment.end_panel(panel)
        rectangles = [{"name": p.get("name", ""), "polygon": short(p["polygon"]),
                       **{key: or_none(plain(p.get(key))) for key in ("s1", "s2", "direction_deg", "t_over_s")}}
                      for p in record.get("probes") or [] if p.get("polygon")]
        circle = record.get("circular_probe") or {}
        found[panel] = {"rectangles": rectangles,
                        "circle": short([*circle["centre"], circle["radius"]]) if circle.get("radius") else None}
    return found
