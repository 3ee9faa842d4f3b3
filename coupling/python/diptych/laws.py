# diptych: constitutive laws at one point
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Constitutive laws of the continuum at one homogeneous point."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from . import _diptych, scenes
from .arrays import Array, History, Record
from .compiled import continuum
from .errors import NotConverged


def _law_scene(law: Any, pressure: float) -> _diptych.Scene:
    if isinstance(law, Mapping) and not any(isinstance(keys, Mapping) for keys in law.values()):
        return scenes.read({"continuum": law, "loading": {"pressure": pressure}})
    return scenes.read(law, {"loading": {"pressure": pressure}})


def _columns(path: Any) -> dict[str, Any]:
    """Columns of a path: those of a mapping, or the components of strain tensors."""
    if hasattr(path, "keys"):
        return {name: path[name] for name in path.keys()}
    strain = np.asarray(path, dtype=float)
    if strain.ndim == 2 and strain.shape[1] == 3:
        strain = strain[:, [0, 2, 2, 1]].reshape(-1, 2, 2)
    if strain.ndim != 3 or strain.shape[1:] != (2, 2):
        raise ValueError(f"path must be columns by name, or strains (n, 2, 2) or (n, 3), not {strain.shape}")
    for k, tensor in enumerate(strain):
        if not (np.isfinite(tensor).all() and tensor[0, 1] == tensor[1, 0]):
            raise ValueError(f"path[{k}] must be finite and symmetric")
    return {"exx": strain[:, 0, 0], "eyy": strain[:, 1, 1], "exy": strain[:, 0, 1]}


def _tensors(rows: Mapping[str, Any], letter: str) -> Array:
    return np.stack([rows[letter + k] for k in ("xx", "xy", "xy", "yy")], axis=1).reshape(-1, 2, 2)


def integrate(law: Any, path: Any, stress: Any = None, pressure: float = 1.0, time: Any = None) -> Record:
    """Drives a law along prescribed strains and stresses, in plane strain, positive in compression.

    law       keys of the section continuum: {"law": "mohr_coulomb", "friction_angle_peak": 30, ...}, or a scene (dict
              or path)
    path      three columns by name, numbers or (n), such as {"eyy": numpy.linspace(0, 0.04, 81), "sxx": 1, "exy": 0}.
              Strains: exx, eyy, exy, volume (exx + eyy); stresses [pressure]: sxx, syy, sxy, mean_stress ((sxx +
              syy)/2). Also strains alone: (n, 2, 2), or (n, 3) with xx, yy, xy. The first row is the start; every row
              is one step, or a hold of 1024 steps if only the time changes. Strains are total; exy is the tensor's
              component. The law takes the increments as given: use logarithmic strain for finite deformation.
    stress    (2, 2) at the start; default: the isotropic `pressure`, also out of the plane
    pressure  unit of the law's moduli and cohesion [pressure]
    time      (n) ascending, or a column "progress" of the path; only for laws with viscosity; default: rate independent

    Returns stress (n, 2, 2) [pressure], stress_zz (n), strain (n, 2, 2) since the start, equivalent_plastic_strain (n),
    dissipation (n) [pressure], verdict (n texts) and reliable (n), verdict == "reliable". "zz_outside": the law ignores
    sigma_zz, which lies beyond the yield surface; "unreliable": softening is too fast. Raises NotConverged, whose
    `reached` is the result so far, if there is no such stress or strain, SceneError (law), ValueError (path).
    """
    columns = _columns(path)
    time = columns.pop("progress", time)
    if len(columns) != 3:
        raise ValueError(f"path has {len(columns)} columns ({', '.join(columns)}); give three, for example eyy, sxx, "
                         "exy")
    arrays = np.broadcast_arrays(*(np.asarray(column, dtype=float) for column in columns.values()))
    start = (pressure * np.eye(2) if stress is None else np.asarray(stress, dtype=float), pressure)
    compiled = continuum("a law")
    named = {name: np.atleast_1d(array) for name, array in zip(columns, arrays)}
    rows, failure = compiled.integrate(_law_scene(law, pressure), start, named, time)
    result = Record({"stress": _tensors(rows, "s"), "stress_zz": rows["szz"], "strain": _tensors(rows, "e"),
                     "equivalent_plastic_strain": rows["equivalent_plastic_strain"], "dissipation": rows["dissipation"],
                     "verdict": np.array(rows["verdict"]), "reliable": np.array(rows["verdict"]) == "reliable"})
    if failure:
        raise NotConverged(failure, result)
    return result


def biaxial(law: Any, axial_strain: float = 0.1, pressure: float = 1.0, step: float = 1e-3,
            path: str = "drained") -> History:
    """Drives a law along a named path from an isotropic stress (the law's key k0: another one), in plane strain. The
    axial strain grows in equal steps to `axial_strain`. Newton's iteration finds the other strains to 1e-10 of the
    pressure.

    law   as in integrate()
    path  "drained": the lateral stress stays at `pressure` (the biaxial test); "constant_volume" (undrained);
          "constant_mean_stress": (sxx + syy)/2; "simple_shear": 2 exy grows in place of the axial strain, syy and the
          width are constant

    Returns the columns of material_point.csv (axial_strain, volumetric_strain, stress_ratio, ...). Raises NotConverged,
    whose `reached` is the result so far, if there is no such stress or strain, SceneError, ValueError.
    """
    compiled = continuum("a law")
    columns, failure = compiled.named_path(_law_scene(law, pressure), path, axial_strain, step)
    result = History(columns, compiled.point_columns())
    if failure:
        raise NotConverged(failure, result)
    return result


def principal(stress: Any) -> tuple[Array, Array, Array]:
    """Principal stresses s1 >= s2 of the symmetric part of (..., 2, 2), and degrees of s1 from the horizontal."""
    stress = np.asarray(stress, dtype=float)
    half = 0.5 * (stress[..., 0, 0] - stress[..., 1, 1])
    shear = 0.5 * (stress[..., 0, 1] + stress[..., 1, 0])
    mean, t = 0.5 * (stress[..., 0, 0] + stress[..., 1, 1]), np.hypot(half, shear)
    return mean + t, mean - t, 0.5 * np.degrees(np.arctan2(shear, half))
