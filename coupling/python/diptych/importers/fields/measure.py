# diptych: frames of an image correlation as a measurement
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scales the frames, takes outliers out, follows the points, and completes what the user did not give. Every default is
a note."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pandas as pd
from scipy.interpolate import LinearNDInterpolator
from scipy.spatial import cKDTree

from ... import _diptych
from ...arrays import Array, rms
from ...errors import SceneError
from ...measurement import FieldFrame, Measurement
from ..frames import refused
from ..readers import require_files
from ..table_files import read_table
from .frames import FieldOptions
from .outliers import outliers, spacing_of

THRESHOLD = 5.0  # that of the authors, 2, is for smooth flows: benchmarks/measured
CURVES = ("volumetric_strain", "volumetric_strain_deviation", "stress_ratio", "stress_ratio_deviation")
SMALLEST = 5  # mean diameters
NOISE_PX, NOISE_SPACING = 0.1, 0.01  # scatter below which no point is an outlier
text_of = _diptych.text_of_number


def _scale(frames: Sequence[FieldFrame], options: FieldOptions) -> float:
    """Factor of all lengths in the files."""
    unit = frames[0].unit
    for frame in frames:
        if frame.unit != unit:
            raise refused(frame.path, f"lengths are in {frame.unit}, but in {unit} in {frames[0].path}")
    if options.scale is not None:
        return options.scale
    if unit == "px":
        raise refused(frames[0].path, "lengths are pixels; give --scale S, the length of a pixel in the unit of "
                      "--mean-diameter, or 1 to keep pixels")
    options.note(f"lengths are in {unit or 'the unit of the files'}; --mean-diameter counts in the same unit")
    return 1.0


def _subset(frame: FieldFrame, options: FieldOptions) -> float:
    """Side of the correlated squares in the unit of the files."""
    if options.subset is not None:
        return options.subset
    if frame.subset is None:
        raise SceneError("--subset is required: the files do not hold it. Give the side of the correlated squares in "
                         "the unit of the files, or 0 if every point was followed by itself")
    options.note(f"--subset = {text_of(frame.subset)}, from {frame.path}")
    return frame.subset


def _take_out_outliers(frames: Sequence[FieldFrame], subset: float, spacing: float,
                       options: FieldOptions) -> list[int]:
    """Makes outliers NaN; returns their number in every frame."""
    threshold = options.outliers
    if threshold is None:
        threshold = 0.0 if subset == 0 else THRESHOLD
        if subset == 0:
            options.note("no test of outliers, because every point was followed by itself; --outliers 20 finds gross "
                         "errors")
    if not threshold:
        return [0] * len(frames)
    is_px = frames[0].unit == "px"
    options.note(f"outliers exceed {text_of(threshold)} in the normalised median test, with a noise of "
                 + (f"{NOISE_PX} px" if is_px else f"{NOISE_SPACING} spacings") + "; --outliers 0 keeps them")
    counts = []
    for frame in frames:
        flags = outliers(frame.points, frame.displacement, spacing=spacing, threshold=threshold,
                         noise=NOISE_PX if is_px else NOISE_SPACING * spacing)
        frame.displacement = np.where(flags[:, None], np.nan, frame.displacement)
        counts.append(int(flags.sum()))
    return counts


def tracked(frames: Sequence[FieldFrame], to_first: bool) -> tuple[Array, Array]:
    """Positions (k + 1, n, 2) and deviations (k + 1, n) of the points of the first frame at every instant.

    to_first  True: every frame holds the displacement since the first image, at the same points.
              False: since the image before. A point is then followed through the frames by linear interpolation, and
              the variances add up. It is lost 1.5 spacings away from all points of a frame.

    Raises SceneError if the frames have other points although they should not.
    """
    start = frames[0].points
    position, variance = [start], [np.zeros(len(start))]
    for frame in frames:
        deviation = np.full(len(frame.points), np.nan) if frame.deviation is None else frame.deviation
        if to_first:
            if frame.points.shape != start.shape or not np.allclose(frame.points, start, atol=1e-6 * np.ptp(start)):
                raise SceneError(f"{frame.path}: its points are not those of {frames[0].path}. If every frame holds "
                                 "the displacement since the image before, give --reference previous")
            position.append(start + frame.displacement)
            variance.append(deviation**2)
            continue
        known = frame.points[frame.known]
        moved = LinearNDInterpolator(known, np.column_stack([frame.displacement, deviation**2])[frame.known])(
            position[-1])
        moved[cKDTree(known).query(np.nan_to_num(position[-1]))[0] > 1.5 * spacing_of(known)] = np.nan
        position.append(position[-1] + moved[:, :2])
        variance.append(variance[-1] + moved[:, 2])
    return np.array(position), np.sqrt(variance)


