# diptych: the bands of a measured field as data of a calibration
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The continuum is averaged over the subsets of the correlation at its points, as `compare --measured` does, and one
detector looks at both. Places are relative to the centre of the sample."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ... import _diptych
from ...arrays import Array, Band, BandReport
from ...errors import SceneError
from ...levelling import field_of, levelled, on_sample, with_noise
from ...measurement import read_measurement
from ...operators import find_bands
from ..measured.comparison import box_of, FEWEST, FRAME, instants_of
from ..runs.key_numbers import BAND_OPTIONS, snapshots_at
from ..runs.statistics import line_turn
from .calibration_file import OF_FIELD
from .noise import ANGLE, Observable, STRIP_PROFILE
from .observations import Observation
from .profiles import STRIPS
from .search import NORMAL

HOMOGENEOUS = 45.0  # degrees: where a compression without a band shears most


@dataclass(kw_only=True)
class MeasuredWindow:
    """A window of the comparison that was measured: points (n, 2) and displacement (n, 2) [length], bands with the
    noise of the measurement in their intervals."""

    edges: tuple[float, float]
    points: Array
    displacement: Array
    report: BandReport
    band: Band | None  # the strongest
    subset: float  # [length]
    resolution: float  # [length]


def measured_windows(scene: _diptych.Scene, folder: str, edges: Sequence[tuple[float, float]]) -> list[MeasuredWindow]:
    """Those of a measurement, scaled to the sample. Raises SceneError if too few points lie in the sample."""
    keys, found = scene.dict(), []
    d, options = keys["sample"]["mean_diameter"], {name: keys["comparison"][name]
                                                   for name in (*BAND_OPTIONS, "band_resamples")}
    measurement = read_measurement(folder).scaled(d)
    half = [0.5 * keys["continuum"][side] for side in ("rectangle_width", "rectangle_height")]
    for window, instants in instants_of(measurement, sorted({one for both in edges for one in both})).items():
        since = measurement.increment(*instants)
        points, u = on_sample(measurement, instants[1], since.points, np.zeros(2)), since.displacement
        inside = int((abs(points) <= half).all(axis=1).sum())
        if inside < FEWEST:
            raise SceneError(f"{folder}: window {window[0]:g}-{window[1]:g}: {inside} measured points lie in the "
                             f"rectangle of the scene; a band needs {FEWEST}. Check continuum/rectangle_width and "
                             "rectangle_height, and --centre and --mean-diameter of the import")
        report = with_noise(find_bands(points, u, **box_of(points, d), **options), points, u, since.deviation, options)
        found.append(MeasuredWindow(
            edges=window, points=points, displacement=u, report=report, band=next(iter(report.bands), None),
            subset=measurement.subset, resolution=measurement.resolution))
    return found


def _strip(one: Observable, points: Array, u: Array, band: Band, report: BandReport) -> float:
    """Mean displacement along a band in a strip to both sides over the travel, from that of its middle, positive in the
    sense of the band. NaN without a point."""
    angle, middle = np.radians(band.angle_deg), band.centre + band.offset * band.normal
    y = (points - middle) @ band.normal / report.frame["mean_diameter"]
    along = np.sign(band.jump) * u @ [np.cos(angle), np.sin(angle)] / np.hypot(*report.frame["platen_increment"])
    inner = along[abs(y) < STRIPS[1]]
    sides = [side * (along[at].mean() - inner.mean()) for side in (1, -1)
             if (at := (side * y >= one.near) & (side * y < one.far)).any() and len(inner)]
    return float(np.mean(sides)) if sides else np.nan


