# diptych: reads displacements at the points of VTK files
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A .vtu or .vtk file a frame, whose points carry a vector."""

from __future__ import annotations

import os

import meshio  # type: ignore
import numpy as np

from ...measurement import FieldFrame
from ..frames import refused
from ..yade_vtk import mesh_of
from .frames import FieldOptions


def _frame(path: str, options: FieldOptions) -> FieldFrame:
    try:
        mesh = meshio.vtk.read(path) if path.endswith(".vtk") else mesh_of(path)
    except Exception as error:  # of many kinds, on damaged files
        raise refused(path, f"is no complete VTK file ({error})") from error
    vectors = [name for name, values in mesh.point_data.items() if values.ndim == 2 and values.shape[1] in (2, 3)]
    [name] = options.columns_of("field", 1) or (vectors if len(vectors) == 1 else [""])
    if name not in vectors:
        raise refused(path, f"its points have {len(vectors)} vectors: {', '.join(vectors)}; choose the displacement by "
                      "--columns field=NAME")
    z = mesh.points[:, 2:]
    if np.ptp(z, axis=0).any():
        raise refused(path, f"z runs from {z.min():g} to {z.max():g}: points in one plane x, y are needed")
    return FieldFrame(os.path.basename(path), mesh.points[:, :2].astype(float),
                      mesh.point_data[name][:, :2].astype(float), path=path)


def read(options: FieldOptions) -> list[FieldFrame]:
    """A frame a file. Raises SceneError."""
    return [_frame(path, options) for path in options.files]
