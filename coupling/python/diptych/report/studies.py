# diptych: a study as it is read, and the tables of its pages
# SPDX-License-Identifier: LGPL-2.1-or-later

import os
from dataclasses import dataclass

from ..arrays import ends_text, short
from ..files import read_json
from .charts.style import signed
from .data.files import open_arrays
from .tables.wording import number, suffix

PANELS = ("discrete", "continuum", "material_point")
PANEL_WORDS = {"discrete": "grains", "continuum": "continuum", "difference": "continuum − grains",
               "material_point": "material point", "comparison": ""}
CURVES = ("stress_ratio", "volumetric_strain")
# class: (colour, text colour, letter) in maps and tables
CLASSES = {"right": ("#b7e1cd", "#222222", "R"), "struggled": ("#e3f0b5", "#222222", "S"),
           "wrong, warned": ("#f6c99b", "#222222", "W"), "silently wrong": ("#d55e00", "white", "X"),
           "stopped": ("#8d8d8d", "white", "!"), "refused": ("#cfcfcf", "#222222", "–"),
           "unjudged": ("#e8eef7", "#222222", "·"), "not run": ("white", "#222222", "?")}


@dataclass(kw_only=True)
class Study:
    """cost: of the finished points, by index in record["points"]. curves: {panel: (progress, {name: rows of
    points})}."""

    folder: str
    record: dict
    bill: dict
    cost: dict
    curves: dict

    @property
    def quantities(self):
        return self.record["quantities"]

    @property
    def points(self):
        return self.record["points"]

    def family(self, name):
        return next(f for f in self.record["families"] if f["name"] == name)

    def of_family(self, name):
        """[(index, point)] of a family, without references."""
        return [(k, point) for k, point in enumerate(self.points) if point["family"] == name
                and not self.is_reference(k)]

    @property
    def has_reference(self):
        """False: the study reports values and judges none."""
        return "reference" in self.points[0]

    def is_reference(self, place):
        return self.points[place].get("reference") == place

    @property
    def references(self):
        """Indices of the references."""
        return [k for k in range(len(self.points)) if self.is_reference(k)]

    def name(self, place):
        """"nscd: step 0.4, tolerance 1e-05"."""
        point = self.points[place]
        if self.is_reference(place):
            return "reference" + (": " + ", ".join(point["labels"]) if point["labels"] else "")
        axes = [axis["name"] for axis in self.family(point["family"])["axes"]]
        setting = ", ".join(f"{axis} {label}" for axis, label in zip(axes, point["labels"]))
        return ": ".join(text for text in (point["family"], setting) if text)


def load(folder):
    """The study of a folder. Raises InputError if a file is missing, broken or has another format."""
    record, bill = (read_json(os.path.join(folder, name), 1) for name in ("study.json", "study_cost.json"))
    return Study(folder=folder, record=record, bill=bill, cost={c["point"]: c for c in bill["points"]},
                 curves=_curves(os.path.join(folder, "study.h5")))


def _curves(path):
    if not os.path.isfile(path):
        return {}
    with open_arrays(path) as file:
        panels = [panel for panel in PANELS if panel in file]
        return {panel: (file[panel]["progress"][()], {name: file[panel][name][()] for name in CURVES})
                for panel in panels}


def share(value, relative):
    """An error with sign and without unit: "+3.4" for a relative one of 0.034 (per cent), or three digits."""
    return signed(f"{100 * value:+.1f}" if relative else f"{value:+.3g}")


def with_ends(error, relative):
    """"+3.4 [+2.1, +4.7] %"."""
    if error["value"] is None:
        return "–"
    ends = ends_text(error["low"], error["high"], lambda end: share(end, relative))
    return share(error["value"], relative) + ends + ("\u00a0%" if relative else "")


def unit_of(quantity):
    """" (d)" behind the label of an axis, or ""."""
    unit = suffix(quantity["unit"]).strip()
    return f" ({unit})" if unit else ""


def seconds(value):
    return "–" if value is None else f"{value:.3g}\u00a0s"


def accuracy_of(study, row):
    if not row["quantity"]:
        return f"{row['accuracy']:g} × every limit"
    relative = next(q["relative"] for q in study.quantities if q["name"] == row["quantity"])
    return share(row["accuracy"], relative).lstrip("+") + ("\u00a0%" if relative else "")


