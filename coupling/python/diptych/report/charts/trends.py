# diptych: charts over the stages: inclination and width of the bands, dissipation in them, difference of the stress
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every figure is over the loading, for both panels, with the 95 % intervals of the comparison."""

from .style import FAINT, INK, PANEL_COLOURS, PANEL_MARKS, THIRD, chart, svg, with_intervals
from ..data.numbers import plain, scaled
from ..data.panels import PANEL_NAMES, THEORY

DASHES = {"coulomb_deg": (0, (5, 1.5)), "arthur_deg": (0, (2, 1.2)), "roscoe_deg": "-."}


def figures(result):
    """List of (Picture or None, caption) in the order of the page."""
    return [_inclination(result), _width(result), _dissipation(result), _stress_difference(result)]


def strongest_band(stage, panel):
    """The first band, which is the strongest, or {}."""
    return next(iter(stage.bands(panel)), {})


def _points(axes, result, numbers):
    """Draws one set of points per panel from numbers(stage, panel). Returns True if any was drawn."""
    drawn = False
    for k, panel in enumerate(PANEL_NAMES):
        # The panels are half a line width apart, so that equal values stay visible.
        x = [s.shown_end * (1 + 0.004 * (2 * k - 1)) for s in result.stages]
        drawn |= with_intervals(axes, x, [numbers(s, panel) for s in result.stages], fmt=PANEL_MARKS[panel],
                                markersize=4.5, color=PANEL_COLOURS[panel], label=PANEL_NAMES[panel])
    axes.set(xlim=(0, 1.04 * result.loading_variable.factor * max((s.end for s in result.stages), default=1.0)))
    return drawn


def _inclination(result):
    caption = ("Angle between the first band and the minor principal stress in it, and theory lines for the "
               "parameters of the continuum (φ friction, ψ dilatancy): "
               f"{', '.join(map(' '.join, THEORY.values()))}. Bars: 95 % intervals, if known.")
    figure, axes = chart(result, "band to minor stress (degrees)")
    if not _points(axes, result, lambda stage, panel: strongest_band(stage, panel).get("to_minor_stress_deg")):
        return None, caption
    for key, (name, _) in THEORY.items():
        angle = plain(result.part("theory").get(key))
        if angle is not None:
            axes.axhline(angle, linestyle=DASHES[key], label=f"{name} {angle:.1f}°")
    axes.legend()
    return svg(figure, "Angle between band and minor principal stress against the loading, with theory lines."), caption


def _width(result):
    caption = "Width of the first band, in current coordinates. Bars: 95 % intervals of the grains by block bootstrap."
    figure, axes = chart(result, "10–90 % width of the band (d)")
    if not _points(axes, result, lambda stage, panel: strongest_band(stage, panel).get("width_10_90_d")):
        return None, caption
    axes.set(ylim=(0, None))
    axes.legend()
    return svg(figure, "10–90 % width of the first band against the loading, both panels."), caption


def _dissipated(stage, panel):
    return stage.panel(panel).get("dissipation") or {}


def _dissipation(result):
    caption = ("Share of the dissipation of a stage inside the 10–90 % width of the band of the grains. Dashed: "
               "share of the area of this band. Grains: friction and impacts; continuum: plastic work.")
    figure, axes = chart(result, "dissipated inside the band (%)")
    if not _points(axes, result, lambda stage, panel: scaled(_dissipated(stage, panel).get("share_inside"), 100)):
        return None, caption
    shares = [(s.shown_end, plain(_dissipated(s, "discrete").get("area_share"))) for s in result.stages]
    area = [(at, 100 * share) for at, share in shares if share is not None]
    if area:
        axes.plot(*zip(*area), color=FAINT, linestyle="--", linewidth=1.2, label="share of the area")
    axes.set(ylim=(0, 100))
    axes.legend(3)
    return svg(figure, "Share of dissipation inside the band of the grains against the loading, both panels."), caption


def _stress_difference(result):
    caption = ("Relative difference of the stress of both panels (L2 over cells with both), for three sizes of cell. "
               "Dashed: scatter of the grains about a quadratic surface, an upper estimate of the difference from "
               "sampling only, because it includes narrow bands.")
    rows = {}
    for stage in result.stages:
        for row in stage.panel("difference").get("stress") or []:
            rows.setdefault(row.get("label", ""), []).append((stage.shown_end, row))
    figure, axes = chart(result, "difference of the stress (%)")
    for (label, found), colour in zip(rows.items(), (INK, PANEL_COLOURS["discrete"], THIRD)):
        for key, dashes, words in (("relative_l2", "-", label), ("sampling_alone", "--", None)):
            points = [(x, 100 * plain(row.get(key))) for x, row in found if plain(row.get(key)) is not None]
            if points:
                axes.plot(*zip(*points), color=colour, linestyle=dashes, linewidth=1.3, label=words,
                          marker="o" if dashes == "-" else "", markersize=3.5)
    if axes.is_empty:
        return None, caption
    axes.set(xlim=(0, None), ylim=(0, None))
    axes.legend(3)
    return svg(figure, "Relative difference of the stress against the loading at three sizes of cell."), caption
