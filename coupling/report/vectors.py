# diptych: displacement increments as arrows, both panels (Moreau 1997, figure 1)
# SPDX-License-Identifier: LGPL-2.1-or-later

import numpy as np

import maps
from fields import Pair
from style import INK, PANEL_COLOURS, PANEL_NAMES, png

SPACING = 2.5     # d, of the grid near whose points an arrow is drawn, in both panels
PLATEN_ARROW = 4  # d, length on paper of the upper platen's own increment


def pair(increment, box):
    """Arrows of grains and of mesh nodes nearest to the points of one grid; one scale for both."""
    platen = _platen_increment(increment.arrays)
    if box is None or not platen > 0:
        return Pair(None, None)
    pictures = [_panel(increment, box, platen, panel) for panel in PANEL_NAMES]
    return Pair(*pictures, caption=f"Displacement increments, {increment.title}; arrows enlarged "
                                   f"{PLATEN_ARROW / platen:.2g} times; the key arrow is the upper platen's own, "
                                   f"{platen:.3g} d.")


def _platen_increment(arrays):
    """|Delta U| [d]: mean increment of the uppermost nodes, which stick to the platen; 0 if not stored."""
    position, increment = arrays.get("nodes/position"), arrays.get("nodes/displacement_increment")
    if position is None or increment is None:
        return 0.0
    height = position[:, 1].max() - position[:, 1].min()
    top = position[:, 1] > position[:, 1].max() - 1e-6 * height
    return float(np.linalg.norm(increment[top, :2].mean(axis=0)))


def _thinned(position):
    """Indices of the point nearest to each point of a regular grid, those farther than half the spacing left out."""
    low = position.min(axis=0)
    column = np.floor((position - low) / SPACING).astype(int)
    distance = np.linalg.norm(position - (low + (column + 0.5) * SPACING), axis=1)
    order = np.lexsort((distance, column[:, 0], column[:, 1]))
    first = np.ones(len(order), dtype=bool)
    first[1:] = (np.diff(column[order], axis=0) != 0).any(axis=1)
    return order[first]


def _panel(increment, box, platen, panel):
    group = "discrete" if panel == "discrete" else "nodes"
    position = increment.arrays.get(group + "/position")
    displacement = increment.arrays.get(group + "/displacement_increment")
    if position is None or displacement is None:
        return None
    position, displacement = position[:, :2], displacement[:, :2]
    chosen = _thinned(position)
    figure, axes, _ = maps.map_axes(box, PANEL_NAMES[panel])
    scale = platen / PLATEN_ARROW
    arrows = axes.quiver(*position[chosen].T, *displacement[chosen].T, angles="xy", scale_units="xy", scale=scale,
                         width=0.0035, headwidth=3.6, headlength=4.2, headaxislength=3.8, color=PANEL_COLOURS[panel])
    axes.quiverkey(arrows, 0.90, 1.022, platen, "upper platen", labelpos="W", coordinates="axes", color=INK,
                   fontproperties={"size": 8.5}, labelsep=0.06)
    maps.draw_bands(axes, increment.bands(panel), increment.centre, on_colour=False)
    alt = (f"{PANEL_NAMES[panel]}: displacement increments as arrows, {increment.title}, "
           f"{len(chosen)} of {len(position)} points.")
    return png(figure, alt)
