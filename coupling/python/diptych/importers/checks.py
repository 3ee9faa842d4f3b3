# diptych: checks of an imported sample
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Compares contact forces with resultants, weights and wall forces, overlaps with places, frames with each other."""

from typing import Any, Iterator, NoReturn

import numpy as np

from .periods import images_within, is_cell
from .touching import AXIS, INWARD, SIDES, Instant, length, total

# Values above these limits cause a warning. The balance is relative to the mean contact force. It is 1e-6 if a code
# writes nine digits of the forces that it integrated. It is 0.02 if the code evaluates them again after the step. In
# slow motion without resultants the rms over all grains stays below 0.3. The worst grain of tests/foreign and of an
# exported moreau_quick has 0.044. Contacts of rigid grains have gaps up to 0.002 mean diameters. Contact points of soft
# ones lie up to half an overlap off.
BALANCE, MOTION, GRAIN, STRESS, WALL_FORCE = 0.05, 0.3, 3, 0.05, 0.03
OVERLAP, OVERLAP_TOLD, WALL_PLACE, APART = 0.05, 0.005, 0.02, 0.05  # [mean diameters]
# Contacts with a force per grain. Discs with friction that support each other have 1.5, without floating grains.
FEW_CONTACTS = 0.5
# Changes from one frame to the next. Rigid grains keep their radius to the digits of the file, and no tested sample
# densifies so much.
RADIUS, DENSITY = 1e-4, 0.15
# Equal discs fill at most 0.907 of the area. Overlaps of 9 % of the diameter raise that to 1.1, and the usual 0.84 of a
# random packing needs 13 %. More means that walls, radii or units are wrong.
MOST_SOLID_FRACTION = 1.1
MOST_BEYOND = 0.05  # share of the grains that may have left the sample through a wall
REACH = 2.2  # of the search for overlaps [largest radii]; 2 finds all, more also small gaps
MOST_OVERLAPS = 20  # per grain; discs that touch have at most three pairs per disc, whatever their sizes


def _checked_solid_fraction(now: Instant) -> float:
    """A wall with grains on both sides is in the wrong place or faces the wrong way."""
    for low in (0, 2):
        if now.place[low] >= now.place[low + 1]:
            raise now.refused(f"the {SIDES[low]} wall lies beyond the {SIDES[low + 1]} one", "wall_file")
    x = now.grains["position"]
    for side, beyond in enumerate(np.sum(INWARD * (x[:, AXIS] - now.place) < 0, axis=0)):
        if beyond > MOST_BEYOND * len(x):
            raise now.refused(f"the centres of {beyond} of {len(x)} grains lie beyond the {SIDES[side]} wall; it "
                              "stands across the sample", "wall_file")
    share = total(np.pi * now.grains["radius"] * now.grains["radius"]) / now.area()
    if share > MOST_SOLID_FRACTION:  # false without side walls
        raise now.refused(f"the discs cover {int(100 * share)} % of the area between the walls; at most "
                          f"{int(100 * MOST_SOLID_FRACTION)} % is possible. Check the places of the walls and the "
                          "radii (is one of them a diameter?)", "wall_file")
    return share


def _near_pairs(now: Instant) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Pairs that may overlap and their distances, by octaves of the larger radius: one large grain does not make all
    pairs neighbours."""
    from scipy.spatial import cKDTree  # loads slowly

    x, r = now.grains["position"], now.grains["radius"]
    octave = np.floor(np.log2(r))
    for k in np.unique(octave):
        rows = np.flatnonzero(octave == k)
        all_rows, places = images_within(now.period, x, REACH * r[rows].max())
        keep = octave[all_rows] <= k
        others, tree, tree_of_others = all_rows[keep], cKDTree(places[rows]), cKDTree(places[keep])
        surely = tree.count_neighbors(tree_of_others, r[rows].min()) - len(rows)
        if surely > 2 * MOST_OVERLAPS * len(r):  # before they fill the memory
            _refuse_overlaps(now)
        near = tree.sparse_distance_matrix(tree_of_others, REACH * r[rows].max(), output_type="ndarray")
        i, j = rows[near["i"]], others[near["j"]]
        once = (r[j] < r[i]) | ((r[j] == r[i]) & (j < i))
        yield i[once], j[once], near["v"][once]


def _refuse_overlaps(now: Instant) -> NoReturn:
    raise now.refused(f"more than {MOST_OVERLAPS} overlaps per grain; do grains lie on top of each other?")


