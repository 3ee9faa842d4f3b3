# diptych: observables of a calibration, from histories, snapshots and measured curves
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A measured curve may replace the grains of a path. One outline serves all samples of a path."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pandas as pd

from ... import _diptych, operators
from ...arrays import Array, Band
from ...errors import SceneError
from ..runs.histories import is_beyond, mean_over, nominal_stress_ratio, peak_of_running_mean, peak_on_path
from ..runs.input_file import Setting
from ..runs.key_numbers import bands_between, panel_values, snapshots_at
from .calibration_file import CURVE_COLUMNS, OF_BANDS, Target, is_element, read_curve
from .noise import Data, Observable
from .profiles import PROFILE, profile

CURVE_POINTS = 120
PEAK = "peak_stress_ratio"
ANGLE = "peak_friction_angle_deg"
NO_CURVE = np.full(CURVE_POINTS, np.nan)


@dataclass(kw_only=True)
class Observation:
    """Results of one run of a panel, or a measured curve."""

    values: Array  # (observables), NaN: not reached, or no band
    numbers: dict[str, float] = field(default_factory=dict)  # compared numbers by their keys
    # of the first band of the last window; without its sign if chance decides between left and right
    angle_deg: float = np.nan
    bands: list[Band | None] = field(default_factory=list)  # the first of every window
    progress: Array = field(default_factory=NO_CURVE.copy)  # of the curve
    stress_ratio: Array = field(default_factory=NO_CURVE.copy)
    volumetric_strain: Array = field(default_factory=NO_CURVE.copy)
    failure: str = ""  # reason if the run did not finish
    samples: "list[Observation]" = field(default_factory=list)  # of a mean over seeds


@dataclass(kw_only=True)
class Outline:
    """Box, mesh and bands of a path's sample: one for all samples of the path."""

    width: float  # [length]
    height: float  # [length]
    solid_fraction: float
    frames: list[dict[str, Any]]  # mean_diameter, platen_increment, centre, width and height of every window
    bands: list[Band | None]  # of its first sample: where a profile is taken if the continuum shows no band
    mesh: str  # file; empty: the rectangle of the scene


@dataclass(kw_only=True)
class Path:
    """A target with what its samples or its curve show. left_out: a reason per observable; empty: it counts. scatter:
    the samples that give the noise, if others than the data."""

    target: Target
    scene: _diptych.Scene
    data: Data
    samples: list[Observation]
    left_out: list[str]
    scatter: Data | None = None

    @property
    def of_noise(self) -> Data:
        return self.scatter or self.data


def of_peak(peak: float) -> dict[str, float]:
    """Peak t/s and its friction angle."""
    return {PEAK: peak, ANGLE: float(np.degrees(np.arcsin(peak)))}


def observe_history(scene: _diptych.Scene, observables: Sequence[Observable], table: pd.DataFrame | None, *,
                    nominal: bool = False) -> Observation:
    """Everything but the bands. nominal: t/s as laboratories plot it, for a comparison with their curves."""
    o = Observation(values=np.full(len(observables), np.nan))
    if table is None:
        return o
    if nominal:
        table = table.assign(stress_ratio=nominal_stress_ratio(scene, table))
    progress, end = table["progress"].to_numpy(), float(table["progress"].iloc[-1])
    columns = {name: table[name].to_numpy() for name in CURVE_COLUMNS if name in table}
    for k, one in enumerate(observables):
        if one.kind in columns and not is_beyond(one.high, end):
            o.values[k] = mean_over(progress, columns[one.kind], one.low, one.high)
    if "lower_fy" in table and not is_element(scene):
        o.numbers = panel_values(scene, table)
    elif "stress_ratio" in columns:
        peak = (peak_on_path(scene, table) if is_element(scene) else
                peak_of_running_mean(table, "stress_ratio", scene.averaging_width()))
        o.numbers = of_peak(peak)
    edges = np.linspace(0, min(end, scene.dict()["loading"]["axial_strain"]), CURVE_POINTS + 1)
    o.progress = 0.5 * (edges[1:] + edges[:-1])
    for name, column in columns.items():
        setattr(o, name, np.array([mean_over(progress, column, a, b) for a, b in zip(edges, edges[1:])]))
    return o


