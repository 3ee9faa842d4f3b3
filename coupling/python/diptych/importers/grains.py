# diptych: grains of tables with the usual names of columns
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Grains of tables."""

from __future__ import annotations

import numpy as np

from .frames import Options, refused
from .tables import Table

RADIUS, DIAMETER = ("radius", "r"), ("diameter", "d")


def grains_of(table: Table, options: Options, position: np.ndarray | None = None) -> dict[str, np.ndarray]:
    """The grains of a frame from columns id, x, y, radius or diameter; if present mass, vx, vy, omega, rotation, fx, fy.

    `position` (n, 2) replaces x and y.
    """
    diameter = table.numbers(*DIAMETER) if table.find(*DIAMETER) is not None else None
    radius = table.numbers(*RADIUS) if diameter is None or table.find(*RADIUS) is not None else diameter / 2
    if diameter is not None and np.any(abs(radius - diameter / 2) > 1e-5 * diameter):
        bad = np.flatnonzero(abs(radius - diameter / 2) > 1e-5 * diameter)[0]
        raise refused(table.path, f"a radius of {radius[bad]:g} and a diameter of {diameter[bad]:g} contradict each other",
                      table.lines[bad])
    known = {"mass": table.optional(options, "mass", "m"),
             "velocity": table.optional_vectors(options, ("vx", "vel_x"), ("vy", "vel_y")),
             "spin": table.optional(options, "omegaz", "omega", "wz", "angVel_z", "spin"),
             "rotation": table.optional(options, "rotation", "angle", "theta"),
             "resultant": table.optional_vectors(options, ("fx", "f_x"), ("fy", "f_y"))}
    for name, values in (("radius", radius), ("mass", known["mass"])):
        if values is not None and np.any(values <= 0):
            bad = np.flatnonzero(values <= 0)[0]
            raise refused(table.path, f"a {name} of {values[bad]:g} must be positive", table.lines[bad])
    grains = {"id": table.whole("id") if table.has("id") else np.arange(len(table.rows)), "radius": radius, "line": table.lines,
              "position": table.vectors(["x"], ["y"]) if position is None else position}
    return grains | {name: values for name, values in known.items() if values is not None}
