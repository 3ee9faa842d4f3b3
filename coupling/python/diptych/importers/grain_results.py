# diptych: another code's sample as results of the grains
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Snapshots, history and scene of an imported sample. Files hold instants, which replace the means over stages."""

import math
from typing import Any, Sequence

import numpy as np

from .. import _diptych, scenes
from ..errors import SceneError
from .arrival import Arrival
from .checks import axial_strain, sum_of_forces
from .frames import refused
from .periods import is_cell
from .touching import NORMALS, SIDES, Instant, dot, length, total

GROWTH = 1e-9  # least growth of the loading variable between two frames
LEAST_FRICTION = 0.05  # frames at rest show less between smooth walls
LEAST_FORCE = 0.1  # mean normal forces of such contacts; the ratio of smaller ones is round-off
MOST_DIAMETERS = 1e5  # between the lower and the upper wall


def _require_places(arrival: Arrival) -> None:
    for now in arrival.frames:
        if is_cell(now.period) != is_cell(arrival.frames[0].period):
            raise now.refused("is periodic in other directions than the first frame")
        if not np.isfinite(now.place[:2]).all() and not is_cell(now.period):
            raise now.refused("the places of the lower and the upper wall are in none of the files; give a table with "
                              "frame, lower_y and upper_y (or width and height), or use --walls-touch")
    for now in arrival.frames:
        height = now.period[1, 1] if is_cell(now.period) else now.place[1] - now.place[0]
        n = height / arrival.mean_diameter
        if not 1 <= n <= MOST_DIAMETERS:
            raise now.refused(f"the lower and the upper end are {_diptych.text_of_number(n)} mean diameters apart; 1 "
                              "to 100000 are allowed", "wall_file")


def _loading_variable(arrival: Arrival, strains: dict[str, np.ndarray]) -> str:
    """The strain that grows from frame to frame. Raises SceneError if neither does."""
    if is_cell(arrival.frames[0].period):
        return "path"  # of any strains
    grows = {name: bool(np.all(strain[1:] > strain[:-1] + GROWTH)) for name, strain in strains.items()}
    first, last = arrival.frames[0], arrival.frames[-1]
    if not any(grows.values()):
        raise refused(last.wall_file, f"frame {first.name} to frame {last.name}: the frames are not a monotonic "
                      "loading: neither the descent of the upper wall nor its motion to the right grows from frame to "
                      "frame; import frames of one monotonic path, each once")
    return max((name for name in grows if grows[name]), key=lambda name: abs(strains[name][-1]))


def _forces(now: Instant, names: Sequence[str]) -> dict[str, float]:
    """The forces of the walls by these names and x or y."""
    return {name + axis: now.force[k, a] for k, name in enumerate(names) for a, axis in enumerate("xy")}


def _snapshot(now: Instant, first: Instant, setting: dict[str, Any]) -> Any:
    g, n = now.grains, len(now.grains["id"])
    grains = {name: g[name] for name in ("position", "velocity", "spin", "radius", "mass")}
    grains |= {name: g[of] - first.grains[of] for name, of in (("displacement", "position"), ("rotation", "rotation"))}
    touched = np.bincount(np.concatenate([now.contacts["i"], now.contacts["j"]]).astype(int), minlength=n)[:n]
    spin_term = 0.25 * g["mass"] * g["radius"] * g["radius"] * g["spin"] * g["spin"]  # (1/2) omega^2 I of discs
    grains |= {"mean_spin_term": np.where(np.isfinite(spin_term), spin_term, 0),
               "rattler": now.has_contacts & (touched == 0), "fixed": np.zeros(n), "applied_force": g["weight"]}
    setting |= {"time": now.time - (first.time if math.isfinite(first.time) else 0), "step": math.nan,
                "residual": math.nan}
    if is_cell(now.period):
        setting |= dict(zip(("cell_a1_x", "cell_a2_x", "cell_a1_y", "cell_a2_y"), now.period.ravel()))
    else:
        setting |= {"upper_platen_displacement_x": now.travel - first.travel,
                    "upper_platen_displacement_y": now.place[1] - first.place[1],
                    "cell_width": 0.0 if now.period is None else now.period[0, 0],
                    **dict(zip(("lower_y", "upper_y", "left_x", "right_x"), now.place)),
                    **_forces(now, ("lower_platen_force_", "upper_platen_force_"))}
    return _diptych.grain_snapshot(grains, now.contacts if now.has_contacts else None, setting)


def _unbalanced_force(now: Instant) -> float:
    """Mean over grains of the sum of forces on each / mean normal contact force."""
    c, weight = now.contacts, now.grains["weight"]
    normal = total(dot(c["force"], c["normal"]) / len(c["i"]))
    return total(length(sum_of_forces(now) + weight) / len(weight)) / normal


UNKNOWN = ("kinetic_energy_ratio", "friction_dissipation", "impact_dissipation", "external_work", "correction_work",
           "rolling_dissipation", "energy_residual", "momentum_residual", "residual", "skew_moment", "inertial_number",
           "spin_term_share", "core_sxx", "core_sxy", "core_syy", "side_sxx",
           "platen_sxx")
STRAINS = {"exx": (0, 0), "eyy": (1, 1), "exy": (0, 1)}  # of a cell
SAME = ("time", "axial_strain", "shear_strain", "progress", "walk")  # as in the snapshot
WALL_FORCES = [side + "_f" for side in SIDES]


def _row(now: Instant, check: dict[str, Any], s: Any, first_area: float) -> dict[str, Any]:
    """A row of discrete.csv; columns that it does not have are 0."""
    g, c, n = now.grains, now.contacts, len(now.grains["id"])
    turning = 0.5 * g["radius"] * g["radius"] * g["spin"] * g["spin"]
    status = c["status"][(c["j"] == n) | (c["j"] == n + 1)]  # of contacts with the platens
    (sxx, sxy), (syx, syy) = stress = total(s.internal_moment / s.area)
    mean, t = 0.5 * (sxx + syy), np.hypot(0.5 * (sxx - syy), 0.5 * (sxy + syx))
    row = dict.fromkeys(UNKNOWN, math.nan) | {name: getattr(s, name) for name in SAME} | _forces(now, WALL_FORCES)
    row |= {"sxx": sxx, "sxy": sxy, "syx": syx, "syy": syy, "volumetric_strain": 1 - s.area / first_area,
            "stress_ratio": t / mean if np.isfinite(stress).all() and mean > 0 else math.nan,
            "solid_fraction": total(np.pi * g["radius"] * g["radius"]) / s.area,
            "width": s.area / (s.cell_a2_y or now.place[1] - now.place[0]), "contacts": len(c["i"]),
            "kinetic_energy": total(0.5 * g["mass"] * (dot(g["velocity"], g["velocity"]) + turning)),
            "rattlers": int(s.rattler.sum()), "max_penetration": check["largest_overlap"],
            "unbalanced_force": _unbalanced_force(now) if len(c["i"]) else math.nan,
            "platen_sliding": np.mean(status == 2) if len(status) and np.all(c["status"] != 3) else math.nan}
    if is_cell(now.period):
        row |= dict.fromkeys(("drive_sxx", "drive_syy", "drive_sxy"), math.nan)
        row |= {name: now.strain[at] for name, at in STRAINS.items()}
    if math.isfinite(g["spin"][0]) and math.isfinite(g["mass"][0]):
        row["spin_term_share"] = total(s.mean_spin_term) / s.area / mean
    return row


@np.errstate(all="ignore")
def results_of(arrival: Arrival) -> Any:
    """One snapshot and one row of the history per frame; the first frame is the start of the loading. nan: unknown.

    Raises SceneError if the upper wall neither descends nor moves sideways steadily from frame to frame.
    """
    _require_places(arrival)
    first = arrival.frames[0]
    height = first.place[1] - first.place[0]
    strains = {"axial_strain": np.array([axial_strain(now, height) for now in arrival.frames]),
               "shear_strain": np.array([2 * now.strain[0, 1] if is_cell(now.period) else
                                         (now.travel - first.travel) / height for now in arrival.frames])}
    walk = _loading_variable(arrival, strains) if len(arrival.frames) > 1 else "axial_strain"
    snapshots = []
    for k, now in enumerate(arrival.frames):
        at = {name: strain[k] for name, strain in strains.items()}
        at |= {"walk": walk, "progress": at.get(walk, k), "mean_diameter": arrival.mean_diameter}
        snapshots.append(_snapshot(now, first, at))
    rows = [{**_row(now, check, s, snapshots[0].area), "step": k}
            for k, (now, check, s) in enumerate(zip(arrival.frames, arrival.checks, snapshots))]
    for before, row in zip(rows, rows[1:]):
        strain = np.linalg.norm([(1 + (name == "exy")) * (row[name] - before[name]) for name in STRAINS]) if (
            walk == "path") else row["progress"] - before["progress"]
        rate = strain / np.float64(row["time"] - before["time"])
        mean = 0.5 * (row["sxx"] + row["syy"])
        row["inertial_number"] = rate * arrival.mean_diameter * np.sqrt(arrival.density / mean)
    return _diptych.grain_results(snapshots, rows)


def facts_of(arrival: Arrival, results: Any) -> dict[str, Any]:
    """The facts of the grains in provenance.json."""
    first, last = results.snapshots[0], results.snapshots[-1]
    return {"preparation_solid_fraction": float(results.history()["solid_fraction"][0]),
            "initial_height": first.upper_y - first.lower_y, "finished": True, "reached_progress": last.progress,
            "reached_axial_strain": last.axial_strain, "reached_shear_strain": last.shear_strain,
            "message": f"imported: {arrival.format}"}


def _side_pressure(arrival: Arrival, results: Any) -> float:
    """Mean horizontal stress on the side walls in the first frame with forces."""
    for what, stresses in (("force on the right wall / height", [-now.force[3, 0] / (now.place[1] - now.place[0])
                                                                 for now in arrival.frames]),
                           ("mean horizontal stress of the contacts", results.history()["sxx"])):
        for now, pressure in zip(arrival.frames, stresses):
            if pressure > 0:
                arrival.remarks.append(f"loading/pressure = {pressure:.6g}, from the {what} in frame {now.name}; "
                                       "--pressure sets another")
                return pressure
    raise arrival.frames[0].refused("no lateral pressure was found, because no frame has a force on the right wall or "
                                    "a horizontal stress above 0; give --pressure P", "wall_file")


def _friction(arrival: Arrival, of_walls: bool) -> float:
    """The largest ratio T/N of the tangential and normal force of a contact of two grains or with a wall; without
    contacts with walls that of the sums on a wall. It is the friction if one contact slides, else less. nan: no
    forces."""
    n, found = len(arrival.id), []
    for now in arrival.frames:
        c = now.contacts
        these = (c["j"] >= n) == of_walls
        force, normal = c["force"][these], c["normal"][these]
        if of_walls and not these.any():
            force, normal = now.told_force, NORMALS
        push = dot(force, normal)
        pressed = push > 0  # false for nan
        if pressed.any():
            pressed &= push > LEAST_FORCE * push[pressed].mean()
            found += list((length(force - push[:, None] * normal) / push)[pressed])
    return float(f"{max(found, default=math.nan):.3g}")


def _grain_friction(arrival: Arrival) -> dict[str, Any]:
    """The key of the friction between grains where the forces show one."""
    friction = _friction(arrival, of_walls=False)
    if not friction > LEAST_FRICTION:
        return {}
    arrival.remarks.append(f"the forces between grains show friction: T/N up to {friction:g}; the scene takes it as "
                           "discrete/friction")
    return {"friction": friction}


def _platens(arrival: Arrival, lateral: str) -> dict[str, Any]:
    """Keys of the continuum's walls in a compression, from the forces of the walls where they are known."""
    if lateral == "periodic":  # rough platens would hold the corners that the period takes along
        return {"platens": "smooth"}
    friction = _friction(arrival, of_walls=True)
    if friction > LEAST_FRICTION and lateral == "rigid_walls":
        arrival.remarks.append(f"the forces on the walls show friction: T/N up to {friction:g}; the scene takes "
                               "continuum/platens = frictional with this platen_friction on all walls, full from the "
                               "first slip (platen_slip_length = 0)")
        return {"platens": "frictional", "platen_friction": friction, "platen_slip_length": 0}
    platens = "rough" if lateral == "end_grains" and not friction <= LEAST_FRICTION else "smooth"
    if math.isnan(friction):
        arrival.remarks.append(f"no forces on walls are in the files: the scene takes continuum/platens = {platens}")
    return {"platens": platens}


