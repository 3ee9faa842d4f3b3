# diptych: frames of an image correlation as a measurement
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scales the frames, takes outliers out, follows the points, and completes what the user did not give. Every default is
a note."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from ... import _diptych
from ...arrays import Array, rms
from ...errors import SceneError
from ...measurement import FieldFrame, Measurement, gradient_of, tracked
from ..frames import refused
from ..readers import require_files
from ..table_files import read_table
from .frames import FieldOptions
from .outliers import outliers, spacing_of

NOISE_PX, NOISE_SPACING = 0.1, 0.01  # scatter below which no point is an outlier
text_of = _diptych.text_of_number


def _scaled(frames: Sequence[FieldFrame], options: FieldOptions) -> float:
    """Multiplies all lengths of the frames by the scale, and returns it."""
    for frame in frames:
        if frame.unit != frames[0].unit:
            raise refused(frame.path, f"lengths are in {frame.unit}, but in {frames[0].unit} in {frames[0].path}")
    unit = frames[0].unit or "the unit of the files"
    if options.scale is None and unit == "px":
        raise refused(frames[0].path, "lengths are pixels; give --scale S, the length of a pixel in the unit of "
                      "--mean-diameter, or 1 to keep pixels")
    if options.scale is None:
        options.note(f"lengths are in {unit}; --mean-diameter counts in the same unit")
    scale = options.scale or 1.0
    for frame in frames:
        frame.points, frame.displacement = scale * frame.points, scale * frame.displacement
        frame.deviation = None if frame.deviation is None else scale * frame.deviation
    return scale


def _sizes(frames: Sequence[FieldFrame], scale: float, options: FieldOptions) -> tuple[float, float]:
    """Subset and spacing after the scale."""
    own = frames[0].subset
    if options.subset is None and own is None:
        raise SceneError("--subset is required: the files do not hold it. Give the side of the correlated squares in "
                         "the unit of the files, or 0 if every point was followed by itself")
    if options.subset is None and own is not None:
        options.note(f"--subset = {text_of(own)}, from {frames[0].path}")
    subset = scale * (options.subset if options.subset is not None else own or 0.0)
    if options.spacing is not None:
        return subset, scale * options.spacing
    spacing = spacing_of(frames[0].points[np.isfinite(frames[0].displacement).all(axis=1)])
    options.note(f"--spacing = {spacing / scale:.6g}, the median distance of the nearest points")
    return subset, spacing


def _take_out_outliers(frames: Sequence[FieldFrame], spacing: float, scale: float, options: FieldOptions) -> list[int]:
    """Makes outliers NaN; returns their number in every frame."""
    if not options.outliers:
        return [0] * len(frames)
    is_px = frames[0].unit == "px"
    noise = NOISE_PX * scale if is_px else NOISE_SPACING * spacing
    options.note(f"outliers exceed {text_of(options.outliers)} in the normalised median test, with a noise of "
                 + (f"{NOISE_PX} px" if is_px else f"{NOISE_SPACING} spacings") + "; --outliers 0 keeps them")
    counts = []
    for frame in frames:
        flags = outliers(frame.points, frame.displacement, spacing=spacing, threshold=options.outliers, noise=noise)
        frame.displacement = np.where(flags[:, None], np.nan, frame.displacement)
        counts.append(int(flags.sum()))
    return counts


def _instants(position: Array, options: FieldOptions) -> list[int]:
    """The two instants of --static, ascending; [] without it."""
    pair = sorted(options.static or ())
    if any(number not in range(len(position)) for number in pair) or len(set(pair)) == 1:
        raise SceneError(f"--static {','.join(map(text_of, pair))}: give two different whole numbers from 0 (the first "
                         f"image) to {len(position) - 1}")
    return [int(number) for number in pair]


def _static_deviation(position: Array, to_first: bool, start: int, end: int) -> Array:
    """(k, n) from two instants at rest. Without its affine part their difference is the noise of both fields against
    the first image, or of all fields between them."""
    moved = position[end] - position[start]
    known = np.isfinite(moved).all(axis=1)
    if known.sum() < 4:
        raise SceneError(f"--static {start},{end}: only {known.sum()} points are known at both instants")
    before, moved = position[start][known], moved[known]
    affine = np.column_stack([before, np.ones(len(before))])
    left = moved - affine @ np.linalg.lstsq(affine, moved, rcond=None)[0]
    fields = (start > 0) + 1 if to_first else end - start
    times = np.arange(len(position))
    return np.broadcast_to((rms(left) / math.sqrt(fields) * np.sqrt(np.minimum(times, 1) if to_first else times))
                           [:, None], position.shape[:2])


