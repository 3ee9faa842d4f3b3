# diptych: grains and continuum beside a measured displacement field
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The same band detector on the measurement and on both panels, levelled: averaged over the subsets of the correlation
at its points. Lengths are those of the sample, stress and strain positive in compression."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ...arrays import Array, BandReport, Interval, Record
from ...errors import SceneError
from ...homogenisation import band_numbers, STRAIN_RADIUS
from ...levelling import bands_of, field_of, levelled, on_sample, resolution, with_noise
from ...measurement import gradient_of, Measurement
from ...operators import find_bands, increment, shear_strain
from ...thickness import thicknesses
from ..runs.key_numbers import BAND_OPTIONS, snapshots_at
from ..runs.statistics import line_turn

MEASURED = "measured"
PANELS = ("discrete", "continuum")
FRAME = ("mean_diameter", "centre", "width", "height")
FEWEST = 30  # points of find_bands()
NEAR = 0.05  # of the length of a window: how far the measured instants may be from its ends


@dataclass(kw_only=True)
class Window:
    """An increment and the instants of the measurement at its ends. frame: mean_diameter, centre, width and height of
    the sample at its end."""

    start: float
    end: float
    instants: tuple[int, int]
    frame: dict[str, Any]
    pairs: dict[str, Sequence[Any]] = field(default_factory=dict)  # panel -> its snapshots at both ends


def windows_of(measurement: Measurement, scene: Any, panels: Mapping[str, Sequence[Any]]) -> list[Window]:
    """The windows of a comparison that were measured, too. Raises SceneError if there is none."""
    edges, found = scene.dict()["comparison"]["window_edges"], []
    for (start, end), instants in instants_of(measurement, edges).items():
        pairs = {panel: pair for panel, all_of in panels.items() if (pair := snapshots_at(all_of, start, end))}
        if pairs:
            of_grains, d = increment(*next(iter(pairs.values()))), scene.dict()["sample"]["mean_diameter"]
            frame = {name: of_grains[name] for name in FRAME} if "centre" in of_grains else box_of(of_grains.points, d)
            found.append(Window(start=start, end=end, instants=instants, frame=frame, pairs=pairs))
    if not found:
        raise not_measured(measurement, edges)
    return found


def instants_of(measurement: Measurement, edges: Sequence[float]) -> dict[tuple[float, float], tuple[int, int]]:
    """The windows between these edges that were measured, with the instants at their ends."""
    found = {}
    for start, end in zip(edges, edges[1:]):
        first, last = (measurement.at(one, NEAR * (end - start)) for one in (start, end))
        if first is not None and last is not None:
            found[start, end] = (first, last)
    return found


def not_measured(measurement: Measurement, edges: Sequence[float]) -> SceneError:
    measured = ", ".join(f"{one:.4g}" for one in measurement.progress)
    return SceneError(f"no window of the comparison was measured. Its edges are {', '.join(map(str, edges))}; the "
                      f"measurement has axial strains {measured}. Give both the same instants: "
                      "comparison/window_edges and loading/stage_strain of the scene, --progress of the import")


def box_of(points: Array, mean_diameter: float) -> dict[str, Any]:
    low, high = points.min(0), points.max(0)
    return {"mean_diameter": mean_diameter, "centre": 0.5 * (low + high), "width": high[0] - low[0],
            "height": high[1] - low[1]}


def increments(measurement: Measurement) -> list[Window]:
    """The increments between successive instants of a measurement without a sample."""
    pairs, progress = range(len(measurement.progress) - 1), measurement.progress
    return [Window(start=progress[k], end=progress[k + 1], instants=(k, k + 1), frame=box_of(
        measurement.increment(k, k + 1).points, measurement.mean_diameter)) for k in pairs]


def compared(measurement: Measurement, windows: Iterable[Window], keys: Mapping[str, Any],
             folded: bool = False) -> tuple[dict[str, Any], dict[str, dict[str, Array]]]:
    """Numbers of every window, and its fields at the points: window -> name -> array.

    keys: of the section comparison. folded: mirror images of a band count as one. Raises SceneError for a window with
    too few points."""
    found = {f"window_{k}": _window(measurement, keys, window, folded) for k, window in enumerate(windows)}
    d = measurement.mean_diameter
    return {"subset_d": measurement.subset / d, "spacing_d": measurement.spacing / d,
            "resolution_d": resolution(measurement.subset, measurement.spacing) / d,
            "windows": [{"key": key, **numbers} for key, (numbers, _) in found.items()]}, {
        key: fields for key, (_, fields) in found.items()}


