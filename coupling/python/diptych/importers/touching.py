# diptych: contacts and walls of another code's frame in order
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Contacts count grains from 0 and walls after them: lower, upper, left, right. Forces push; each pair occurs once."""

import math
from dataclasses import dataclass, field
from typing import Any, Callable, NoReturn

import numpy as np

from ..errors import SceneError
from .frames import Frame, Options, completed, refused, rows_of
from .periods import followed, gradient_between, is_cell, shifts_of, without_walls

SIDES = ("lower", "upper", "left", "right")
AXIS = np.array([1, 1, 0, 0])  # normal to a side
INWARD = np.array([1.0, -1.0, 1.0, -1.0])  # along that axis
NORMALS = np.array([[0.0, 1], [0, -1], [1, 0], [-1, 0]])
SAME_FORCE = 1e-6  # of the two rows of a pair, relative
FLAT = 0.02  # allowed scatter of a wall's contact points along its normal [mean radii]


@dataclass(kw_only=True, repr=False)
class Instant:
    """A frame in order, per unit thickness. nan: not in the files. Walls have the order of SIDES."""

    name: str
    grain_file: str  # for messages
    wall_file: str
    time: float
    grains: dict[str, np.ndarray]  # the columns of Frame.grains, and "weight"
    # i, j, point, normal, force, gap, status, couple, and the shift of the image of j
    contacts: dict[str, np.ndarray] = field(default_factory=dict)
    has_contacts: bool = False
    place: np.ndarray = field(default_factory=lambda: np.full(4, np.nan))
    period: np.ndarray | None = None  # (2, 2): vectors a1, a2; a2 = 0: along x only
    lattice: np.ndarray | None = None  # the vectors of the same lattice that are nearest to those of the frame before
    strain: np.ndarray = field(default_factory=lambda: np.zeros((2, 2)))  # of a cell, since the first frame
    travel: float = 0.0  # of the upper wall, to the right, since the first frame
    # on the sample: sum of contacts, or from a table; and from a table
    force: np.ndarray = field(default_factory=lambda: np.full((4, 2), np.nan))
    told_force: np.ndarray = field(default_factory=lambda: np.full((4, 2), np.nan))
    is_guessed: bool = False  # a wall was placed at the outermost grains
    # The largest difference of overlaps in the file and of the discs, distance of a wall from its contact points, gap
    # of two bodies in contact, distance of a contact point from where the surfaces meet.
    miss: dict[str, float] = field(default_factory=lambda: {"overlap": 0.0, "wall": 0.0, "gap": 0.0, "point": 0.0})

    def area(self) -> Any:
        """Area of the cell, or between the walls; nan: unknown."""
        if is_cell(self.period):
            return np.linalg.det(self.period)
        width = self.place[3] - self.place[2] if self.period is None else self.period[0, 0]
        return (self.place[1] - self.place[0]) * width

    def refused(self, text: str, of: str = "grain_file") -> SceneError:
        """The error to raise; `of`: the file to name."""
        return refused(getattr(self, of), f"frame {self.name}: {text}")


def total(values: np.ndarray) -> Any:
    """The sum over the first axis in the order of the rows, which gives the same bits everywhere."""
    return np.cumsum(values, axis=0)[-1] + 0.0 if len(values) else np.zeros(values.shape[1:])


def dot(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """(n): products of two lists of vectors."""
    return a[..., 0] * b[..., 0] + a[..., 1] * b[..., 1]


def length(vectors: np.ndarray) -> np.ndarray:
    """(n): lengths of vectors."""
    return np.sqrt(dot(vectors, vectors))


def _surfaces(grains: dict[str, np.ndarray]) -> np.ndarray:
    """(n, 4): the outermost place of each grain towards each side."""
    return grains["position"][:, AXIS] - INWARD * grains["radius"][:, None]


def _extremes(grains: dict[str, np.ndarray]) -> np.ndarray:
    return INWARD * (INWARD * _surfaces(grains)).min(axis=0)


class _Rows:
    """Rows of contacts, and the refusal of the first wrong one."""

    def __init__(self, frame: Frame) -> None:
        self.frame, self.of = frame, completed(frame, "contacts")
        self.wall = self.of["wall"].astype(int)
        self.first, self.second = (self.of[name].astype(np.int64) for name in ("first", "second"))
        if np.any(self.wall >= len(frame.walls)):
            raise ValueError(f"contacts of frame {frame.name}: 'wall' = {self.wall.max()}, but the frame has "
                             f"{len(frame.walls)} walls")

    def refuse(self, *problems: tuple[np.ndarray, Callable[[int], str]]) -> None:
        """Refuses the first row that has a problem."""
        rows = [(int(np.argmax(bad)), k) for k, (bad, _) in enumerate(problems) if np.any(bad)]
        if rows:
            row, k = min(rows)
            self.fail(problems[k][1](row), int(self.of["line"][row]))

    def fail(self, text: str, line: int = 0) -> NoReturn:
        """Refuses the file of the contacts."""
        raise refused(self.frame.contact_file, f"frame {self.frame.name}: {text}", line)

    def bodies(self, ids: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The two grains of each row, counted from 0; the second is -1 on a wall."""
        i, j = rows_of(ids, self.first), np.where(self.wall < 0, rows_of(ids, self.second), -1)

        def unknown(body: int) -> str:
            return f"a contact of body {body}, which is not a grain of {self.frame.grain_file}"

        self.refuse((i < 0, lambda k: unknown(self.first[k])),
                    ((j < 0) & (self.wall < 0), lambda k: unknown(self.second[k])),
                    (i == j, lambda k: f"grain {self.first[k]} touches itself"))
        return i, j


