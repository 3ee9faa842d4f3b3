# diptych: operators on snapshots and on arrays
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stress maps, bands, strips and probes, from snapshots of the panels or from arrays."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from . import _diptych, scenes
from .arrays import Array, Band, BandReport, Interval, Mesh, periods_of, Record, StressMap
from .sheets import cell_of

_CONTACT = ("i", "j", "point", "force", "normal", "shift", "shift_y", "couple")


def _column(table: Any, name: str) -> Any:
    """An entry of a dict or a DataFrame, or an attribute; None if missing."""
    if isinstance(table, Mapping) or hasattr(table, "columns"):
        return table[name] if name in table else None
    return getattr(table, name, None)


def _grains(grains: Any) -> dict[str, Array]:
    position, radius = _column(grains, "position"), _column(grains, "radius")
    if position is None and _column(grains, "x") is not None:
        position = np.column_stack([_column(grains, "x"), _column(grains, "y")])
    if radius is None:
        radius = _column(grains, "r")
    if position is None or radius is None:
        raise ValueError("grains: position (n, 2), or x and y, and radius (or r) are needed")
    position, radius = np.asarray(position, dtype=float), np.asarray(radius, dtype=float)
    if position.ndim != 2 or position.shape[1] != 2 or len(position) == 0:
        raise ValueError(f"position: an array of shape (n, 2) is needed, this one has {position.shape}")
    if radius.shape != (len(position),) or not np.all(radius > 0):
        raise ValueError(f"radius: {len(position)} positive numbers are needed, one per grain")
    return {"position": position, "radius": radius}


def _from_import(contacts: Any, grains: Any) -> dict[str, Any]:
    """Contacts with the columns of the CSV files of an import, whose bodies are ids or, if negative, walls."""
    vectors = {name: np.column_stack([_column(contacts, axis) for axis in axes])
               for name, axes in (("force", ("fx", "fy")), ("point", ("px", "py")))
               if _column(contacts, axes[0]) is not None}
    ids, n = _column(grains, "id"), len(_grains(grains)["radius"])
    number = {int(name): k for k, name in enumerate(range(n) if ids is None else ids)}
    for name in ("i", "j"):
        bodies = [int(body) for body in _column(contacts, name)]
        if lost := [body for body in bodies if body >= 0 and body not in number]:
            raise ValueError(f"contacts: body {lost[0]} of '{name}' is not a grain")
        vectors[name] = np.array([number[body] if body >= 0 else n - 1 - body for body in bodies])
    return vectors


def _contacts(contacts: Any, grains: Any) -> dict[str, Any]:
    if contacts is None:
        contacts = getattr(grains, "window", None)
        if contacts is None:
            raise ValueError("contacts are needed: i, j, point, force")
        if len(contacts) == 0:
            contacts = grains.contacts
    given = {name: _column(contacts, name) for name in _CONTACT}
    if given["force"] is None and _column(contacts, "fx") is not None:
        given |= _from_import(contacts, grains)
    for name in _CONTACT[:4]:
        if given[name] is None:
            raise ValueError(f"contacts: '{name}' is missing; points may be px, py and forces fx, fy, and "
                             "diptych.contacts() computes points from grains, walls and forces")
    if given["couple"] is not None:
        given["couple"] = np.nan_to_num(given["couple"])  # NaN: not in the files of another code
    return given


def _mesh(mesh: Any) -> Mesh:
    if isinstance(mesh, StressMap):
        return mesh.mesh
    if isinstance(mesh, _diptych.ContinuumSnapshot):
        return Mesh(**_diptych.mesh_of(mesh))
    nodes, cells = (mesh["nodes"], mesh["cells"]) if isinstance(mesh, Mapping) else mesh
    return Mesh(np.asarray(nodes, dtype=float), np.asarray(cells))


def grid(lower: Any, upper: Any, size: float) -> Mesh:
    """A mesh of equal rectangles over the box from `lower` (2) to `upper` (2), with sides of about `size` [length]."""
    return Mesh(**_diptych.grid(lower, upper, size))


