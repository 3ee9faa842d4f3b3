# diptych: reads data files of LAMMPS
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Data files: places, radii and velocities."""

from typing import Callable

import numpy as np

from .frames import Frame, Options, refuse_where, refused, rows_of
from .periods import period_of
from .tables import Table, grains_of, rows_below
from .text import floats_of, int_of, read_lines

STYLES = {"sphere": ["id", "type", "diameter", "density", "x", "y", "z"],
          "bpm/sphere": ["id", "molecule", "type", "diameter", "density", "x", "y", "z"]}
OWN = {"sphere": ["diameter", "density"], "bpm/sphere": ["molecule", "diameter", "density"], "bond": ["molecule"],
       # columns of a style in hybrid, behind id, type, x, y, z
       "molecular": ["molecule"], "charge": ["q"], "atomic": []}


def is_data_file(path: str) -> bool:
    """True if one of the first lines is "N atoms"."""
    return any(line.split()[1:] == ["atoms"] for line in read_lines(path)[:40])


def _columns(path: str, line: int, styles: list[str], width: int, options: Options) -> list[str]:
    """Columns of the section Atoms, from the comment that names the style; image flags may follow."""
    style, *others = styles or ["sphere"]
    wanted = options.columns_of("particles") or STYLES.get(style)
    if not wanted and style == "hybrid" and all(other in OWN for other in others):
        wanted = ["id", "type", "x", "y", "z", *(name for other in others for name in OWN[other])]
    if wanted is None or "diameter" not in wanted and "radius" not in wanted:
        raise refused(path,
                      f"the columns of atom_style {' '.join(styles)} are not known here, or have no radii; name them "
                      "with --columns particles=id,type,x,y,z,diameter,...", line)
    if width not in (len(wanted), len(wanted) + 3):
        raise refused(path, f"rows have {width} columns instead of {len(wanted)} ({','.join(wanted)}); name them with "
                      "--columns particles=...", line)
    return wanted + ["ix", "iy", "iz"] * (width > len(wanted))


def _section(path: str, lines: list[str], head: int, count: int, columns: Callable[[int], list[str]]) -> Table:
    """`count` rows below a section's head; columns(width) gives the names of their columns."""
    start = next((k for k in range(head + 1, len(lines)) if lines[k].strip()), len(lines))
    bare = [line.partition("#")[0] for line in lines[:start + count]]
    return rows_below(path, bare, start, count, columns(len(bare[start].split()) if start < len(bare) else 0))


def read_data(path: str, options: Options) -> Frame:
    """The frame of a data file. Raises SceneError."""
    lines, count, grains, tilt, size = read_lines(path), 0, {}, 0.0, {"xlo": 0.0, "ylo": 0.0}
    for k, line in enumerate(lines):
        words = line.split()
        if words[1:] == ["atoms"]:
            count = int_of(path, k + 1, words[0], "the number of grains")
        elif words[2:4] in (["xlo", "xhi"], ["ylo", "yhi"]):
            low, high = floats_of(path, k + 1, words[:2], "a bound of the box")
            size[words[2]] = high - low
        elif words[3:6] == ["xy", "xz", "yz"]:
            tilt, *others = floats_of(path, k + 1, words[:3], "a tilt of the box")
            if any(others):
                raise refused(path, "the box is tilted out of the x-y plane", k + 1)
        elif words[:1] == ["Atoms"]:
            table = _section(path, lines, k, count, lambda width: _columns(path, k + 1, words[2:], width, options))
            grains = grains_of(table, options)
            if table.has("density") and options.density is None:
                options.note(f"{path}: its densities were not used, because the script decides whether they are those "
                             "of spheres or of discs (set ... density/disc); --density gives the discs a mass per area")
        elif words[:1] == ["Velocities"] and grains:
            table = _section(path, lines, k, count, lambda width: ["id", "vx", "vy", "vz", "wx", "wy", "wz"][:width])
            order = rows_of(table.whole("id"), grains["id"])
            refuse_where(path, order < 0, np.full(len(order), k + 1),
                         lambda row: f"grain {grains['id'][row]} has no velocity")
            grains["velocity"] = table.vectors("vx", "vy")[order]
            if table.has("wz"):
                grains["spin"] = table.numbers("wz")[order]
    if not grains:
        raise refused(path, "contains no section Atoms")
    # LAMMPS tilts periodic boxes only; whether an upright one is periodic stands in the script.
    period = period_of([size["xlo"], 0], [tilt, size["ylo"]]) if tilt else None
    return Frame(path, grains, grain_file=path, period=period)
