# diptych: the command `report`
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws the page of any folder of results again, or packs the folder."""

import argparse
import os

from ... import _diptych
from ...errors import SceneError
from ..runs.engine import Options, say
from ..runs.folders import Folder, draw
from .crates import write_crate

# page -> (the file that a folder of the kind has, parts of its record whose checksums are checked)
_PAGES: dict[str, tuple[str, tuple[str, ...]]] = {
    "study": ("study_input.json", ()), "calibration": ("calibration_input.json", ()),
    "ensemble": ("ensemble.prm", ("ensemble",)), "homogenised": ("homogenised.json", ()),
    "element": ("element.json", ()), "page": ("comparison.json", ("", "comparison")),
    "measured": ("levelled.json", ())}


def run_report(line: argparse.Namespace, options: Options) -> None:
    """The command `diptych report`."""
    folder = line.target
    if not os.path.isdir(folder):
        raise SceneError(f"{folder} is not a result folder; diptych run SCENE makes one")
    if line.crate:
        with Folder(folder):
            write_crate(folder, line.crate)
        return say(options, f"written to {line.crate}")
    page = next((page for page, (name, _) in _PAGES.items() if os.path.exists(os.path.join(folder, name))), None)
    if page is None:
        raise SceneError(f"{folder} is not a result folder (no comparison.json), nor the folder of an ensemble, a "
                         "study, a calibration, an element, homogenised grains or a measurement")
    if line.movie and page != "page":
        raise SceneError(f"report {folder} --movie: only a result folder with both panels has a movie")
    for part in _PAGES[page][1]:
        _diptych.check_part(folder, part)
    with Folder(folder):
        draw(options, folder, page, *(["movie"] if line.movie else []))
