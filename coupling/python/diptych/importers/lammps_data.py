# diptych: reads data files of LAMMPS
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Data files: places, radii and velocities. Their densities are those of spheres in any dimension and are not used."""

from __future__ import annotations

import numpy as np

from .frames import Frame, Options, refused, rows_of
from .grains import grains_of
from .tables import Table
from .text import floats_of, int_of, read_lines

OWN = {"sphere": ["diameter", "density"], "bpm/sphere": ["molecule", "diameter", "density"], "bond": ["molecule"],
       "molecular": ["molecule"], "charge": ["q"], "atomic": []}  # columns of a style besides id, type, x, y, z


def is_data_file(path: str) -> bool:
    """True if one of the first lines is "N atoms"."""
    return any(line.split()[1:] == ["atoms"] for line in read_lines(path)[:40])


def _columns(path: str, line: int, styles: list[str], width: int, options: Options) -> list[str]:
    """Columns of the section Atoms, from the comment that names the style; image flags may follow."""
    wanted = options.columns_of("particles")
    if wanted is None and (styles or ["sphere"])[0] == "sphere":
        wanted = ["id", "type", "diameter", "density", "x", "y", "z"]
    elif wanted is None and styles[0] == "bpm/sphere":
        wanted = ["id", "molecule", "type", "diameter", "density", "x", "y", "z"]
    elif wanted is None and styles[0] == "hybrid" and len(styles) > 1 and all(style in OWN for style in styles[1:]):
        wanted = ["id", "type", "x", "y", "z", *(name for style in styles[1:] for name in OWN[style])]
    if wanted is None or "diameter" not in wanted and "radius" not in wanted:
        raise refused(path,
                      f"the columns of atom_style {' '.join(styles)} are not known here, or have no radii; name them with "
                      "--columns particles=id,type,x,y,z,diameter,...", line)
    if width not in (len(wanted), len(wanted) + 3):
        raise refused(path, f"rows have {width} columns instead of {len(wanted)} ({','.join(wanted)}); name them with "
                      "--columns particles=...", line)
    return wanted + ["ix", "iy", "iz"] * (width > len(wanted))


def _rows(path: str, lines: list[str], head: int, count: int) -> tuple[list[list[str]], list[int]]:
    """`count` rows below a section's head, with the numbers of their lines."""
    start = next((k for k in range(head + 1, len(lines)) if lines[k].strip()), len(lines))
    if start + count > len(lines):
        raise refused(path, f"the section {lines[head].split()[0]} has {len(lines) - start} rows instead of {count}",
                      len(lines))
    return [line.partition("#")[0].split() for line in lines[start:start + count]], list(range(start + 1, start + count + 1))


def read_data(path: str, options: Options) -> Frame:
    """The frame of a data file. Raises SceneError."""
    lines, count, grains = read_lines(path), 0, {}
    for k, line in enumerate(lines):
        words = line.split()
        if words[1:] == ["atoms"]:
            count = int_of(path, k + 1, words[0], "the number of grains")
        elif words[3:6] == ["xy", "xz", "yz"] and any(floats_of(path, k + 1, words[:3], "a tilt of the box")):
            raise refused(path, "the box is tilted; only upright boxes are supported", k + 1)
        elif words[:1] == ["Atoms"]:
            rows, places = _rows(path, lines, k, count)
            table = Table(path, _columns(path, k + 1, words[2:], len(rows[0]) if rows else 0, options), rows, places)
            short = [line for row, line in zip(rows, places) if len(row) != len(table.columns)]
            if short:
                raise refused(path, f"expected {len(table.columns)} entries: {', '.join(table.columns)}", short[0])
            grains = grains_of(table, options)
        elif words[:1] == ["Velocities"] and grains:
            rows, places = _rows(path, lines, k, count)
            values = np.array([floats_of(path, place, row, "a velocity") for row, place in zip(rows, places)])
            order = rows_of(values[:, 0].astype(int), grains["id"])
            if np.any(order < 0):
                raise refused(path, f"grain {grains['id'][np.argmin(order)]} has no velocity", k + 1)
            grains["velocity"] = values[order, 1:3]
            if values.shape[1] >= 7:
                grains["spin"] = values[order, 6]
    if not grains:
        raise refused(path, "contains no section Atoms")
    grains.pop("mass", None)
    return Frame(path, grains, grain_file=path)
