# diptych: three probes: stress crosses of both panels, contact normals of the grains
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Moreau 1997, section 3: the mean stress of a probe as a cross, its contact normals in 24 sectors."""

import numpy as np
from matplotlib.collections import PatchCollection, PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon, Wedge

import maps
from fields import Pair
from maps import plain
from style import GRAINS, INK, PANEL_COLOURS, PANEL_NAMES, svg

SECTORS = 24


def pair(increment, box):
    """Crosses of both panels, and as extra the roses of the grains."""
    stored = {panel: increment.panel(panel).get("probes") or [] for panel in PANEL_NAMES}
    if box is None or not any(stored.values()):
        return Pair(None, None)
    every = stored["discrete"] + stored["continuum"]
    sides = [np.ptp(np.asarray(p["polygon"], dtype=float), axis=0).min() for p in every if p.get("polygon")]
    largest = max(plain(p.get("s1")) or 0.0 for p in every)
    # Arm of a stress of 1 P, such that the largest cross fits into the smallest probe [d].
    unit = 0.46 * min(sides, default=0.0) / largest if largest > 0 else 0.0
    pictures = [_crosses(increment, box, panel, stored[panel], unit) if stored[panel] else None
                for panel in PANEL_NAMES]
    return Pair(*pictures, caption=f"Probes, {increment.title}.", extra=_roses(increment, stored["discrete"]))


def _sample(axes, arrays):
    """The sample as a pale area: the mesh's cells, which both panels share, with the grains' sides where stored."""
    corners = arrays.get("cells/corners")
    if corners is not None:
        axes.add_collection(PolyCollection(corners, facecolor="#eeeeee", edgecolor="none", antialiased=False,
                                           rasterized=True), autolim=False)
    maps.draw_outline(axes, arrays)


def _crosses(increment, box, panel, probes, unit):
    """Each principal stress as a line through the probe's centre, half length = unit times it. unit: [d / P]."""
    figure, axes, _ = maps.map_axes(box, PANEL_NAMES[panel])
    _sample(axes, increment.arrays)
    for probe in probes:
        corners = np.asarray(probe.get("polygon") or [], dtype=float).reshape(-1, 2)
        if not len(corners):
            continue
        axes.add_patch(Polygon(corners, fill=False, edgecolor=INK, linewidth=0.9))
        centre = corners.mean(axis=0)
        angle = plain(probe.get("direction_deg"))
        for name, turn, width in (("s1", 0, 2.4), ("s2", 90, 1.6)):
            stress = plain(probe.get(name))
            if stress is None or angle is None:
                continue
            a = np.radians(angle + turn)
            arm = unit * stress * np.array([np.cos(a), np.sin(a)])
            axes.plot(*np.stack([centre - arm, centre + arm]).T, color=PANEL_COLOURS[panel], linewidth=width,
                      solid_capstyle="butt")
        ratio = plain(probe.get("t_over_s"))
        text = probe.get("name", "") + ("" if ratio is None else f": t/s = {ratio:.3f}")
        if probe.get("name") == "zone":  # oblique: below its lowest corner, where no other probe lies
            low = corners[corners[:, 1].argmin()]
            axes.text(low[0], low[1] - 0.6, text, fontsize=8.5, ha="center", va="top")
        else:
            axes.text(corners[:, 0].mean(), corners[:, 1].max() + 0.6, text, fontsize=8.5, ha="center", va="bottom")
    maps.draw_bands(axes, increment.bands(panel), increment.centre, on_colour=False)
    _key(axes, box, unit, panel)
    alt = f"{PANEL_NAMES[panel]}: principal stresses of {len(probes)} probes as crosses, {increment.title}."
    return svg(figure, alt)


def _key(axes, box, unit, panel):
    """A line as long as a cross's line of 1 P, above the axes."""
    x, y = box[1] - 2 * unit, box[3] + 0.018 * (box[3] - box[2])
    axes.plot([x, x + 2 * unit], [y, y], color=PANEL_COLOURS[panel], linewidth=2.4, clip_on=False,
              solid_capstyle="butt")
    axes.text(x - 1, y, "1 P", ha="right", va="center", fontsize=8.5)


def _roses(increment, probes):
    """Share of contact normals in each sector over the isotropic share; a normal counts in both its senses."""
    roses = [(p, np.asarray(p["normals_24"], dtype=float)) for p in probes if len(p.get("normals_24") or []) == SECTORS]
    roses = [(probe, counts) for probe, counts in roses if counts.sum() > 0]
    if not roses:
        return None
    figure = Figure(figsize=(2.1 * len(roses), 2.7))
    shares = [SECTORS * (c + np.roll(c, SECTORS // 2)) / (2 * c.sum()) for _, c in roses]
    reach = 1.1 * max(share.max() for share in shares)
    for k, ((probe, _), share) in enumerate(zip(roses, shares)):
        axes = figure.add_axes([k / len(roses), 0.0, 1 / len(roses), 0.9], aspect="equal")
        step = 360 / SECTORS
        axes.add_collection(PatchCollection([Wedge((0, 0), s, step * i, step * (i + 1)) for i, s in enumerate(share)],
                                            facecolor=GRAINS, edgecolor="white", linewidth=0.5, alpha=0.75))
        axes.add_patch(Circle((0, 0), 1, fill=False, color=INK, linewidth=0.7, linestyle=":"))
        for name, line, label in (("direction_deg", "-", "stress σ₁"), ("fabric_direction_deg", "--", "fabric")):
            angle = plain(probe.get(name))
            if angle is not None:
                arm = reach * np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
                axes.plot([-arm[0], arm[0]], [-arm[1], arm[1]], color=INK, linestyle=line, linewidth=1.2, label=label)
        axes.set(xlim=(-1.12 * reach, 1.12 * reach), ylim=(-1.12 * reach, 1.12 * reach))
        axes.axis("off")
        axes.set_title(f"{probe.get('name', '')}, {probe.get('contacts', '?')} contacts", fontsize=9)
        if k == 0:
            figure.legend(*axes.get_legend_handles_labels(), loc="lower center", ncol=2, fontsize=8.5)
    alt = f"Roses of contact normals in {SECTORS} sectors in {len(roses)} probes of the grains, {increment.title}."
    return svg(figure, alt)
