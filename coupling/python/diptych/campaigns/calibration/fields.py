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
from ...levelling import bands_of, field_of, levelled, on_sample, resolution, with_noise
from ...measurement import read_measurement
from ..measured.comparison import FEWEST, instants_of
from ..runs.key_numbers import BAND_OPTIONS, snapshots_at
from ..runs.statistics import line_turn
from .calibration_file import OF_FIELD
from .noise import ANGLE, Observable, STRIP_PROFILE
from .observations import Observation
from .search import NORMAL
from .profiles import STRIPS

HOMOGENEOUS = 45.0  # degrees: where a compression without a band shears most


@dataclass(kw_only=True)
class MeasuredWindow:
    """What was measured in a window of the comparison. points (n, 2) [length], displacement (n, 2) [length], bands with
    the noise of the measurement in their intervals; subset and resolution [length]."""

    edges: tuple[float, float]
    points: Array
    displacement: Array
    report: BandReport
    subset: float
    resolution: float

    @property
    def band(self) -> Band | None:
        """The strongest."""
        return next(iter(self.report.bands), None)


def _options(scene: _diptych.Scene) -> dict[str, Any]:
    keys = scene.dict()["comparison"]
    return {name: keys[name] for name in (*BAND_OPTIONS, "band_resamples")}


def measured_windows(scene: _diptych.Scene, folder: str, edges: Sequence[tuple[float, float]]) -> list[MeasuredWindow]:
    """Those of a measurement, scaled to the sample. Raises SceneError if too few points lie in the sample."""
    measurement, keys, found = read_measurement(folder), scene.dict(), []
    d, options = keys["sample"]["mean_diameter"], _options(scene)
    scale, half = d / measurement.mean_diameter, 0.5 * np.array(
        [keys["continuum"]["rectangle_width"], keys["continuum"]["rectangle_height"]])
    for start, end in edges:
        instants = instants_of(measurement, (start, end))[start, end]
        since = measurement.increment(*instants)
        points, u = on_sample(measurement, instants[1], since.points, np.zeros(2), d), scale * since.displacement
        inside = (abs(points) <= half).all(axis=1).sum()
        if inside < FEWEST:
            raise SceneError(f"{folder}: window {start:g}-{end:g}: {inside} measured points lie in the rectangle of the "
                             f"scene; a band needs {FEWEST}. Check rectangle_width and rectangle_height, --centre and "
                             "--mean-diameter of the import")
        low, high = points.min(0), points.max(0)
        frame = {"mean_diameter": d, "centre": 0.5 * (low + high), "width": high[0] - low[0],
                 "height": high[1] - low[1]}
        report = with_noise(bands_of(points, u, frame, options), points, u, scale * since.deviation, options)
        found.append(MeasuredWindow(edges=(start, end), points=points, displacement=u, report=report,
                                    subset=scale * measurement.subset,
                                    resolution=scale * resolution(measurement.subset, measurement.spacing)))
    return found


def _angle(scene: _diptych.Scene, band: Band) -> float:
    return abs(band.angle_deg) if scene.is_mirror_symmetric() else band.angle_deg


def _strip(one: Observable, points: Array, u: Array, band: Band, report: BandReport) -> float:
    """Mean displacement along a band in a strip to both sides over the travel, from that of its middle, positive in the
    sense of the band. NaN without a point."""
    d, angle = report.frame["mean_diameter"], np.radians(band.angle_deg)
    y = ((points - band.centre) @ band.normal - band.offset) / d
    along = np.sign(band.jump) * u @ np.array([np.cos(angle), np.sin(angle)])
    along /= np.hypot(*report.frame["platen_increment"])
    strips = [(side, (side * y >= one.near) & (side * y < one.far)) for side in (1, -1)]
    middle = abs(y) < STRIPS[1]
    sides = [side * (along[at].mean() - along[middle].mean()) for side, at in strips if at.any() and middle.any()]
    return float(np.mean(sides)) if sides else np.nan


