# diptych: a measurement made of our own grains
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Samples the grains of a result folder as an image correlation would: means over square subsets on a grid, with noise.
Writes FIELD/frame_K.csv, the displacements since the first stage, and FIELD/boundary.csv, whose t/s is that of the
forces on the platens and the pressure on the sides.

    PYTHONPATH=build/release/python python3 benchmarks/measured/own_grains.py RUN FIELD
"""
import os
import sys

import numpy as np
import pandas as pd

import diptych
from diptych.campaigns.runs.histories import nominal_stress_ratio
from diptych.levelling import field_of, levelled

SUBSET, SPACING, NOISE = 2.5, 1.5, 0.01  # [d]: a rod of 10 pixels, subsets of 25, points every 15, noise of 0.1 pixel


def points_of(snapshot, d):
    low, high = snapshot.position.min(0), snapshot.position.max(0)
    axes = [np.arange(a + SUBSET * d / 2, b - SUBSET * d / 2, SPACING * d) for a, b in zip(low, high)]
    return np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, 2)


def main(run, folder):
    snapshots = diptych.load(run).discrete.snapshots
    first, d, draw = snapshots[0], snapshots[0].mean_diameter, np.random.default_rng(1)
    points = points_of(first, d)
    os.makedirs(folder, exist_ok=True)
    for k, snapshot in enumerate(snapshots[1:], 1):
        back = field_of(snapshot, first)  # at places of the first instant, from the later to the first
        moved = NOISE * d * draw.standard_normal(points.shape) - levelled(back, points, SUBSET * d)
        table = pd.DataFrame({"x": points[:, 0], "y": points[:, 1], "u": moved[:, 0], "v": moved[:, 1],
                              "sigma": NOISE * d})
        table.dropna().to_csv(os.path.join(folder, f"frame_{k:02d}.csv"), index=False, float_format="%.6g")
    history = diptych.load(run).discrete.history.frame()
    history["stress_ratio"] = nominal_stress_ratio(diptych.scenes.read(os.path.join(run, "scene.prm")), history)
    history.iloc[::10][["axial_strain", "stress_ratio", "volumetric_strain"]].to_csv(
        os.path.join(folder, "boundary.csv"), index=False, float_format="%.6g")
    print(f"{folder}: {len(points)} points, {len(snapshots) - 1} frames")


if __name__ == "__main__":
    main(*sys.argv[1:3])
