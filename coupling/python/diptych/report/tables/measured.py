# diptych: tables of panels beside a measurement
# SPDX-License-Identifier: LGPL-2.1-or-later

from ...thickness import CONVENTIONS
from ..data.numbers import plain
from ..data.panels import DIFFUSE, DIFFUSE_ZONE, PANE_NAMES, PANEL_NAMES
from .wording import number, rounded, suffix

# key of a pane or of its strongest band -> name and unit
ROWS = {"volumetric_strain": ("volumetric strain", "%"), "shear_strain": ("shear strain", "%"),
        "angle_deg": ("inclination", "°"), "width_10_90_d": ("10–90 % width", " d"), "offset_d": ("offset", " d"),
        "jump": ("jump", "")}


def summary(record):
    """The first numbers of all panes, from levelled.json."""
    panes = [pane for pane in PANE_NAMES if any(plain(row[pane]) is not None for row in record["summary"])]
    rows = [[row["quantity"], *("–" if plain(row[pane]) is None else number(row[pane], suffix(row["unit"]), 3)
                                for pane in panes)] for row in record["summary"]]
    return {"head": ["", *(PANE_NAMES[pane].lower() for pane in panes)], "rows": rows}


def bands(window):
    """Mean strains and the strongest band of every pane, levelled and not, and the differences from the measurement."""
    levelled, unblurred, difference = window["levelled"], window["unblurred"], window["difference"]
    panels = {panel: name for panel, name in PANEL_NAMES.items() if panel in unblurred}
    panes = [levelled["measured"], *(levelled[panel] for panel in panels), *(unblurred[panel] for panel in panels)]
    rows = [[name, *(_cell(pane, key, unit) for pane in panes),
             *(_shown(difference[panel], key, unit) for panel in panels)] for key, (name, unit) in ROWS.items()]
    return {"head": ["", PANE_NAMES["measured"], *(f"{name}, levelled" for name in panels.values()), *panels.values(),
                     *(f"{name} − measurement" for name in panels.values())], "rows": rows}


def _cell(pane, key, unit):
    band = pane["bands"][0] if pane["bands"] else {}
    if key == "angle_deg" and not band:
        return DIFFUSE
    if key == "angle_deg" and band["diffuse"]:
        return DIFFUSE_ZONE
    if key == "width_10_90_d" and "unresolved" in band:
        return "not resolved"
    return _shown({**band, **pane}, key, unit)


def _shown(numbers, key, unit):
    return "–" if plain(numbers.get(key)) is None else rounded(numbers[key], unit)


def thickness(window):
    """The thickness of the strongest band by every convention, levelled; {} without a band that is resolved."""
    found = {pane: bands[0]["thickness_d"] for pane in PANE_NAMES if pane in window["levelled"]
             and (bands := window["levelled"][pane]["bands"]) and bands[0]["thickness_d"]}
    rows = [[title, words, f"{over_delta:.2f} δ", *(_shown(values, key, " d") for values in found.values())]
            for key, (title, words, over_delta) in CONVENTIONS.items()]
    return {"head": ["thickness", "definition", "of a tanh profile", *(PANE_NAMES[pane] for pane in found)],
            "rows": rows} if found else {}


def notes(record, window):
    """Sentences below the tables."""
    unresolved = [f"{PANE_NAMES[pane]}: {band['unresolved']}." for pane, one in window["levelled"].items()
                  for band in one["bands"] if "unresolved" in band]
    blur = " Levelled: averaged over the same squares." if window["unblurred"] else ""
    spacing, subset, finest = (number(record[name + "_d"], " d") for name in ("spacing", "subset", "resolution"))
    of = f"the mean over a square of {subset}" if record["subset_d"] else "followed by itself"
    return [f"{window['points']} points every {spacing}, each {of}.{blur} No band below {finest} is resolved.",
            *unresolved]
