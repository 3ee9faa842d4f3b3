# diptych: a result folder beside a measurement
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes the comparison of a result folder with a measurement: levelled.json, levelled.h5, and rows of the summary."""

import math
import os
from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd

from ... import _diptych
from ...arrays import Interval
from ...entries import describe
from ...files import LEVELLED, read_json
from ...measurement import HISTORY, Measurement, read_measurement
from ...results import load
from ..runs.engine import columns_text, counted
from ..runs.folders import write_arrays, write_json, write_text
from ..runs.histories import mean_over, panel_table, peak_of_running_mean
from ..runs.key_numbers import panel_values
from .comparison import compared, increments, MEASURED, PANELS, windows_of

PEAK = "peak_nominal_stress_ratio"  # as a test with platens and a pressure on the sides gives it
WORDS = {"position": ("position", "length", "of the points at the end of the window"),
         "deviation": ("standard deviation", "length", "of a component of the measured displacement"),
         "displacement_increment": ("displacement increment", "length", "levelled: averaged over the subsets"),
         "shear_strain_increment": ("shear strain increment", "-", "eps_1 - eps_2 of the levelled displacements")}
UNKNOWN = Interval(math.nan, math.nan, math.nan)

describe("levelled.json", """\
format: version of this file's format
folder (text): folder of the measurement
history/: columns of measured.csv
subset_d [mean diameters]: side of the squares over which the correlation averages
spacing_d [mean diameters]: distance of the points
resolution_d [mean diameters]: 10-90 % width below which no band is resolved
summary/: the numbers that a user asks for first
    key (text): key of the quantity
    quantity (text): name of the quantity
    unit (text): unit of the numbers
    measured (interval) [as unit says]: of the measurement
    discrete (interval) [as unit says]: of the grains, levelled if it is a number of a band
    continuum (interval) [as unit says]: of the continuum, levelled if it is a number of a band
windows/: windows of the comparison that were measured
    key (text): group of levelled.h5
    from [strain]: begin of the window
    to [strain]: end of the window
    measured_from [strain]: axial strain of the measured instant nearest to the begin
    measured_to [strain]: axial strain of the measured instant nearest to the end
    points: number of points that all panes have
    levelled/: panes: measured, discrete, continuum; each has mean strains and bands as in homogenised.json
    unblurred/: bands of the panels without the blur of the measurement
    difference/: panel minus measurement; intervals hold those of both
