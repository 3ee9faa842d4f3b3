# diptych: bands and stages as rows of text
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A table is {"head": [...], "rows": [[...]]}; a row's first entry names it; a head may be (words, small print)."""

from increments import interval, plain
from style import DIFFUSE, PANEL_NAMES
from trends import THEORY, minor_direction
from wording import ABSENT, MESH_SET, NULLS, WORDS, number, rounded

LAW_KEYS = ("law", "law_parameters")

BAND_ROWS = (("inclination", "angle_deg", "°"), ("10–90 % width", "width_10_90_d", " d"), ("width 2 δ", "half_width_d", " d"),
             ("offset from centre", "offset_d", " d"), ("jump / |ΔU|", "jump", ""), ("dilation angle", "dilation_deg", "°"),
             ("R² points; strips", "r_squared", ""))


def bands(result, increment):
    """Bands of both panels for one increment: one column a band, then the difference continuum - grains."""
    flat = []
    for panel, heading in PANEL_NAMES.items():
        found = increment.panel(panel).get("bands")
        for k, band in enumerate(found or [DIFFUSE if found is not None else ABSENT]):
            flat.append((f"{heading}, band {k + 1}" if len(found or []) > 1 else heading, band))
    rows = [[words] + [_band_cell(band, key, unit) for _, band in flat] for words, key, unit in BAND_ROWS]
    head = [("", "")] + [(heading, "") for heading, _ in flat]
    difference = {k: v for k, v in (increment.record.get("difference") or {}).items() if v is not None}
    if any(key in difference for _, key, _ in BAND_ROWS):
        head.append(("Difference", ""))
        for row, (_, key, unit) in zip(rows, BAND_ROWS):
            row.append(rounded(difference[key], unit) if key in difference else "–")
    return {"head": head, "rows": rows}


def _thickness(result, increment):
    """What sets the thickness of the continuum's band, and its value on the other mesh."""
    size = plain((result.comparison.get("continuum_summary") or {}).get("element_size_d"))
    text = f"Thickness of the continuum's band: {thickness_note(result)}" + (
        f"; elements of {number(size, ' d')}" if size is not None else "")
    coarse = result.comparison.get("continuum_coarse") or {}
    same = [w for w in coarse.get("windows") or [] if increment.kind == "window"
            and abs(w["from"] - increment.start) < 1e-9 and abs(w["to"] - increment.end) < 1e-9]
    if same:
        bands = same[0].get("bands") or []
        text += f". On the coarse mesh, elements of {number(coarse.get('element_size_d'), ' d')}: " + ("; ".join(
            f"{rounded(b.get('width_10_90_d'), ' d')} at {rounded(b.get('angle_deg'), '°')}" for b in bands) or DIFFUSE)
    return [text + "."]


def _band_cell(band, key, unit):
    if isinstance(band, str):
        return band if key == BAND_ROWS[0][1] else "–"
    if key == "half_width_d":
        return rounded(_doubled(band.get(key)), unit)
    if key == "r_squared" and band.get("r_squared_strips") is not None:
        return f"{rounded(band.get(key), unit)}; {rounded(band['r_squared_strips'], unit)}"
    return rounded(band.get(key), unit)


def _doubled(value):
    if isinstance(value, dict):
        return {k: _doubled(v) for k, v in value.items()}
    return None if plain(value) is None else 2 * value


