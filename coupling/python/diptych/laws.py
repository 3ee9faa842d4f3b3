# diptych: constitutive laws at one point
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Constitutive laws of the continuum at one homogeneous point."""

from __future__ import annotations

import importlib
from collections.abc import Mapping
from typing import Any

import numpy as np

from . import _diptych, scenes
from .arrays import Array, History, Record
from .errors import NotConverged


def _law_scene(law: Any, pressure: float) -> _diptych.Scene:
    if isinstance(law, Mapping) and not any(isinstance(keys, Mapping) for keys in law.values()):
        return scenes.read({"continuum": law, "loading": {"pressure": pressure}})
    return scenes.read(law, {"loading": {"pressure": pressure}})


def integrate(law: Any, strain_path: Any, stress: Any = None, pressure: float = 1.0, time: Any = None) -> Record:
    """Drives a law along prescribed strains, in plane strain.

    law          keys of the section continuum: {"law": "mohr_coulomb", "friction_angle_peak": 30, ...}, or a scene (dict or path)
    strain_path  (n, 2, 2), or (n, 3) with xx, yy, xy: total strain, positive in compression; xy is the tensor's component. The first
                 row is the start. The law takes the increments as given: use logarithmic strain for finite deformation.
    stress       (2, 2) at the start, positive in compression; default: the isotropic `pressure`, also out of the plane
    pressure     unit of the law's moduli and cohesion [pressure]
    time         (n), only for laws with viscosity; default: rate independent

    Returns stress (n, 2, 2) [pressure], stress_zz (n), equivalent_plastic_strain (n), dissipation (n) [pressure], reliable (n).
    Raises NotConverged with the step at which the law found no stress, SceneError for a wrong law, ValueError for a wrong path.
    """
    strain = np.asarray(strain_path, dtype=float)
    if strain.ndim == 2 and strain.shape[1] == 3:
        strain = strain[:, [0, 2, 2, 1]].reshape(-1, 2, 2)
    scene = _law_scene(law, pressure)
    start = (pressure * np.eye(2) if stress is None else np.asarray(stress, dtype=float), pressure)
    compiled = importlib.import_module("diptych._continuum")
    result = compiled.integrate(scene, strain, start, time)
    reached = len(result["stress_zz"])
    if reached < len(strain):
        raise NotConverged(f"the law found no stress for strain_path[{reached}]")
    result["reliable"] = result["reliable"].astype(bool)
    return Record(result)


def biaxial(law: Any, axial_strain: float = 0.1, pressure: float = 1.0, step: float = 1e-3) -> History:
    """Drives a law along the biaxial path, in plane strain. The lateral stress stays at `pressure`; the axial strain grows in equal
    steps to `axial_strain`, from an isotropic stress. Newton's iteration finds the lateral strain to 1e-10 of the pressure.

    law  as in integrate()

    Returns the columns of material_point.csv (axial_strain, volumetric_strain, stress_ratio, ...). Raises NotConverged if the law or
    the lateral strain does not converge, SceneError, ValueError.
    """
    compiled = importlib.import_module("diptych._continuum")
    columns, failure = compiled.biaxial(_law_scene(law, pressure), axial_strain, step)
    if failure:
        raise NotConverged(failure)
    return History(columns, compiled.point_columns())


def principal(stress: Any) -> tuple[Array, Array, Array]:
    """Principal stresses s1 >= s2 of the symmetric part of (..., 2, 2), and the direction of s1 from the horizontal [degrees]."""
    stress = np.asarray(stress, dtype=float)
    half = 0.5 * (stress[..., 0, 0] - stress[..., 1, 1])
    shear = 0.5 * (stress[..., 0, 1] + stress[..., 1, 0])
    mean, t = 0.5 * (stress[..., 0, 0] + stress[..., 1, 1]), np.hypot(half, shear)
    return mean + t, mean - t, 0.5 * np.degrees(np.arctan2(shear, half))
