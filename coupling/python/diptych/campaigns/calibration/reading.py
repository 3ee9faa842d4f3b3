# diptych: the first phase of a calibration: what is fitted to which data
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Everything is checked before a run changes the folder; then the data, for the step of their grains."""

import argparse
from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd

from ... import _diptych
from ...compiled import continuum, demand_continuum
from ...errors import NotConverged, SceneError
from ..runs.coordinates import Coordinates
from ..runs.engine import complain
from ..runs.input_file import settings_of
from .calibration_file import OF_BANDS, STRIPS_OF, Calibration, Target, is_element, read_curve
from .calibration_runs import CalibrationRuns
from .noise import ANGLE, Data, noise_of, STRIP_PROFILE
from .observations import Path, observe_curve, read_target
from .profiles import PROFILE
from .standard import standard_calibration

FAR_FROM_START = 0.05  # t/s; a measured curve begins less exactly than its model


def _check_start(target: Target, scene: _diptych.Scene) -> None:
    """A curve that begins at another stress than the model would be fitted by wrong parameters."""
    table, k0 = read_curve(target.curve), scene.dict()["continuum"]["k0"]
    if "stress_ratio" not in table or table["progress"][0] != 0:  # a first row of grains is a step, not a state
        return
    found, start = table["stress_ratio"][0], abs((1 - k0) / (1 + k0))
    if abs(abs(found) - start) > FAR_FROM_START:
        way = "only an element test of the law (loading/mode = path) can start there"
        if is_element(scene) and not target.seeds:
            way = f'give the target "k0": {(1 - found) / (1 + found):.3g}, lateral over axial stress at the start'
        raise SceneError(f"{target.curve}: stress_ratio = {found:g} in the first row, but the model starts at "
                         f"{start:.3g} (k0 = {k0:g}); {way}")


def _check_target(calibration: Calibration, coordinates: Coordinates, target: Target) -> Data:
    """The start must be a scene for every target. Returns data of the same shape as the samples will give."""
    read_target(target, target.before)
    try:
        scene = read_target(target, [*calibration.fixed, *coordinates.settings(coordinates.start, target.name)])
    except SceneError as error:
        raise SceneError(f"{calibration.file}: with every parameter at its start: {error}; "
                         "change start or set") from error
    if is_element(scene) and not calibration.of_grains and (warning := scene.reversal_warning()):
        complain(f"diptych: warning: target '{target.name}': {warning}")
    if not calibration.of_grains:
        demand_continuum("calibrate")
    if not calibration.of_grains and not is_element(scene):
        continuum("calibrate").require_continuum(scene)
    if not calibration.of_grains and scene.dict()["continuum"]["initial_stress"] == "mapped":
        raise SceneError(f"{target.scene}: continuum/initial_stress = mapped has no place in a calibration: one mesh "
                         "serves all samples")
    place = f"{calibration.file}: target '{target.name}': "
    if PROFILE in calibration.kinds and not is_element(scene) and "platen_rotation" in scene.unused_keys():
        raise SceneError(f"{place}{PROFILE} needs a law with rotations; continuum/law = "
                         f"{scene.dict()['continuum']['law']} has none; use ln_width")
    try:
        observables = calibration.observables_of(scene, target)
    except ValueError as error:
        raise SceneError(place + str(error)) from error
    if target.is_fitted and not (target.curve or is_element(scene)):
        found = [ANGLE, STRIP_PROFILE, *(one.kind for one in observables)]
        for kind in [kind for kind in calibration.kinds if kind not in found]:
            raise SceneError(f"{place}no bin or window of {kind} lies within its loading")
    for p in coordinates.parameters:
        if p.is_of(target.name) and p.key in (unused := scene.unused_keys()):
            raise SceneError(f"{calibration.file}: parameters: {p.key} is read by no law of target '{target.name}': "
                             f"continuum/{unused[p.key]}")
    if scene.dict()["continuum"]["k0"] != 1 and (target.seeds or target.results):
        raise SceneError(f"{place}k0: grains start at the isotropic pressure; only the law's point starts elsewhere")
    if target.curve:
        _check_start(target, scene)
        sample, deviations = observe_curve(scene, observables, target.curve)
        if not target.seeds:
            return Data(observables=observables, values=sample.values, given=deviations)
    return Data(observables=observables, values=np.zeros((len(target.seeds), len(observables))))


def checked(calibration: Calibration) -> Coordinates:
    """Checks a calibration before anything is changed. Shares and drops refer to fixed keys, else to those of the
    first fitted scene. Whether the scatter can be estimated follows from the number of samples alone."""
    first = next(target for target in calibration.targets if target.is_fitted)
    values = {**read_target(first).dict()["continuum"], **{one.key: one.value for one in calibration.fixed}}
    numbers = pd.to_numeric(pd.Series(values), errors="coerce").dropna().to_dict()
    try:
        coordinates = Coordinates(calibration.parameters, numbers)
    except ValueError as error:
        raise SceneError(f"{calibration.file}: parameters: {error}") from error
    try:
        noise_of([_check_target(calibration, coordinates, target) for target in calibration.targets], calibration.noise)
    except SceneError:
        raise
    except ValueError as error:
        raise SceneError(f"{calibration.file}: {error}") from error
    return coordinates


def check_data(calibration: Calibration, paths: Sequence[Path], runs: CalibrationRuns, record: dict[str, Any]) -> None:
    """With coarser steps of the grains the fit would describe the step and not the material."""
    noise = noise_of([path.of_noise for path in paths], calibration.noise)
    record["words"] += calibration.remarks
    for path in paths:
        target = path.target
        if not target.is_fitted:
            continue
        if target.curve:
            if not target.seeds:
                what = "field" if target.measured else "curve"
                record["words"] += [f"target '{target.name}' is a measured {what}: nothing was run again",
                                    *_left_out(path)]
        elif path.scene.dict()["discrete"]["method"] == "imported":
            stages = path.scene.stages()  # between frames nothing is known of the grains
            path.left_out = ["" if one.kind in OF_BANDS or any(one.low <= at <= one.high for at in stages)
                             else "no frame lies in it" for one in path.data.observables]
            record["words"].append(f"target '{target.name}' is imported: nothing was run again, and only bins that "
                                   "hold a frame count")
        elif calibration.check_samples == 0 or target.results:
            record["words"].append(f"target '{target.name}' was not checked for the step of its grains")
        else:
            path.left_out = runs.unsteady(path, noise)
            record["words"] += _left_out(path)
        if target.kinds:
            path.left_out = [why if one.kind in target.kinds else "its target does not count it"
                             for one, why in zip(path.data.observables, path.left_out)]
        if any(one.kind in STRIPS_OF for one in path.data.observables):
            path.left_out = [why or ("the profile shows it" if one.kind == "ln_width" else "")
                             for one, why in zip(path.data.observables, path.left_out)]


def _left_out(path: Path) -> list[str]:
    """A line per observable that has a reason; strips of a window are one."""
    words = [f"left out: {path.target.name}, {one.kind} from {one.low:.3g} to {one.high:.3g}: {why}"
             for one, why in zip(path.data.observables, path.left_out) if why]
    return list(dict.fromkeys(words))


def with_data(coordinates: Coordinates, paths: Sequence[Path], record: dict[str, Any]) -> Coordinates:
    """Without an internal length whose targets ask for a width of a band and have none: nothing would tell it."""
    kept = []
    for p in coordinates.parameters:
        counts = [np.isfinite(mean) and not why for path in paths if path.target.is_fitted and p.is_of(path.target.name)
                  for one, mean, why in zip(path.data.observables, path.data.mean, path.left_out)
                  if one.kind in OF_BANDS]
        if p.key != "internal_length" or not counts or any(counts):
            kept.append(p)
        else:
            value = coordinates.others[p.key]
            record["findings"].append(f"{p.key} keeps the scene's value {value:g} d: too few samples have a band")
    if not kept:
        raise NotConverged(f"no parameter is left to fit: {'; '.join(record['findings'])}")
    return Coordinates(kept, coordinates.others)


def inputs_of(calibration: Calibration) -> list[tuple[str, str]]:
    inputs = [("the calibration", calibration.file)]
    for target in calibration.targets:
        own = [("the scene", target.scene), *(("results", folder) for folder in target.results),
               ("measured", target.measured), ("curve", target.curve)]
        inputs += [(f"targets: '{target.name}': {what}", path) for what, path in own if path]
        inputs += read_target(target).input_files()
    return inputs


def standard_contents(line: argparse.Namespace) -> dict[str, Any] | None:
    """Contents of the standard calibration of a scene; None for a calibration file."""
    is_file = line.target.endswith(".json")
    if is_file and (line.seeds or line.set or line.set_file):
        raise SceneError(f"--seeds, --set and --set-file belong to a scene; {line.target} is a calibration file, whose "
                         "targets have seeds and set")
    if not is_file and not line.seeds:
        raise SceneError(f"{line.target}: a scene needs the samples of the fit, for example --seeds 1-4; it then takes "
                         "the standard parameters. Other parameters need a calibration file, .json")
    return None if is_file else standard_calibration(line.target, line.seeds, settings_of(line.set, line.set_file))