def scene_of(arrival: Arrival, results: Any, pressure: float | None) -> str:
    """Text of a scene that runs on these results with `file` beside it. Raises SceneError if it would not run."""
    last, rows, number = results.snapshots[-1], results.history(), _diptych.text_of_number
    has_sides, is_axial = math.isfinite(results.snapshots[0].left_x), last.walk == "axial_strain"
    progress = np.array([s.progress for s in results.snapshots])
    stages = progress[1:]
    edges = [0, *dict.fromkeys([stages[(len(stages) - 1) // 2], stages[-1]])]
    time, sections = rows["time"][-1], {}
    sections["sample"] = {"mean_diameter": arrival.mean_diameter,
                          **({"density": arrival.density} if math.isfinite(arrival.density) else {})}
    sections["loading"] = {"pressure": _side_pressure(arrival, results) if pressure is None else pressure,
                           "mode": "descent" if is_axial else "shear", "axial_strain": stages[-1], "stages": stages,
                           **({"strain_rate": rows["progress"][-1] / time} if time > 0 and math.isfinite(time) else {})}
    sections["discrete"] = {"method": "imported", "file": "discrete.h5",
                            "lateral": "rigid_walls" if has_sides else
                            "periodic" if results.snapshots[0].cell_width else "end_grains",
                            **_grain_friction(arrival)}
    lateral = sections["discrete"]["lateral"]
    if lateral == "end_grains":
        arrival.remarks.append("no side walls are in the files: the scene takes discrete/lateral = end_grains, free "
                               "sides that carry loading/pressure")
    if is_axial:
        sections["continuum"] = _platens(arrival, lateral)
    elif lateral == "periodic":
        sections["discrete"]["side_motion"] = "velocity"  # of a period that keeps its width
    # The continuum is compared at instants, too.
    sections["comparison"] = {"window_edges": edges, "averaging_strain": 1e-3 * np.diff(progress).min()}
    try:
        _diptych.read_scene(None, list(scenes.changes(sections)), False)
    except SceneError as error:  # units and options may lead out of the ranges of a scene's keys
        raise SceneError(f"import {arrival.format}: the scene of this sample would not run: {error}") from error

    def text(value: Any) -> str:
        return value if isinstance(value, str) else ", ".join(map(number, np.atleast_1d(value)))

    unit = f", per unit thickness ({number(arrival.thickness)})" if arrival.thickness != 1 else ""
    lines = [f"# A sample of {arrival.format}, imported; lengths, forces and masses in the units of its files{unit}.",
             "# The continuum is loaded by the motion of its walls. Keys of the continuum and of the comparison may be "
             "changed."]
    for section, keys in sections.items():
        lines += [f"subsection {section}", *(f"  set {key} = {text(value)}" for key, value in keys.items()), "end"]
    return "\n".join(lines) + "\n"
