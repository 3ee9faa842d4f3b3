# diptych: reads the results of Ncorr
# SPDX-License-Identifier: LGPL-2.1-or-later
"""MATLAB 7.3 files, which are HDF5: arrays are transposed, and a struct of several elements holds references. Formatted
displacements have the unit of the calibration, and all refer to the first image."""

from __future__ import annotations

import os
from typing import Any

import h5py
import numpy as np

from ...measurement import FieldFrame
from ..frames import refused
from .frames import FieldOptions


def _elements(group: Any, name: str) -> list[Any]:
    """The items of a field in all elements of a struct; a struct of one element holds it directly."""
    item = group[name]
    is_listed = isinstance(item, h5py.Dataset) and item.dtype == h5py.ref_dtype
    return [group.file[reference] for reference in np.ravel(item)] if is_listed else [item]


def _frames(path: str, result: Any, options: FieldOptions) -> list[FieldFrame]:
    info, fields = result["dispinfo"], result["displacements"]
    scale, spacing, radius = (float(np.ravel(info[name])[0]) for name in ("pixtounits", "spacing", "radius"))
    unit = "".join(map(chr, np.ravel(info["units"])))
    frames = []
    listed = zip(*(_elements(fields, name) for name in ("plot_u_ref_formatted", "plot_v_ref_formatted",
                                                        "roi_ref_formatted")), strict=True)
    for number, (u, v, roi) in enumerate(listed, 1):
        moved = np.stack([u[()].T, v[()].T], axis=-1).astype(float)
        if isinstance(roi, h5py.Group) and "mask" in roi:
            inside = roi["mask"][()].T != 0
        else:  # an object of a class, which only MATLAB reads
            inside = (moved != 0).any(axis=-1)
            options.note("points whose displacement is exactly 0 count as lost: the region of interest in the file is "
                         "an object that only MATLAB reads")
        rows, columns = np.indices(inside.shape)
        points = np.stack([columns, rows], axis=-1).reshape(-1, 2) * (spacing + 1) * scale
        moved[~inside] = np.nan
        frames.append(FieldFrame(f"{os.path.basename(path)} {number}", points, moved.reshape(-1, 2), path=path,
                                 unit="px" if unit.startswith("pix") else unit, y_down=True,
                                 subset=2 * radius * scale))
    return frames


def read(options: FieldOptions) -> list[FieldFrame]:
    """All displacements of the files. Raises SceneError."""
    frames = []
    for path in options.files:
        try:
            with h5py.File(path) as file:
                frames += _frames(path, file["data_dic_save"], options)
        except (OSError, KeyError, ValueError, TypeError, IndexError) as error:
            raise refused(path, f"is no complete result of Ncorr in MATLAB's format 7.3 ({error}); format the "
                          "displacements in Ncorr, then save the data, or in MATLAB: load('FILE'); save('NEW.mat', "
                          "'data_dic_save', '-v7.3')") from error
    return frames
