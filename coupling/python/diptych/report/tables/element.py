# diptych: tables of grains and of the law's point along one path
# SPDX-License-Identifier: LGPL-2.1-or-later

from .wording import ABSENT, rounded, suffix

NAMES = {"stress_ratio": "t/s", "mean_stress": "mean stress s", "volumetric_strain": "volumetric strain",
         "stress_direction": "direction of σ₁", "fabric_anisotropy": "anisotropy of the fabric",
         "fabric_direction": "direction of the fabric",
         "coordination": "contacts per grain", "solid_fraction": "solid fraction",
         **{"s" + c: "σ " + c for c in ("xx", "yy", "xy")}, **{"e" + c: "ε " + c for c in ("xx", "yy", "xy")}}


def _name(quantity):
    when, _, name = quantity.rpartition(" ")
    return " ".join(filter(None, [when, NAMES[name]]))


def _text(one, key):
    """A dash stands for a number that the law does not have."""
    unit = "%" if one["quantity"].endswith("volumetric_strain") else suffix(one["unit"])
    return rounded(one[key], unit).replace(ABSENT, "–")


def numbers(record):
    """One row per quantity: grains and difference with their 95 % intervals."""
    rows = [[_name(one["quantity"]), *(_text(one, key) for key in ("grains", "law", "difference"))]
            for one in record["quantities"]]
    return {"head": ["quantity", ("grains", "[95 %]"), "law", ("law − grains", "[95 %]")], "rows": rows}


def rms(record):
    """One row per quantity: rms of law − grains, its standard error, and the standard error of the grains."""
    rows = [[_name(one["quantity"]), *(_text(one, key) for key in ("value", "error", "noise"))]
            for one in record["rms"]]
    return {"head": ["quantity", ("law − grains", "rms"), ("its standard error", "jackknife"),
                     ("standard error of the grains", "rms")],
            "rows": rows}
