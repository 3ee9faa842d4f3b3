# diptych: tables of a study without a reference: means and changes
# SPDX-License-Identifier: LGPL-2.1-or-later

from diptych_report.tables.wording import number, suffix, typeset

PANEL_WORDS = {"discrete": "grains", "continuum": "continuum", "difference": "continuum − grains", "material_point": "material point",
               "comparison": ""}


def changes(study):
    """One row per quantity, panel and parameter: smallest and largest mean, change, verdict."""
    several = len({(row["family"], row["parameter"]) for row in study.record["changes"]}) > 1
    rows = []
    for row in study.record["changes"]:
        unit = suffix(row["unit"])
        verdict = row["verdict"]
        if verdict == "not resolved":
            verdict += f": needs about {row['samples_needed']} samples" if row["samples_needed"] else ": needs more than 1000 samples"
        where = [": ".join(filter(None, (row["family"], row["parameter"])))] if several else []
        ends = [f"{number(row[end], unit)} at {row[end + '_at']}" for end in ("smallest", "largest")]
        panel = "continuum − grains" if row["panel"] == "difference" else row["panel"]
        rows.append([typeset(row["quantity"]), panel, *where, *ends, number(row["change"], unit, 3), row["samples"], verdict])
    head = ["quantity", "panel", *(["parameter"] if several else []), "smallest mean", "largest mean", "change [95 %]", "samples", "verdict"]
    return {"head": head, "rows": rows}


def means(study, family, places):
    """One row per point: mean of each panel with its interval. places: {panel: index of the quantity}."""
    rows = []
    for k, point in study.of_family(family["name"]):
        rows.append([", ".join(point["labels"]) or study.name(k), *(_mean(point["quantities"][q], study.quantities[q]) for q in places.values())])
    return {"head": [", ".join(axis["name"] for axis in family["axes"]), *(PANEL_WORDS[panel] or "mean" for panel in places)], "rows": rows}


def _mean(found, quantity):
    if found["mean"] is None:
        return "none"
    text = number({"value": found["mean"], "low": found["low"], "high": found["high"]}, suffix(quantity["unit"]))
    n_missing = len(found["values"]) - found["n"]
    return text + (f" ({found['n']} of {len(found['values'])} samples)" if n_missing else "")


def label(quantity):
    """"10-90 % width of the band (d)"."""
    unit = suffix(quantity["unit"]).strip()
    return typeset(quantity["name"]) + (f" ({unit})" if unit else "")
