# diptych: a result folder beside a measurement
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes measurements, and the comparison of a result folder with one: levelled.json, levelled.h5, rows of the
summary."""

import math
import os
from collections.abc import Mapping
from typing import Any

import pandas as pd

from ... import _diptych
from ...arrays import Interval
from ...entries import describe
from ...files import LEVELLED, read_json
from ...measurement import ARRAYS, FACTS, FIELD, HISTORY, Measurement, NUMBERS, read_measurement
from ...results import load
from ..runs.engine import columns_text, counted
from ..runs.folders import write_arrays, write_json, write_text
from ..runs.histories import mean_over, panel_table, peak_of_running_mean
from ..runs.key_numbers import panel_values
from .comparison import compared, increments, MEASURED, PANELS, windows_of

PANES = {MEASURED: "measured", "discrete": "grains", "continuum": "continuum"}
PEAK = "peak_nominal_stress_ratio"  # as a test with platens and a pressure on the sides gives it
WORDS = {"position": ("position", "length", "of the points at the end of the window"),
         "displacement_increment": ("displacement increment", "length", "levelled: averaged over the subsets"),
         "shear_strain_increment": ("shear strain increment", "-", "eps_1 - eps_2 of the levelled displacements")}

describe("levelled.json", """\
format: version of this file's format
folder (text): folder of the measurement
history/: columns of measured.csv
subset_d [mean diameters]: side of the squares over which the correlation averages
spacing_d [mean diameters]: distance of the points
resolution_d [mean diameters]: 10-90 % width below which no band is resolved
summary/: the numbers that a user asks for first
    key (text): key of the compared quantity
    quantity (text): name of the quantity
    unit (text): unit of the numbers
    measured (interval) [as unit says]: of the measurement
    discrete (interval) [as unit says]: of the grains, levelled if it is a number of a band
    continuum (interval) [as unit says]: of the continuum, levelled if it is a number of a band
windows/: windows of the comparison that were measured
    key (text): group of levelled.h5
    from [strain]: begin of the window
    to [strain]: end of the window
    mean_diameter [length]: unit d of the window
    points: number of points that all panes have
    covered: share of the sample's box that the points cover
    outside: share of the points that lie outside of the sample, or were lost at the edge
    levelled/: panes: measured, discrete, continuum; each has mean strains, and bands as in homogenised.json
    unblurred/: bands of the panels without the blur of the measurement
    difference/: panel minus measurement; intervals hold those of both
""")


def _with_deviation(value: float, curve: pd.DataFrame, column: str) -> Interval:
    """A number of a curve, with the mean of the column of deviations if the curve has it."""
    half = 1.96 * curve[name].mean() if (name := column + "_deviation") in curve else math.nan
    return Interval(float(value), value - half, value + half)


def _summary(folder: str, scene: Any, measured: pd.DataFrame, window: Mapping[str, Any],
             of_table: bool) -> list[dict[str, Any]]:
    """Rows of a window, and of the curves up to its end. measured: the curves of the measurement. of_table: they come
    from the boundary of the sample; those of the points' hull are compared at the points."""
    end, where = window["to"], f"{window['from']:g} to {window['to']:g}"
    tables = {panel: table for panel in PANELS if (table := panel_table(folder, panel)) is not None}
    curves = {**tables, MEASURED: measured.rename(columns={"axial_strain": "progress"})}
    bands = {pane: numbers["bands"][0] for pane, numbers in window["levelled"].items() if numbers["bands"]}
    levelled = {pane: numbers["volumetric_strain"] for pane, numbers in window["levelled"].items()}
    found = [("window_volumetric_strain", f"volumetric strain of the levelled fields ({where})", "-", levelled)]
    if of_table and "volumetric_strain" in measured:
        found = [("final_volumetric_strain", f"volumetric strain at {end:g}", "-", {
            pane: _with_deviation(mean_over(curve["progress"], curve["volumetric_strain"], end, end), curve,
                                  "volumetric_strain") for pane, curve in curves.items()})]
    found += [("band_angle_deg", f"inclination of the levelled band ({where})", "degrees",
               {pane: band["angle_deg"] for pane, band in bands.items() if not band["diffuse"]}),
              ("band_width_10_90_d", f"10-90 % width of the levelled band ({where})", "mean diameters",
               {pane: band["width_10_90_d"] for pane, band in bands.items()})]
    if "stress_ratio" in measured:
        peaks = {panel: panel_values(scene, table)[PEAK] for panel, table in tables.items()}
        peaks[MEASURED] = peak_of_running_mean(curves[MEASURED], "stress_ratio", scene.averaging_width())
        found.insert(0, (PEAK, "nominal peak t/s beside the measurement", "-",
                         {pane: _with_deviation(peak, curves[pane], "stress_ratio") for pane, peak in peaks.items()}))
    unknown = Interval(math.nan, math.nan, math.nan)
    return [{"key": key, "quantity": quantity, "unit": unit, **{pane: values.get(pane, unknown) for pane in PANES}}
            for key, quantity, unit, values in found]


