# diptych: the command `export`
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A sample of a result folder as a start for another code, or all stages for OVITO."""

import argparse
import os
from typing import Any

from ... import _diptych
from ...errors import SceneError
from ...importers.exports import as_csv, as_dump, as_lammps
from ..runs.engine import Options, say
from ..runs.folders import Folder, write_text


def scene_of(folder: str) -> Any:
    """The scene of a result folder, as a run computed it or an import proposes it; without one the defaults."""
    prm = os.path.join(folder, "scene.prm")
    if not os.path.exists(prm):
        return _diptych.read_scene(None, [], False)
    if os.path.exists(os.path.join(folder, "import.json")) and not _diptych.resolved_scene(prm):
        return _diptych.read_scene(prm, [], False)
    return _diptych.read_computed_scene(prm, [], False)


def _files(line: argparse.Namespace) -> dict[str, str]:
    """Name -> text of the exported files. Raises SceneError."""
    file = os.path.join(line.target, "discrete.h5")
    if not os.path.isdir(line.target):
        raise SceneError(f"{line.target} is not a result folder; diptych run SCENE makes one")
    if not os.path.exists(file):
        raise SceneError(f"{line.target}: has no discrete.h5; diptych discrete or run makes it")
    scene, snapshots = scene_of(line.target).dict(), _diptych.read_grains(line.target).snapshots
    _diptych.check_part(line.target, "discrete")
    if not 0 <= line.stage < len(snapshots):
        raise SceneError(f"--stage {line.stage}: {file} holds {len(snapshots)} snapshots, 0 to {len(snapshots) - 1}")
    if line.format == "dump":
        if line.stage:
            raise SceneError(f"--stage {line.stage}: a dump holds all stages; leave --stage out")
        return as_dump(snapshots)
    return as_lammps(snapshots[line.stage], scene) if line.format == "lammps" else as_csv(
        snapshots[line.stage], line.stage)


def _beside(folder: str) -> str:
    """The folder as the user named it, without a slash at its end. "." and ".." become their paths."""
    named = os.path.normpath(folder)
    return os.path.realpath(folder) if os.path.basename(named) in (".", "..") else named


def run_export(line: argparse.Namespace, options: Options) -> None:
    """The command `diptych export`."""
    files = _files(line)
    folder = line.output or f"{_beside(line.target)}_for_{line.format}"
    if os.path.exists(folder) and os.path.samefile(folder, line.target):
        raise SceneError(f"--output {folder}: is the result folder itself; name a new folder")
    for name in files:
        if os.path.exists(os.path.join(folder, name)):
            raise SceneError(f"--output {folder}: {name} exists; name a new folder")
    with Folder(folder):
        for name, text in files.items():
            write_text(os.path.join(folder, name), text)
    say(options, f"written to {folder}")
