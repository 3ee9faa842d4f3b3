# diptych: a sample of ours as a start for other codes
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Text files, by their names. Grains and walls come from a snapshot, friction and pressure from the scene."""

import math
from typing import Any, Sequence

import numpy as np

from .. import _diptych
from ..entries import describe
from .walls import CELL

FORMATS = ("lammps", "csv", "dump")

describe("discrete/stage_NNNN.vtu", """\
mean_stress (numbers) [pressure]: half the trace of the internal moment of the last step over the area of the disc; \
    the other arrays are those of grains/ in discrete.h5
""")

describe("discrete_contacts/stage_NNNN.vtu", """\
normal_force (numbers) [pressure length]: force along the normal at both ends of each line, positive in compression; \
    contacts that carry force in the last step
tangential_force (numbers) [pressure length]: force on the first body along the normal turned by +90 degrees
gap (numbers) [length]: distance of the surfaces; negative: penetration
status (whole numbers): 1 sticking, 2 slipping, 3 unknown (imported)
""")

describe("grains.dump", """\
type (whole numbers): 1 free, 2 held at its velocity, 3 and 4 part of the lower and upper platen; the other columns \
    have the names of discrete.h5 or of LAMMPS
""")

describe("contacts.dump", """\
fx, fy (numbers) [pressure length]: normal part of the force on patom1; force: its size; patom1 and patom2 count from 1
p1, p2 (numbers) [pressure length]: tangential part of the force on patom1
""")


def _exact(value: float) -> str:
    return f"{value:.17g}"


def _rows(template: str, *columns: Any) -> str:
    """A line for each row of the columns, in which # of the template stands for all digits of a number."""
    template = template.replace("#", "%.17g") + "\n"
    return "".join(template % tuple(row) for row in np.column_stack(columns).tolist())


def _cell(s: Any) -> np.ndarray | None:
    """Vectors a1 and a2 (columns) of a sample that is periodic in both directions."""
    return np.array([[s.cell_a1_x, s.cell_a2_x], [s.cell_a1_y, s.cell_a2_y]]) if s.cell_a2_y else None


def as_csv(s: Any, stage: int) -> dict[str, str]:
    """Particles, contacts and walls, with the stage in their names. Columns that a sample lacks are left out."""
    n, c = len(s), s.contacts
    told, columns = ["id,x,y,r"], [np.arange(n), s.position, s.radius]
    for name, values in (("mass", s.mass), ("vx,vy", s.velocity), ("omega", s.spin)):
        if not np.isnan(values).any():
            told.append(name)
            columns.append(values)
    head = ",".join(told)
    particles = head + "\n" + _rows("%d" + ",#" * head.count(","), *columns)
    acts = np.any(c.force != 0, axis=1)
    j = np.where(c.j < n, c.j, n - c.j - 1)
    of_contacts = [c.i[acts], j[acts], c.force[acts], c.point[acts]]
    of_contacts += [] if np.isnan(c.couple).any() else [c.couple[acts]]
    names = "i,j,fx,fy,px,py" + ",couple" * (len(of_contacts) > 4)
    contacts = (f"# force on i; j = -1 lower, -2 upper, -3 left, -4 right wall\n{names}\n"
                + _rows("%d,%d" + ",#" * (names.count(",") - 1), *of_contacts))
    if _cell(s) is not None:
        walls = {"frame": stage, **{name: getattr(s, name) for name in CELL}}
    else:
        walls = {"frame": stage, "left_x": s.left_x, "right_x": s.right_x, "cell_width": s.cell_width or math.nan,
                 "lower_y": s.lower_y, "upper_y": s.upper_y, "upper_travel": s.upper_platen_displacement_x}
        walls = {name: value for name, value in walls.items() if math.isfinite(value)}
    return {f"particles_{stage}.csv": particles, f"contacts_{stage}.csv": contacts,
            f"walls_{stage}.csv": ",".join(walls) + "\n" + ",".join(map(_exact, walls.values())) + "\n"}