def band_notes(result, increment):
    """Sentences under the bands: thickness, theory lines beside the measured angles, the detector's words, resamples."""
    said = [(words.lower(), increment.panel(panel).get("band_verdict")) for panel, words in PANEL_NAMES.items()]
    notes = ["Detector – " + "; ".join(f"{words}: {verdict}" for words, verdict in said if verdict) + "."] if any(
        verdict for _, verdict in said) else []
    samples = {band.get("resamples") for panel in PANEL_NAMES for band in increment.bands(panel) if band.get("resamples")}
    if any(interval(band.get("angle_deg")) for panel in PANEL_NAMES for band in increment.bands(panel)):
        notes.append("In brackets: 95 % intervals by block bootstrap" + (
            f", {'/'.join(map(str, sorted(samples)))} resamples" if samples else "") + ". Difference: continuum − grains; "
            "of inclinations the turn from the grains' line to the continuum's, anticlockwise positive.")
    lost = max((plain(b.get("lost_share")) or 0.0 for panel in PANEL_NAMES for b in increment.bands(panel)), default=0.0)
    if lost > 0:
        notes.append(f"In up to {rounded(lost, '%', 0)} of the resamples a band was lost: its interval holds for the rest.")
    return _thickness(result, increment) + _theory_note(result, increment) + notes


def _theory_note(result, increment):
    angles = []
    for panel, words in PANEL_NAMES.items():
        minor = minor_direction(increment, panel)
        turned = [] if minor is None else [abs((plain(b.get("angle_deg")) - minor + 90) % 180 - 90)
                                           for b in increment.bands(panel) if plain(b.get("angle_deg")) is not None]
        if turned:
            angles.append(f"{words.lower()} " + "; ".join(rounded(angle, "°") for angle in turned))
    theory = result.comparison.get("theory") or {}
    lines = [f"{label} = {rounded(theory[key], '°')}" for key, label, _ in THEORY if plain(theory.get(key)) is not None]
    if not angles:
        return []
    return [f"To the minor principal stress of the zone: {', '.join(angles)}." + (
        f" Theory lines: {', '.join(lines)}." if lines else "")]


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
    stress = {"head": [result.progress.word, "t/s, grains", "t/s, continuum", "difference", "volumetric strain, grains",
                       "volumetric strain, continuum", "difference"], "rows": []}
    inclined = {"head": [result.progress.word, "inclination, grains", "inclination, continuum", "turn",
                         "10–90 % width, grains", "10–90 % width, continuum", "difference", "R², grains",
                         "R², continuum"], "rows": []}
    inclined["head"][5] = (inclined["head"][5], thickness_note(result))
    for stage in result.stages:
        panels, difference = (stage.panel("discrete"), stage.panel("continuum")), stage.record.get("difference") or {}
        row = [result.progress.text(stage.end)]
        for key, unit in (("stress_ratio", ""), ("volumetric_strain", "%")):
            row += [rounded(source.get(key), unit) for source in (*panels, difference)]
        stress["rows"].append(row)
        row = [result.progress.text(stage.end)]
        for key, unit in (("angle_deg", "°"), ("width_10_90_d", " d")):
            row += [_of_bands(stage, panel, key, unit) for panel in PANEL_NAMES] + [_or_dash(difference.get(key), unit)]
        inclined["rows"].append(row + [_of_bands(stage, panel, "r_squared", "") for panel in PANEL_NAMES])
    return [stress, inclined]


def _of_bands(stage, panel, key, unit):
    found = stage.panel(panel).get("bands")
    if found is None:
        return ABSENT
    return "; ".join(rounded(band.get(key), unit) for band in found) or "diffuse"


def _or_dash(value, unit):
    return "–" if value is None else rounded(value, unit)


def summary(values):
    """Words, number, what to hold it against; keys without words here are shown under their own name."""
    rows = []
    order = list(WORDS)
    values = values or {}
    for key in sorted(values, key=lambda name: order.index(name) if name in WORDS else len(order)):
        value = values[key]
        ends = values.get(key + "_interval")
        if isinstance(ends, dict):
            value = {"value": value, **ends}
        if key in LAW_KEYS or value == "" or (isinstance(value, (dict, list)) and "value" not in value):
            continue
        words, unit, expected = WORDS.get(key, (key.replace("_", " "), "", ""))
        rows.append([words, NULLS[key] if value is None and key in NULLS else number(value, unit), expected])
    return {"head": ["", "value", "hold against"], "rows": rows}
