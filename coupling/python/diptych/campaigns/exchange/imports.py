# diptych: the command `import`
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Frames of another code, checked and stored like results of the grains."""

import argparse
import json
import math
import os

from ... import _diptych
from ...arrays import plain
from ...importers.arrival import Arrival, arrive
from ...importers.frames import Options as ImportOptions
from ...importers.grain_results import facts_of, results_of, scene_of
from ...importers.readers import read_frames, read_with, registered
from ..runs.engine import Options, complain, say, stops_raised
from ..runs.folders import Folder, record_phase, write_json, write_text

LAYOUT = "%-18.18s %8s %7s %9s %9s %10s %10s %10s %10s %14s %12s %13s"
HEAD = ("frame", "strain %", "grains", "contacts", "on walls", "solid fr.", "stress xx", "yy", "xy", "walls diff %",
        "balance rms", "overlap/d")


def import_options(line: argparse.Namespace, kind: type[ImportOptions] = ImportOptions) -> ImportOptions:
    """The options of an import among the words."""
    known = kind.__dataclass_fields__
    return kind(**{name: value for name, value in vars(line).items() if name in known})


def _say_checks(arrival: Arrival, options: Options) -> None:
    def cell(value: float, format: str) -> str:
        return format % value if math.isfinite(value) else "-"

    say(options, LAYOUT % HEAD)
    for c in arrival.checks:
        on_walls = sum(c[side + "_contacts"] for side in ("lower", "upper", "left", "right"))
        (xx, xy), (yx, yy) = c["contact_stress"]
        say(options, LAYOUT % (
            c["frame"], cell(100 * c["axial_strain"], "%.4f"), c["grains"], c["contacts"], on_walls,
            cell(c["solid_fraction"], "%.4f"), cell(xx, "%.6g"), cell(yy, "%.6g"), cell(0.5 * (xy + yx), "%.4g"),
            cell(100 * c["stress_difference"], "%.2g"), cell(c["balance_rms"], "%.2g"),
            cell(c["largest_overlap"], "%.2g")))
    say(options, "balance: forces on each grain minus its net force in the files, over the mean contact force"
        if arrival.checks[-1]["balance_against_resultants"] else
        "balance: forces on each grain, over the mean contact force (the files hold no net forces, so accelerations "
        "count as imbalance)")
    for text in arrival.remarks:
        say(options, f"note: {text}")
    for text in arrival.lacking:
        say(options, f"not in the files: {text}")
    for text in arrival.doubtful:
        complain(f"diptych import: warning: {text}")


def import_files(word: str, given: ImportOptions, folder: str, options: Options) -> None:
    """Imports files with the reader of a format, or of a Python file. Writes the files of the grains, import.json and
    provenance.json; from two frames on also scene.prm. Raises SceneError, and then writes nothing."""
    began = os.times()
    _diptych.require_usable(folder, False, options.overwrite, False)
    arrival = read_with(word, registered, "importers.register",
                        lambda format: arrive(format, read_frames(format, given), given))
    results = results_of(arrival)
    has_stress = any(len(frame.contacts["i"]) for frame in arrival.frames)
    why_no_scene = ("one frame is no loading, so there is no scene" if len(results.snapshots) == 1 else
                    f"a cell has no counterpart on a mesh, so there is no scene; diptych homogenise {folder}"
                    if results.snapshots[0].cell_a2_y else "" if has_stress else
                    f"contacts are missing, so there is no stress and no scene; diptych homogenise {folder}")
    scene = "" if why_no_scene else scene_of(arrival, results, given.pressure)
    with Folder(folder) as locked:
        if options.overwrite and not _diptych.is_empty_folder(folder):
            locked.set_aside([("the file", file) for file in given.files])
        # first: a killed import is recognised as one
        write_json(os.path.join(folder, "import.json"), arrival.record(), 2)
        _diptych.write_grains(results, folder)
        if scene:
            write_text(os.path.join(folder, "scene.prm"), scene)
        record_phase(folder, "import", began, (os.path.basename(os.path.normpath(folder)), [1]), options)
        _diptych.record_grains(folder, json.dumps(plain(facts_of(arrival, results))))
    _say_checks(arrival, options)
    say(options, f"written to {folder}; both panels: diptych run {os.path.join(folder, 'scene.prm')}" if scene else
        f"written to {folder}; {why_no_scene}")
    if scene:
        origin = _diptych.read_scene(os.path.join(folder, "scene.prm"), [], False).dict()["comparison"]
        say(options, _diptych.origin_of_law(origin["parameters_from"]))


def run_import(line: argparse.Namespace, options: Options) -> None:
    """The command `diptych import`."""
    with stops_raised("import: stopped on request"):
        import_files(line.format, import_options(line), line.output, options)
