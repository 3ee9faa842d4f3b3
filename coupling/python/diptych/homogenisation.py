# diptych: stress, strain, fabric, solid fraction and bands of grains alone
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Homogenises snapshots of grains, computed or imported, without a continuum."""

import os
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from .arrays import Array, Band, Interval, Mesh, periods_of
from .averaging_width import width_scan
from .laws import principal
from .operators import displacement_gradient, find_bands, increment, map_stress, probe, strips
from .results import load
from .sheets import cell_of, outline_of, Sheet

STRAIN_RADIUS = 2.5  # mean diameters, as in the comparison
NO_FORCES = {"i": np.zeros(0, int), "j": np.zeros(0, int), "point": np.zeros((0, 2)), "force": np.zeros((0, 2))}


@dataclass(repr=False, kw_only=True)
class Homogenised:
    """Grains as fields. Stress and strain are positive in compression, angles degrees from the horizontal."""

    frames: list[dict[str, Any]]  # means of the sample, one dict per frame; an Interval has 95 % ends
    # mean strain and bands between successive frames, last from the first to the last frame
    increments: list[dict[str, Any]]
    meshes: list[Mesh]  # cells over the outline of the sample, the same number in every frame
    maps: list[dict[str, Array]]  # name -> (k), or (k, 2, 2) of tensors; NaN: unknown
    resolution_study: dict[str, Any]  # the local stress of the last frame with forces, over the width of a kernel
    missing: list[dict[str, str]]  # quantities that the grains do not give: quantity and reason
    mean_diameter: float
    grid: float  # size of the cells [mean diameters]
    walk: str  # axial_strain, shear_strain or time: what `progress` is

    def table(self) -> pd.DataFrame:
        """One row per frame; an interval takes three columns: NAME, NAME_low, NAME_high. The strain and the strongest
        band are those since the frame before."""
        rows = []
        for k, frame in enumerate(self.frames):
            since = self.increments[k - 1] if k else {}
            known = {name: value for name, value in since.items() if name not in ("from", "to", "bands")}
            bands = since.get("bands", [])
            strongest = {"band_" + name: value for name, value in (bands or [{}])[0].items()
                         if name not in ("middle", "profile")}
            rows.append(_flat({**frame, **known, **({"bands": len(bands)} if k else {}), **strongest}))
        table = pd.DataFrame(rows)
        # some may be missing
        return table.astype({name: "Int64" for name in ("contacts", "rattlers", "bands") if name in table})

    def __repr__(self) -> str:
        return (f"Homogenised({len(self.frames)} frames of {self.frames[0]['grains']} grains, "
                f"{len(self.meshes[0].cells)} cells)")


def _flat(numbers: dict[str, Any]) -> dict[str, Any]:
    flat: dict[str, Any] = {}
    for name, value in numbers.items():
        if isinstance(value, Interval):
            flat.update({name: value.value, name + "_low": value.low, name + "_high": value.high})
        else:
            flat[name] = value
    return flat


def has_forces(snapshot: Any) -> bool:
    """True if a contact of the frame carries force."""
    return bool(np.any(snapshot.contacts.force)) or len(snapshot.window) > 0


def _whole_periods(snapshot: Any, points: Array) -> Array:
    """(n, k): how many of the k periods move each point into a periodic sample."""
    periods, away = periods_of(snapshot), points - snapshot.outline_left[0]
    return np.asarray(-np.floor(away @ np.linalg.pinv(periods) if len(periods) else np.zeros((len(points), 0))))


def _wrapped(snapshot: Any, points: Array) -> Array:
    """The points, moved by whole periods into a periodic sample."""
    return np.asarray(points + _whole_periods(snapshot, points) @ periods_of(snapshot))


def _earlier_periods(start: Any, end: Any, field: Any) -> Array:
    """The periods at the start of the increment that became those at its end. A cell may take other vectors of the same
    lattice meanwhile: the mean strain of the grains tells which."""
    before, now = periods_of(start), periods_of(end)
    if len(now) < 2:
        return before
    points = field.points - field.points.mean(0)
    moved = np.linalg.lstsq(points, field.displacement - field.displacement.mean(0), rcond=None)[0]
    return np.asarray(np.round((now - now @ moved) @ np.linalg.inv(before)) @ before)


def _strain(start: Any, end: Any, at: Array) -> Array:
    field, now = increment(start, end), periods_of(end)
    own, change = _whole_periods(end, field.points), now - _earlier_periods(start, end, field)
    copies = [own + copy for copy in product((0, -1, 1), repeat=len(now))]
    gradient = displacement_gradient(np.concatenate([field.points + copy @ now for copy in copies]),
                                     np.concatenate([field.displacement + copy @ change for copy in copies]), at,
                                     weight=np.tile(field.weight, len(copies)),
                                     radius=STRAIN_RADIUS * end.mean_diameter)
    return -0.5 * (gradient + gradient.transpose(0, 2, 1))


def _shear(strain: Array) -> Array:
    return np.hypot(strain[..., 0, 0] - strain[..., 1, 1], 2 * strain[..., 0, 1])


def _means(snapshot: Any, first: Any) -> dict[str, Any]:
    """The sample as a whole, one row of the table."""
    n, contacts = len(snapshot), snapshot.contacts
    row: dict[str, Any] = {
        "progress": snapshot.progress, "axial_strain": snapshot.axial_strain, "shear_strain": snapshot.shear_strain,
        "time": snapshot.time, "grains": n, "volumetric_strain": 1 - snapshot.area / first.area,
        "solid_fraction": np.pi * np.sum(snapshot.radius**2) / snapshot.area}
    if not has_forces(snapshot):
        return row
    stress = snapshot.mean_internal_moment.sum(0) / snapshot.area
    s1, s2, _ = principal(stress)
    acts = np.any(contacts.force != 0, axis=1)
    d = snapshot.mean_diameter
    places = _wrapped(snapshot, snapshot.position)
    low, high = places.min(0) - d, places.max(0) + d
    box = np.array([low, (high[0], low[1]), high, (low[0], high[1])])
    whole = probe(snapshot, box)  # encloses the contacts on the walls; ratios and directions do not depend on its area
    row |= {"contacts": int(acts.sum()), "coordination_number": (acts.sum() + np.sum(contacts.j[acts] < n)) / n,
            "rattlers": int(np.sum(snapshot.rattler)), "sxx": stress[0, 0], "syy": stress[1, 1],
            "sxy": 0.5 * (stress[0, 1] + stress[1, 0]), "s": 0.5 * (s1 + s2), "t": 0.5 * (s1 - s2)}
    names = "t_over_s", "direction_deg", "anisotropy", "fabric_direction_deg"
    return row | {name: whole.interval[name] for name in names}


def _stress_maps(snapshot: Any, sheet: Sheet) -> dict[str, Array]:
    mesh, forces = sheet.mesh, has_forces(snapshot)
    mapped = map_stress(snapshot, None if forces else NO_FORCES, mesh)
    maps = {"area": mapped.area, "solid_fraction": mapped.solid_fraction}
    if not forces:
        return maps
    acts = np.any(snapshot.contacts.force != 0, axis=1)
    cell, normal = sheet.cell_of(_wrapped(snapshot, snapshot.contacts.point[acts])), snapshot.contacts.normal[acts]
    count = np.bincount(cell, minlength=len(mesh.cells))
    fabric = np.full((len(count), 2, 2), np.nan)
    for a, b in np.ndindex(2, 2):
        np.divide(np.bincount(cell, normal[:, a] * normal[:, b], len(count)), count, out=fabric[:, a, b],
                  where=count > 0)
    maps |= {"stress": mapped.symmetric, "s": mapped.s, "t_over_s": mapped.t_over_s, "contacts": count,
             "fabric": fabric, "anisotropy": 2 * _shear(fabric)}
    for name in ("stress", "s", "t_over_s", "fabric", "anisotropy"):
        maps[name] = np.where(mapped.covered.reshape(-1, *[1] * (maps[name].ndim - 1)), maps[name], np.nan)
    return maps


def band_numbers(band: Band, field: Any) -> dict[str, Any]:
    """A band of an increment in units of its mean diameter and platen increment, with strips along it."""
    d = field.mean_diameter
    cut = strips(field.points, field.displacement, d, band, weight=field.weight,
                 platen_increment=field.platen_increment)
    middles = 0.5 * (cut.edges[1:] + cut.edges[:-1]) - band.offset
    angles = {name: band.interval[name] for name in ("angle_deg", "jump", "dilation_deg")}
    lengths = {name + "_d": Interval(*(end / d for end in band.interval[name])) for name in ("width_10_90", "offset")}
    return {**angles, **lengths, "r_squared": band.r_squared, "no_packs_because": band.no_packs_because,
            "diffuse": band.diffuse, "middle": band.line(0.0)[0].tolist(),
            "profile": {"distance_d": (middles / d).tolist(), "displacement": cut.mean.tolist()}}


def _between(start: Any, end: Any, maps: tuple[Array, Array], missing: list[dict[str, str]]) -> dict[str, Any]:
    """Mean strain and bands from one frame to another. maps: strain increment (k, 2, 2) and area (k) of the cells."""
    strain, area = maps
    known, now = np.isfinite(strain[:, 0, 0]), periods_of(end)
    mean = np.average(strain[known], axis=0, weights=area[known]) if known.any() else np.full((2, 2), np.nan)
    if len(now) == 2:  # a cell knows it exactly
        kept = np.linalg.inv(now) @ _earlier_periods(start, end, increment(start, end))
        mean = 0.5 * (kept + kept.T) - np.eye(2)
    row: dict[str, Any] = {"from": start.progress, "to": end.progress, "strain_xx": mean[0, 0], "strain_yy": mean[1, 1],
                           "strain_xy": mean[0, 1]}
    if len(now) == 2:
        reason = {"quantity": "bands", "reason": "a cell has no platens, whose travel a band would carry"}
        missing += [] if reason in missing else [reason]
        return row | {"band_verdict": "not computed", "bands": []}
    field = increment(start, end)
    try:
        report = find_bands(**field)
    except ValueError as error:
        missing.append({"quantity": f"band from {start.progress:g} to {end.progress:g}", "reason": str(error)})
        return row | {"band_verdict": "not computed", "bands": []}
    return row | {"band_verdict": report.verdict, "bands": [band_numbers(band, field) for band in report.bands]}


def _sheets(frames: list[Any], size: float) -> list[Sheet]:
    """Cells of about `size` [length] over the outline of each frame, the same number in every one."""
    first, left, right = frames[0], frames[0].outline_left, frames[0].outline_right
    if len(periods_of(first)) == 2:
        cells = cell_of(first, size)
        return [replace(cells, corner=frame.outline_left[0], sides=periods_of(frame)) for frame in frames]
    n_x = max(1, round((right[:, 0].mean() - left[:, 0].mean()) / size))
    n_y = max(1, round((left[-1, 1] - left[0, 1]) / size))
    return [outline_of(frame, n_x, n_y) for frame in frames]


def homogenise(grains: Any, grid: float = 3.0) -> Homogenised:
    """Homogenises grains without a continuum.

    grains  a result folder with discrete.h5 (of `diptych run`, `discrete` or `import`), or snapshots of the same grains
    grid    size of the cells over the outline of the sample [mean diameters]

    One snapshot gives all but strain and bands. Stresses of runs are means over the stage that ends at the frame. Those
    of imported frames are of their instant. Raises FileNotFoundError without grains, ValueError for an empty list.
    """
    if isinstance(grains, (str, os.PathLike)):
        results = load(grains).discrete
        if results is None:
            raise FileNotFoundError(f"{os.fspath(grains)}: no discrete.h5")
        grains = results.snapshots
    frames = list(grains)
    if not frames:
        raise ValueError("homogenise: at least one snapshot is needed")
    first, last, scanned = frames[0], frames[-1], [k for k, frame in enumerate(frames) if has_forces(frame)]
    missing = [{"quantity": f"stress, fabric and contacts at {frame.progress:g}",
                "reason": "no contact of this frame carries force, or the files hold none"}
               for k, frame in enumerate(frames) if k not in scanned] if scanned or len(frames) == 1 else [
        {"quantity": "stress, fabric and contacts", "reason": "no frame has contacts: displacements alone"}]
    if len(frames) == 1:
        missing.append({"quantity": "strain and bands", "reason": "there is only one frame"})
    sheets = _sheets(frames, grid * first.mean_diameter)
    maps, increments = [_stress_maps(frame, sheet) for frame, sheet in zip(frames, sheets)], []
    for before, end, sheet, fields in zip(frames, frames[1:], sheets[1:], maps[1:]):
        strain, total = (_strain(start, end, sheet.mesh.centres) for start in (before, first))
        fields |= {"strain_increment": strain, "shear_strain_increment": _shear(strain),
                   "strain_since_start": total, "shear_strain_since_start": _shear(total)}
        increments.append(_between(before, end, (strain, fields["area"]), missing))
    if len(frames) > 2:
        increments.append(_between(first, last, (maps[-1]["strain_since_start"], maps[-1]["area"]), missing))
    scan = width_scan(frames[scanned[-1]]) if scanned else {}
    if scan:
        scan["frame"] = scanned[-1]
    elif scanned:
        missing.append({"quantity": "averaging width", "reason": "the sample is too narrow for kernels of different "
                        "widths"})
    means = [_means(frame, first) for frame in frames]
    return Homogenised(frames=means, increments=increments, meshes=[sheet.mesh for sheet in sheets], maps=maps,
                       resolution_study=scan, missing=missing, mean_diameter=first.mean_diameter, grid=grid,
                       walk=last.walk)
