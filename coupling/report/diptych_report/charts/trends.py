# diptych: what the stages tell together: inclination and width of the bands, dissipation in them, difference of the stress
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every figure against the loading, both panels, with the 95 % intervals that the comparison gives."""

from increments import interval, plain, scaled
from style import INK, FAINT, PANEL_COLOURS, PANEL_NAMES, THIRD, chart, svg, with_intervals

THEORY = (("coulomb_deg", "Coulomb 45° + φ/2", (0, (5, 1.5))), ("arthur_deg", "Arthur 45° + (φ + ψ)/4", (0, (2, 1.2))),
          ("roscoe_deg", "Roscoe 45° + ψ/2", "-."))
MARKS = {"discrete": "o", "continuum": "s"}


def figures(result):
    """List of (Picture or None, caption) in the order of the page."""
    return [_inclination(result), _band_curve(result, "width_10_90_d", "10–90 % width of the band (d)",
                                              "Width of the first band, in current coordinates."),
            _dissipation(result), _stress_difference(result)]


def main_band(increment, panel):
    """The band with the largest jump; {} where none is detected."""
    bands = [band for band in increment.bands(panel) if plain(band.get("angle_deg")) is not None]
    return max(bands, key=lambda band: abs(plain(band.get("jump")) or 0.0), default={})


def minor_direction(increment, panel):
    """Direction of the minor principal stress [degrees] in the zone probe (else the first) of the stage that ends here."""
    stored = increment.end_panel(panel).get("probes") or []
    probes = [p for p in stored if p.get("name") == "zone"] or stored
    major = plain(probes[0].get("direction_deg")) if probes else None
    return None if major is None else major + 90


def to_minor_stress(increment, panel):
    """Angle [degrees, 0 to 90] between the first band and the minor principal stress, the angle that theory lines give.

    A number with an interval where the band's inclination has one (the stress direction is taken as known); None if unknown.
    """
    band, minor = main_band(increment, panel), minor_direction(increment, panel)
    if not band or minor is None:
        return None
    turned = (plain(band["angle_deg"]) - minor + 90) % 180 - 90
    angle = band["angle_deg"]
    if not isinstance(angle, dict):
        return abs(turned)
    if interval(angle) is None:
        return {"value": abs(turned), "low": None, "high": None}
    ends = [abs(turned + end - plain(angle)) for end in interval(angle)]
    return {"value": abs(turned), "low": min(ends), "high": max(ends)}


def _points(axes, result, numbers):
    """One set of points a panel; numbers(stage, panel). True if any was drawn."""
    drawn = False
    for k, panel in enumerate(PANEL_NAMES):
        # Half a line width apart, so that equal values do not hide each other.
        x = [result.across(s.end) * (1 + 0.004 * (2 * k - 1)) for s in result.stages]
        drawn |= with_intervals(axes, x, [numbers(s, panel) for s in result.stages], fmt=MARKS[panel], markersize=4.5,
                                color=PANEL_COLOURS[panel], label=PANEL_NAMES[panel])
    axes.set_xlim(left=0)
    return drawn


def _inclination(result):
    caption = ("Angle between the first band and the direction of the minor principal stress in the zone, with 95 % intervals, "
               "beside the theory lines of the continuum's parameters (φ friction, ψ dilatancy).")
    figure, axes = chart(result, "band to minor stress (degrees)")
    if not _points(axes, result, to_minor_stress):
        return None, caption
    for key, label, dashes in THEORY:
        angle = plain((result.comparison.get("theory") or {}).get(key))
        if angle is not None:
            axes.axhline(angle, color=INK, linewidth=1, linestyle=dashes, label=f"{label} = {angle:.1f}°")
    low, high = axes.get_ylim()
    axes.set_ylim(low - 1, high + 0.45 * (high - low) + 2)
    axes.legend(loc="upper right", ncol=2, fontsize=8)
    return svg(figure, "Angle between band and minor principal stress against the loading, with theory lines."), caption


def _band_curve(result, key, label, words):
    figure, axes = chart(result, label)
    if not _points(axes, result, lambda stage, panel: main_band(stage, panel).get(key)):
        return None, words
    axes.set_ylim(bottom=0)
    axes.legend(loc="best")
    return svg(figure, f"{label} against the loading, both panels."), words + " 95 % intervals by block bootstrap where given."


def _dissipation(result):
    caption = ("Share of the energy dissipated in a stage that is dissipated within the 10–90 % width of the grains' band; "
               "dashed: that band's share of the area. Grains: friction and impacts; continuum: plastic work.")
    figure, axes = chart(result, "dissipated inside the band (%)")
    of = lambda stage, panel: scaled((stage.panel(panel).get("dissipation") or {}).get("share_inside"), 100)  # noqa: E731
    if not _points(axes, result, of):
        return None, caption
    shares = [(s.end, plain((s.panel("discrete").get("dissipation") or {}).get("area_share"))) for s in result.stages]
    area = [(result.across(end), 100 * share) for end, share in shares if share is not None]
    if area:
        axes.plot(*zip(*area), color=FAINT, linestyle="--", linewidth=1.2, label="share of the area")
    axes.set_ylim(0, 100)
    axes.legend(loc="best")
    return svg(figure, "Share of dissipation inside the grains' band against the loading, both panels."), caption


def _stress_difference(result):
    caption = ("Relative difference of the stress of the two panels (L2 over cells that carry both), at three sizes of cell. "
               "Dashed: the grains' scatter about their own quadratic surface, a narrow band in it included: what sampling alone "
               "would give, and rather more.")
    rows = {}
    for stage in result.stages:
        for row in (stage.record.get("difference") or {}).get("stress") or []:
            rows.setdefault(row.get("label", ""), []).append((result.across(stage.end), row))
    figure, axes = chart(result, "difference of the stress (%)")
    drawn = False
    for (label, found), colour in zip(rows.items(), (INK, PANEL_COLOURS["discrete"], THIRD)):
        for key, dashes, words in (("relative_l2", "-", label), ("sampling_alone", "--", None)):
            points = [(x, 100 * plain(row.get(key))) for x, row in found if plain(row.get(key)) is not None]
            if points:
                axes.plot(*zip(*points), color=colour, linestyle=dashes, linewidth=1.3, label=words,
                          marker="o" if dashes == "-" else None, markersize=3.5)
                drawn = True
    if not drawn:
        return None, caption
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=0)
    axes.legend(loc="best", title="size of the cells", title_fontsize=8.5, ncol=3)
    return svg(figure, "Relative difference of the stress against the loading at three sizes of cell."), caption
