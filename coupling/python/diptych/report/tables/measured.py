# diptych: tables of panels beside a measurement
# SPDX-License-Identifier: LGPL-2.1-or-later

from ...thickness import CONVENTIONS
from ..data.numbers import plain
from ..data.panels import DIFFUSE, DIFFUSE_ZONE, PANE_NAMES, PANEL_NAMES
from .wording import number, rounded, suffix

BAND = {"angle_deg": ("inclination", "°"), "width_10_90_d": ("10–90 % width", " d"), "offset_d": ("offset", " d"),
        "jump": ("jump", "")}
STRAIN = {"volumetric_strain": "volumetric strain", "shear_strain": "shear strain"}


def summary(record):
    """The first numbers of all panes, from levelled.json."""
    panes = [pane for pane in PANE_NAMES if any(plain(row[pane]) is not None for row in record["summary"])]
    rows = [[row["quantity"], *("–" if plain(row[pane]) is None else number(row[pane], suffix(row["unit"]), 3)
                                for pane in panes)] for row in record["summary"]]
    return {"head": ["", *(PANE_NAMES[pane].lower() for pane in panes)], "rows": rows}


def _columns(window):
    """(name, pane) of every field in which bands were searched, the measurement first."""
    panels = [panel for panel in PANEL_NAMES if panel in window["unblurred"]]
    return [(PANE_NAMES["measured"], window["levelled"]["measured"]),
            *((f"{PANEL_NAMES[panel]}, levelled", window["levelled"][panel]) for panel in panels),
            *((PANEL_NAMES[panel], window["unblurred"][panel]) for panel in panels)]


def bands(window):
    """Mean strains and the strongest band of every pane, levelled and not, and the differences from the measurement."""
    columns = _columns(window)
    strongest = [(pane["bands"] or [None])[0] for _, pane in columns]
    rows = [[title, *(rounded(pane[key], "%") for _, pane in columns)] for key, title in STRAIN.items()]
    rows += [[title, *(_cell(band, key, unit) for band in strongest)] for key, (title, unit) in BAND.items()]
    for panel in [panel for panel in PANEL_NAMES if panel in window["difference"]]:
        found = window["difference"][panel]
        columns.append((f"{PANEL_NAMES[panel]} − measurement", None))
        units = {**dict.fromkeys(STRAIN, "%"), **{key: unit for key, (_, unit) in BAND.items()}}
        for row, (key, unit) in zip(rows, units.items()):
            row.append("–" if plain(found.get(key)) is None else rounded(found[key], unit))
    return {"head": ["", *(name for name, _ in columns)], "rows": rows}


def _cell(band, key, unit):
    if band is None:
        return DIFFUSE if key == "angle_deg" else "–"
    if key == "angle_deg" and band["diffuse"]:
        return DIFFUSE_ZONE
    if key == "width_10_90_d" and "unresolved" in band:
        return "not resolved"
    return "–" if plain(band[key]) is None else rounded(band[key], unit, 2 if key == "jump" else None)


def thickness_of(window, pane):
    """The thickness of the strongest levelled band of a pane [d]; {} without one that is resolved."""
    bands = window["levelled"].get(pane, {}).get("bands")
    return bands[0]["thickness_d"] if bands else {}


def thickness(window):
    """The thickness of the strongest band by every convention, levelled; {} without a band that is resolved."""
    found = {pane: thickness_of(window, pane) for pane in PANE_NAMES if thickness_of(window, pane)}
    rows = [[title, words, f"{over_delta:.2f} δ", *(rounded(values[key], " d") for values in found.values())]
            for key, (title, words, over_delta) in CONVENTIONS.items()]
    return {"head": ["thickness", "definition", "of a tanh profile", *(PANE_NAMES[pane] for pane in found)],
            "rows": rows} if found else {}


def notes(record, window):
    """Sentences below the tables."""
    unresolved = [f"{PANE_NAMES[pane]}: {band['unresolved']}." for pane, one in window["levelled"].items()
                  for band in one["bands"] if "unresolved" in band]
    blur = " Levelled: averaged over the same squares." if window["unblurred"] else ""
    spacing, subset, finest = (number(record[name + "_d"], " d") for name in ("spacing", "subset", "resolution"))
    return [f"{window['points']} points every {spacing}, each the mean over a square of {subset}.{blur} No band below "
            f"{finest} is resolved.", *unresolved]