def compare_folder(folder: str, scene: Any, source: str) -> dict[str, Any]:
    """Compares the panels in a result folder with the measurement in the folder `source`. Returns levelled.json.

    Raises ValueError, with the file, for a damaged one, SceneError if nothing was measured in the windows."""
    measurement, results = read_measurement(source), load(folder)
    panels = {panel: getattr(results, panel).snapshots for panel in PANELS if getattr(results, panel) is not None}
    record = compared(measurement, windows_of(measurement, scene, panels), scene.dict()["comparison"],
                      scene.is_mirror_symmetric())
    curves = pd.read_csv(os.path.join(source, HISTORY))
    record["summary"] = _summary(folder, scene, curves, record["windows"][-1],
                                 measurement.facts.get("curves") == "boundary")
    write_levelled(folder, source, curves, record)
    if os.path.exists(os.path.join(folder, "comparison.json")):
        _add_to_comparison(folder, record["summary"])
    return record


def alone(measurement: Measurement, quiet: bool) -> dict[str, Any]:
    """As compared(), for a measurement without a sample: bands and strains between its instants."""
    windows = counted(increments(measurement), "increments", quiet)
    return compared(measurement, windows, _diptych.read_scene(None, [], False).dict()["comparison"]) | {"summary": []}


def write_measurement(folder: str, measurement: Measurement, curves: pd.DataFrame) -> None:
    """Writes measured.h5, measured.json and measured.csv."""
    write_arrays(os.path.join(folder, FIELD),
                 {name: (getattr(measurement, name), *words) for name, words in ARRAYS.items()}, {})
    write_json(os.path.join(folder, FACTS), {"format": 1, **{name: getattr(measurement, name) for name in NUMBERS},
                                             **measurement.facts})
    write_text(os.path.join(folder, HISTORY), curves.to_csv(index=False, float_format="%.10g", lineterminator="\n"))


def write_levelled(folder: str, source: str, curves: pd.DataFrame, record: dict[str, Any]) -> None:
    """Writes levelled.json and levelled.h5 to a folder. source: folder of the measurement."""
    record |= {"format": 1, "folder": os.path.abspath(source), "history": curves.to_dict("list")}
    arrays = {}
    for window in record["windows"]:
        arrays[f"{window['key']}/position"] = (window.pop("position"), *WORDS["position"])
        for pane, fields in window.pop("fields").items():
            arrays |= {f"{window['key']}/{pane}_{name}": (values, *WORDS[name]) for name, values in fields.items()}
    write_arrays(os.path.join(folder, "levelled.h5"), arrays, {})
    write_json(os.path.join(folder, LEVELLED), record)


def _add_to_comparison(folder: str, rows: list[dict[str, Any]]) -> None:
    """Adds the rows to comparison.json and summary.csv, in place of earlier ones."""
    path = os.path.join(folder, "comparison.json")
    record = read_json(path)
    write_json(path, record | {MEASURED: rows})
    _diptych.record_files(folder, "comparison")
    path = os.path.join(folder, "summary.csv")
    table = pd.read_csv(path)
    table = table[table["quantity"].isin([row["quantity"] for row in record["summary"]] + ["checks"])]
    more = pd.DataFrame([{"quantity": row["quantity"], "unit": row["unit"], **{
        name + end: value for pane, name in PANES.items() for end, value in zip(("", "_low", "_high"), row[pane])}}
        for row in rows])
    write_text(path, pd.concat([table, more]).to_csv(index=False, float_format="%.9g", lineterminator="\n"))


def text_of(record: Mapping[str, Any]) -> str:
    """The table of a terminal, and a line per band that is not resolved."""
    rows = [[row["quantity"] + ("" if row["unit"] == "-" else f" [{row['unit']}]"), *(row[one].text() for one in PANES)]
            for row in record["summary"]]
    unresolved = [f"{PANES[pane]}, {window['from']:g} to {window['to']:g}: {band['unresolved']}"
                  for window in record["windows"] for pane, one in window["levelled"].items()
                  for band in one["bands"] if "unresolved" in band]
    last = record["windows"][-1]
    covered = (f"the points cover {100 * last['covered']:.0f} % of the sample's box; {100 * last['outside']:.0f} % of "
               "them lie outside of it or were lost")
    return "\n".join([columns_text([["", *PANES.values()], *rows]), *unresolved, covered])
