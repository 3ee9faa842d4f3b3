# diptych: the command `homogenise`
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Grains of a result folder, or of files of another code, as fields: tables, maps for ParaView and a page."""

import argparse
import os

import numpy as np

from ... import _diptych
from ...entries import describe
from ...errors import SceneError
from ...files import part_of
from ...homogenisation import Homogenised, homogenise
from ...importers.frames import Options as ImportOptions
from ..exchange.imports import import_files, import_options
from ..runs.engine import Options, say, tell
from ..runs.folders import Folder, draw, record_phase, write_json, write_text

SHOWN = {"progress": "progress", "t_over_s": "t/s", "direction_deg": "direction", "solid_fraction": "solid fr.",
         "coordination_number": "contacts/grain", "anisotropy": "anisotropy", "band_angle_deg": "band angle",
         "band_width_10_90_d": "band width/d"}

FRAME = """\
progress [strain or time]: loading variable: axial strain, shear strain or time
axial_strain: descent of the upper platen / initial height
shear_strain: travel of the upper platen to the right / initial height
time [time]: time of the frame, if known
grains: number of grains
volumetric_strain: 1 - V/V0 of the outline since the first frame, dilation negative
solid_fraction: area of the grains / area of the outline
contacts: contacts that carry force
coordination_number: mean number of these contacts per grain, rattlers included; a contact with a platen or wall \
    counts for its grain
rattlers: grains without a contact that carries force
sxx [pressure]: mean stress: sum of the grains' moments / area of the outline, positive in compression; over the \
    stage that ends at the frame, of imported frames at the instant
syy [pressure]: the same, yy component
sxy [pressure]: the same, mean of the xy and yx components
s [pressure]: mean stress (s1 + s2)/2
t [pressure]: shear stress (s1 - s2)/2
t_over_s (interval): stress ratio t/s; interval by bootstrap over blocks of 5 d
direction_deg (interval) [degrees]: direction of s1 from the horizontal; ends may lie beyond -90 and 90
anisotropy (interval): anisotropy a of the contact normals, in the density 1 + a cos 2(theta - theta_0)
fabric_direction_deg (interval) [degrees]: theta_0, the direction of most contact normals
"""
STRAIN = """\
strain_xx: strain of the increment, mean over the cells, relative to the present size; sliding along the platens \
    is not part of it
strain_yy: the same, yy component
strain_xy: the same, xy component
band_verdict (text): result of the band detection: diffuse, one band or two bands, with its reason
"""
BAND = """\
angle_deg (interval) [degrees]: inclination of the band from the horizontal
jump (interval): displacement across the band / travel of the platens
dilation_deg (interval) [degrees]: direction of this displacement against the band, positive if the band opens
width_10_90_d (interval) [mean diameters]: width that holds 80 % of the jump
offset_d (interval) [mean diameters]: distance of the band from the middle of the sample, along its normal
r_squared: share of the displacements' variance that the profile explains
no_packs_because (text): why the band does not separate two packs; empty: it does
diffuse (yes or no): true for a zone wider than a third of the sample, which the page does not draw
"""

describe("homogenised.json", """\
format: version of this file's format
source (text): folder with the grains
walk (text): loading variable: axial_strain, shear_strain or time
mean_diameter [length]: mean grain diameter d
grid_d [mean diameters]: size of the cells
cells: number of cells of each frame
frames/: the sample as a whole, one entry per frame; a quantity that the grains do not give is absent
""")
describe("homogenised.json", FRAME, below="frames/")
describe("homogenised.json", """\
increments/: strain and bands between successive frames; with three or more frames the last entry is from the first to \
    the last frame
    from [strain or time]: progress at the start
    to [strain or time]: progress at the end
""")
describe("homogenised.json", STRAIN, below="increments/")
describe("homogenised.json", "bands/: bands, the strongest first", below="increments/")
describe("homogenised.json", BAND, below="increments/bands/")
describe("homogenised.json", """\
increments/bands/middle (list) [length]: x and y of the point of the middle line that is nearest to the middle of the \
    sample
increments/bands/profile/: displacement along the band in strips parallel to it
    distance_d (list) [mean diameters]: of the middle of each strip from the middle of the band
    displacement (list): its mean / travel of the platens; null: no grain
resolution_study/: local stress of one frame over the width of a Gauss kernel, up to a quarter of the smaller side of \
    the sample; empty without forces
    frame: number of the frame, from 0: the last one with forces
    kernel/: one entry per width
        width_d [mean diameters]: standard deviation of the kernel along each axis
        scatter_s: standard deviation / mean of s over the sample
        scatter_t: standard deviation / mean of t over the sample
        points/: values at three places: shares 1/2 and 1/2, 1/4 and 3/4, 3/4 and 1/4 of width and height
            name (text): name of the place
            s [pressure]: mean stress (s1 + s2)/2
            t_over_s: stress ratio t/s
    plateau_d (list) [mean diameters]: widest range of widths in which s and t/s at every place stay within 5 % of \
        their mean; null: none of a factor of 2
    verdict (text): the same in words
missing/: quantities that the grains do not give
    quantity (text): name of the quantity
    reason (text): why it is missing