def _instants(position: Array, options: FieldOptions) -> list[int]:
    """The two instants of --static, ascending; [] without it."""
    pair = sorted(options.static or ())
    if any(number not in range(len(position)) for number in pair) or len(set(pair)) == 1:
        raise SceneError(f"--static {','.join(map(text_of, pair))}: give two different whole numbers from 0 (the first "
                         f"image) to {len(position) - 1}")
    return [int(number) for number in pair]


def _static_deviation(result: Measurement, to_first: bool, start: int, end: int) -> Array:
    """(k, n) from two instants at rest. Without its affine part their difference is the noise of both fields against
    the first image, or of all fields between them."""
    moved = result.increment(start, end)
    if len(moved.points) < 4:
        raise SceneError(f"--static {start},{end}: only {len(moved.points)} points are known at both instants")
    affine = np.insert(moved.points, 2, 1, axis=1)
    left = moved.displacement - affine @ np.linalg.lstsq(affine, moved.displacement, rcond=None)[0]
    fields = (start > 0) + 1 if to_first else end - start
    times = np.arange(len(result.position))
    of_instants = rms(left) / math.sqrt(fields) * np.sqrt(np.minimum(times, 1) if to_first else times)
    return np.broadcast_to(of_instants[:, None], result.deviation.shape)


def boundary_of(path: str) -> dict[str, Array]:
    """axial_strain and, if they are there, stress_ratio and volumetric_strain of a table. Raises SceneError."""
    require_files([path])
    table = read_table(path)
    curves = {"axial_strain": table.numbers("axial_strain")}
    table.refuse(np.diff(curves["axial_strain"], prepend=-np.inf) < 0, lambda k: "column axial_strain does not ascend")
    table.refuse(curves["axial_strain"] >= 1, lambda k: f"axial_strain = {curves['axial_strain'][k]:g}: 3 % is 0.03")
    curves |= {name: table.numbers(name) for name in CURVES if table.has(name)}
    if "stress_ratio" not in curves and table.has("sxx", "syy"):
        sxx, syy = table.numbers("sxx"), table.numbers("syy")
        table.refuse(sxx + syy <= 0, lambda k: f"sxx + syy = {sxx[k] + syy[k]:g}: compression must be positive")
        curves["stress_ratio"] = abs(syy - sxx) / (syy + sxx)
    if len(curves) == 1:
        raise refused(path, "needs a column stress_ratio, or sxx and syy, or volumetric_strain; its columns are "
                      + ", ".join(table.columns))
    return curves


def strains_of(result: Measurement) -> Array:
    """(k, 3): axial strain, volumetric strain (compression positive) and eps_1 - eps_2 of the mean gradient since
    the first instant."""
    rows = [[0.0, 0.0, 0.0]]
    for k in range(1, len(result.position)):
        since = result.increment(0, k)
        if len(since.points) < 3:
            raise SceneError(f"instant {k}: only {len(since.points)} points were followed to it; at least 3 are needed")
        h = result.mean_gradient(0, k)
        rows.append([-h[1, 1], 1 - np.linalg.det(np.eye(2) + h), math.hypot(h[0, 0] - h[1, 1], h[0, 1] + h[1, 0])])
    return np.array(rows)