def boundary_of(path: str) -> dict[str, Array]:
    """axial_strain and, if they are there, stress_ratio and volumetric_strain of a table. Raises SceneError."""
    require_files([path])
    table = read_table(path)
    curves = {"axial_strain": table.numbers("axial_strain")}
    table.refuse(np.diff(curves["axial_strain"], prepend=-np.inf) < 0, lambda k: "column axial_strain does not ascend")
    if table.has("volumetric_strain"):
        curves["volumetric_strain"] = table.numbers("volumetric_strain")
    if table.has("stress_ratio"):
        curves["stress_ratio"] = table.numbers("stress_ratio")
    elif table.has("sxx", "syy"):
        sxx, syy = table.numbers("sxx"), table.numbers("syy")
        table.refuse(sxx + syy <= 0, lambda k: f"sxx + syy = {sxx[k] + syy[k]:g}: compression must be positive")
        curves["stress_ratio"] = abs(syy - sxx) / (syy + sxx)
    if len(curves) == 1:
        raise refused(path, "needs a column stress_ratio, or sxx and syy, or volumetric_strain; its columns are "
                      + ", ".join(table.columns))
    return curves


def strains_of(position: Array) -> Array:
    """(k, 3): axial strain, volumetric strain (compression positive) and eps_1 - eps_2 of the affine fit since the
    first instant."""
    rows = [[0.0, 0.0, 0.0]]
    for now in position[1:]:
        moved = now - position[0]
        known = np.isfinite(moved).all(axis=1)
        if known.sum() < 3:
            raise SceneError(f"instant {len(rows)}: only {known.sum()} points were followed to it; at least 3 are "
                             "needed")
        h = gradient_of(now[known], moved[known])
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
        progress, source = strains[:, 0].copy(), "the vertical strain of the affine fit to the field"
        if static:
            progress[static[0]:static[1] + 1] = progress[static[0]]  # at rest
    if options.progress is None:
        options.note(f"the axial strain of every instant is {source}")
    for k in np.flatnonzero(np.diff(progress) < 0)[:1]:
        raise SceneError(f"{source}: the axial strain falls from {progress[k]:.6g} at instant {k} to "
                         f"{progress[k + 1]:.6g} at instant {k + 1}; give --progress with ascending values, positive "
                         "in compression")
    return progress


def _centre(points: Array, scale: float, turned: bool, options: FieldOptions) -> Array:
    if options.centre is not None:
        return scale * np.array(options.centre) * (1, -1 if turned else 1)
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    named = middle / scale * (1, -1 if turned else 1)
    options.note(f"--centre = {named[0]:.6g},{named[1]:.6g}, the middle of the points")
    return np.asarray(middle)


def measure(frames: list[FieldFrame], options: FieldOptions) -> tuple[Measurement, dict[str, Array]]:
    """The measurement, and the curves of measured.csv by their names. Raises SceneError."""
    if len(frames) > 1 and not options.reference:
        raise SceneError(f"--reference is required for {len(frames)} frames: give first, if every frame holds the "
                         "displacement since the first image, or previous, if since the image before. The files do not "
                         "tell it, and the increments differ")
    to_first = options.reference != "previous"  # a single frame is both
    scale = _scaled(frames, options)
    subset, spacing = _sizes(frames, scale, options)
    lost = [int((~np.isfinite(frame.displacement).all(axis=1)).sum()) for frame in frames]
    counts = _take_out_outliers(frames, spacing, scale, options)
    position, deviation = tracked(frames, to_first)
    seen = np.isfinite(position[1:]).all(axis=2).any(axis=0)
    position, deviation = position[:, seen], deviation[:, seen]
    if not seen.all():
        options.note(f"points that were lost in every frame, and left out: {(~seen).sum()} of {len(seen)}")
    static = _instants(position, options)
    if static:
        deviation = _static_deviation(position, to_first, *static)
    elif not np.isfinite(deviation[1:]).any():
        options.note("the standard deviation of the displacements is unknown; --static A,B finds it from two images "
                     "at rest")
    strains = strains_of(position)
    boundary = boundary_of(options.boundary) if options.boundary else {}
    progress = _progress(strains, boundary, static, options)
    diameter = options.mean_diameter or 1.0
    rows: list[dict[str, Any]] = [
        {"frame": frame.name, "points": len(frame.points), "lost": n_lost, "outliers": n_out,
         "axial_strain": float(progress[k]), "volumetric_strain": strain[1], "shear_strain": strain[2],
         "deviation_d": float(np.median(known)) / diameter if (known := deviation[k][np.isfinite(deviation[k])]).size
         else None}
        for k, (frame, n_lost, n_out, strain) in enumerate(zip(frames, lost, counts, strains[1:].tolist()), 1)]
    result = Measurement(position=position, deviation=deviation, progress=progress, mean_diameter=diameter,
                         subset=subset, spacing=spacing, facts={"scale": scale, "frames": rows},
                         centre=_centre(position[0], scale, options.y == "down" or frames[0].y_down, options))
    curves = boundary or {"axial_strain": progress, "volumetric_strain": strains[:, 1]}
    return result, curves
