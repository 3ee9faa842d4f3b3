# diptych: another code's frames in order
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Puts the frames of a reader in order: grains ascend by their ids, forces are per unit thickness."""

import math
from dataclasses import dataclass, field
from typing import Any, Sequence

import numpy as np

from .. import _diptych
from ..entries import describe
from ..errors import SceneError
from ..files import sha256_of
from .checks import check_arrival
from .frames import Frame, Options, completed, refused
from .periods import is_cell
from .touching import Instant, take_contacts, total

describe("import.json", """\
format (text): format of the files
files (list): files that were read
sha256 (list): their SHA-256 checksums
thickness [length]: thickness by which forces and masses were divided
mean_diameter [length]: mean diameter d of the grains, or the value of --mean-diameter
density [mass/length^2]: mass of the grains / their area, per unit thickness; null: unknown
remarks (list): notes on data that were reordered, reversed or left out
lacking (list): quantities that the files do not contain; absent from all results
doubtful (list): findings of the checks that a user should look at
frames/: one per frame
    frame (text): name of the frame in the files
    time [time]: time of the frame; null: not in the files
    axial_strain: descent of the upper wall / height in the first frame
    grains: number of grains
    contacts: number of contacts between grains with a force
    lower_contacts: number of contacts with the lower wall with a force
    upper_contacts: number of contacts with the upper wall with a force
    left_contacts: number of contacts with the left wall with a force
    right_contacts: number of contacts with the right wall with a force
    mass [mass]: mass of all grains, per unit thickness
    solid_fraction: area of the grains / area between the walls
    balance_against_resultants (yes or no): true: contact forces are compared with the resultant in the file; false: \
        with zero
    balance_rms: rms over grains of contact forces plus weight minus resultant (or 0) / mean contact force; without \
        resultants and with free sides only the vertical component counts
    balance_worst: largest such residual of a grain
    balance_worst_grain: id of that grain
    contact_stress (tensor) [pressure]: sum over contacts of force (x) branch / area
    wall_stress (tensor) [pressure]: sum over wall contacts of force on the wall (x) contact point, less weights (x) \
        centres, / area
    stress_difference: largest component of their difference / largest component of the wall stress; inertia or an error
    wall_force_difference: wall forces in the files against the sums of contacts, relative
    largest_overlap [mean diameters]: largest overlap of two grains or of a grain and a wall
