# diptych: the standard calibration of a scene
# SPDX-License-Identifier: LGPL-2.1-or-later
"""`diptych calibrate SCENE --seeds LIST` stands for a calibration file. This module holds its contents."""

import os
from collections.abc import Sequence
from typing import Any

import numpy as np

from ... import _diptych
from ...errors import SceneError
from ..runs.histories import path_bins
from ..runs.input_file import Setting, read_seeds, seeds_of_line
from .calibration_file import FAR

SOFTENING = 0.3  # softening_strain if the scene sets none; the bounds of mobilisation_strain belong to it
_PEAK = {"key": "friction_angle_peak", "start": 25, "low": 12, "high": 40}
_RESIDUAL = {"key": "friction_angle_residual", "start": 0.5, "low": 0.05, "high": 0.9}
_DILATANCY = {"key": "dilatancy_angle_peak", "of": "friction_angle_peak", "start": 0.5, "low": 0.05, "high": 1}
_DENSITY = ({"key": "critical_stress_ratio", "start": 0.26, "low": 0.1, "high": 0.6},
            {"key": "critical_solid_fraction", "coordinate": "value", "start": 0.82, "low": 0.76, "high": 0.88},
            {"key": "strength_by_density", "start": 5.5, "low": 1, "high": 20},
            {"key": "dilatancy_ratio", "coordinate": "above_least", "start": 0.25, "low": 0.05, "high": 2},
            {"key": "stress_ratio_start", "start": 0.1, "low": 0.01, "high": 0.5},
            {"key": "mobilisation_strain", "start": 0.02, "low": 0.002, "high": 0.2})
# The standard parameters of each hardening, and those of every law that reads them. Those of mobilisation are those of
# benchmarks/calibration/reference.
PARAMETERS = {
    "constant": (_PEAK, _DILATANCY),
    "exponential": (_PEAK, _RESIDUAL, _DILATANCY),
    "mobilisation": (_PEAK, _RESIDUAL, {"key": "friction_angle_start", "start": 0.7, "low": 0.2, "high": 1},
                     {"key": "mobilisation_strain", "start": 0.005, "low": 0.0005, "high": 0.2},
                     _DILATANCY | {"of": "friction_angle_start"}),
    "critical_state": _DENSITY,
    "kinematic": (*_DENSITY, {"key": "elastic_stress_ratio", "coordinate": "share_of", "of": "critical_stress_ratio",
                              "start": 0.2, "low": 0.02, "high": 0.9})}
OF_ALL = ({"key": "internal_length", "start": 3, "low": 0.8, "high": 8},
          {"key": "youngs_modulus", "start": 2000, "low": 200, "high": 20000})
# of the bins / end of the loading
EDGES = (0.025, 0.05, 0.075, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1)
LOAD_STEPS = 40
HOW = "README_calibration.md, A calibration file"
COARSE = 5 / 3  # coarse / own elements
SMALLEST_COARSE = 4  # mean diameters


# Grains in a cell have no edges: strength, dilatancy and modulus are the material's, whatever the platens.
CELL = {"loading/mode": "path", "loading/path": "drained", "discrete/lateral": "cell", "sample/width_over_height": 1}
WALLS = {"loading/horizontal_over_vertical": 0, "sample/rough_platens": "false", "discrete/platen_friction": 0,
         "discrete/wall_friction": 0, "discrete/lateral": "rigid_walls", "discrete/side_motion": "pressure",
         "continuum/platens": "smooth"}


def _targets(own: dict[str, Any], keys: dict[str, Any], has_length: bool) -> list[dict[str, Any]]:
    """own: the scene's target. If platens compress the sample, cells give the curves, and the platen test only the
    width of its band. Unseen samples, smooth walls and another direction are predicted. For other loadings the scene is
    the only target."""
    if keys["loading"]["mode"] != "descent" or keys["discrete"]["method"] == "imported":
        return [own]
    seeds, settings = read_seeds(own["seeds"]), own["set"]
    predicted = own | {"seeds": f"{max(seeds) + 1}-{max(seeds) + len(seeds)}", "use": "predict"}
    turned = {"loading/horizontal_over_vertical": 0 if keys["loading"]["horizontal_over_vertical"] else 1}
    of_cells = {"set": settings | CELL, "quantities": ["stress_ratio", "volumetric_strain"]}
    return [own | of_cells | {"name": f"cells of {own['name']}"},
            own | ({"quantities": ["ln_width"]} if has_length else {"use": "predict"}),
            predicted | {"name": "unseen samples"},
            predicted | {"name": "smooth rigid walls", "set": settings | WALLS},
            predicted | {"name": "other direction", "set": settings | turned}]