def _largest_overlap(now: Instant) -> float:
    """The largest overlap of two grains, or of a grain and a wall; negative: the smallest gap."""
    x, r, count = now.grains["position"], now.grains["radius"], 0
    largest = np.nanmax(r[:, None] - INWARD * (x[:, AXIS] - now.place), initial=-np.inf)
    for i, j, distance in _near_pairs(now):
        overlap = r[i] + r[j] - distance
        largest, count = max(largest, overlap.max(initial=-np.inf)), count + np.sum(overlap > 0)
    if count > MOST_OVERLAPS * len(r):
        _refuse_overlaps(now)
    return largest


def _residual(rest: np.ndarray, mean: float, vertical_only: bool) -> tuple[float, float, int]:
    """Resultant force / mean contact force: root mean square over all grains, the largest and its grain."""
    miss = (abs(rest[:, 1]) if vertical_only else length(rest)) / mean
    worst = int(np.argmax(miss))
    return np.sqrt(total(miss * miss / len(miss))), miss[worst], worst


def sum_of_forces(now: Instant) -> np.ndarray:
    """(n, 2): of all contacts of each grain, in the order of the contacts."""
    c, n = now.contacts, len(now.grains["id"])
    bodies = np.column_stack([c["i"], c["j"]]).ravel()
    forces = np.stack([c["force"], -c["force"]], axis=1).reshape(-1, 2)
    return np.column_stack([np.bincount(bodies, forces[:, axis], n + 4)[:n] for axis in (0, 1)])


def _check_balance(now: Instant, ids: np.ndarray, check: dict[str, Any]) -> np.ndarray | None:
    """Contact forces and weight against the resultant, or against zero. Some codes leave the weight out of the
    resultant. Returns the gravity that would halve a residual without weight."""
    grains, rest, mean = now.grains, sum_of_forces(now), total(length(now.contacts["force"]) / len(now.contacts["i"]))
    against = bool(np.isfinite(grains["resultant"][0]).all())
    if against:
        rest = rest - grains["resultant"]
    # the files do not contain the pressure on free sides
    vertical_only = not against and now.period is None and not np.isfinite(now.place[2])
    found, without = (_residual(forces, mean, vertical_only) for forces in (rest + grains["weight"], rest))
    if against and without[0] < found[0]:
        found = without
    check.update(balance_against_resultants=against, balance_rms=found[0], balance_worst=found[1],
                 balance_worst_grain=ids[found[2]])
    if against or not np.isfinite(check["mass"]) or grains["weight"][0].any():
        return None
    gravity = 0.0 - total(rest / check["mass"])
    halves = _residual(rest + grains["mass"][:, None] * gravity, mean, vertical_only)[0] < 0.5 * found[0]
    return gravity if halves else None


def _outer(force: np.ndarray, branch: np.ndarray) -> np.ndarray:
    return force[:, :, None] * branch[:, None, :]


def _add_stresses(now: Instant, check: dict[str, Any]) -> None:
    """Sums of force (x) branch, row of the force. Branches end at the contact points on walls. The stress of the walls
    uses the lower left corner, so that it does not depend on the origin."""
    c, x, n = now.contacts, now.grains["position"], len(now.grains["id"])
    on_wall = c["j"] >= n
    corner = np.array([now.place[2], now.place[0]])
    ends = np.where(on_wall[:, None], c["point"], x[np.where(on_wall, 0, c["j"])] + c["shift"])
    contacts = total(_outer(c["force"], x[c["i"]] - ends))
    walls = -total(np.concatenate([_outer(c["force"], c["point"] - corner)[on_wall],
                                   _outer(now.grains["weight"], x - corner)]))
    check["contact_stress"] = contacts / now.area()
    if all(check[side + "_contacts"] for side in SIDES):
        check["wall_stress"] = walls / now.area()
        check["stress_difference"] = abs(contacts - walls).max() / abs(walls).max()


