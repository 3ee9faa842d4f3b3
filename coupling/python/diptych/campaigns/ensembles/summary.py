# diptych: the numbers of an ensemble that a user asks for first
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The rows of the summary of a single run, with means over the samples, their 95 % intervals and verdicts."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from ..runs.statistics import Interval

_PANELS = ("discrete", "continuum")


def summary(member: Sequence[dict[str, Any]], record: dict[str, Any]) -> list[dict[str, Any]]:
    """One row per quantity in the summary of a member's comparison.json. record: quantities and verdicts as in ensemble.json.

    Differences are continuum - grains in the unit of the row; verdicts are those of the record, with their margins."""
    verdicts, quantities = list(zip(record["verdicts"], record["validation"])), {q["name"]: q for q in record["quantities"]}
    asked = verdicts[:4] + (verdicts[-2:] if len(verdicts) > 4 else [])  # of the windows only the last
    return [_row(name["quantity"], name["unit"], *pair, quantities) for name, pair in zip(member, asked)]


def _row(quantity: str, unit: str, verdict: dict[str, Any], validation: dict[str, Any],
         quantities: dict[str, Any]) -> dict[str, Any]:
    window, _, key = verdict["quantity"].rpartition(" band ")
    of = [quantities.get(f"{window} {panel} band {key}" if window else f"{panel}_summary {key}") for panel in _PANELS]
    grains, continuum = (Interval(q["mean"], q["low"], q["high"]) if q else Interval(*[math.nan] * 3) for q in of)
    return {"quantity": quantity, "unit": unit, "grains": grains, "continuum": continuum, "difference": validation["E"],
            "verdict": words_of(verdict)}


def words_of(verdict: dict[str, Any]) -> str:
    """A verdict of ensemble.json with its margin, such as "equivalent within 5 %"."""
    margin = f"{100 * verdict['margin']:g} %" if verdict["relative"] else f"{verdict['margin']:g}"
    words = {"equivalent": f"equivalent within {margin}", "different": f"different by more than {margin}",
             "cannot tell": f"cannot tell (margin {margin})"}[verdict["verdict"]]
    return words if verdict["n"] else "not in both panels"


def text_of(rows: Sequence[dict[str, Any]]) -> str:
    """The table of a terminal, one line per quantity."""
    table = [["", "grains", "continuum", "difference [95 %]", "verdict"]]
    table += [[row["quantity"] + ("" if row["unit"] == "-" else f" [{row['unit']}]"),
               *(_with_ends(row[key]) for key in ("grains", "continuum", "difference")), row["verdict"]] for row in rows]
    widths = [max(map(len, column)) for column in zip(*table)]
    return "\n".join("  ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip() for line in table)


def _with_ends(number: Interval) -> str:
    ends = f" [{number.low:.4g}, {number.high:.4g}]" if math.isfinite(number.low) else ""
    return f"{number.value:.4g}{ends}" if math.isfinite(number.value) else "-"