def _nearest_side(rows: _Rows, w: int, touching: np.ndarray, grains: dict[str, np.ndarray], diameter: float) -> int:
    """The side whose outermost surface is nearest to the touching grains, on average."""
    distance = total(abs(_surfaces(grains)[touching] - _extremes(grains)))
    if not len(touching) or not distance.min() / len(touching) < diameter:
        rows.fail(f"{rows.frame.walls[w].name} touches no grain at the lower, upper, left or right end of the sample, "
                  "so its side is unknown")
    return int(np.argmin(distance))


def _sides_of(rows: _Rows, first: np.ndarray, grains: dict[str, np.ndarray], diameter: float) -> list[int]:
    """The side of each wall; -1: nothing touches it. A wall in a table and one in contacts may be the same."""
    sides, of_contacts = [], {}
    for w, wall in enumerate(rows.frame.walls):
        touching = first[rows.wall == w]
        if wall.side is not None and wall.side not in SIDES:
            raise ValueError(f"{wall.name}: side = '{wall.side}'; allowed: lower, upper, left, right or None")
        if wall.side is None and not len(touching) and math.isnan(wall.place):
            sides.append(-1)
            continue
        side = SIDES.index(wall.side) if wall.side else _nearest_side(rows, w, touching, grains, diameter)
        sides.append(side)
        if len(touching) and of_contacts.setdefault(side, wall) is not wall:
            rows.fail(f"{of_contacts[side].name} and {wall.name} both appear to be the {SIDES[side]} wall")
    return sides


def _place_from_points(rows: _Rows, on_side: np.ndarray, side: int, most_scatter: float) -> float:
    """Mean place of a wall's contact points along its normal; nan without any. Refuses a larger scatter."""
    points = rows.of["point"][on_side]
    along = points[np.isfinite(points).all(axis=1), AXIS[side]]
    if not len(along):
        return math.nan
    scatter = along.max() - along.min()
    if scatter > most_scatter:
        rows.fail(f"contact points of the {SIDES[side]} wall scatter over {scatter:f} [length] along its normal; a "
                  "flat wall is needed")
    return total(along) / len(along)


def _place_walls(rows: _Rows, sides: list[int], now: Instant, thickness: float, walls_touch: bool) -> None:
    frame, of_rows = rows.frame, np.append(sides, -1).astype(int)[rows.wall]
    most_scatter, extremes = FLAT * now.grains["radius"].mean(), _extremes(now.grains)
    for side, name in enumerate(SIDES):
        here = [wall for wall, its in zip(frame.walls, sides) if its == side]
        for wall in here:
            if math.isfinite(wall.place):
                now.place[side] = wall.place
            if np.isfinite(wall.force).all():
                now.told_force[side] = np.array(wall.force) / thickness
            if name == "upper" and wall.travel:
                now.travel = wall.travel
        is_placed = math.isfinite(now.place[side])
        most = math.inf if is_placed else most_scatter
        from_points = _place_from_points(rows, of_rows == side, side, most) if here else math.nan
        if not is_placed:
            now.place[side] = from_points
        elif math.isfinite(from_points):
            now.miss["wall"] = max(now.miss["wall"], abs(from_points - now.place[side]))
        if walls_touch and math.isnan(now.place[side]) and (here or AXIS[side] == 1 and not is_cell(now.period)):
            now.place[side], now.is_guessed = extremes[side], True
        if here and math.isnan(now.place[side]):
            raise now.refused(f"the place of the {name} wall is in none of the files; give a table with frame, width "
                              "and height (or left_x, right_x, lower_y, upper_y), or --walls-touch to place walls at "
                              "the outermost grains")


