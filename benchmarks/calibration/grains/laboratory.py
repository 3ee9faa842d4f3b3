#!/usr/bin/env python3
# diptych: the mean curve of synthetic tests, in the place of a laboratory
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: laboratory.py FRICTION SEEDS CURVE.csv, for example 0.4 101-196 lab.csv. Runs scene.prm with this friction of
the grains and writes the mean curve of all seeds with the deviation of this mean."""
import os
import sys

import diptych
import numpy as np
import pandas as pd
from diptych import scenes
from diptych.campaigns.runs.input_file import read_seeds

STRAIN = np.linspace(0.00025, 0.01, 40)
SCENE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "scene.prm")


def curves(friction, seed):
    panel = diptych.DiscretePanel(scenes.read(SCENE, {"discrete/friction": friction, "sample/seed": seed}))
    panel.run()
    return [np.interp(STRAIN, panel.history["axial_strain"], panel.history[name])
            for name in ("stress_ratio", "volumetric_strain")]


def main():
    friction, seeds, to = float(sys.argv[1]), read_seeds(sys.argv[2]), sys.argv[3]
    found = np.array([curves(friction, seed) for seed in seeds])
    (stress, volume), deviations = found.mean(0), found.std(0, ddof=1) / np.sqrt(len(seeds))
    pd.DataFrame({"axial_strain": STRAIN, "stress_ratio": stress, "stress_ratio_deviation": deviations[0],
                  "volumetric_strain": volume,
                  "volumetric_strain_deviation": deviations[1]}).to_csv(to, index=False, float_format="%.5g")


if __name__ == "__main__":
    main()