def _deviation(one: Observable, band: Band, d: float) -> float:
    """Standard deviation of a measured observable, from the 95 % intervals of the band. A strip shows half the jump x
    tanh(distance / half width)."""
    def of(name: str) -> float:
        return 0.5 * (band.interval[name].high - band.interval[name].low) / NORMAL

    of_ln = of("width_10_90") / band.width_10_90
    if one.kind != STRIP_PROFILE:
        return of("angle_deg") if one.kind == ANGLE else of_ln
    y = 0.5 * d * (one.near + one.far) / band.half_width
    return float(np.hypot(0.5 * np.tanh(y) * of("jump"), 0.5 * band.jump * y / np.cosh(y) ** 2 * of_ln))


def _why_not(one: Observable, window: MeasuredWindow, deviation: float) -> str:
    """Why a measured observable does not count; empty if it does."""
    low = window.band.interval["width_10_90"].low
    if not np.isfinite(deviation):
        return "its interval is unknown; comparison/band_resamples above 0 gives it"
    if one.kind == "ln_width":
        return "" if low > window.resolution else "the measured band is not wider than the resolution"
    return "the measured band is a diffuse zone" if window.band.diffuse else ""


def observe_field(o: Observation, deviations: Array, scene: _diptych.Scene, observables: Sequence[Observable],
                  windows: Sequence[MeasuredWindow]) -> list[str]:
    """Fills in the values of the bands of a measurement and their deviations (observables). Returns a reason per
    observable that has none, else ""."""
    left_out, of_edges, d = [""] * len(observables), {one.edges: one for one in windows}, _mean_diameter(scene)
    o.bands = [window.band for window in windows]
    o.angle_deg = next((_angle(scene, band) for band in reversed(o.bands) if band and not band.diffuse), np.nan)
    for k, one in enumerate(observables):
        if one.kind not in OF_FIELD:
            continue
        window = of_edges[one.low, one.high]
        if window.band is None:
            left_out[k] = "no band was measured"
            continue
        deviation = _deviation(one, window.band, d)
        left_out[k] = _why_not(one, window, deviation)
        if not left_out[k]:
            o.values[k], deviations[k] = _value(one, scene, window, window.displacement, window.report), deviation
    return left_out


def _mean_diameter(scene: _diptych.Scene) -> float:
    return float(scene.dict()["sample"]["mean_diameter"])


def _value(one: Observable, scene: _diptych.Scene, window: MeasuredWindow, u: Array, report: BandReport) -> float:
    """An observable of a displacement (n, 2) at the points of a window. Without a band the width is half the sample's
    height, like that of a homogeneous deformation; the profile is taken across the measured band."""
    found, d = next(iter(report.bands), None), _mean_diameter(scene)
    if one.kind == "ln_width":
        return float(np.log((found.width_10_90 if found else 0.5 * scene.dict()["continuum"]["rectangle_height"]) / d))
    inclined = found if found and not found.diffuse else None  # the angle of a diffuse zone means little
    if one.kind == STRIP_PROFILE:
        known = np.isfinite(u).all(axis=1)
        return _strip(one, window.points[known], u[known], inclined or window.band, report)
    measured = _angle(scene, window.band)
    angle = _angle(scene, inclined) if inclined else float(np.copysign(HOMOGENEOUS, measured))
    return measured + float(line_turn(angle, measured))


def observe_levelled(o: Observation, scene: _diptych.Scene, observables: Sequence[Observable],
                     snapshots: Sequence[Any], windows: Sequence[MeasuredWindow]) -> Observation:
    """Adds the bands of a continuum, seen as the measurement saw the sample. Windows without a measured band do not
    count."""
    options = {**_options(scene), "band_resamples": 0}
    for window in windows:
        pair = snapshots_at(snapshots, *window.edges)
        if not pair:
            continue
        nodes = pair[1].position
        centre = 0.5 * (nodes.min(0) + nodes.max(0))
        u = levelled(field_of(*pair), window.points + centre, window.subset)
        frame = {name: window.report.frame[name] for name in ("mean_diameter", "centre", "width", "height")}
        report = bands_of(window.points, u, frame, options)
        o.bands.append(next(iter(report.bands), None))
        if o.bands[-1]:
            o.angle_deg = _angle(scene, o.bands[-1])
        for k, one in enumerate(observables):
            if one.kind in OF_FIELD and (one.low, one.high) == window.edges and window.band:
                o.values[k] = _value(one, scene, window, u, report)
    return o
