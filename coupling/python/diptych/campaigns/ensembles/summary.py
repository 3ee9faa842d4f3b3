# diptych: the numbers of an ensemble that a user asks for first
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The rows of the summary of a single run, with means over the samples, their 95 % intervals and verdicts."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from ...arrays import ends_text
from ..runs.key_numbers import QUANTITIES
from ..runs.statistics import Interval, line_statistics, statistics, words_of


def summary(member: Mapping[str, dict[str, Any]], record: dict[str, Any]) -> list[dict[str, Any]]:
    """One row per quantity in the summary of a member's comparison.json, by key. record: quantities and verdicts as in
    ensemble.json.

    Differences are continuum - grains in the unit of the row; verdicts are those of the record, with their margins."""
    # Of the windows only the last: it replaces those before it.
    verdicts, validation = ({one["key"]: one for one in record[part]} for part in ("verdicts", "validation"))
    return [{"key": key, "quantity": row["quantity"], "unit": row["unit"],
             "grains": _mean(key, verdicts[key]["discrete"]), "continuum": _mean(key, verdicts[key]["continuum"]),
             "difference": validation[key]["E"], "verdict": words_of(verdicts[key])} for key, row in member.items()]


def _mean(key: str, values: Sequence[float]) -> Interval:
    return (line_statistics if QUANTITIES[key]["difference"] == "line" else statistics)(values).interval()


def text_of(rows: Sequence[dict[str, Any]]) -> str:
    """The table of a terminal, one line per quantity."""
    table = [["", "grains", "continuum", "difference [95 %]", "verdict"]]
    table += [[row["quantity"] + ("" if row["unit"] == "-" else f" [{row['unit']}]"),
               *(_with_ends(row[key]) for key in ("grains", "continuum", "difference")), row["verdict"]]
              for row in rows]
    widths = [max(map(len, column)) for column in zip(*table)]
    return "\n".join("  ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip() for line in table)


def _with_ends(number: Interval) -> str:
    return f"{number.value:.4g}{ends_text(number.low, number.high)}" if math.isfinite(number.value) else "-"