def _value(one: Observable, scene: _diptych.Scene, window: MeasuredWindow, u: Array, report: BandReport) -> float:
    """An observable of a displacement (n, 2) at the points of a window with a measured band. Without a band the width
    is half the sample's height, like that of a homogeneous deformation; the strips lie along the measured band."""
    found, folded = next(iter(report.bands), None), scene.is_mirror_symmetric()
    if one.kind == "ln_width":
        width = found.width_10_90 if found else 0.5 * scene.dict()["continuum"]["rectangle_height"]
        return float(np.log(width / report.frame["mean_diameter"]))
    inclined = found if found and not found.diffuse else None  # the angle of a diffuse zone means little
    if one.kind == STRIP_PROFILE:
        known = np.isfinite(u).all(axis=1)
        return _strip(one, window.points[known], u[known], inclined or window.band, report)
    measured, angle = window.band.angle_deg, HOMOGENEOUS * np.sign(window.band.angle_deg)
    angle = inclined.angle_deg if inclined else angle
    if folded:
        measured, angle = abs(measured), abs(angle)
    return float(measured + line_turn(angle, measured))


def _add(o: Observation, scene: _diptych.Scene, observables: Sequence[Observable], window: MeasuredWindow,
         seen: tuple[Array, BandReport]) -> None:
    """Adds the bands of a window. seen: displacement (n, 2) at its points, and the bands in it."""
    o.bands.append(next(iter(seen[1].bands), None))
    if o.bands[-1]:
        o.angle_deg = abs(o.bands[-1].angle_deg) if scene.is_mirror_symmetric() else o.bands[-1].angle_deg
    for k, one in enumerate(observables):
        if one.kind in OF_FIELD and (one.low, one.high) == window.edges and window.band:
            o.values[k] = _value(one, scene, window, *seen)


def _deviation(one: Observable, window: MeasuredWindow) -> tuple[float, str]:
    """Standard deviation of a measured observable, from the 95 % intervals of its band, and why it does not count. A
    strip shows half the jump x tanh(distance / half width)."""
    band = window.band
    if band is None:
        return np.nan, "no band was measured"
    angle, width, jump = (0.5 * (high - low) / NORMAL for _, low, high in (
        band.interval[name] for name in ("angle_deg", "width_10_90", "jump")))
    if not np.isfinite(angle + width + jump):
        return np.nan, "the intervals of the measured band are unknown"
    if one.kind == "ln_width":
        return width / band.width_10_90, ("" if band.interval["width_10_90"].low > window.resolution else
                                          "the measured band may be as narrow as the resolution")
    y = 0.5 * (one.near + one.far) * window.report.frame["mean_diameter"] / band.half_width
    strip = 0.5 * np.hypot(np.tanh(y) * jump, band.jump * y / np.cosh(y) ** 2 * width / band.width_10_90)
    return angle if one.kind == ANGLE else float(strip), "the measured band is a diffuse zone" if band.diffuse else ""


def observe_field(o: Observation, deviations: Array, scene: _diptych.Scene, observables: Sequence[Observable],
                  windows: Sequence[MeasuredWindow]) -> list[str]:
    """Fills in the bands of a measurement and their deviations (observables). Returns why one does not count, or ""."""
    left_out, of_edges = [""] * len(observables), {window.edges: window for window in windows}
    for window in windows:
        _add(o, scene, observables, window, (window.displacement, window.report))
    for k, one in enumerate(observables):
        if one.kind in OF_FIELD:
            deviations[k], left_out[k] = _deviation(one, of_edges[one.low, one.high])
            if left_out[k]:
                o.values[k] = np.nan
    return left_out


def observe_levelled(o: Observation, scene: _diptych.Scene, observables: Sequence[Observable],
                     snapshots: Sequence[Any], windows: Sequence[MeasuredWindow]) -> Observation:
    """Adds the bands of a continuum, seen as the measurement saw the sample."""
    options = {"band_resamples": 0, **{name: scene.dict()["comparison"][name] for name in BAND_OPTIONS}}
    for window in windows:
        if pair := snapshots_at(snapshots, *window.edges):
            nodes = pair[1].position
            u = levelled(field_of(*pair), window.points + 0.5 * (nodes.min(0) + nodes.max(0)), window.subset)
            frame, known = {name: window.report.frame[name] for name in FRAME}, np.isfinite(u).all(axis=1)
            _add(o, scene, observables, window, (u, find_bands(window.points[known], u[known], **frame, **options)))
    return o