def _of_library(read: _diptych.Scene) -> list[dict[str, Any]]:
    """A decade on either side of each value of the scene, within the range that the library states."""
    found = []
    for name, value, *ends in read.law_parameters():
        low, high = sorted((0.1 * value, 10 * value)) if value else ends
        low, high = max(low, ends[0]), min(high, ends[1])
        if not -FAR < low < high < FAR:
            raise SceneError(f"continuum/{name} = {value:g} has no standard bounds, because it is 0 without a range; "
                             f"write a calibration file ({HOW})")
        found.append({"key": name, "coordinate": "logarithm" if low > 0 else "value", "start": value, "low": low,
                      "high": high})
    return found


def _parameters(read: _diptych.Scene, has_length: bool) -> list[dict[str, Any]]:
    """The standard parameters of the scene's law. Raises SceneError if it has none."""
    keys, unused = read.dict()["continuum"], read.unused_keys()
    if keys["law"] == "library":
        return _of_library(read)
    of_hardening: Sequence[dict[str, Any]] = ()
    if "hardening" not in unused:
        if keys["hardening"] not in PARAMETERS:
            raise SceneError(f"continuum/hardening = {keys['hardening']} has no standard parameters; those that have "
                             f"some are {', '.join(PARAMETERS)}; else write a calibration file ({HOW})")
        of_hardening = PARAMETERS[keys["hardening"]]
    found = [p for p in (*of_hardening, *OF_ALL) if p["key"] not in unused]
    scale = 1.0 if "softening_strain" in unused else min(1.0, keys["softening_strain"] / SOFTENING)
    return [p | ({end: scale * p[end] for end in ("start", "low", "high")} if p["key"] == "mobilisation_strain" else {})
            for p in found if has_length or p["key"] != "internal_length"]


def standard_calibration(scene: str, seeds: str, settings: Sequence[Setting]) -> dict[str, Any]:
    """Contents of a calibration file beside the scene file, with the law of the scene. Without an internal length the
    width of the band is left out, too. Raises SceneError."""
    given = {(one.section, one.key) for one in [*map(Setting._make, _diptych.read_fragment(scene)), *settings]}
    usual = {} if ("continuum", "softening_strain") in given else {"softening_strain": str(SOFTENING)}
    fixed = [Setting("continuum", key, value, file="the standard calibration") for key, value in usual.items()]
    read = _diptych.read_changed_scene(scene, [*settings, *fixed], True)
    keys, unused, files = read.dict(), read.unused_keys(), dict(read.input_files())
    file, n = keys["discrete"]["file"], len(seeds_of_line(seeds))
    is_one = keys["discrete"]["method"] == "imported" and "{seed}" not in file
    if is_one and n > 1:
        raise SceneError(f"--seeds {seeds}: discrete/file = '{file}' is one sample; give --seeds 1-1")
    if not is_one and n < 2:
        raise SceneError(f"--seeds {seeds}: the scatter of samples needs at least two seeds, for example --seeds 1-4")
    is_point = keys["loading"]["mode"] == "path"
    has_length = "internal_length" not in unused and not is_point  # a point has no band
    own = {"name": read.name, "scene": os.path.basename(scene), "seeds": seeds,
           "set": {(name := f"{one.section}/{one.key}"): keys[one.section][one.key] if name in files else one.value
                   for one in settings}}
    end = keys["loading"]["axial_strain"]
    rows, strain = read.path_shape() if is_point else ([0, end], [0, end])
    edges = path_bins(read, len(EDGES))[1:] if len(rows) > 2 else end * np.array(EDGES)
    law = {key: keys["continuum"][key] for key in ("law", "hardening", "geometry")}
    return {
        "title": f"{read.name}, seeds {seeds}",
        "targets": _targets(own, keys, has_length),
        "quantities": ["stress_ratio", "volumetric_strain", *(["ln_width"] if has_length else [])],
        "bins": [float(f"{edge:.6g}") for edge in edges],
        "set": {f"continuum/{key}": value for key, value in {**law, **usual}.items() if key not in unused},
        "parameters": _parameters(read, has_length),
        "load_step": float(f"{strain[-1] / LOAD_STEPS:.4g}"),
        "coarse_element_size": float(np.round(max(SMALLEST_COARSE, COARSE * keys["continuum"]["element_size"]), 2))}