def contacts(grains: Any, i: Any, j: Any, force: Any, *, ids: Any = None,
             walls: Mapping[int, tuple[Any, Any]] | None = None) -> Record:
    """Adds contact points, which many codes do not write, to contacts of discs: on the line of centres or a wall.

    grains  position (n, 2), or x and y, and radius (or r) [length]: a dict, a DataFrame or a snapshot
    i, j    (c): numbers of the bodies, as in `ids` if given, else counted from 0
    force   (c, 2): force ON i from j
    ids     (n): numbers of the grains, in any order, gaps allowed
    walls   number -> (a point on it (2), its inward normal (2)); the result numbers them after the grains, in this
            order

    Returns i, j, point, normal, force for map_stress() and probe(). If `force` has the wrong sign, the mean stress is
    negative. Raises ValueError with the number of a missing body.
    """
    given, walls = _grains(grains), walls or {}
    position, radius = given["position"], given["radius"]
    n, i, j, force = len(radius), np.asarray(i), np.asarray(j), np.array(force, dtype=float)
    names = np.arange(n) if ids is None else np.asarray(ids)
    number = {int(name): k for k, name in enumerate([*names, *walls])}
    missing = sorted({int(name) for name in [*i, *j]} - set(number))
    if missing:
        raise ValueError(f"body {missing[0]} of a contact is neither a grain nor a wall ({len(missing)} such numbers)")
    i, j = (np.array([number[int(name)] for name in side], dtype=np.int32) for side in (i, j))
    swapped = i >= n
    i[swapped], j[swapped] = j[swapped], i[swapped]
    force[swapped] *= -1
    if np.any(i >= n):
        raise ValueError("a contact joins two walls")
    normal, point = np.zeros((len(i), 2)), np.zeros((len(i), 2))
    pair = j < n
    a, b = i[pair], j[pair]
    branch = position[a] - position[b]
    normal[pair] = branch / np.linalg.norm(branch, axis=1, keepdims=True)
    gap = np.linalg.norm(branch, axis=1) - radius[a] - radius[b]
    point[pair] = position[a] - (radius[a] + 0.5 * gap)[:, None] * normal[pair]
    for k, (place, inward) in enumerate(walls.values()):
        at = j == n + k
        inward = np.asarray(inward, dtype=float) / np.linalg.norm(inward)
        normal[at] = inward
        point[at] = position[i[at]] - ((position[i[at]] - np.asarray(place)) @ inward)[:, None] * inward
    return Record(i=i, j=j, point=point, normal=normal, force=force)


def map_stress(grains: Any, contacts: Any = None, mesh: Any = None, method: str = "segments", *,
               period: Any = None, **options: Any) -> StressMap:
    """Maps contact forces to stress on the cells of a mesh. Conservative: the sums over cells and contacts are equal.

    grains    snapshot of a DiscretePanel, or position (n, 2), or x and y, and radius (or r) [length] in a dict or a
              DataFrame
    contacts  i, j (c), point (c, 2) [length], force (c, 2) ON i from j [pressure length]; i is a grain, j a grain or
              (from n on) a wall; shift, shift_y (c) of a periodic image of j; couple (c) ON i [pressure length^2].
              Or the columns of the CSV files of an import: i, j (ids; a negative j is a wall), px, py, fx, fy.
              Default for a snapshot: the mean forces over the stage, or before the first stage those of the instant.
    mesh      (nodes (m, 2), cells (k, 4) anticlockwise), grid(...), a continuum snapshot; default: grid of 3 d over the
              grains' box, or over the cell of a snapshot that is periodic in both directions
    method    segments (branches cut by the cells), centroid, laguerre, kernel, projection
    period    width of a periodic sample [length], 0: none; or the two vectors (2, 2) of a cell periodic in both
              directions, a row each; default: that of the snapshot
    options   averaging_kernel, averaging_width [mean diameters]: as in the section comparison of a scene

    Returns a StressMap: stress (k, 2, 2) positive in compression, row index = component of the force, and couple_stress
    (k, 2). The spin term, small in slow flow, is not added. Source: coupling/averaging (branches: Drescher & de
    Josselin de Jong 1972; Bagi 1996). Raises SceneError for a wrong option, ValueError for a wrong array.
    """
    given = _grains(grains)
    pairs = _contacts(contacts, grains)
    if period is None:
        periods = periods_of(grains)
    else:
        periods = np.array([[period, 0.0]] if np.ndim(period) == 0 else period, dtype=float)
    if mesh is None and len(periods) == 2 and period is None:
        mesh = cell_of(grains, 6 * given["radius"].mean()).mesh
    if mesh is None:
        position, radius = given["position"], given["radius"]
        mesh = grid((position - radius[:, None]).min(0), (position + radius[:, None]).max(0), 6 * radius.mean())
    cells = _mesh(mesh)
    keys = {"averaging": method, **{name: scenes.text_of(value) for name, value in options.items()}}
    result = _diptych.map_stress(given, pairs, cells._asdict(), periods, keys)
    result["covered"] = result["covered"].astype(bool)
    return StressMap(mesh=cells, **result)


