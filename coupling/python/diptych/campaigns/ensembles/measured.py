# diptych: the panels of an ensemble against a measurement, as in ASME V&V 20
# SPDX-License-Identifier: LGPL-2.1-or-later
"""D is the measurement and S the mean of a panel over the samples. The parts of u_num and u_input are those of the
validation of the panels; u_D is the uncertainty of the measurement."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ...entries import describe
from ...files import key_of_band, window_name
from ..measured.comparison import MEASURED, PANELS
from ..measured.folder import PANES
from ..runs.engine import columns_text
from ..runs.key_numbers import OF_PANEL, QUANTITIES
from ..runs.statistics import line_statistics, statistics
from .validation import DRAWS, validated

# uncertainties of a row of `validation` that belong to a panel
_PARTS = {"discrete": ("grains_step",), "continuum": ("mesh", "load_step", "parameters")}
_UNKNOWN = dict.fromkeys(sum(_PARTS.values(), ()), math.nan)

describe("ensemble.json", """\
measured/: with --measured only
    folder (text): folder of the measurement
    rows/: every panel against the measurement
        quantity (text): name of the quantity
        unit (text): unit of the numbers
        panel (text): discrete or continuum
        n: number of samples with a value
        S [as in unit]: mean of the panel over the samples
        D [as in unit]: measured value
        E (interval) [as in unit]: error S - D; the interval holds all known parts of u_val
        u_num [as in unit]: uncertainty of the numerical methods; null if unknown
        u_input [as in unit]: uncertainty of the calibrated parameters; null if unknown
        u_S [as in unit]: standard error of the mean over the samples; null for less than two
        u_D [as in unit]: standard uncertainty of the measurement; null if unknown
        u_val [as in unit]: root of the sum of the squares of the known parts
        margin [as in unit]: largest error that counts as equivalent
        verdict (text): equivalent, different or cannot tell, and if u_D is not known; not in both panels without a \
            value
""")


def rows_of(records: Sequence[Mapping[str, Any]], validation: Sequence[Mapping[str, Any]], margins: Mapping[str, float],
            folded: bool) -> list[dict[str, Any]]:
    """The rows of ensemble.json. records: levelled.json of every member. validation: rows of the panels. folded: mirror
    images of a band count as one."""
    last = records[0]["windows"][-1]
    window, rows, of_panels = window_name(last["from"], last["to"]), [], {row["quantity"]: row for row in validation}
    summaries = [{row["key"]: row for row in record["summary"]} for record in records]
    for key, first in summaries[0].items():
        known = of_panels.get(key if key in OF_PANEL else f"{window} band {key_of_band(key)}", {})
        parts = {**known.get("parts", {}), "parameters": known.get("u_input", math.nan)}
        values = {pane: np.array([rows_by_key[key][pane] for rows_by_key in summaries], float)
                  for pane in (MEASURED, *PANELS)}  # (members, 3): value, low, high
        if folded and key == "band_angle_deg":
            values = {pane: np.where(one[:, :1] < 0, -one[:, [0, 2, 1]], one) for pane, one in values.items()}
        quantity = QUANTITIES.get(key, QUANTITIES["final_volumetric_strain"])  # that of a window has the same margin
        rows += [{"quantity": first["quantity"], "unit": first["unit"], "panel": panel, **_row(
            quantity, values[panel][:, 0], values[MEASURED], {name: parts.get(name, math.nan) for name in own},
            margins)} for panel, own in _PARTS.items()]
    return rows


def _row(quantity: Mapping[str, Any], panel: np.ndarray, measured: np.ndarray, parts: Mapping[str, float],
         margins: Mapping[str, float]) -> dict[str, Any]:
    kind = quantity["difference"]
    data = (line_statistics if kind == "line" else statistics)(measured[:, 0]).mean
    u_d = statistics(0.5 * (measured[:, 2] - measured[:, 1])).mean / 1.96
    total, row = validated(kind, (np.full(len(panel), data), panel), {**_UNKNOWN, **parts, "measurement": u_d}, DRAWS)
    share = margins[quantity["margin"]]
    margin, verdict = share * (abs(data) if kind == "relative" else 1), total.verdict(share)
    if row["n"]:
        verdict += f" (margin {margin:.2g}{'' if math.isfinite(u_d) else ', u_D is not known'})"
    return {**{name: row[name] for name in ("n", "S", "E", "u_num", "u_input", "u_val")}, "u_S": row["u_D"],
            "D": data, "u_D": u_d, "margin": margin, "verdict": verdict}


def text_of(rows: Sequence[Mapping[str, Any]]) -> str:
    """The table of a terminal, one line per quantity and panel."""
    return columns_text([["against the measurement", "", "S", "D", "E = S - D [95 %]", "verdict"], *(
        [row["quantity"] + ("" if row["unit"] == "-" else f" [{row['unit']}]"), PANES[row["panel"]], f"{row['S']:.4g}",
         f"{row['D']:.4g}", row["E"].text(), row["verdict"]] for row in rows)])
