# diptych: the options of the commands of campaigns
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A function adds the arguments of a command. It loads nothing that only a run needs, so that help comes at once."""

import argparse
from collections.abc import Callable

from .. import _diptych
from ..importers import exports, readers
from ..importers.fields import readers as fields
from ..words import Parser, add_output, add_overwrite, add_quiet, filled, number

FIELD = "check a displacement field of an image correlation and store it as one panel beside others"
_LEVELS = "auto, or two accuracies: means of the grains in the limit of short steps"


def _add_scene(parser: Parser, meaning: str = "scene file, .prm or .json") -> None:
    parser.add_argument("target", metavar="SCENE", help=meaning)


def _add_set(parser: Parser) -> None:
    parser.add_argument("--set", metavar="KEY=VALUE", action="append", default=[],
                        help="section/key=value: change one key of the scene; may be repeated")
    parser.add_argument("--set-file", metavar="FILE", action="append", default=[],
                        help="file of keys as calibrate writes it (.prm); if a key is in both, --set wins")


def _add_seeds(parser: Parser, meaning: str, required: bool = False) -> None:
    parser.add_argument("--seeds", metavar="LIST", default="", required=required, help=meaning)


def _add_runs(parser: Parser, folder: str) -> None:
    add_output(parser, folder)
    _add_set(parser)
    parser.add_argument("--threads", metavar="N", type=number(1, 1024, True), default=1,
                        help="threads of the contact solver; every number gives the same bits")
    parser.add_argument("--jobs", metavar="N", type=number(1, 4096, True), default=0,
                        help="number of runs at once (default: usable cores / threads; under mpirun one for each "
                             "process)")
    either = parser.add_mutually_exclusive_group()
    either.add_argument("--resume", action="store_true",
                        help="continue the results in the folder: keep finished runs, compute the others")
    add_overwrite(either)
    add_quiet(parser)


def add_run(parser: Parser) -> None:
    _add_scene(parser)
    _add_seeds(parser, "samples, a list like 1-8 or 1,3,5-7, each on its own; then means, intervals and verdicts",
               True)
    parser.add_argument("--levels", metavar="LEVELS", default="", help=_LEVELS)
    parser.add_argument("--check", action="store_true",
                        help="check the scene and print the resources; computes nothing")
    _add_runs(parser, "folder of the ensemble (default: results/<scene name>_ensemble)")


def add_compare(parser: Parser) -> None:
    parser.add_argument("target", metavar="DIR", help="folder of an ensemble, or with --measured of a run")
    _add_set(parser)
    parser.add_argument("--measured", metavar="DIR", type=filled,
                        help="put the measurement in a folder of `diptych import field` beside the panels")
    add_quiet(parser)


def add_study(parser: Parser) -> None:
    _add_scene(parser, "scene file with --vary, or study file, .json")
    parser.add_argument("--vary", metavar="KEY=VALUES", action="append", default=[],
                        help="values of a key, such as discrete/friction=0.2,0.3,0.5; repeated: all combinations")
    _add_seeds(parser, "with --vary: samples of each point, a list like 1-4 (default: the scene's one)")
    parser.add_argument("--panels", choices=("both", "discrete", "continuum"), default="",
                        help="with --vary: the panels that run (default: both, which bands need)")
    parser.add_argument("--levels", metavar="LEVELS", default="", help=_LEVELS)
    _add_runs(parser, "folder of the study (default: results/<name>_study)")


def add_plan(parser: Parser) -> None:
    _add_scene(parser)
    parser.add_argument("--accuracy", metavar="SHARE", required=True,
                        help="relative, of the means: 2 %% or 0.02; covers errors of the method and the 95 %% interval")
    parser.add_argument("--for", metavar="NAMES", default="",
                        help="keys of quantities, separated by commas: peak_stress_ratio, strength (both by default), "
                             "platen_force_pd, band_angle_deg and others, or numbers of comparison.json; for one "
                             "panel, put discrete. or continuum. before a key")
    parser.add_argument("--run", action="store_true", help="also run the planned samples")
    _add_runs(parser, "folder of the plan (default: results/<scene name>_plan)")


def add_calibrate(parser: Parser) -> None:
    _add_scene(parser, "scene file with --seeds, which takes the standard parameters, or calibration file, .json")
    _add_seeds(parser, "with a scene: samples of the fit, a list like 1-4")
    _add_runs(parser, "folder of the calibration (default: results/<name>_calibration)")


def add_element(parser: Parser) -> None:
    _add_scene(parser)
    _add_seeds(parser, "samples of the grains, a list like 1-4 (default: the scene's one)")
    _add_runs(parser, "folder of the results (default: results/<scene name>_element)")


def add_homogenise(parser: Parser) -> None:
    parser.add_argument("target", metavar="SOURCE",
                        help="folder with grains; or, with FILES behind it, a format or reader as for import: "
                             + ", ".join(readers.FORMATS) + ", READER.py")
    parser.add_argument("files", metavar="FILES", nargs="*", default=[],
                        help="files of grains, contacts and walls of another code")
    parser.add_argument("--grid", metavar="D", type=number(0.5, 1000), default=3.0,
                        help="size of the cells in mean diameters (default: 3)")
    add_output(parser, "folder of the results (default: FOLDER_homogenised; required with FILES)")
    _add_import_options(parser)


def _numbers(what: str, count: int | None = None) -> Callable[[str], list[float]]:
    """The type of a list of numbers, such as 0,-9.81. count: of the numbers."""
    def parse(text: str) -> list[float]:
        try:
            values = [float(part) for part in text.split(",")]
        except ValueError:
            values = []
        if not values or count not in (None, len(values)):
            raise argparse.ArgumentTypeError(f"'{text}' is not {what}")
        return values
    return parse


def _add_import_options(parser: Parser) -> None:
    parser.add_argument("--columns", metavar="KIND=NAMES", action="append", default=[],
                        help="KIND=NAME,NAME,...: names of columns that the files do not name; KIND: particles, "
                        "contacts or walls; may be repeated")
    for name, meaning in (
            ("thickness", "thickness of a layer of spheres; divides forces and masses; 1 keeps forces per length"),
            ("timestep", "time step, for codes that count steps"),
            ("density", "mass per area, if no file contains masses"),
            ("pressure", "lateral pressure (default: that of the right wall in the first frame with forces)"),
            ("mean-diameter", "unit d of the results (default: mean of the grains), and diameter of points without "
             "radii"),
            ("period-x", "period along x of a periodic sample, if the files do not contain it"),
            ("period-y", "period along y, for a cell that is periodic in both directions")):
        parser.add_argument("--" + name, metavar="NUMBER", type=number(1e-30, 1e30), help=meaning)
    parser.add_argument("--gravity", metavar="GX,GY", type=_numbers("GX,GY, two numbers such as 0,-9.81", 2),
                        help="acceleration of the grains (default: that of the files)")
    parser.add_argument("--plane", choices=("xy", "xz"), default="xy",
                        help="plane of a layer of spheres; xz: z of the files points upwards (default: xy)")
    parser.add_argument("--frames", metavar="LIST", default="",
                        help="only these frames, such as 10-20,30; counted from 0 in ascending order")
    parser.add_argument("--walls-touch", action="store_true",
                        help="put walls without a place in the files where the grains reach farthest")
    add_overwrite(parser)
    add_quiet(parser)


def add_import(parser: Parser) -> None:
    parser.add_argument("format", metavar=f"FORMAT {{{','.join(readers.FORMATS)}}}",
                        help="code that wrote the files; csv: tables of any origin; or a Python file (READER.py) that "
                             "registers a reader of your own. For measured displacements: diptych import field")
    parser.add_argument("files", metavar="FILES", nargs="+", help="files of grains, contacts and walls, in any order")
    add_output(parser, "folder of the imported sample", required=True)
    _add_import_options(parser)
    of_fields = Parser("import field", FIELD)
    add_import_field(of_fields)
    parser.epilog = f"{_diptych.example_of('import')}\n\ndiptych import field: {of_fields.format_help().rstrip()}"


def add_import_field(parser: Parser) -> None:
    parser.add_argument("format", metavar=f"FORMAT {{{','.join(fields.FORMATS)}}}",
                        help="program that wrote the files; csv: tables of any origin; or a Python file (READER.py) "
                             "that registers a reader of your own")
    parser.add_argument("files", metavar="FILES", nargs="+", help="files of one test, sorted by the last number in "
                        "their names")
    add_output(parser, "folder of the imported measurement", required=True)
    positive = number(1e-30, 1e30)
    for name, metavar, kind, meaning in (
            ("scale", "S", positive, "factor of all lengths in the files: length of a pixel; required if they are "
             "pixels, and 1 keeps them"),
            ("subset", "LENGTH", number(0, 1e30), "side of the correlated squares in the unit of the files; 0: points "
             "that were followed by themselves"),
            ("time-between", "SECONDS", positive, "time between the images of a frame, if the files hold velocities"),
            ("progress", "LIST", _numbers("a list of numbers such as 0,0.01,0.02"),
             "axial strain of the first image and of every frame, such as 0,0.01,0.02 (default: rows of --boundary if "
             "they are as many, else the vertical strain of the field)"),
            ("centre", "X,Y", _numbers("X,Y, two numbers such as 512,380", 2),
             "centre of the sample at the first image, in unit and axes of the files (default: middle of the points)"),
            ("boundary", "FILE", filled, "table of axial_strain, stress_ratio (or sxx and syy) and volumetric_strain"),
            ("static", "A,B", _numbers("A,B, two whole numbers such as 0,1", 2),
             "two instants at rest, whose difference gives the standard deviation; 0: the first image")):
        parser.add_argument("--" + name, metavar=metavar, type=kind, help=meaning)
    parser.add_argument("--outliers", metavar="T", type=number(0, 1e6),
                        help="threshold of the normalised median test (default: 5, or 0 for points that were followed "
                             "by themselves; 0 keeps all)")
    parser.add_argument("--mean-diameter", metavar="D", type=positive, required=True,
                        help="unit d of the results, in the unit after --scale")
    parser.add_argument("--reference", choices=("first", "previous"), default="",
                        help="frames hold displacements since the first image, or since the image before; required for "
                             "several frames")
    parser.add_argument("--y", choices=("down", "up"), default="",
                        help="direction of y in the files (default: up for vtk and csv, else down, as in images)")
    parser.add_argument("--columns", metavar="field=NAMES", action="append", default=[],
                        help="field=NAME,NAME,...: names of columns that the files do not name; vtk: the displacement")
    add_overwrite(parser)
    add_quiet(parser)
    parser.epilog = ("Example: diptych import field spam step_*-ddic.tsv --output dic --scale 0.35 --mean-diameter 3.5 "
                     "--subset 0 --reference first")


def add_export(parser: Parser) -> None:
    parser.add_argument("target", metavar="FOLDER", help="result folder")
    parser.add_argument("--format", required=True, choices=exports.FORMATS, help="code that reads them; dump: OVITO")
    add_output(parser, "folder of the exported files (default: FOLDER_for_FORMAT)")
    parser.add_argument("--stage", metavar="N", type=number(0, 1000000, True), default=0,
                        help="number of the snapshot (default: 0, the prepared sample); not for dump")
    add_quiet(parser)


def add_report(parser: Parser) -> None:
    parser.add_argument("target", metavar="DIR", help="result folder")
    either = parser.add_mutually_exclusive_group()
    either.add_argument("--movie", action="store_true", help="also draw both panels step by step: movie.gif")
    either.add_argument("--crate", metavar="FILE.zip", default="",
                        help="draw nothing; store the folder as a zip file with ro-crate-metadata.json (RO-Crate), "
                             "which repositories of research data read")
    add_quiet(parser)