def _meeting(now: Instant, i: np.ndarray, j: np.ndarray) -> dict[str, np.ndarray]:
    """Normal, point (the middle of the overlap, or the nearest on the wall), overlap and gap of contacts; the nearest
    image of j is meant, which is at `shift` from j."""
    x, r, n = now.grains["position"], now.grains["radius"], len(now.grains["id"])
    on_wall, side, other = j >= n, np.maximum(j - n, 0), np.where(j < n, j, 0)
    branch = x[i] - x[other]
    shift = np.where(on_wall[:, None], 0, shifts_of(now.period, branch))
    branch = branch - shift
    distance = length(branch)
    height = INWARD[side] * (x[i, AXIS[side]] - now.place[side])
    overlap = np.where(on_wall, r[i] - height, r[i] + r[other] - distance)
    normal = np.where(on_wall[:, None], NORMALS[side], branch / distance[:, None])
    point = x[i] - np.where(on_wall, height, r[i] - 0.5 * overlap)[:, None] * normal
    gap = np.where(on_wall, abs(height), distance - r[other]) - r[i]
    return {"normal": normal, "point": point, "overlap": overlap, "gap": gap, "shift": shift, "branch": branch}


def _may_be_periodic(now: Instant, apart: np.ndarray, branch: np.ndarray) -> bool:
    """True if all bodies that are apart lie at opposite ends of the sample, and others touch."""
    half = 0.5 * np.ptp(now.grains["position"], axis=0)
    return not np.all(apart) and bool(np.all(np.any(abs(branch[apart]) > half, axis=1)))


def _contacts(rows: _Rows, sides: list[int], now: Instant, bodies: tuple[np.ndarray, np.ndarray],
              thickness: float) -> int:
    """Fills now.contacts; returns how many pairs were repeated."""
    n, frame = len(now.grains["id"]), rows.frame
    i, j = bodies
    j = np.where(rows.wall >= 0, n + np.append(sides, -1).astype(int)[rows.wall], j)
    turned = j < i
    force = np.where(turned[:, None], -rows.of["force"], rows.of["force"]) / thickness
    couple = np.where(turned, -rows.of["couple"], rows.of["couple"]) / thickness
    i, j = np.minimum(i, j), np.maximum(i, j)
    row = np.arange(len(i))
    _, index, inverse = np.unique(np.where(j < n, i * n + j, -1 - row), return_index=True, return_inverse=True)
    original = index[inverse]  # the first row of the same pair; contacts with walls may repeat
    again = original != row
    meeting = _meeting(now, i, j)
    normal, point, overlap = (meeting[name] for name in ("normal", "point", "overlap"))
    radius = now.grains["radius"]
    diameter = 2 * np.maximum(radius[i], np.where(j < n, radius[np.where(j < n, j, 0)], 0))

    def other(k: int) -> str:
        return frame.walls[rows.wall[k]].name if rows.wall[k] >= 0 else f"grain {rows.second[k]}"

    apart = ~again & (-overlap > diameter) & force.any(axis=1)
    periodic = not np.all(now.period) and _may_be_periodic(now, apart, meeting["branch"])
    why = ("periodic? Give its periods with --period-x and --period-y, or with a table of cell_width (or of cell_a1_x, "
           "cell_a1_y, cell_a2_x, cell_a2_y)" if periodic else
           "do the files belong to one frame, and the columns have this meaning?")
    differs = length(force[original] - force) > SAME_FORCE * (length(force[original]) + length(force))
    rows.refuse(
        (again & differs, lambda k: f"the pair {rows.first[k]}, {rows.second[k]} occurs twice with different forces"),
        (apart,
         lambda k: f"the surfaces of the two bodies in contact (grain {rows.first[k]} and {other(k)}) are "
         f"{-overlap[k] / diameter[k]:f} grain diameters apart; {why}"),
        (~np.isfinite(normal).all(axis=1),
         lambda k: f"grains {rows.first[k]} and {rows.second[k]} have the same position"))
    told, slides = rows.of["point"], rows.of["slides"]
    told = told - np.nan_to_num(shifts_of(now.period, told - point))
    has_point = np.isfinite(told).all(axis=1)
    for name, misses in (("gap", -overlap), ("overlap", abs(rows.of["overlap"] - overlap)),
                         ("point", np.where(has_point, length(told - point), 0))):
        now.miss[name] = max(now.miss[name], np.nanmax(misses[~again], initial=0))
    status = np.where(np.isnan(slides), 3, np.where(slides != 0, 2, 1))
    columns = {"i": i, "j": j, "point": np.where(has_point[:, None], told, point), "normal": normal, "force": force,
               "gap": meeting["gap"], "status": status, "shift": meeting["shift"], "couple": couple}
    now.contacts = {name: values[~again] for name, values in columns.items()}
    return int(again.sum())