def _doubts(now: Instant, check: dict[str, Any], gravity: np.ndarray | None, arrival: Any) -> list[str]:
    contacts = len(now.contacts["i"]) / len(now.grains["id"])
    miss = {name: value / arrival.mean_diameter for name, value in now.miss.items()}
    grain, resultants = f"grain {check['balance_worst_grain']}", check["balance_against_resultants"]
    # Without contacts on walls, which is reported, grains at the walls cannot be in balance.
    told = "contacts with walls" not in arrival.lacking or is_cell(now.period)
    why = ("a contact missing, repeated or of the wrong sign?" if gravity is None
           else f"their weight missing? --gravity {gravity[0]:g},{gravity[1]:g}")
    found = [
        (told and resultants, check["balance_worst"], BALANCE,
         f"contact forces on {grain} differ from its resultant; difference / mean contact force:"),
        (told and not resultants, check["balance_rms"], MOTION,
         f"grains are far from balance ({why}); rms / mean contact force:"),
        (told and not resultants, check["balance_worst"], GRAIN,
         f"{grain} is far from balance (a contact missing or of another grain?); residual / mean contact force:"),
        (True, check["stress_difference"], STRESS,
         "stress of contacts and stress of wall forces differ; relative difference:"),
        (True, check["wall_force_difference"], WALL_FORCE,
         "wall forces in the files and sums over their contacts differ; relative difference:"),
        (True, check["largest_overlap"], OVERLAP,
         "discs overlap each other or a wall; largest overlap / mean diameter:"),
        (True, miss["overlap"], OVERLAP_TOLD,
         "overlaps in the files and of the discs differ; largest difference / mean diameter:"),
        (True, miss["wall"], WALL_PLACE, "a wall lies apart from its contact points; distance / mean diameter:"),
        (now.has_contacts, -contacts, -FEW_CONTACTS,
         "there are too few contacts to hold the grains (contacts lost?); contacts per grain:"),
        (True, miss["gap"], APART, "two bodies in contact do not touch; gap / mean diameter:"),
        (True, miss["point"], APART,
         "a contact point lies off the place where the surfaces meet; distance / mean diameter:")]
    return [f"frame {now.name}: {what} {abs(100 * value):.3g} %"
            for applies, value, most, what in found if applies and value > most]


def axial_strain(now: Instant, first_height: float) -> Any:
    """Descent of the upper wall / first height; of a cell 1 - exp(-eyy), which is the same change of height."""
    return 1 - (np.exp(-now.strain[1, 1]) if is_cell(now.period) else (now.place[1] - now.place[0]) / first_height)


def _check(now: Instant, first_height: float, arrival: Any) -> dict[str, Any]:
    """The numbers of a frame, with the names of import.json; nan: unknown."""
    n, solid_fraction = len(arrival.id), _checked_solid_fraction(now)
    check: dict[str, Any] = {
        "frame": now.name, "time": now.time, "axial_strain": axial_strain(now, first_height),
        "grains": n, "mass": total(now.grains["mass"]), "solid_fraction": solid_fraction,
        "largest_overlap": _largest_overlap(now) / arrival.mean_diameter,
        "contacts": int(np.sum(now.contacts["j"] < n)),
        **{side + "_contacts": int(np.sum(now.contacts["j"] == n + k)) for k, side in enumerate(SIDES)},
        "balance_against_resultants": False, "balance_rms": np.nan, "balance_worst": np.nan, "balance_worst_grain": 0,
        "contact_stress": np.full((2, 2), np.nan), "wall_stress": np.full((2, 2), np.nan), "stress_difference": np.nan,
        "wall_force_difference": np.nan}
    gravity = None
    if len(now.contacts["i"]):
        gravity = _check_balance(now, arrival.id, check)
        _add_stresses(now, check)
        known = np.isfinite(now.told_force).all(axis=1) & np.isfinite(now.force).all(axis=1)
        told, here = now.told_force[known], now.force[known]
        if told.any():
            check["wall_force_difference"] = length(told - here).max() / length(told).max()
    arrival.doubtful += _doubts(now, check, gravity, arrival)
    if np.trace(check["contact_stress"]) <= 0:  # false without contacts
        raise now.refused("the mean stress of the contacts is tensile; do the forces act on the other body?")
    return check


def _changes(arrival: Any, k: int) -> list[str]:
    """Doubtful changes from the frame before; one such grain is enough."""
    before, now = arrival.frames[k - 1], arrival.frames[k]
    found = []
    for name in ("radius", "mass"):
        was, here = before.grains[name], now.grains[name]
        found += [(f"the {name} of grain {arrival.id[i]}", was[i], here[i])
                  for i in np.flatnonzero(abs(here - was) > RADIUS * was)[:1]]
    was, here = (arrival.checks[at]["solid_fraction"] for at in (k - 1, k))
    if abs(here - was) > DENSITY * was:
        found.append(("the solid fraction between the walls", was, here))
    return [f"frame {now.name}: {what} is {here:.6g} instead of {was:.6g} in the frame before"
            for what, was, here in found]


def check_arrival(arrival: Any) -> None:
    """Fills arrival.checks, one per frame, and arrival.doubtful. Raises SceneError for what cannot be."""
    place = arrival.frames[0].place
    arrival.checks = [_check(now, place[1] - place[0], arrival) for now in arrival.frames]
    for k in range(1, len(arrival.frames)):
        arrival.doubtful += _changes(arrival, k)
