# diptych: tables of the numbers of a whole run
# SPDX-License-Identifier: LGPL-2.1-or-later

from ..data.numbers import interval, plain
from .wording import NULLS, ORDER, number, shown_unit, suffix, typeset

LEFT_OUT = ("law", "parameters_from")  # shown elsewhere on the page


def first(record):
    """The numbers that a user asks for first, from comparison.json or ensemble.json. A difference without an interval
    has no verdict."""
    rows = [[typeset(row["quantity"])] + ["–" if plain(row[of]) is None else number(row[of], suffix(row["unit"]), 3)
                                          for of in ("grains", "continuum", "difference")]
            + [row["verdict"] if plain(row["difference"]) is None or interval(row["difference"]) else "–"]
            for row in record.get("summary", [])]
    return {"head": ["", "grains", "continuum", "difference [95 %]", "verdict"], "rows": rows}


def table(result, part):
    """Rows of a group of the comparison: meaning and number. Empty texts are left out, and numbers of the summary and
    of the checks, which the page has already."""
    rows, values = [], result.part(part)
    elsewhere = {f"{part}/{row['key']}" for row in result.comparison.get("summary", [])} | {
        one["key"] for one in result.comparison.get("checks", [])}
    for key in sorted(values, key=lambda name: (ORDER.index(name) if name in ORDER else len(ORDER), name)):
        value = values[key]
        is_group = isinstance(value, list) or (isinstance(value, dict) and "value" not in value)
        place = f"{part}/{key}"
        if key not in LEFT_OUT and value != "" and not is_group and place not in elsewhere:
            rows.append([result.numbers.meaning(place), _text(result, place, key, value)])
    return {"head": ["", "value"], "rows": rows}


def _text(result, place, key, value):
    if value is None and key in NULLS:
        return NULLS[key]
    if result.numbers.unit(place) == "strain or time" and isinstance(value, (int, float)):
        return result.loading_variable.text(value)
    return number(value, shown_unit(result.numbers, place))
