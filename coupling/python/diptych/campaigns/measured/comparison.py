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
from ...levelling import DRAWS, field_of, levelled, on_sample, with_noise
from ...measurement import mean_gradient, Measurement
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
    instants: Sequence[int]
    frame: dict[str, Any]
    pairs: dict[str, Sequence[Any]] = field(default_factory=dict)  # panel -> its snapshots at both ends


def windows_of(measurement: Measurement, scene: Any, panels: Mapping[str, Sequence[Any]]) -> list[Window]:
    """The windows of a comparison that were measured, too. Raises SceneError if there is none."""
    edges, found = scene.dict()["comparison"]["window_edges"], []
    for ends, instants in instants_of(measurement, edges).items():
        pairs = {panel: pair for panel, all_of in panels.items() if (pair := snapshots_at(all_of, *ends))}
        if pairs:
            of_grains, d = increment(*next(iter(pairs.values()))), scene.dict()["sample"]["mean_diameter"]
            frame = {name: of_grains[name] for name in FRAME} if "centre" in of_grains else box_of(of_grains.points, d)
            found.append(Window(start=ends[0], end=ends[1], instants=instants, frame=frame, pairs=pairs))
    if not found:
        raise not_measured(measurement, edges)
    return found


def instants_of(measurement: Measurement, edges: Sequence[float]) -> dict[tuple[float, float], list[int]]:
    """The windows between these edges that were measured, with the instants at their ends."""
    found, progress = {}, measurement.progress
    for ends in zip(edges, edges[1:]):
        instants = [int(abs(progress - end).argmin()) for end in ends]
        if abs(progress[instants] - ends).max() <= NEAR * (ends[1] - ends[0]):
            found[ends] = instants
    return found


def not_measured(measurement: Measurement, edges: Sequence[float]) -> SceneError:
    measured = ", ".join(f"{one:.4g}" for one in measurement.progress)
    return SceneError(f"no window of the comparison was measured. Its edges are {', '.join(map(str, edges))}; the "
                      f"measurement has axial strains {measured}. Give both the same instants: "
                      "comparison/window_edges and loading/stage_strain of the scene, --progress of the import")


def box_of(points: Array, mean_diameter: float) -> dict[str, Any]:
    low, high = points.min(0), points.max(0)
    return dict(zip(FRAME, (mean_diameter, 0.5 * (low + high), *(high - low))))


def increments(measurement: Measurement) -> list[Window]:
    """The increments between successive instants of a measurement without a sample; those at rest are left out."""
    progress = measurement.progress
    return [Window(start=progress[k], end=progress[k + 1], instants=(k, k + 1), frame=box_of(
        measurement.increment(k, k + 1).points, measurement.mean_diameter)) for k in np.flatnonzero(np.diff(progress))]


def compared(measurement: Measurement, windows: Iterable[Window], keys: Mapping[str, Any],
             folded: bool = False) -> dict[str, Any]:
    """levelled.json without its summary. A window also has, for levelled.h5, the `position` of its points and the
    `fields` of every pane there.

    keys: of the section comparison. folded: mirror images of a band count as one. Raises SceneError for a window with
    too few points."""
    d = measurement.mean_diameter
    return {"subset_d": measurement.subset / d, "spacing_d": measurement.spacing / d,
            "resolution_d": measurement.resolution / d, "windows": [
                {"key": f"window_{k}", "from": window.start, "to": window.end,
                 "mean_diameter": window.frame["mean_diameter"],
                 **_window(measurement.scaled(window.frame["mean_diameter"]), window, keys, folded)}
                for k, window in enumerate(windows)]}


