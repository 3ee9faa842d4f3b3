# diptych: tables of bands and of stages
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A table is {"head": [...], "rows": [[...]]}. The first entry of a row is its name. A head may be (text, small
print)."""

from ..data.numbers import interval, plain
from ..data.panels import DIFFUSE, DIFFUSE_ZONE, PANEL_NAMES, THEORY
from .wording import MESH_SET, number, rounded, shown

BAND_KEYS = ("angle_deg", "width_10_90_d", "half_width_d", "offset_d", "jump", "dilation_deg", "r_squared",
             "r_squared_strips")


def bands(result, increment):
    """Bands of both panels for one increment: one column per band, then the difference continuum - grains."""
    columns = []
    for panel, heading in PANEL_NAMES.items():
        found = increment.bands(panel)
        for k, band in enumerate(found or [DIFFUSE]):
            name = DIFFUSE_ZONE if found and band.get("diffuse") else f"band {k + 1}" if len(found) > 1 else ""
            columns.append((f"{heading}, {name}" if name else heading, band))
    place = increment.place("discrete/bands")
    rows = [[result.numbers.meaning(f"{place}/{key}")]
            + [_band_cell(result, band, f"{place}/{key}") for _, band in columns]
            for key in BAND_KEYS]
    head = [("", "")] + [(heading, "") for heading, _ in columns]
    difference = {k: v for k, v in increment.panel("difference").items() if plain(v) is not None}
    if any(key in difference for key in BAND_KEYS):
        head.append(("Difference", ""))
        for row, key in zip(rows, BAND_KEYS):
            row.append(shown(result.numbers, f"{place}/{key}", difference[key]) if key in difference else "–")
    return {"head": head, "rows": rows}


def _band_cell(result, band, place):
    key = place.rsplit("/", 1)[-1]
    if isinstance(band, str):
        return band if key == BAND_KEYS[0] else "–"
    if key == BAND_KEYS[0] and band.get("diffuse"):
        return DIFFUSE_ZONE
    return shown(result.numbers, place, band.get(key))


def notes(result, increment):
    """Sentences below the bands: width, theory lines and measured angles, verdict of the detector, bootstrap
    samples."""
    verdicts = [(name.lower(), increment.panel(panel).get("band_verdict")) for panel, name in PANEL_NAMES.items()]
    verdicts = [f"{name}: {verdict}" for name, verdict in verdicts if verdict]
    found = [f"Detector – {'; '.join(verdicts)}."] if verdicts else []
    every = [band for panel in PANEL_NAMES for band in increment.bands(panel)]
    misfit = increment.panel("continuum").get("band_misfit")
    samples = {band["resamples"] for band in every if band.get("resamples")}
    if any(interval(band.get("angle_deg")) for band in every):
        found.append("In brackets: 95 % intervals by block bootstrap" + (
            f" with {'/'.join(map(str, sorted(samples)))} samples" if samples else "")
            + ". The continuum has none: nothing in it is random. Its fit leaves "
            f"{number(misfit, '%', 2)} of the platen’s displacement (root mean square). Difference: continuum − "
            "grains; for inclinations the rotation from the band of the grains to that of the continuum, positive "
            "anticlockwise.")
    lost = round(100 * max((plain(band.get("lost_share")) or 0.0 for band in every), default=0.0))
    if lost > 0:
        found.append(f"In {lost} % of the bootstrap samples no band was found; the interval is based on the other "
                     f"{100 - lost} %.")
    return _thickness(result, increment) + _theory(result, increment) + found


def _thickness(result, increment):
    """The cause of the width of the band in the continuum, and its value on the coarse mesh."""
    size = plain(result.part("continuum_summary").get("element_size_d"))
    text = f"Width of the band in the continuum: {thickness_note(result)}" + (
        f"; elements of {number(size, ' d')}" if size is not None else "")
    coarse = result.part("continuum_coarse")
    same = [w for w in coarse.get("windows") or [] if increment.kind == "window"
            and abs(w["from"] - increment.start) < 1e-6 and abs(w["to"] - increment.end) < 1e-6]
    if same:
        text += f". On the coarse mesh with elements of {number(coarse.get('element_size_d'), ' d')}: " + ("; ".join(
            f"{rounded(b.get('width_10_90_d'), ' d')} at {rounded(b.get('angle_deg'), '°')}"
            for b in same[0].get("bands") or []) or DIFFUSE)
    return [text + "."]


def _theory(result, increment):
    angles = []
    for panel, name in PANEL_NAMES.items():
        known = [band["to_minor_stress_deg"] for band in increment.bands(panel)
                 if plain(band.get("to_minor_stress_deg")) is not None]
        if known:
            angles.append(f"{name.lower()} " + "; ".join(rounded(angle, "°") for angle in known))
    theory = result.part("theory")
    lines = [f"{' '.join(line)} = {rounded(theory[key], '°')}" for key, line in THEORY.items()
             if plain(theory.get(key)) is not None]
    if not angles:
        return []
    return [f"Angle to the minor principal stress in the band: {', '.join(angles)}." + (
        f" Theory lines: {', '.join(lines)}." if lines else "")]


def internal_length(result):
    """Internal length of the continuum law [d], or None."""
    length = plain(result.part("continuum_summary").get("internal_length_d"))
    return length if length is not None and length > 0 else None


def thickness_note(result):
    """The cause of the width of the band in the continuum."""
    length = internal_length(result)
    return MESH_SET if length is None else f"internal length {number(length, ' d')}"


def stages(result):
    """The comparison as two tables of readable width: stress and volume; bands. The program computed the
    differences."""
    stress = {"head": [result.loading_variable.word, "t/s, grains", "t/s, continuum", "difference",
                       "volumetric strain, grains", "volumetric strain, continuum", "difference"], "rows": []}
    inclined = {"head": [result.loading_variable.word, "inclination, grains", "inclination, continuum", "difference",
                         "10–90 % width, grains", ("10–90 % width, continuum", thickness_note(result)), "difference",
                         "R², grains", "R², continuum"],
                "rows": []}
    for stage in result.stages:
        difference = stage.panel("difference")
        row = [result.loading_variable.text(stage.end)]
        for key in ("stress_ratio", "volumetric_strain"):
            row += [shown(result.numbers, f"stages/discrete/{key}", stage.panel(source).get(key))
                    for source in (*PANEL_NAMES, "difference")]
        stress["rows"].append(row)
        row = [result.loading_variable.text(stage.end)]
        for key in ("angle_deg", "width_10_90_d"):
            change = difference.get(key)
            row += [_of_bands(result, stage, panel, key) for panel in PANEL_NAMES]
            row.append("–" if plain(change) is None else shown(result.numbers, f"stages/difference/{key}", change))
        inclined["rows"].append(row + [_of_bands(result, stage, panel, "r_squared") for panel in PANEL_NAMES])
    return [stress, inclined]


def _of_bands(result, stage, panel, key):
    texts = [_band_cell(result, band, f"stages/{panel}/bands/{key}") for band in stage.bands(panel)]
    return "; ".join(texts) or "diffuse"
