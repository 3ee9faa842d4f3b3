# diptych: collapse load of the bodies of limit analysis by `diptych continuum`
# SPDX-License-Identifier: LGPL-2.1-or-later
import csv
import os
import shutil
import subprocess

import numpy

from bodies import EDGE, Footing, quads_of

HERE = os.path.dirname(os.path.abspath(__file__))
ENVIRONMENT = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
# A softer body slips farther in a step than Coulomb's law sticks. In small strain its load is the same.
COULOMB = ("continuum/platens=frictional", "continuum/platen_slip_length=0", "continuum/youngs_modulus=1e6",
           "continuum/initial_step=1e-6", "continuum/max_step=5e-4", "continuum/min_step=1e-9",
           "loading/axial_strain=0.003", "loading/stage_strain=0.003")
LINES = ("lower_platen", "upper_platen", "left_side", "right_side", "free")


def mirrored(half):
    """Grid lines of both halves of lines that begin at the symmetry line 0."""
    return numpy.concatenate((-half[:0:-1], half))


def write_mesh(path, shape, n):
    """Writes the whole body as quadrilaterals in gmsh's format 2.2, on the grid of the upper bound with n rows,
    mirrored."""
    x, y = shape.grid(n)
    x, y = mirrored(x), y if isinstance(shape, Footing) else mirrored(y)
    quads = quads_of(len(x) - 1, len(y) - 1) + 1
    cells = quads.reshape(len(x) - 1, len(y) - 1, 4)
    beside = numpy.abs(x[:-1] + x[1:]) / 2 > shape.corner[0] - EDGE
    edges = [(1, *cell[[0, 1]]) for cell in cells[:, 0]]
    edges += [(5 if free else 2, *cell[[2, 3]]) for free, cell in zip(beside, cells[:, -1])]
    edges += [(3, *cell[[3, 0]]) for cell in cells[0]] + [(4, *cell[[1, 2]]) for cell in cells[-1]]
    elements = [f"1 2 {line} {line} {a} {b}" for line, a, b in edges]
    elements += [f"3 2 6 6 {' '.join(map(str, quad))}" for quad in quads]
    places = [f"{a:.17g} {b:.17g} 0" for a in x for b in y - y[0]]
    with open(path, "w") as file:
        file.write(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{len(LINES)}\n")
        file.writelines(f'1 {number} "{name}"\n' for number, name in enumerate(LINES, 1))
        for title, rows in (("PhysicalNames", None), ("Nodes", places), ("Elements", elements)):
            if rows:
                file.write(f"${title}\n{len(rows)}\n" + "".join(f"{number} {row}\n" for number,
                                                                row in enumerate(rows, 1)))
            file.write(f"$End{title}\n")


def collapse_load(program, shape, soil, n, folder):
    """Mean vertical stress under the platen at the end of the run, its relative growth over the last tenth of the
    settlement, and the number of elements. Throws RuntimeError if the run fails."""
    os.makedirs(folder, exist_ok=True)
    mesh, result = os.path.join(folder, "mesh.msh"), os.path.join(folder, "run")
    shutil.rmtree(result, ignore_errors=True)
    write_mesh(mesh, shape, n)
    angles = [f"continuum/{key}_angle_peak={soil.friction_angle}" for key in ("friction", "dilatancy")]
    friction = [f"continuum/platen_friction={shape.friction}", *COULOMB] if shape.friction else []
    words = [word for setting in (f"continuum/mesh={mesh}", *angles, *friction) for word in ("--set", setting)]
    scene = os.path.join(HERE, "footing.prm" if isinstance(shape, Footing) else "rectangle.prm")
    done = subprocess.run([program, "continuum", scene, "--output", result, "--quiet", *words], env=ENVIRONMENT,
                          capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{result} ended with exit code {done.returncode}: {done.stderr.strip()}")
    with open(os.path.join(result, "continuum.csv")) as file:
        rows = [{key: float(row[key]) for key in ("axial_strain", "upper_fy", "n_cells")}
                for row in csv.DictReader(file)]
    strain, load = (numpy.array([row[key] for row in rows]) for key in ("axial_strain", "upper_fy"))
    load /= -2 * shape.platen_width
    return load[-1], 1 - numpy.interp(0.9 * strain[-1], strain, load) / load[-1], int(rows[-1]["n_cells"])


def limit(loads):
    """Limit of the loads of meshes, each with half the element size of the one before, and its doubt. The differences
    of the last three loads are continued as a geometric series (Aitken). The doubt is a quarter of this correction
    (Roache 1994: safety factor 1.25)."""
    a, b, c = loads[-3:]
    correction = (c - b)**2 / ((c - b) - (b - a))
    return c - correction, 0.25 * abs(correction)