def increment(start: Any, end: Any) -> Record:
    """Displacements between two snapshots of one panel, for find_bands(**increment(a, b)).

    Returns points (n, 2) at the later instant, displacement (n, 2), and weight (n): the area of a node or a grain, 0
    for rattlers. For grains it also returns mean_diameter, platen_increment, and centre, width, height of the outline.
    Raises ValueError for snapshots of different grains."""
    return Record(_diptych.increment(start, end))


def _frame(points: Array, displacement: Array, mean_diameter: float, given: Mapping[str, Any]) -> dict[str, Any]:
    low, high = points.min(0), points.max(0)
    frame = {"centre": 0.5 * (low + high), "width": high[0] - low[0], "height": high[1] - low[1],
             "mean_diameter": mean_diameter, **{name: value for name, value in given.items() if value is not None}}
    if "platen_increment" not in frame:  # from the points near both ends: each end has at least one
        top, bottom = points[:, 1] > high[1] - 2 * mean_diameter, points[:, 1] < low[1] + 2 * mean_diameter
        frame["platen_increment"] = displacement[top].mean(0) - displacement[bottom].mean(0)
    return frame


def _field(points: Any, displacement: Any, weight: Any) -> dict[str, Array]:
    points, displacement = np.asarray(points, dtype=float), np.asarray(displacement, dtype=float)
    if not (np.all(np.isfinite(points)) and np.all(np.isfinite(displacement))):
        raise ValueError("points and displacement: all must be finite; leave out the others")
    if points.ndim != 2 or points.shape[1:] != (2,) or points.shape != displacement.shape or len(points) == 0:
        raise ValueError(f"points and displacement: (n, 2) each are needed, they have {points.shape} and "
                         f"{displacement.shape}")
    return {"position": points, "increment": displacement, "weight": np.ones(len(points)) if weight is None else weight}


def find_bands(points: Any, displacement: Any, mean_diameter: float, *, weight: Any = None,
               platen_increment: Any = None,
               centre: Any = None, width: float | None = None, height: float | None = None, seed: int = 1,
               **options: Any) -> BandReport:
    """Finds shear bands in a displacement field of grains, nodes or image correlation.

    points            (n, 2) [length] at the end of the increment
    displacement      (n, 2) [length]
    mean_diameter     of the grains [length]: unit of widths and correlation lengths
    weight            (n): area of each point, 0 leaves it out; default: equal
    platen_increment  (2) [length]: unit of the jumps; default: mean displacement within 2 d of the uppermost point
                      minus that within 2 d of the lowest
    centre, width, height  of the sample [length]; default: of the box of the points
    seed              for the random blocks of the intervals
    options           max_bands, huber_threshold, correlation_length, minimum_jump, residual_floor, band_resamples: as
                      in the section comparison of a scene

    Fits no, one and two tanh profiles with Huber loss and chooses their number by BIC (coupling/bands). Returns a
    BandReport: angles in degrees from the horizontal, lengths in the unit of the points, 95 % intervals by block
    bootstrap. Raises SceneError for a wrong option, ValueError below 30 points with weight or without an increment.
    """
    field = _field(points, displacement, weight)
    frame = _frame(field["position"], field["increment"], mean_diameter,
                   {"platen_increment": platen_increment, "centre": centre, "width": width, "height": height})
    found = _diptych.find_bands(field, frame, seed, {name: scenes.text_of(value) for name, value in options.items()})
    bands = []
    for band in found.pop("bands"):
        intervals = {name: Interval(*ends) for name, ends in band.pop("interval").items()}
        bands.append(Band(**band, interval=intervals, centre=np.asarray(frame["centre"])))
    return BandReport(bands=bands, frame=frame, **found)


def strips(points: Any, displacement: Any, mean_diameter: float, band: Any = 45.0, n: int = 16, *, offset: float = 0.0,
           weight: Any = None, platen_increment: Any = None) -> Record:
    """Mean displacement along a band in strips parallel to it (Moreau 1997).

    points, displacement, mean_diameter, weight, platen_increment  as in find_bands()
    band    a Band, or an angle from the horizontal [degrees] with the `offset` of its middle from the centre of the
            points [length]
    n       number of strips; they reach 30 mean diameters to both sides, or to the edge of the sample

    Returns edges (n + 1) along the normal from the centre [length]; mean and deviation (n) over |platen increment|, NaN
    in an empty strip; count (n); angle_deg.
    """
    field = _field(points, displacement, weight)
    frame = _frame(field["position"], field["increment"], mean_diameter, {"platen_increment": platen_increment})
    if isinstance(band, Band):
        frame["centre"] = band.centre
        band, offset = band.angle_deg, band.offset
    return Record(_diptych.strips(field, frame, float(band), offset, n))