def _window(measurement: Measurement, window: Window, keys: Mapping[str, Any], folded: bool) -> dict[str, Any]:
    start, end = window.instants
    points = measurement.filled(end)  # at the end
    moved = {MEASURED: points - measurement.filled(start)}
    if window.pairs:
        points = on_sample(measurement, end, points, window.frame["centre"])
        moved |= {panel: levelled(field_of(*pair), points, measurement.subset) for panel, pair in window.pairs.items()}
    inside = np.isfinite(list(moved.values())).all(axis=(0, 2))  # all panes have the same points
    known = np.isfinite(measurement.position[start] + measurement.position[end]).all(axis=1)
    common, noise = inside & known, np.full(len(points), np.nan)
    if common.sum() < FEWEST:
        raise SceneError(f"window {window.start:g}-{window.end:g}: {common.sum()} measured points lie in the sample; "
                         f"a band needs {FEWEST}. Check --centre and --mean-diameter of the import")
    noise[known] = measurement.increment(start, end).deviation
    options = {name: keys[name] for name in (*BAND_OPTIONS, "band_resamples")}
    of_pane = {pane: options | ({"band_resamples": 0} if pane == "continuum" else {}) for pane in moved}
    panes, unblurred, fields, at = {}, {}, {}, points[common]
    for pane, everywhere in moved.items():
        everywhere[~inside], u = np.nan, everywhere[common]
        report = find_bands(at, u, **window.frame, **of_pane[pane])
        if pane == MEASURED:
            report = with_noise(report, at, u, noise[common], options)
        strains, area = _strains(measurement, points - everywhere, everywhere, noise if pane == MEASURED else None)
        panes[pane] = strains | _bands(report, at, u)
        for numbers, band in zip(panes[pane]["bands"], report.bands):
            _add_thickness(numbers, thicknesses(at, u, band, measurement.spacing), measurement)
        reach = max(STRAIN_RADIUS * measurement.mean_diameter, 2 * measurement.spacing)
        fields[pane] = {"displacement_increment": u, "shear_strain_increment": shear_strain(at, u, radius=reach)}
    for panel, pair in window.pairs.items():
        of_panel = increment(*pair)
        report = find_bands(**{**of_panel, **window.frame}, **of_pane[panel])
        unblurred[panel] = _bands(report, of_panel.points, of_panel.displacement)
    return {"points": len(at), "position": at, "fields": fields, "levelled": panes, "unblurred": unblurred,
            "covered": area / (window.frame["width"] * window.frame["height"]), "outside": float(1 - inside.mean()),
            "difference": {panel: differences(panes[panel], panes[MEASURED], folded) for panel in window.pairs}}


def _strains(measurement: Measurement, before: Array, moved: Array,
             noise: Array | None) -> tuple[dict[str, Interval], float]:
    """Mean strains of one field (n, 2), and the area that it covers. noise (n): standard deviation of the points; it
    gives the interval of the volumetric strain."""
    ((xx, xy), (yx, yy)), area = mean_gradient(measurement.triangles, before, moved)
    half, generator = math.nan, np.random.default_rng(1)
    if noise is not None and np.isfinite(noise).any():
        size = np.nan_to_num(noise, nan=np.nanmedian(noise))[:, None]
        draws = [mean_gradient(measurement.triangles, before, size * generator.standard_normal(moved.shape))[0]
                 for _ in range(DRAWS)]
        half = 1.96 * float(np.std(np.trace(draws, axis1=1, axis2=2)))
    return {"volumetric_strain": Interval(-(xx + yy), -(xx + yy) - half, -(xx + yy) + half),
            "shear_strain": Interval(math.hypot(xx - yy, xy + yx), math.nan, math.nan)}, area


def _bands(report: BandReport, points: Array, u: Array) -> dict[str, Any]:
    of_points = Record(points=points, displacement=u, weight=None, **report.frame)
    return {"bands": [band_numbers(band, of_points) for band in report.bands], "band_verdict": report.verdict}


def _add_thickness(band: dict[str, Any], found: Mapping[str, float], measurement: Measurement) -> None:
    """Adds the thickness by every convention [mean diameters]. A band that may be as narrow as the resolution has no
    width."""
    width, d = band["width_10_90_d"], measurement.mean_diameter
    band["thickness_d"] = {name: value / d for name, value in found.items()}
    if not (width.value if math.isnan(width.low) else width.low) > measurement.resolution / d:
        band |= {"width_10_90_d": Interval(math.nan, math.nan, math.nan), "thickness_d": {},
                 "unresolved": f"the 10-90 % width of {width.text()} d may be as small as the resolution of "
                               f"{measurement.resolution / d:.2g} d, so none is given"}


def differences(pane: Mapping[str, Any], measured: Mapping[str, Any], folded: bool) -> dict[str, Any]:
    """A panel minus the measurement: mean strains, and the strongest bands. folded: mirror images count as one."""
    found = {name: _difference(pane[name].value - measured[name].value, pane[name], measured[name])
             for name in ("volumetric_strain", "shear_strain")}
    if not (pane["bands"] and measured["bands"]):
        return found
    ours, theirs = pane["bands"][0], measured["bands"][0]
    if not (ours["diffuse"] or theirs["diffuse"]):
        angles = [band["angle_deg"].value for band in (ours, theirs)]
        turn = float(line_turn(*(np.abs(angles) if folded else angles)))
        found["angle_deg"] = _difference(turn, ours["angle_deg"], theirs["angle_deg"])
    widths = ours["width_10_90_d"], theirs["width_10_90_d"]
    return found | {"width_10_90_d": _difference(widths[0].value - widths[1].value, *widths)}


def _difference(value: float, *parts: Interval) -> Interval:
    """Half widths add in squares, those that are known."""
    half = math.hypot(*(0.5 * (part.high - part.low) for part in parts if math.isfinite(part.high))) or math.nan
    return Interval(value, value - half, value + half)