""")


@dataclass(kw_only=True, repr=False)
class Arrival:
    """A sample in order, with the results of its checks."""

    format: str
    files: list[str]
    id: np.ndarray  # of the grains, the same in all frames
    thickness: float
    mean_diameter: float
    density: float = math.nan  # [mass / length^2 per unit thickness]
    frames: list[Instant] = field(default_factory=list)
    checks: list[dict[str, Any]] = field(default_factory=list)  # one per frame, with the names of import.json
    remarks: list[str] = field(default_factory=list)  # on data that were reordered, reversed or left out
    lacking: list[str] = field(default_factory=list)  # quantities that the files do not contain; null in all results
    doubtful: list[str] = field(default_factory=list)  # findings of the checks that a user should look at

    def record(self) -> dict[str, Any]:
        """The content of import.json; nan: unknown."""
        return {name: value for name, value in vars(self).items() if name not in ("id", "checks")} | {
            "sha256": [sha256_of(file) for file in self.files], "frames": self.checks}


def _sorted_grains(frame: Frame) -> dict[str, np.ndarray]:
    grains = completed(frame, "grains")
    order = np.argsort(grains["id"], kind="stable")
    grains = {name: values[order] for name, values in grains.items()}
    ids, radius = grains["id"].astype(np.int64), grains["radius"]
    twice = np.append(False, ids[1:] == ids[:-1])
    bad = ~np.isfinite(grains["position"]).all(axis=1) | ~np.isfinite(radius) | (radius <= 0)
    for k in np.flatnonzero(twice | bad)[:1]:
        what = "occurs twice" if twice[k] else "has no finite position or no positive radius"
        raise refused(frame.grain_file, f"frame {frame.name}: grain {ids[k]} {what}", int(grains["line"][k]))
    return {**grains, "id": ids}


def _require_effect(format: str, frames: Sequence[Frame], options: Options) -> None:
    """An option without effect is refused, because its user believes that it counts."""
    if options.pressure is not None and len(frames) == 1:
        raise SceneError(f"import {format}: --pressure would have no effect: a single frame has no loading, so there "
                         "is no scene")
    if options.density is not None and np.isfinite(completed(frames[0], "grains")["mass"]).all():
        raise SceneError(f"import {format}: --density would have no effect: the files contain the masses of the grains")


def _thickness(format: str, is_spheres: bool, grains: dict[str, np.ndarray], options: Options) -> float:
    """Spheres lie in one layer; forces are those of its thickness. Masses that grow as r^3 belong to spheres."""
    radius, mass = grains["radius"], grains["mass"]
    by_area, by_volume = mass / (radius * radius), mass / (radius * radius * radius)
    is_spheres = is_spheres or bool(np.nanmax(by_volume, initial=0) < 1.001 * np.nanmin(by_volume, initial=np.inf)
                                    and np.nanmax(by_area, initial=0) > 1.01 * np.nanmin(by_area, initial=np.inf))
    if options.thickness is None and is_spheres:
        raise SceneError(f"import {format}: the grains are spheres; give --thickness T, the thickness over which the "
                         "forces act (stress = force / (length x T)), or 1 to keep forces per length")
    return 1.0 if options.thickness is None else options.thickness


def _weights(frame: Frame, mass: np.ndarray, options: Options) -> np.ndarray:
    gravity = np.array(frame.gravity if options.gravity is None else options.gravity, dtype=float)  # None: nan
    if not np.isfinite(gravity).all() or not gravity.any():
        return np.zeros((len(mass), 2))
    if not math.isfinite(mass[0]):
        raise refused(frame.grain_file, f"frame {frame.name}: gravity acts on the grains, but the files contain no "
                      "masses; give --density, the mass per area")
    options.note("the grains have weight; the continuum of a run has none")
    return mass[:, None] * gravity


def _ordered(frame: Frame, grains: dict[str, np.ndarray], arrival: Arrival, options: Options) -> Instant:
    ids, here = arrival.id, grains["id"]
    for lost in np.setdiff1d(ids, here)[:1]:
        raise refused(frame.grain_file, f"frame {frame.name} lacks grain {lost} of the first frame; displacements need "
                      "the same grains in all frames")
    if len(here) != len(ids):
        raise refused(frame.grain_file, f"frame {frame.name} has {len(here)} grains, but the first frame "
                      f"has {len(ids)}")
    grains["resultant"] = grains["resultant"] / arrival.thickness
    by_area = np.pi * grains["radius"] * grains["radius"] * (math.nan if options.density is None else options.density)
    grains["mass"] = np.where(np.isfinite(grains["mass"]), grains["mass"] / arrival.thickness, by_area)
    grains["weight"] = _weights(frame, grains["mass"], options)
    now = Instant(name=frame.name, grain_file=frame.grain_file, wall_file=frame.wall_file or frame.grain_file,
                  time=math.nan if frame.time is None else float(frame.time), grains=grains)
    take_contacts(frame, now, arrival, options)
    if arrival.frames and now.time <= arrival.frames[-1].time:  # false without a time
        before, number = arrival.frames[-1], _diptych.text_of_number
        raise refused(frame.grain_file, f"frame {now.name} has the time {number(now.time)}, but frame {before.name} "
                      f"before it has {number(before.time)}")
    return now


def _note_what_is_lacking(arrival: Arrival) -> None:
    last, told = arrival.frames[-1], {}
    for name, what in (("mass", "masses"), ("velocity", "velocities"),
                       ("spin", "spins (their term in the internal moment counts as 0)"), ("rotation", "rotations")):
        told[what] = np.isfinite(last.grains[name][0]).all()
    couple = last.contacts["couple"]
    told["couples of contacts (rolling resistance; they count as 0)"] = not np.isnan(couple).any()
    told["times"] = math.isfinite(last.time)
    told["which contacts slide"] = np.any(last.contacts["status"] != 3)
    told["contacts with walls"] = is_cell(last.period) or "contacts with walls" in arrival.lacking or any(
        np.any(frame.contacts["j"] >= len(arrival.id)) for frame in arrival.frames)
    told["dissipation, energies and means over stages (a frame is one instant)"] = False
    if any(len(frame.contacts["i"]) for frame in arrival.frames):
        told.update({f"contacts of frame {frame.name}": frame.has_contacts for frame in arrival.frames})
    else:
        told["contacts: positions alone give strain and bands, but no stress and no fabric"] = False
    arrival.lacking += [what for what, is_told in told.items() if not is_told]


@np.errstate(all="ignore")
def arrive(format: str, frames: Sequence[Frame], options: Options) -> Arrival:
    """Orders and checks the frames. Raises SceneError with file, line and contradiction."""
    _require_effect(format, frames, options)
    grains = [_sorted_grains(frame) for frame in frames]
    first, ids = grains[0], grains[0]["id"]
    if len(ids) < 3:
        raise refused(frames[0].grain_file, f"{len(ids)} grains; at least 3 are needed")
    thickness = _thickness(format, any(frame.spheres for frame in frames), first, options)
    diameter = total(2 * first["radius"] / len(ids)) if options.mean_diameter is None else options.mean_diameter
    arrival = Arrival(format=format, files=options.files, id=ids, remarks=options.notes, thickness=thickness,
                      mean_diameter=diameter)
    gaps = ids[-1] - ids[0] + 1 - len(ids)
    if gaps > 0:
        options.note(f"ids run from {ids[0]} to {ids[-1]} with {gaps} missing; grains are counted from 0 in the order "
                     "of their ids")
    without = [frame for frame in frames[1:] if frame.contacts is None or not len(frame.contacts["first"])]
    if without and (len(without) < len(frames) - 1 or frames[0].contacts is not None):
        raise refused(without[0].grain_file, f"frame {without[0].name} has no contacts; every frame after the first "
                      "needs them for its stresses, or no frame has any")
    for frame, its in zip(frames, grains):
        arrival.frames.append(_ordered(frame, its, arrival, options))
    if options.walls_touch and not any(frame.is_guessed for frame in arrival.frames):
        raise SceneError(f"import {format}: --walls-touch would have no effect: the files, or the points of their "
                         "contacts, give the place of every wall")
    arrival.density = total(first["mass"]) / total(np.pi * first["radius"] * first["radius"])
    arrival.lacking = list(dict.fromkeys(text for frame in frames for text in frame.lacking))
    _note_what_is_lacking(arrival)
    check_arrival(arrival)
    return arrival
