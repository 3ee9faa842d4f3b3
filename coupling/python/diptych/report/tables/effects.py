# diptych: tables of a study without a reference: means and changes
# SPDX-License-Identifier: LGPL-2.1-or-later

from .wording import number, suffix, typeset

PANEL_WORDS = {"discrete": "grains", "continuum": "continuum", "difference": "continuum − grains",
               "material_point": "material point", "comparison": ""}


def changes(study):
    """One row per quantity, panel and parameter: verdict, change, smallest and largest mean."""
    several = len({(row["family"], row["parameter"]) for row in study.record["changes"]}) > 1
    head = ["quantity", "panel", *(["parameter"] if several else []), "verdict", "change [95 %]", "smallest mean",
            "largest mean", "samples"]
    rows = []
    for row in study.record["changes"]:
        where = [": ".join(filter(None, (row["family"], row["parameter"])))] if several else []
        panel = "continuum − grains" if row["panel"] == "difference" else row["panel"]
        rows.append([typeset(row["quantity"]), panel, *where, _verdict(row), *_ends(study, row), row["samples"]])
    return {"head": head, "rows": rows}


def _verdict(row):
    if row["verdict"] != "not resolved":
        return row["verdict"]
    needed = f"about {row['samples_needed']}" if row["samples_needed"] else "more than 1000"
    return f"not resolved: needs {needed} samples"


def _ends(study, row):
    """Change, smallest and largest mean. The means of a few complete samples would not be those of the charts."""
    unit = suffix(row["unit"])
    if row["verdict"] == "no change":
        return "0", number(row["smallest"], unit), number(row["smallest"], unit)
    if row["samples"] < min(2, len(study.record["seeds"]) or 1):
        return "–", "–", "–"
    means = (f"{number(row[end], unit)} at {row[end + '_at']}" for end in ("smallest", "largest"))
    return number(row["change"], unit, 3), *means


def means(study, family, places):
    """One row per point: mean of each panel with its interval. places: {panel: index of the quantity}."""
    rows = []
    for k, point in study.of_family(family["name"]):
        rows.append([", ".join(point["labels"]) or study.name(k),
                     *(_mean(point["quantities"][q], study.quantities[q]) for q in places.values())])
    return {"head": [", ".join(axis["name"] for axis in family["axes"]),
                     *(PANEL_WORDS[panel] or "mean" for panel in places)], "rows": rows}


def _mean(found, quantity):
    if found["mean"] is None:
        return "none"
    text = number({"value": found["mean"], "low": found["low"], "high": found["high"]}, suffix(quantity["unit"]))
    n_missing = len(found["values"]) - found["n"]
    return text + (f" ({found['n']} of {len(found['values'])} samples)" if n_missing else "")


def unit_of(quantity):
    """" (d)" behind the label of an axis, or ""."""
    unit = suffix(quantity["unit"]).strip()
    return f" ({unit})" if unit else ""
