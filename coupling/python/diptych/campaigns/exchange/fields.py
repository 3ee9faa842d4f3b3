# diptych: the command `import field`
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A measured displacement field, checked and stored as one panel beside others."""

import argparse
import os
from typing import Any

from ... import _diptych
from ...entries import describe
from ...files import sha256_of
from ...importers.fields.frames import FieldOptions
from ...importers.fields.measure import measure
from ...importers.fields.readers import read_fields, registered
from ...importers.readers import read_with
from ...measurement import ARRAYS, FACTS, FIELD, HISTORY, Measurement
from ..measured.folder import alone, write_levelled, write_measurement
from ..runs.engine import columns_text, Options, say, stops_raised
from ..runs.folders import draw, Folder, record_phase
from .imports import import_options

HEAD = ("frame", "points", "lost", "outliers", "axial %", "volumetric %", "shear %", "sigma/d")

describe(FIELD, "\n".join(f"{name} (numbers) [{unit}]: {meaning}" for name, (_, unit, meaning) in ARRAYS.items()))

describe(FACTS, """\
format (whole number): version of the layout
source (text): format of the files
files (list): files that were read
sha256 (list): their SHA-256 checksums
mean_diameter [length]: mean diameter d of the grains
subset [length]: side of the correlated squares; 0: points that were followed by themselves
spacing [length]: of the points
centre (numbers) [length]: of the sample at the first instant
scale [length]: by which all lengths of the files were multiplied
curves (text): boundary or field, from which measured.csv comes
reference (text): first: frames hold displacements since the first image; previous: since the image before
notes (list): defaults, and data that were turned, sorted or left out
frames/: one per frame
    frame (text): name of the frame in the files
    points: number of points in the files
    lost: number of points whose correlation failed
    outliers: number of points that failed the normalised median test
    axial_strain: axial strain of this instant
    volumetric_strain: mean since the first instant; dilation is negative
    shear_strain: eps_1 - eps_2 of the mean strain since the first instant
    deviation_d [mean diameters]: median standard deviation of a component of the displacement since the first \
        instant; null: unknown
""")

describe(HISTORY, """\
axial_strain (numbers): axial strain, of the boundary table or of every instant
volumetric_strain (numbers): 1 - V/V0, dilation negative; of the boundary table, else the mean between the points
stress_ratio (numbers): t/s; of the boundary table, else left out
""")


def _text_of(result: Measurement) -> str:
    """The table of the frames, and the notes."""
    rows = [[row["frame"], *(str(row[name]) for name in ("points", "lost", "outliers")),
             *(f"{100 * row[name + '_strain']:.4f}" for name in ("axial", "volumetric", "shear")),
             "-" if row["deviation_d"] is None else f"{row['deviation_d']:.2g}"] for row in result.facts["frames"]]
    return "\n".join([columns_text([HEAD, *rows]), *(f"note: {text}" for text in result.facts["notes"])])


def run_import_field(line: argparse.Namespace, options: Options) -> None:
    """The command `diptych import field`: writes measured.h5, measured.json, measured.csv and provenance.json. Raises
    SceneError, and then writes nothing."""
    began, folder = os.times(), line.output
    _diptych.require_usable(folder, False, options.overwrite, False)
    given: Any = import_options(line, FieldOptions)
    with stops_raised("import field: stopped on request"):
        result, curves = read_with(line.format, registered, "fields.register",
                                   lambda format: measure(read_fields(format, given), given))
        record = alone(result, options.quiet)
    inputs = [*given.files, *([given.boundary] if given.boundary else [])]
    result.facts |= {"source": line.format, "notes": given.notes,
                     "curves": "boundary" if given.boundary else "field",
                     "files": inputs, "sha256": [sha256_of(path) for path in inputs]}
    with Folder(folder) as locked:
        if options.overwrite and not _diptych.is_empty_folder(folder):
            locked.set_aside([("the file", file) for file in inputs])
        write_measurement(folder, result, curves)
        write_levelled(folder, folder, curves, record)
        record_phase(folder, "import", began, ("", []), options)
        say(options, _text_of(result))
        draw(options, folder, "measured")
    say(options, f"written to {folder}; beside a run: diptych compare RUN --measured {folder}")
