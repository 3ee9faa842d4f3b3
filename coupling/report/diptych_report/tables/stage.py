# diptych: probes, stress differences, dissipation and force chains of one stage as rows of text
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every table is None where nothing of it is stored."""

from increments import interval, plain
from style import PANEL_NAMES
from wording import ABSENT, number, rounded

PERCENTILES = ("5", "25", "50", "75", "95")


def probes(increment):
    head = ["probe", "panel", "σ₁", "σ₂", "direction of σ₁", "t/s", "mean of", "fabric direction", "fabric − stress",
            "anisotropy", "contacts"]
    rows = []
    for panel, words in PANEL_NAMES.items():
        for probe in increment.panel(panel).get("probes") or []:
            grains = panel == "discrete"
            rows.append([probe.get("name", ""), words, rounded(probe.get("s1"), " P"), rounded(probe.get("s2"), " P"),
                         rounded(probe.get("direction_deg"), "°"), rounded(probe.get("t_over_s"), ""),
                          "–" if probe.get("count") is None else f"{probe['count']} " + ("grains" if grains else "cells")]
                        + (_fabric(probe) if grains else ["–"] * 4))
    return {"head": head, "rows": rows} if rows else None


def _fabric(probe):
    return [_with_error(probe, "fabric_direction_deg", "fabric_direction_error_deg", "°"), _turn(probe),
            _with_error(probe, "anisotropy", "anisotropy_error", ""), number(probe.get("contacts"))]


def _with_error(probe, key, error, unit):
    text = rounded(probe.get(key), unit)
    return text if probe.get(error) is None or interval(probe.get(key)) else f"{text} ± {rounded(probe[error], unit)}"


def _turn(probe):
    """Angle from the stress's to the fabric's major direction, in [-90, 90): directions have no sense."""
    if probe.get("fabric_to_stress_deg") is not None:
        return rounded(probe["fabric_to_stress_deg"], "°")
    stress, fabric = plain(probe.get("direction_deg")), plain(probe.get("fabric_direction_deg"))
    return ABSENT if stress is None or fabric is None else rounded((fabric - stress + 90) % 180 - 90, "°")


def differences(increment):
    """Zone minus packs, of the grains."""
    rows = [[f"{row.get('of', '')} − {row.get('and', '')}", rounded(row.get("t_over_s"), ""),
             rounded(row.get("anisotropy"), ""), rounded(row.get("direction_deg"), "°"), row.get("verdict") or ""]
            for row in increment.panel("discrete").get("probe_differences") or []]
    return {"head": ["difference, grains", "t/s", "anisotropy", "direction of σ₁", "verdict"], "rows": rows} if rows else None


def grain_pressures(increment):
    """Dispersion of the pressure of single grains in each probe."""
    rows = []
    for probe in increment.panel("discrete").get("probes") or []:
        spread = probe.get("grain_pressure")
        if spread:
            percentiles = spread.get("percentiles") or {}
            rows.append([probe.get("name", ""), rounded(spread.get("mean"), " P"), rounded(spread.get("deviation"), " P")]
                        + [rounded(percentiles.get(p), " P") for p in PERCENTILES])
    return {"head": ["pressure of single grains", "mean", "standard deviation"] + [f"{p} %" for p in PERCENTILES],
            "rows": rows} if rows else None


def stress_difference(increment):
    """Cells, 3 d, 6 d: difference of the stress beside what sampling alone would give; the verdict is the caption."""
    difference = increment.record.get("difference") or {}
    rows = [[row.get("label", ""), rounded(row.get("resolution_d"), " d"), rounded(row.get("relative_l2"), "%", 1),
             rounded(row.get("sampling_alone"), "%", 1), rounded(row.get("direction_deg"), "°")]
            for row in difference.get("stress") or []]
    if not rows and difference.get("stress_l2_relative") is not None:
        rows = [["cells", ABSENT, rounded(difference["stress_l2_relative"], "%", 1), ABSENT, ABSENT]]
    return {"head": ["averaged over", "size", "difference (L2), continuum − grains", "sampling of the grains alone",
                     "angle between principal directions (rms)"], "rows": rows} if rows else None


def mapping(result):
    """How well each stage's mapping kept its totals."""
    rows = [[result.progress.text(stage.end), str(kept.get("method", "")), number(kept.get("total_relative_error"), "", 2),
             number(kept.get("nodal_residual"), "", 2), rounded(kept.get("outside_share"), "%", 2)]
            for stage in result.stages for kept in [stage.record.get("mapping") or {}] if kept]
    return {"head": [result.progress.word, "method", "error of the total", "nodal residual", "from outside the mesh"],
            "rows": rows} if rows else None


def dissipation(increment):
    rows = []
    for panel, words in PANEL_NAMES.items():
        found = increment.panel(panel).get("dissipation")
        if found:
            rows.append([words, rounded(found.get("share_inside"), "%", 1), rounded(found.get("area_share"), "%", 1),
                         _density(found)])
    return {"head": ["dissipation since the stage before (grains: friction and impacts; continuum: plastic work)", "inside the grains' band", "the band's share of the area",
                     "dissipated per area, inside over outside"], "rows": rows} if rows else None


def _density(found):
    share, area = plain(found.get("share_inside")), plain(found.get("area_share"))
    if share is None or area is None or not 0 < area < 1 or share >= 1:
        return ABSENT
    return rounded((share / area) / ((1 - share) / (1 - area)), "", 2)


def chains(increment):
    """Major principal stress of single grains inside and outside the zone."""
    found = increment.panel("discrete").get("force_chains") or {}
    rows = [[f"{name} the band", number(part.get("grains")), rounded(part.get("mean"), ""),
             rounded(part.get("share_above_mean"), "%", 1)]
            for name in ("inside", "outside") for part in [found.get(name) or {}] if part]
    if rows and found.get("largest_distance") is not None:
        rows.append(["largest distance of the two distributions", "", rounded(found["largest_distance"], ""), ""])
    return {"head": ["major principal stress of a grain", "grains", "mean, relative", "share above the mean"],
            "rows": rows} if rows else None


def chains_verdict(increment):
    return (increment.panel("discrete").get("force_chains") or {}).get("verdict") or ""