def _script(scene: dict[str, dict[str, Any]], s: Any) -> str:
    places = s.left_x, s.right_x, s.lower_y, s.upper_y
    left, right, lower, upper = (_diptych.text_of_number(place) for place in places)
    edges = "p p p" if _cell(s) is not None else "p f p" if s.cell_width else "f f p"
    law, p, rho, d = scene["discrete"], scene["loading"]["pressure"], scene["sample"]["density"], s.mean_diameter
    stiffness = 1e4 * p
    damping = math.sqrt(stiffness / (rho * math.pi * d * d / 4))
    lines = ["# Discs of sample.data between walls or periods at rest, springs kn = 1e4 P (rigid grains have none), "
             "dashpots near critical."]
    if law["rolling_friction"] > 0:
        lines.append("# They roll freely here; `rolling sds` of pair_style granular resists rolling.")
    lines += ["units si", "dimension 2", "boundary " + edges, "newton off", "comm_modify vel yes", "atom_style sphere",
              "read_data sample.data", f"set group all density/disc {_exact(rho)}",
              f"variable kn equal {_exact(stiffness)}",
              "variable kt equal 0.8*${kn}", f"variable gn equal {_exact(damping)}", "variable gt equal 0.5*${gn}",
              f"pair_style gran/hooke/history ${{kn}} ${{kt}} ${{gn}} ${{gt}} {_exact(law['friction'])} 1",
              "pair_coeff * *"]
    walls = [] if _cell(s) is not None else [("lower", f"INF INF {lower} INF INF INF", "platen_friction"),
                                             ("upper", f"INF INF INF {upper} INF INF", "platen_friction")]
    if math.isfinite(s.left_x) and math.isfinite(s.right_x):
        walls += [("left", f"{left} INF INF INF INF INF", "wall_friction"),
                  ("right", f"INF {right} INF INF INF INF", "wall_friction")]
    for name, sides, friction in walls:
        lines += [f"region {name} block {sides} units box side in",
                  f"fix {name} all wall/gran/region hooke/history ${{kn}} ${{kt}} ${{gn}} ${{gt}} "
                  f"{_exact(law[friction])} 1 region {name} contacts"]
    lines += ["fix move all nve/sphere disc", "fix plane all enforce2d", f"timestep {_exact(0.05 * math.pi / damping)}",
              "compute pp all pair/local dist force fx fy p1 p2 p4 cutoff radius",
              "compute id all property/local patom1 patom2 cutoff radius",
              "# frames that `diptych import lammps` reads back",
              "dump g all custom 1000 grains.dump id type x y radius mass vx vy omegaz fx fy",
              "dump_modify g sort id format float %.9g",
              "dump c all local 1000 contacts.dump index c_id[1] c_id[2] "
              + " ".join(f"c_pp[{k}]" for k in range(1, 8)),
              "dump_modify c format float %.9g", "thermo 1000", "run 1000"]
    return "\n".join(lines) + "\n"


def as_lammps(s: Any, scene: dict[str, dict[str, Any]]) -> dict[str, str]:
    """A data file and a script. Rigid grains have no contact stiffness and damping: the script states its own.

    LAMMPS needs the first vector of a cell along x, so the cell is turned."""
    room, n, x, tilt = 2 * s.mean_diameter, len(s), s.position, ""
    bounds = {"x": (x[:, 0].min() - 5 * room, x[:, 0].max() + 5 * room), "y": (s.lower_y - room, s.upper_y + room)}
    cell = _cell(s)
    if s.cell_width:
        left = s.outline_left[0, 0]
        bounds["x"] = left, left + s.cell_width
    elif cell is not None:
        a1 = cell[:, 0] / np.linalg.norm(cell[:, 0])
        turn = np.array([a1, (-a1[1], a1[0])])
        (width, xy), (_, height) = turn @ cell
        bounds, tilt = {"x": (0.0, width), "y": (0.0, height)}, f"{_exact(xy)} 0 0 xy xz yz\n"
        x = np.linalg.solve(cell, x.T).T % 1 @ (turn @ cell).T
    data = (f"LAMMPS data file: discs of a prepared sample; in.sample sets density/disc\n\n{n} atoms\n1 atom types\n\n"
            + "".join(f"{_exact(low)} {_exact(high)} {axis}lo {axis}hi\n" for axis, (low, high) in bounds.items())
            + "-0.5 0.5 zlo zhi\n" + tilt + "\nAtoms # sphere\n\n"
            + _rows("%d 1 # # # # 0", 1 + np.arange(n), 2 * s.radius, np.full(n, scene["sample"]["density"]), x))
    return {"sample.data": data, "in.sample": _script(scene, s)}


