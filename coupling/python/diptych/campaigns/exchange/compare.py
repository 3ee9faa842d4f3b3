# diptych: the command `compare`, for ensembles and measurements
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The program itself compares the panels of one run."""

import argparse
import os

from ... import _diptych
from ...errors import SceneError
from ..ensembles.ensemble import compare_again
from ..measured.folder import compare_folder, text_of
from ..runs.engine import Options, say
from ..runs.folders import draw, Folder, record_phase
from .exports import scene_of


def run_compare(line: argparse.Namespace, options: Options) -> None:
    """diptych compare ENSEMBLE, or diptych compare DIR --measured MEASUREMENT."""
    if os.path.exists(os.path.join(line.target, "ensemble.prm")):
        compare_again(line, options)
        return
    folder = line.target
    if line.set or line.set_file:
        raise SceneError("compare --measured: --set would have no effect; change the comparison first by diptych "
                         f"compare {folder} --set KEY=VALUE")
    if not os.path.exists(os.path.join(folder, "scene.prm")):
        raise SceneError(f"{folder} is not a result folder; diptych run SCENE makes one")
    began = os.times()
    with Folder(folder):
        scene = scene_of(folder)
        record = compare_folder(folder, scene, line.measured)
        keys = scene.dict()
        record_phase(folder, "measurement", began, (_diptych.recorded_scene(folder), [keys["sample"]["seed"]]), options)
        say(options, text_of(record))
        if keys["output"]["report"]:
            draw(options, folder, "page" if os.path.exists(os.path.join(folder, "comparison.json")) else "measured")
        else:
            say(options, f"output/report = false: no page; diptych report {folder} draws it")