def _window(measurement: Measurement, keys: Mapping[str, Any], window: Window,
            folded: bool) -> tuple[dict[str, Any], dict[str, Array]]:
    since, d = measurement.increment(*window.instants), window.frame["mean_diameter"]
    scale = d / measurement.mean_diameter
    subset, spacing = scale * measurement.subset, scale * measurement.spacing
    points = on_sample(measurement, window.instants[1], since.points,
                       window.frame["centre"], d) if window.pairs else since.points
    moved = {MEASURED: scale * since.displacement,
             **{panel: levelled(field_of(*pair), points, subset) for panel, pair in window.pairs.items()}}
    common = np.isfinite(list(moved.values())).all(axis=(0, 2))  # all panes have the same points
    if common.sum() < FEWEST:
        raise SceneError(f"window {window.start:g}-{window.end:g}: {common.sum()} measured points lie in the sample; "
                         f"a band needs {FEWEST}. Check --centre and --mean-diameter of the import")
    points, deviation = points[common], scale * since.deviation[common]
    options = {name: keys[name] for name in (*BAND_OPTIONS, "band_resamples")}
    of_pane = {pane: options | ({"band_resamples": 0} if pane == "continuum" else {}) for pane in moved}
    panes, arrays = {}, {"position": points, "measured_deviation": deviation}
    for pane, everywhere in moved.items():
        u = everywhere[common]
        report = bands_of(points, u, window.frame, of_pane[pane])
        if pane == MEASURED:
            report = with_noise(report, points, u, deviation, options)
        panes[pane] = _pane(report, points, u)
        for numbers, band in zip(panes[pane]["bands"], report.bands):
            _add_thickness(numbers, thicknesses(points, u, band, spacing), resolution(subset, spacing) / d, d)
        arrays[f"{pane}_displacement_increment"] = u
        arrays[f"{pane}_shear_strain_increment"] = shear_strain(points, u, radius=max(STRAIN_RADIUS * d, 2 * spacing))
    unblurred = {}
    for panel, pair in window.pairs.items():
        of_panel = increment(*pair)
        report = find_bands(**{**of_panel, **window.frame}, **of_pane[panel])
        unblurred[panel] = _pane(report, of_panel.points, of_panel.displacement)
    return {"from": window.start, "to": window.end, "points": len(points), "levelled": panes, "unblurred": unblurred,
            "measured_from": measurement.progress[window.instants[0]],
            "measured_to": measurement.progress[window.instants[1]],
            "difference": {panel: differences(panes[panel], panes[MEASURED], folded) for panel in window.pairs}}, arrays


def _pane(report: BandReport, points: Array, u: Array) -> dict[str, Any]:
    """Mean strain and bands of one field."""
    gradient, field = gradient_of(points, u), Record(points=points, displacement=u, weight=None, **report.frame)
    strain = -0.5 * (gradient + gradient.T)
    return {"bands": [band_numbers(band, field) for band in report.bands], "band_verdict": report.verdict,
            "strain_xx": strain[0, 0], "strain_yy": strain[1, 1], "strain_xy": strain[0, 1],
            "volumetric_strain": strain[0, 0] + strain[1, 1],
            "shear_strain": math.hypot(strain[0, 0] - strain[1, 1], 2 * strain[0, 1])}


def _add_thickness(band: dict[str, Any], found: Mapping[str, float], finest: float, d: float) -> None:
    """Adds the thickness by every convention [mean diameters]. A band that may be as narrow as the resolution `finest`
    has no width."""
    width = band["width_10_90_d"]
    band["thickness_d"] = {name: value / d for name, value in found.items()}
    if not (width.value if math.isnan(width.low) else width.low) > finest:
        band["unresolved"] = (f"10-90 % width {width.text()} d: not above the resolution of {finest:.2g} d, so the "
                              "band has no width")
        band |= {"width_10_90_d": Interval(math.nan, math.nan, math.nan), "thickness_d": {}}


def differences(pane: Mapping[str, Any], measured: Mapping[str, Any], folded: bool) -> dict[str, Any]:
    """A panel minus the measurement: mean strains, and the measured strongest band against the nearest one of the
    panel. folded: mirror images count as one. Half widths of the intervals add in squares."""
    found = {name: pane[name] - measured[name] for name in ("volumetric_strain", "shear_strain")}
    if not (pane["bands"] and measured["bands"]):
        return found

    def angle(band: Mapping[str, Any]) -> Interval:
        a = band["angle_deg"]
        return Interval(-a.value, -a.high, -a.low) if folded and a.value < 0 else a

    reference = measured["bands"][0]
    nearest = min(pane["bands"], key=lambda band: abs(line_turn(angle(band).value, angle(reference).value)))
    if not (nearest["diffuse"] or reference["diffuse"]):
        turn = float(line_turn(angle(nearest).value, angle(reference).value))
        found["angle_deg"] = _difference(turn, angle(nearest), angle(reference))
    a, b = nearest["width_10_90_d"], reference["width_10_90_d"]
    return found | {"width_10_90_d": _difference(a.value - b.value, a, b)}


def _difference(value: float, *parts: Interval) -> Interval:
    halves = [0.5 * (part.high - part.low) for part in parts if math.isfinite(part.high)]
    half = math.hypot(*halves) if halves else math.nan
    return Interval(value, value - half, value + half)