def _progress(strains: Array, boundary: dict[str, Array], static: list[int], options: FieldOptions) -> Array:
    """Axial strain at every instant."""
    if options.progress is not None:
        progress, source = np.array(options.progress), "--progress"
        if len(progress) != len(strains):
            raise SceneError(f"--progress has {len(progress)} values; expected {len(strains)}: of the reference image "
                             "and of every frame")
    elif boundary and len(boundary["axial_strain"]) == len(strains):
        progress, source = boundary["axial_strain"], "the boundary table, row by row"
    else:
        progress, source = strains[:, 0].copy(), "the mean vertical strain of the field"
        if static:
            progress[static[0]:static[1] + 1] = progress[static[0]]  # at rest
    if options.progress is None:
        options.note(f"the axial strain of every instant is {source}")
    if max(abs(progress)) >= 1:
        raise SceneError(f"{source}: an axial strain of {max(abs(progress)):g}: 3 % is 0.03")
    for k in np.flatnonzero(np.diff(progress) < 0)[:1]:
        raise SceneError(f"{source}: the axial strain falls from {progress[k]:.6g} at instant {k} to "
                         f"{progress[k + 1]:.6g} at instant {k + 1}; give --progress with ascending values, positive "
                         "in compression")
    return progress


def _centre(points: Array, turned: bool, options: FieldOptions) -> Array:
    """Centre of the sample in the unit of the files, y upwards."""
    axes = np.array([1, -1 if turned else 1])  # of the files
    if options.centre is not None:
        return axes * options.centre
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    options.note("--centre = {:.6g},{:.6g}, the middle of the points".format(*axes * middle))
    return np.asarray(middle)


def _require_size(result: Measurement) -> None:
    """Refuses lengths of different units."""
    points, d = result.position[0], result.mean_diameter
    side = math.sqrt(12 * np.linalg.eigvalsh(np.cov(points.T))[0])  # of a rectangle that is as narrow
    if side < SMALLEST * d or result.subset > side / 2:
        raise SceneError(f"the points span {side / d:.2g} mean diameters, and a subset {result.subset / d:.3g}: a band "
                         f"needs points over {SMALLEST} diameters, and subsets of at most half of that span. "
                         "--mean-diameter counts in the unit after --scale, --subset in the unit of the files")


def measure(frames: list[FieldFrame], options: FieldOptions) -> tuple[Measurement, pd.DataFrame]:
    """The measurement, and the curves of measured.csv. Raises SceneError."""
    if len(frames) > 1 and not options.reference:
        raise SceneError(f"--reference is required for {len(frames)} frames: give first, if every frame holds the "
                         "displacement since the first image, or previous, if since the image before. The files do not "
                         "tell it, and the increments differ")
    to_first = options.reference != "previous"  # a single frame is both
    scale, subset = _scale(frames, options), _subset(frames[0], options)
    spacing = spacing_of(frames[0].points[frames[0].known])
    lost = [int((~frame.known).sum()) for frame in frames]
    counts = _take_out_outliers(frames, subset, spacing, options)
    position, deviation = tracked(frames, to_first)
    seen = np.isfinite(position[1:]).all(axis=2).any(axis=0)
    position, deviation = position[:, seen], deviation[:, seen]
    if not seen.all():
        options.note(f"points that were lost in every frame, and left out: {(~seen).sum()} of {len(seen)}")
    centre = _centre(position[0], options.y == "down" or frames[0].y_down, options)
    result = Measurement(position=position, deviation=deviation, progress=np.array([]), centre=centre, subset=subset,
                         spacing=spacing, mean_diameter=options.mean_diameter / scale,
                         facts={"reference": "first" if to_first else "previous"})
    _require_size(result)
    static = _instants(position, options)
    if static:
        result.deviation = _static_deviation(result, to_first, *static)
    elif not np.isfinite(deviation[1:]).any():
        options.note("the standard deviation of the displacements is unknown; --static A,B finds it from two images "
                     "at rest")
    strains = strains_of(result)
    boundary = boundary_of(options.boundary) if options.boundary else {}
    result.progress = progress = _progress(strains, boundary, static, options)
    result.facts |= {"scale": scale, "frames": [
        {"frame": frame.name, "points": len(frame.points), "lost": n_lost, "outliers": n_out,
         "axial_strain": progress[k], "volumetric_strain": strains[k, 1], "shear_strain": strains[k, 2],
         "deviation_d": _median(result.deviation[k] / result.mean_diameter)}
        for k, (frame, n_lost, n_out) in enumerate(zip(frames, lost, counts), 1)]}
    curves = boundary or {"axial_strain": progress, "volumetric_strain": strains[:, 1]}
    return result.scaled(options.mean_diameter), pd.DataFrame(curves).drop_duplicates("axial_strain", keep="last")


def _median(values: Array) -> float | None:
    known = values[np.isfinite(values)]
    return float(np.median(known)) if known.size else None
