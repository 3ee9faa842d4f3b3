# diptych: roses of contact normals in the probes, with 24 sectors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Moreau 1997, section 3: the radius of each sector grows with its number of contact normals."""

import numpy as np

from .drawing import Figure
from .style import GRAINS, svg
from ..data.numbers import plain

SECTORS = 24


def roses(increment):
    """[Picture]: share of contact normals in each sector over the isotropic share. Counts include both senses of a
    normal."""
    probes = increment.panel("discrete").get("probes") or []
    found = [(p, np.asarray(p["normals_24"], dtype=float)) for p in probes if len(p.get("normals_24") or []) == SECTORS]
    found = [(probe, SECTORS * counts / counts.sum()) for probe, counts in found if counts.sum() > 0]
    reach = 1.1 * max((share.max() for _, share in found), default=1.0)
    return [_rose(increment, probe, share, reach) for probe, share in found]


def _rose(increment, probe, share, reach):
    figure = Figure((2.3, 2.3), [[0, 0, 1, 1]])
    axes, = figure.axes
    axes.has_frame = False
    edges = np.radians(np.linspace(0, 360, SECTORS + 1))
    x, y = [], []
    for radius, low, high in zip(share, edges, edges[1:]):
        arc = np.linspace(low, high, 6)
        x += [0, *radius * np.cos(arc), np.nan]
        y += [0, *radius * np.sin(arc), np.nan]
    axes.fill(x, y, color=GRAINS, alpha=0.75, edge="white")
    around = np.linspace(0, 2 * np.pi, 73)
    axes.plot(np.cos(around), np.sin(around), linewidth=0.8, linestyle=":")
    for name, line, label in (("direction_deg", "-", "major stress"), ("fabric_direction_deg", "--", "fabric")):
        angle = plain(probe.get(name))
        if angle is not None:
            arm = reach * np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
            axes.plot([-arm[0], arm[0]], [-arm[1], arm[1]], linestyle=line, linewidth=1.2, label=label)
    axes.set(xlim=(-1.08 * reach, 1.08 * reach), ylim=(-1.08 * reach, 1.08 * reach))
    name = probe.get("name", "")
    axes.title(f"{name}, {probe.get('contacts', '?')} contacts", "center")
    axes.legend()
    return svg(figure, f"Rose of contact normals in {SECTORS} sectors, probe {name} of the grains, {increment.title}.")