def displacement_gradient(points: Any, displacement: Any, at: Any = None, *, radius: float,
                          weight: Any = None) -> Array:
    """(m, 2, 2): d u_k / d x_l at the places `at` (m, 2); default: at the points. An affine least-squares fit to the
    points within `radius` [length]; NaN for fewer than 4 points or nearly collinear ones."""
    field = _field(points, displacement, weight)
    return _diptych.displacement_gradient(field, field["position"] if at is None else at, radius)


def shear_strain(points: Any, displacement: Any, at: Any = None, *, radius: float, weight: Any = None) -> Array:
    """(m): eps_1 - eps_2 >= 0 at the places `at` (m, 2); default: at the points. The displacement gradient is fitted to
    the points within `radius` [length]; the comparison uses 2.5 mean diameters. NaN for fewer than 4 points."""
    field = _field(points, displacement, weight)
    return _diptych.shear_strain(field, field["position"] if at is None else at, radius)


def probe(sample: Any, where: Any, contacts: Any = None, *, angle_deg: float = 0.0, block: float | None = None,
          resamples: int = 400, seed: int = 1) -> Record:
    """Mean stress and fabric in a polygon or circle, with 95 % intervals (Moreau 1997).

    sample     a snapshot (means over the stage with the spin term, as in the comparison); or grains with `contacts` as
               in map_stress(), without the spin term; or a StressMap, whose cells are averaged
    where      (m, 2): corners of a polygon, anticlockwise; or (x, y, radius) of a circle, only for grains
    angle_deg  direction of the bootstrap blocks [degrees]
    block      smallest side of the blocks [length]; default: 5 mean diameters
    resamples  number of bootstrap samples; fewer than 40: no intervals

    Returns stress (2, 2) positive in compression, s1 >= s2, t_over_s and direction_deg of s1. For a polygon of grains
    also fabric (2, 2), anisotropy, fabric_direction_deg, contacts, solid_fraction, count, and interval: name -> (value,
    low, high). For a circle also the tractions on its diameters (angles_deg, normal, tangential) and those predicted by
    the mean stress. Raises ValueError with the name of the argument.
    """
    if isinstance(sample, StressMap):
        return Record(_diptych.probe_cells(sample.mesh._asdict(), sample.stress, np.asarray(where, dtype=float)))
    grains: Any = _grains(sample)
    blocks = {"block": 10 * grains["radius"].mean() if block is None else block, "resamples": resamples, "seed": seed}
    pairs = None
    if contacts is None and isinstance(sample, _diptych.DiscreteSnapshot) and len(sample.window) > 0:
        grains = sample
    else:
        pairs = _contacts(contacts, sample)
    if np.ndim(where) == 1:
        x, y, radius = (float(number) for number in where)
        result = _diptych.probe_circle(grains, pairs, (x, y, radius), blocks)
        result["relative_l2"] = Interval(*result["relative_l2"])
        return Record(result)
    result = _diptych.probe_grains(grains, pairs, np.asarray(where, dtype=float), angle_deg, blocks)
    result["interval"] = {name: Interval(*ends) for name, ends in result["interval"].items()}
    return Record(result)


def platen_friction(samples: Sequence[Any], *, mirror_symmetric: bool = True, parts: int = 5) -> Record:
    """The law of continuum/platens = frictional, fitted to slip and shear of grains along flat platens.

    samples           list per sample of its snapshots in their order: load(FOLDER).discrete.snapshots
    mirror_symmetric  the platen is folded at its middle, as in a vertical compression
    parts             number of parts of the folded platen; twice as many suit a whole one

    Returns friction [-] and slip_length [length], each (value, low, high): 95 % intervals by a jackknife over the
    samples. NaN if nothing slips.
    """
    found = _diptych.platen_friction([list(sample) for sample in samples], mirror_symmetric, parts)
    return Record({name: Interval(*ends) for name, ends in found.items()})


def theory_lines(friction_deg: float, dilatancy_deg: float) -> tuple[float, float, float]:
    """Angles between a band and the minor principal stress after Coulomb (45 + phi/2), Roscoe (45 + psi/2) and Arthur
    (45 + (phi + psi)/4) [degrees]."""
    return _diptych.theory_lines(friction_deg, dilatancy_deg)