def _turn(now: Instant, note: Callable[[str], None]) -> None:
    """Forces push bodies apart, walls push inwards. If their sum pulls, the file has the forces on the other body."""
    c, n = now.contacts, len(now.grains["id"])
    for of_walls, those, other in ((False, "between grains", "other grain"), (True, "of walls on grains", "wall")):
        these = (c["j"] >= n) == of_walls
        if total(dot(c["force"], c["normal"])[these]) < 0:
            c["force"] = np.where(these[:, None], -c["force"], c["force"])
            c["couple"] = np.where(these, -c["couple"], c["couple"])
            note(f"forces {those} were reversed: in the files they pull, so they act on the {other}")
    for side in range(4):
        if dot(now.told_force[side], NORMALS[side]) < 0:  # false for nan
            now.told_force[side] *= -1
            note("wall forces in the files act on the walls; they were reversed")
        touching = c["j"] == n + side
        now.force[side] = total(c["force"][touching]) if touching.any() else now.told_force[side]


def _follow(now: Instant, before: Instant | None) -> None:
    """Moves grains by whole periods to where the motion of the period since the frame before carried them."""
    now.lattice = now.period if before is None else followed(now.period, before.lattice)
    if before is None or now.period is None:
        return
    gradient = gradient_between(before.lattice, now.lattice)
    x, old = now.grains["position"], before.grains["file_place"]
    carried = x.mean(axis=0) + (before.grains["position"] - old.mean(axis=0)) @ gradient.T
    now.grains["position"] = x + shifts_of(now.period, carried - x)
    if is_cell(now.period):
        from scipy.linalg import logm  # loads slowly

        rate = logm(gradient).real
        now.strain = before.strain - 0.5 * (rate + rate.T)


def _complete_couples(now: Instant, note: Callable[[str], None]) -> None:
    """Couples are known of all contacts or of none."""
    couple = now.contacts["couple"]
    unknown = np.isnan(couple)
    if unknown.any() and not unknown.all():
        now.contacts["couple"] = np.where(unknown, 0, couple)
        note(f"{unknown.sum()} of {len(unknown)} contacts have no couple in the files; it counts as 0")


def take_contacts(frame: Frame, now: Instant, arrival: Any, options: Options) -> None:
    """Fills contacts and walls of `now`; its grains are in the order of arrival.id. Raises SceneError."""
    rows = _Rows(frame)
    now.has_contacts = frame.contacts is not None
    bodies = rows.bodies(arrival.id)
    sides = _sides_of(rows, bodies[0], now.grains, arrival.mean_diameter)
    now.period = without_walls(frame, sides, now.refused)
    now.grains["file_place"] = now.grains["position"]
    _follow(now, arrival.frames[-1] if arrival.frames else None)
    _place_walls(rows, sides, now, arrival.thickness, options.walls_touch)
    if _contacts(rows, sides, now, bodies, arrival.thickness) > 0:
        options.note("pairs of grains occur in two rows; each was counted once")
    _turn(now, options.note)
    _complete_couples(now, options.note)
