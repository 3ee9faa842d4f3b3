# diptych: tables of the sensitivity indices of a study
# SPDX-License-Identifier: LGPL-2.1-or-later

from ..data.sensitivity import by_total, short
from .wording import number, rounded, suffix

COORDINATES = {"value": "", "logarithm": "in its logarithm", "share_of": "as a share of",
               "drop_from": "as 1 − a share of"}


def indices(one, names):
    """One row per parameter. names: {key: label}."""
    rows = [[names[p["parameter"]], rounded(p["first"], "", 2), rounded(p["total"], "", 2),
             rounded(p["correlation"], "", 2)]
            for p in by_total(one)]
    return {"head": ["parameter", "first index [95 %]", "total index [95 %]", "rank correlation"], "rows": rows}


def ranges(record):
    """One row per parameter: key and range."""
    rows = []
    for p in record["parameters"]:
        how = " ".join(text for text in (COORDINATES[p["coordinate"]], short(p["of"])) if text)
        rows.append([p["key"], f"{p['low']:g} to {p['high']:g}", how or "–"])
    return {"head": ["key", "range", "varied uniformly"], "rows": rows}


def basis(one, record):
    """"128 of 128 points, Q² 0.998; mean 0.365, standard deviation 0.058"."""
    unit = suffix(one["unit"])
    q2 = f", Q² {one['q2']:.3f}" if one["q2"] is not None else ""
    lost = [f"{one[name]} {words}" for name, words in (("failed", "failed"), ("without_value", "without a value"))
            if one[name]]
    left_out = f" (left out: {', '.join(lost)})" if lost else ""
    return (f"{one['used']} of {record['points']} points{left_out}{q2}; mean {number(one['mean'], unit, 3)}, "
            f"standard deviation {number(one['deviation'], unit, 2)}")