def _section(stage: int, s: Any, rows: str, n_rows: int) -> str:
    """Head of a section. Sides without a wall have the outermost surface of the grains as the bound of the box."""
    periodic, x, r, cell = s.cell_width > 0, s.position[:, 0], s.radius, _cell(s)
    left, right = (0, s.cell_width) if periodic else ((x - r).min(), (x + r).max())
    if not periodic:
        left, right = np.fmin(left, s.left_x), np.fmax(right, s.right_x)  # nan: there is no wall
    lines = ["ITEM: TIMESTEP", str(stage), *(["ITEM: TIME", _exact(s.time)] if math.isfinite(s.time) else []),
             f"ITEM: NUMBER OF {rows}", str(n_rows)]
    if cell is None:
        lines += [f"ITEM: BOX BOUNDS {'pp' if periodic else 'ff'} ff pp", f"{_exact(left)} {_exact(right)}",
                  f"{_exact(s.lower_y)} {_exact(s.upper_y)}", "-0.5 0.5"]
    else:  # each line a vector and a component of the corner
        lines += ["ITEM: BOX BOUNDS abc origin pp pp pp",
                  *(f"{_exact(a[0])} {_exact(a[1])} 0 {_exact(at)}" for a, at in zip(cell.T, s.outline_left[0])),
                  "0 0 1 -0.5"]
    return "\n".join(lines) + "\n"


def _grain_section(stage: int, s: Any) -> str:
    """Columns: id (from 1), type (1 free, 2 held, 3 and 4 part of the lower and upper platen), x y z, then the fields
    of the grains. velocity and spin have the names that LAMMPS and OVITO know."""
    names = {"velocity": "vx vy vz", "spin": "omegaz", "displacement": "displacement_x displacement_y displacement_z"}
    listed = ("displacement", "velocity", "rotation", "spin", "radius", "mass", "rattler", "fixed")
    fields = {name: getattr(s, name) for name in listed}
    fields["mean_stress"] = 0.5 * np.trace(s.internal_moment, axis1=1, axis2=2) / (np.pi * s.radius * s.radius)
    head, template = "id type x y z", "%d %d # # 0"
    columns = [1 + np.arange(len(s)), 1 + s.fixed.astype(int), s.position]
    for name, values in fields.items():
        if not np.isnan(values).all():
            head += " " + names.get(name, name)
            template += " # # 0" if values.ndim == 2 else " #"
            columns.append(values)
    return _section(stage, s, "ATOMS", len(s)) + f"ITEM: ATOMS {head}\n" + _rows(template, *columns)


def _contact_section(stage: int, s: Any) -> str:
    """Pairs of grains that carry force: on patom1, fx, fy are its normal part, p1, p2 the tangential part."""
    c = s.contacts
    acts = (c.j < len(s)) & np.any(c.force != 0, axis=1)
    i, j, force, direction = c.i[acts], c.j[acts], c.force[acts], c.normal[acts]
    size = force[:, 0] * direction[:, 0] + force[:, 1] * direction[:, 1]
    normal = size[:, None] * direction
    return (_section(stage, s, "ENTRIES", len(i)) + "ITEM: ENTRIES index patom1 patom2 force fx fy p1 p2\n"
            + _rows("%d %d %d # # # # #", 1 + np.arange(len(i)), i + 1, j + 1, size, normal, force - normal))


def as_dump(snapshots: Sequence[Any]) -> dict[str, str]:
    """All stages as dump files of LAMMPS, which OVITO opens: `dump custom` of grains, `dump local` of contacts (bonds).
    One section per stage, whose step is the number of the stage."""
    return {name: "".join(section(stage, s) for stage, s in enumerate(snapshots))
            for name, section in (("grains.dump", _grain_section), ("contacts.dump", _contact_section))}