def cheapest(study):
    """One row per quantity and accuracy: [text, accuracy, point, seconds, errors, sure or not]."""
    rows = []
    for row in study.bill["cheapest"]:
        known = row["point"] >= 0
        errors = study.points[row["point"]]["quantities"] if known else []
        text = "; ".join(f"{of['name']} {with_ends(q['error'], of['relative'])}"
                         for q, of in zip(errors, study.quantities)
                         if of["limit"] and row["quantity"] in ("", of["name"]))
        sure = "–" if not known else "yes" if row["certain"] else "no, within the scatter of the samples"
        reference = ", ".join(study.points[row["reference"]]["labels"])
        rows.append([(row["quantity"] or "all with a limit") + (f" ({reference})" if reference else ""),
                     accuracy_of(study, row), study.name(row["point"]) if known else "none of these",
                     seconds(row["cpu_s"]), text or "–", sure])
    return {"head": ["quantity", "error at most", "cheapest point", "CPU per sample", "error [95 %]", "sure"],
            "rows": rows}


def points(study):
    """One row per point: name, class, errors, cost, messages."""
    rows = []
    for k, point in enumerate(study.points):
        cost = study.cost.get(k)
        messages = [point["words"]] if point["words"] else []
        if point["warned"]:
            messages.append(f"warned in {point['warned']} of {len(point['folders'])}")
        if point["halved_steps"]:
            messages.append(f"{point['halved_steps']} steps halved")
        if point["cut_backs"]:
            messages.append(f"{point['cut_backs']:g} load steps halved")
        log = point["folders"][0] + ".log"
        rows.append({"place": k, "name": study.name(k), "messages": "; ".join(messages),
                     "cost": seconds(cost["cpu_s"] if cost else None),
                     "log": log if os.path.isfile(os.path.join(study.folder, log)) else ""})
        if study.has_reference:
            colour, ink, _ = CLASSES[point["class"]]
            rows[-1].update(kind=point["class"], sure=point["certain"], colour=colour, ink=ink,
                            errors=[with_ends(q["error"], of["relative"])
                                    for q, of in zip(point["quantities"], study.quantities)])
    return rows


def orders(study):
    rows = []
    for row in study.record["orders"]:
        others = ", ".join(f"{axis['name']} {label}"
                           for axis, label in zip(study.family(row["family"])["axes"], row["labels"]) if label)
        rows.append([row["quantity"], f"{row['family']}: {row['axis']}".lstrip(": "), others or "–", row["points"],
                     _interval(row["order"], short), _interval(row["limit"], "{:.4g}".format)])
    return {"head": ["quantity", "along", "at", "points", "order [95 %]", "limit [95 %]"], "rows": rows}


def _interval(record, form):
    return signed(form(record["value"]) + ends_text(record["low"], record["high"], form))


def counts(study):
    """"7 right, 3 silently wrong"."""
    found = {}
    for k, point in enumerate(study.points):
        if study.is_reference(k):
            continue
        found[point["class"]] = found.get(point["class"], 0) + 1
    return ", ".join(f"{found[kind]} {kind}" for kind in CLASSES if kind in found)


def disturbed(study):
    """A warning about the CPU times, or ""."""
    if not study.bill["disturbed"]:
        return ""
    return (f"During {study.bill['disturbed']} of {study.bill['runs']} runs other programs used the machine. "
            "The CPU times of these runs may be too large.")


def provenance(study):
    record, bill, seeds = study.record, study.bill, study.record["seeds"]
    return {"head": ["", ""], "rows": [
        ["scene", record["scene"]], ["command", "diptych " + record["command"]],
        ["settings of all points", "; ".join(record["settings"]) or "those of the scene"],
        *([["reference", "; ".join(study.points[0]["settings"]) or "the unchanged scene"]] * study.has_reference),
        ["samples", f"{len(seeds)}: seeds {', '.join(map(str, seeds))}" if seeds else "the sample of the scene"],
        ["program", record["revision"]], ["phases counted", ", ".join(bill["phases"])],
        ["all runs", f"{bill['runs']} runs, {number(bill['total_cpu_s'])} CPU seconds"]]}