def add_bands(o: Observation, scene: _diptych.Scene, observables: Sequence[Observable], snapshots: Sequence[Any],
              outline: Outline, *, of_grains: bool) -> Observation:
    """Adds ln(width / d) of the first band of every window, and the profiles across it. The continuum's bands are
    searched in the grains' frames, so that both panels are measured alike. A continuum without a band counts as half
    the sample's height wide, like a homogeneous deformation; its profile is taken across the first sample's band."""
    d, windows = scene.dict()["sample"]["mean_diameter"], windows_of(observables)
    for n, (window, frame) in enumerate(zip(windows, outline.frames)):
        pair = snapshots_at(snapshots, *window)
        found = bands_between(scene, pair, {} if of_grains else frame) if pair else []
        o.bands.append(found[0] if found else None)
        if found:
            o.angle_deg = abs(found[0].angle_deg) if scene.is_mirror_symmetric() else found[0].angle_deg
        band = o.bands[-1] if of_grains or found else outline.bands[n]
        for kind in {one.kind for one in observables} if pair else ():
            at = [k for k, one in enumerate(observables) if (one.kind, one.low, one.high) == (kind, *window)]
            if kind == "ln_width" and (found or not of_grains):
                o.values[at] = np.log((found[0].width_10_90 if found else 0.5 * frame["height"]) / d)
            elif kind == PROFILE and band:
                strips = [(d * observables[k].near, d * observables[k].far) for k in at]
                o.values[at] = profile(pair, operators.increment(*pair)["weight"], band, strips,
                                       d / float(np.hypot(*frame["platen_increment"])))
    return o


def windows_of(observables: Sequence[Observable]) -> list[tuple[float, float]]:
    """The windows in which bands are searched, in their order."""
    return list(dict.fromkeys((one.low, one.high) for one in observables if one.kind in OF_BANDS))


def observe_curve(scene: _diptych.Scene, observables: Sequence[Observable], file: str) -> tuple[Observation, Array]:
    """A measured curve and the deviations (observables) that it brings, NaN where it brings none. Bins that begin
    before its first row have no value. A bin's deviation is a mean: the error of a test is common to close readings."""
    table = read_curve(file)
    o, deviations = observe_history(scene, observables, table), np.full(len(observables), np.nan)
    x = table["progress"].to_numpy()
    for k, one in enumerate(observables):
        if is_beyond(x[0], one.low):
            o.values[k] = np.nan
        if CURVE_COLUMNS.get(one.kind) in table and np.isfinite(o.values[k]):
            deviations[k] = mean_over(x, table[CURVE_COLUMNS[one.kind]].to_numpy(), one.low, one.high)
    return o, deviations


def half_step(scene: _diptych.Scene) -> list[Setting]:
    """Halves the step of the grains, or the accuracy that chooses it."""
    keys = scene.dict()["discrete"]
    key = "accuracy" if keys["step"] == "auto" else "step"
    return [Setting("discrete", key, repr(0.5 * keys[key]), file="the calibration")]


def read_target(target: Target, more: Sequence[Setting] = ()) -> _diptych.Scene:
    """The scene of a target with its settings and more. Raises SceneError."""
    scene = _diptych.read_changed_scene(target.scene, [*target.settings, *more], False)
    if is_element(scene):
        return scene
    if target.measured or not target.curve:  # bands need stages at the edges of windows
        scene = _diptych.read_changed_scene(target.scene, [*target.settings, *more], True)
    mesh, mode = scene.dict()["continuum"]["mesh"], scene.dict()["loading"]["mode"]
    if target.curve and not target.seeds and mesh != "rectangle":
        raise SceneError(f"{target.scene}: continuum/mesh = {mesh}: a measured curve has no grains with an outline; "
                         "set mesh = rectangle, rectangle_width and rectangle_height")
    if target.curve and scene.loading_variable() != "axial_strain":
        raise SceneError(f"{target.scene}: loading/mode = {mode}: a measured curve needs mode = descent, whose "
                         "progress is the axial strain")
    if target.curve and np.isnan(_diptych.side_pressure(scene)):
        raise SceneError(f"{target.scene}: discrete/lateral = {scene.dict()['discrete']['lateral']}: t/s of a measured "
                         "curve needs sides under the pressure; give end_grains, or rigid_walls with side_motion = "
                         "pressure")
    return scene
