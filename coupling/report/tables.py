# diptych: every number of the report as rows of text
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A table is {"head": [...], "rows": [[...]]}; a row's first entry names it."""

from style import DIFFUSE, PANEL_NAMES
from wording import ABSENT, MESH_SET, NULLS, WORDS, number, rounded

LAW_KEYS = ("law", "law_parameters")

BAND_ROWS = (("inclination from the horizontal", "angle_deg", "°"), ("10–90 % width", "width_10_90_d", " d"),
             ("offset from the centre, along the normal", "offset_d", " d"), ("jump / |ΔU|", "jump", ""),
             ("dilation angle", "dilation_deg", "°"), ("R² of the fit, all points", "r_squared", ""),
             ("R² of the fit, means of 16 strips", "r_squared_strips", ""))

def bands(result, increment):
    """Bands of both panels and of the coarse mesh for one increment: one column a band."""
    size = result.comparison.get("continuum_summary", {}).get("element_size_d")
    columns = [(PANEL_NAMES["discrete"], "", increment.panel("discrete").get("bands")),
               (PANEL_NAMES["continuum"], "" if size is None else f"elements of {number(size, ' d')}",
                increment.panel("continuum").get("bands"))]
    if increment.kind == "window":
        coarse = result.comparison.get("continuum_coarse") or {}
        same = [w for w in coarse.get("windows") or []
                if abs(w["from"] - increment.start) < 1e-9 and abs(w["to"] - increment.end) < 1e-9]
        columns.append(("Continuum, coarse mesh", f"elements of {number(coarse.get('element_size_d'), ' d')}",
                        same[0].get("bands") if same else None))
    flat = []
    for heading, elements, found in columns:
        if not found:
            flat.append((heading, elements, DIFFUSE if found is not None else ABSENT))
        for k, band in enumerate(found or []):
            flat.append((heading + (f", band {k + 1}" if len(found) > 1 else ""), elements, band))
    note = thickness_note(result)
    rows = []
    for words, key, unit in BAND_ROWS:
        cells = []
        for heading, _, band in flat:
            if isinstance(band, str):
                cells.append(band if key == BAND_ROWS[0][1] else "–")
                continue
            text = rounded(band.get(key), unit)
            if key == "width_10_90_d" and heading.startswith("Continuum"):
                text += f" – {note}"
            cells.append(text)
        rows.append([words] + cells)
    head = [("", "")] + [(heading, elements) for heading, elements, _ in flat]
    difference = {k: v for k, v in (increment.record.get("difference") or {}).items() if v is not None}
    if any(key in difference for _, key, _ in BAND_ROWS):
        at = 1 + sum(not heading.startswith("Continuum, coarse") for heading, _, _ in flat)
        head.insert(at, ("Difference", "continuum − grains; angle between the lines"))
        for row, (_, key, unit) in zip(rows, BAND_ROWS):
            row.insert(at, rounded(difference[key], unit) if key in difference else "–")
    return {"head": head, "rows": rows}


def verdicts(increment):
    """What the band detector says of each panel, in its own words; empty if it does not."""
    said = [(words, increment.panel(panel).get("band_verdict")) for panel, words in PANEL_NAMES.items()]
    return "; ".join(f"{words.lower()}: {verdict}" for words, verdict in said if verdict)


def internal_length(result):
    """Of the continuum's law [d]; None where it has none."""
    summary = result.comparison.get("continuum_summary") or {}
    values = [summary.get("internal_length_d")] + [(summary.get(k) or {}).get("internal_length") for k in LAW_KEYS
                                                    if isinstance(summary.get(k), dict)]
    return next((v for v in values if isinstance(v, (int, float)) and v > 0), None)


def thickness_note(result):
    """What sets the thickness of the continuum's band."""
    length = internal_length(result)
    return MESH_SET if length is None else f"internal length {number(length, ' d')}"


def stages(result):
    """The comparison table, as two of readable width: stress and volume; bands. Differences are the program's own."""
    stress = {"head": ["axial strain", "t/s, grains", "t/s, continuum", "difference", "volumetric strain, grains",
                       "volumetric strain, continuum", "difference", "stress on cells, L2 difference",
                       "mapping: error of the total", "mapping: nodal residual", "mapping: from outside"], "rows": []}
    bands = {"head": ["axial strain", "inclination, grains", "inclination, continuum", "angle between",
                      "10–90 % width, grains", "10–90 % width, continuum", "difference", "R², grains",
                      "R², continuum"], "rows": []}
    bands["head"][5] = (bands["head"][5], thickness_note(result))
    for stage in result.stages:
        panels = stage.panel("discrete"), stage.panel("continuum")
        difference, mapping = stage.record.get("difference") or {}, stage.record.get("mapping") or {}
        row = [number(stage.end, "%")]
        for key, unit in (("stress_ratio", ""), ("volumetric_strain", "%")):
            row += [rounded(source.get(key), unit) for source in (*panels, difference)]
        stress["rows"].append(row + [rounded(difference.get("stress_l2_relative"), "%", 0),
                                     number(mapping.get("total_relative_error"), "", 2),
                                     number(mapping.get("nodal_residual"), "", 2),
                                     rounded(mapping.get("outside_share"), "%", 1)])
        row = [number(stage.end, "%")]
        for key, unit in (("angle_deg", "°"), ("width_10_90_d", " d")):
            row += [_of_bands(stage, panel, key, unit) for panel in PANEL_NAMES] + [_or_dash(difference.get(key), unit)]
        bands["rows"].append(row + [_of_bands(stage, panel, "r_squared", "") for panel in PANEL_NAMES])
    return [stress, bands]


def _of_bands(stage, panel, key, unit):
    found = stage.panel(panel).get("bands")
    if found is None:
        return ABSENT
    return "; ".join(rounded(band.get(key), unit) for band in found) or "diffuse"


def _or_dash(value, unit):
    return "–" if value is None else rounded(value, unit)


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
    return text if probe.get(error) is None else f"{text} ± {rounded(probe[error], unit)}"


def _turn(probe):
    """Angle from the stress's to the fabric's major direction, in [-90, 90): directions have no sense."""
    stress, fabric = probe.get("direction_deg"), probe.get("fabric_direction_deg")
    if not isinstance(stress, (int, float)) or not isinstance(fabric, (int, float)):
        return ABSENT
    return rounded((fabric - stress + 90) % 180 - 90, "°")


def summary(values):
    """Words, number, what to hold it against; keys without words here are shown under their own name."""
    rows = []
    order = list(WORDS)
    values = values or {}
    for key in sorted(values, key=lambda name: order.index(name) if name in WORDS else len(order)):
        value = values[key]
        if key in LAW_KEYS or value == "" or (isinstance(value, (dict, list)) and "value" not in value):
            continue
        words, unit, expected = WORDS.get(key, (key.replace("_", " "), "", ""))
        rows.append([words, NULLS[key] if value is None and key in NULLS else number(value, unit), expected])
    return {"head": ["", "value", "hold against"], "rows": rows}
