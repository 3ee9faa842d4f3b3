# diptych: roses of contact normals in the probes, with 24 sectors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Moreau 1997, section 3: the radius of each sector grows with its number of contact normals."""

import numpy as np
from matplotlib.collections import PatchCollection
from matplotlib.patches import Circle, Wedge

from .style import GRAINS, INK, frame, svg
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
    figure, (axes,) = frame("rose", (2.3, 2.75), [[0.0, 0.08, 1.0, 2.3 / 2.75]])
    axes.set_aspect("equal")
    step = 360 / SECTORS
    axes.add_collection(PatchCollection([Wedge((0, 0), s, step * i, step * (i + 1)) for i, s in enumerate(share)],
                                        facecolor=GRAINS, edgecolor="white", linewidth=0.5, alpha=0.75))
    axes.add_patch(Circle((0, 0), 1, fill=False, color=INK, linewidth=0.8, linestyle=":"))
    for name, line, label in (("direction_deg", "-", "major stress"), ("fabric_direction_deg", "--", "fabric")):
        angle = plain(probe.get(name))
        if angle is not None:
            arm = reach * np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
            axes.plot([-arm[0], arm[0]], [-arm[1], arm[1]], color=INK, linestyle=line, linewidth=1.2, label=label)
    axes.set(xlim=(-1.08 * reach, 1.08 * reach), ylim=(-1.08 * reach, 1.08 * reach))
    axes.axis("off")
    name = probe.get("name", "")
    figure.texts.clear()
    figure.legends.clear()
    figure.text(0.5, 0.99, f"{name}, {probe.get('contacts', '?')} contacts", fontsize=9.5, ha="center", va="top")
    handles, labels = axes.get_legend_handles_labels()
    if handles:
        figure.legend(handles, labels, loc="lower center", ncol=2, fontsize=8.5, borderpad=0.1)
    return svg(figure, f"Rose of contact normals in {SECTORS} sectors, probe {name} of the grains, {increment.title}.")