""")


def _peak(table: pd.DataFrame | None, width: float) -> Interval:
    if table is None or "stress_ratio" not in table:
        return UNKNOWN
    peak = peak_of_running_mean(table.rename(columns={"axial_strain": "progress"}), "stress_ratio", width)
    return Interval(peak, math.nan, math.nan)


def _summary(folder: str, scene: Any, measured: pd.DataFrame, windows: Sequence[Mapping[str, Any]]
             ) -> list[dict[str, Any]]:
    """Rows of the last measured window, and of the curves up to its end."""
    last, tables = windows[-1], {panel: panel_table(folder, panel) for panel in PANELS}
    tables = {panel: table for panel, table in tables.items() if table is not None}

    def row(key: str, quantity: str, unit: str, values: Mapping[str, Interval]) -> dict[str, Any]:
        return {"key": key, "quantity": quantity, "unit": unit,
                **{pane: values.get(pane, UNKNOWN) for pane in (MEASURED, *PANELS)}}

    def volume(x: Any, y: Any) -> Interval:
        return Interval(float(mean_over(x, y, last["to"], last["to"])), math.nan, math.nan)

    def of_bands(key: str) -> dict[str, Interval]:
        return {pane: numbers["bands"][0][key] for pane, numbers in last["levelled"].items()
                if numbers["bands"] and not (key == "angle_deg" and numbers["bands"][0]["diffuse"])}

    where = f"{last['from']:g} to {last['to']:g}"
    volumes = {panel: volume(table["progress"], table["volumetric_strain"]) for panel, table in tables.items()}
    volumes[MEASURED] = volume(measured["axial_strain"], measured["volumetric_strain"])
    rows = [row("volumetric_strain", f"volumetric strain at {last['to']:g}", "-", volumes),
            row("angle_deg", f"inclination of the levelled band ({where})", "degrees", of_bands("angle_deg")),
            row("width_10_90_d", f"10-90 % width of the levelled band ({where})", "mean diameters",
                of_bands("width_10_90_d"))]
    if "stress_ratio" in measured:
        peaks = {panel: Interval(panel_values(scene, table)[PEAK], math.nan, math.nan)
                 for panel, table in tables.items()}
        rows.insert(0, row(PEAK, "nominal peak t/s beside the measurement", "-",
                           peaks | {MEASURED: _peak(measured, scene.averaging_width())}))
    return rows


def compare_folder(folder: str, scene: Any, source: str) -> dict[str, Any]:
    """Compares the panels in a result folder with the measurement in the folder `source`. Returns levelled.json.

    Raises ValueError, with the file, for a damaged one, SceneError if nothing was measured in the windows."""
    measurement, results = read_measurement(source), load(folder)
    panels = {panel: getattr(results, panel).snapshots for panel in PANELS if getattr(results, panel) is not None}
    record, fields = compared(measurement, windows_of(measurement, scene, panels), scene.dict()["comparison"],
                              scene.is_mirror_symmetric())
    table = pd.read_csv(os.path.join(source, HISTORY))
    record["summary"] = _summary(folder, scene, table, record["windows"])
    write_levelled(folder, source, record, fields)
    if os.path.exists(os.path.join(folder, "comparison.json")):
        _add_to_comparison(folder, record["summary"])
    return record


def alone(measurement: Measurement, quiet: bool) -> tuple[dict[str, Any], dict[str, dict[str, Any]]]:
    """levelled.json and the arrays of levelled.h5 of a measurement without a sample: bands and strains between its
    instants."""
    windows = counted(increments(measurement), "increments", quiet)
    record, fields = compared(measurement, windows, _diptych.read_scene(None, [], False).dict()["comparison"])
    return record | {"summary": []}, fields


def write_levelled(folder: str, source: str, record: dict[str, Any], fields: Mapping[str, Mapping[str, Any]]) -> None:
    """Writes levelled.json and levelled.h5 to a folder. source: folder of the measurement."""
    history = pd.read_csv(os.path.join(source, HISTORY))
    record |= {"format": 1, "folder": os.path.abspath(source),
               "history": {name: values.tolist() for name, values in history.items()}}
    arrays = {f"{window}/{name}": (values, *WORDS[name.partition("_")[2] or name])
              for window, named in fields.items() for name, values in named.items()}
    write_arrays(os.path.join(folder, "levelled.h5"), arrays, {})
    write_json(os.path.join(folder, LEVELLED), record)


def _add_to_comparison(folder: str, rows: list[dict[str, Any]]) -> None:
    """Adds the rows to comparison.json and summary.csv, in place of earlier ones."""
    path = os.path.join(folder, "comparison.json")
    write_json(path, read_json(path) | {MEASURED: rows})
    _diptych.record_files(folder, "comparison")
    path = os.path.join(folder, "summary.csv")
    table = pd.read_csv(path)
    table = table[~table["quantity"].isin([row["quantity"] for row in rows])]
    panes = {MEASURED: MEASURED, "discrete": "grains", "continuum": "continuum"}
    more = pd.DataFrame([{"quantity": row["quantity"], "unit": row["unit"], **{
        name + end: value for pane, name in panes.items() for end, value in zip(("", "_low", "_high"), row[pane])}}
        for row in rows])
    write_text(path, pd.concat([table, more]).to_csv(index=False, float_format="%.9g", lineterminator="\n"))


def text_of(record: Mapping[str, Any]) -> str:
    """The table of a terminal, and a line per band that is not resolved."""
    panes = {MEASURED: "measured", "discrete": "grains", "continuum": "continuum"}
    table = columns_text([["", *panes.values()], *(
        [row["quantity"] + ("" if row["unit"] == "-" else f" [{row['unit']}]"), *(row[one].text() for one in panes)]
        for row in record["summary"])])
    unresolved = [f"{panes[pane]}, {window['from']:g} to {window['to']:g}: {band['unresolved']}"
                  for window in record["windows"] for pane, one in window["levelled"].items()
                  for band in one["bands"] if "unresolved" in band]
    return "\n".join([table, *unresolved])