""")
describe("homogenised.csv", "frame: number of the frame, from 0; ends of intervals: NAME_low, NAME_high", "column")
describe("homogenised.csv", FRAME, "column")
describe("homogenised.csv", STRAIN, "column")
describe("homogenised.csv", "bands: number of bands since the frame before; band_... is the strongest", "column")
describe("homogenised.csv", BAND, "column", "band_")

describe("fields_0000.vtu ..., fields.pvd", """\
area (cells) [length^2]: area of the cell; the cells fill the outline of the frame
solid_fraction (cells): area of the discs in the cell / its area
stress (cells x 9) [pressure]: stress by the method segments, symmetric part, as xx, xy, 0, yx, yy, 0, 0, 0, 0; NaN in \
    this and the other fields: too few grains
s (cells) [pressure]: mean stress (s1 + s2)/2
t_over_s (cells): stress ratio t/s
contacts (cells): contacts that carry force, with their point in the cell
fabric (cells x 9): mean of n (x) n over these contacts
anisotropy (cells): 2 (F1 - F2) of the fabric F; n contacts of random directions give sqrt(pi/n) on average
strain_increment (cells x 9): strain since the frame before: affine fit to the grains within 2.5 d of the middle of \
    the cell, rattlers excluded
shear_strain_increment (cells): eps_1 - eps_2 of it
strain_since_start (cells x 9): strain since the first frame
shear_strain_since_start (cells): eps_1 - eps_2 of it
""")


def _source(line: argparse.Namespace) -> tuple[str, str]:
    """The folder of the results, and that of the grains. Raises SceneError."""
    if line.files:
        if not line.output:
            raise SceneError(f"homogenise {line.target} FILES: add --output DIR, the folder of the results")
        return line.output, os.path.join(line.output, "imported")
    grains = line.target.rstrip("/") or "/"
    if not os.path.isfile(os.path.join(grains, "discrete.h5")):
        raise SceneError(f"{line.target}: holds no discrete.h5. Give a folder of `diptych run`, `discrete` or "
                         "`import`; or a FORMAT of `diptych import` and FILES")
    for name, value in vars(import_options(line)).items():
        if value != getattr(ImportOptions([]), name):
            raise SceneError(f"homogenise {line.target}: --{name.replace('_', '-')} has no effect on a folder; it is "
                             "for FORMAT FILES")
    return line.output or grains + "_homogenised", grains


def _write_fields(folder: str, found: Homogenised) -> None:
    """fields_0000.vtu ..., and fields.pvd with their progress; a tensor has xx, xy, 0, yx, yy, 0, 0, 0, 0."""
    import meshio  # type: ignore

    entries = ""
    for k, (mesh, maps) in enumerate(zip(found.meshes, found.maps)):
        name = f"fields_{k:04d}.vtu"
        cells = {key: [np.pad(value, ((0, 0), (0, 1), (0, 1))).reshape(-1, 9)
                       if value.ndim == 3 else value.astype(float)] for key, value in maps.items()}
        points = np.column_stack([mesh.nodes, np.zeros(len(mesh.nodes))])
        with part_of(os.path.join(folder, name)) as part:
            meshio.vtu.write(part, meshio.Mesh(points, [("quad", mesh.cells)], cell_data=cells))
        entries += f'<DataSet timestep="{found.frames[k]["progress"]!r}" part="0" file="{name}"/>\n'
    write_text(os.path.join(folder, "fields.pvd"), '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1" '
               f'byte_order="LittleEndian">\n<Collection>\n{entries}</Collection>\n</VTKFile>\n')


def _print(found: Homogenised, options: Options) -> None:
    table = found.table()
    shown = table[[name for name in SHOWN if name in table]].rename(columns=SHOWN)
    say(options, shown.to_string(float_format=lambda x: f"{x:.4g}", na_rep="", index=False))
    if found.resolution_study:
        say(options, "averaging width: " + found.resolution_study["verdict"])
    for entry in found.missing:
        tell(f"missing: {entry['quantity']}: {entry['reason']}")


def run_homogenise(line: argparse.Namespace, options: Options) -> None:
    """The commands `diptych homogenise FOLDER` and `diptych homogenise FORMAT FILES`."""
    folder, grains = _source(line)
    began = os.times()
    with Folder(folder) as locked:
        if not _diptych.is_empty_folder(folder):
            if not options.overwrite:
                raise SceneError(f"the folder '{folder}' is not empty. Add --overwrite to rename it to "
                                 f"{os.path.basename(folder)}.1, or --output with another folder.")
            _diptych.require_usable(folder, False, True)
            locked.set_aside([("the folder with the grains", line.target),
                              *(("the file", file) for file in line.files)])
        given = import_options(line)
        if line.files:
            import_files(line.target, given, grains, options)
        found = homogenise(grains, line.grid)
        if "mean_diameter" in given.used:
            found.missing.append({"quantity": "radii", "reason": "solid fractions are those of discs of "
                                  "--mean-diameter"})
        write_text(os.path.join(folder, "homogenised.csv"), found.table().to_csv(index_label="frame"))
        _write_fields(folder, found)
        record = {"format": 1, "source": os.path.abspath(grains), "walk": found.walk, "grid_d": found.grid,
                  "mean_diameter": found.mean_diameter, "cells": len(found.meshes[0].cells), "frames": found.frames,
                  "increments": found.increments, "resolution_study": found.resolution_study, "missing": found.missing}
        write_json(os.path.join(folder, "homogenised.json"), record)
        record_phase(folder, "homogenise", began, ("", []), options)
        _print(found, options)
        draw(options, folder, "homogenised")
