#!/usr/bin/env python3
# diptych: rotation across the band of grains and of the law with several internal lengths
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: figure.py FIGURE.png GRAINS... -- LAW... Result folders of `diptych discrete` and `diptych continuum`, for
moreau_1997."""
import os
import sys

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

import diptych
from diptych import _diptych, operators, scenes
from diptych.campaigns.calibration.profiles import STRIPS, profile
from diptych.campaigns.runs.key_numbers import bands_between, snapshots_at

SCENE = scenes.read(os.path.join(diptych.benchmarks_dir(), "moreau_1997", "scene.prm"))
WINDOWS = ((0, 0.01), (0.01, 0.02), (0.02, 0.04))


def profiles(snapshots, frames):
    """(window, strip), and the frames of the grains."""
    found, own = [], []
    for window, frame in zip(WINDOWS, frames or [{}] * len(WINDOWS)):
        pair = snapshots_at(snapshots, *window)
        moved = dict(operators.increment(*pair))
        own.append(frame or {key: moved[key] for key in ("mean_diameter", "platen_increment", "centre", "width",
                                                         "height")})
        band = bands_between(SCENE, pair, frame)[0]
        found.append(profile(pair, moved["weight"], band, list(zip(STRIPS, STRIPS[1:])),
                             1 / np.hypot(*own[-1]["platen_increment"])))
    return np.array(found), own


def main():
    to, *folders = sys.argv[1:]
    split = folders.index("--")
    read = [profiles(_diptych.read_grains(folder).snapshots, None) for folder in folders[:split]]
    grains, frames = np.array([one for one, _ in read]), read[0][1]
    middle = 0.5 * (np.array(STRIPS[1:]) + STRIPS[:-1])
    figure = Figure(figsize=(9.5, 3.2), layout="constrained")
    for k, axes in enumerate(figure.subplots(1, len(WINDOWS), sharey=True)):
        axes.errorbar(middle, grains[:, k].mean(0), 2 * grains[:, k].std(0, ddof=1) / np.sqrt(len(grains)), fmt="o",
                      color="#222222", markersize=4, label=f"{len(grains)} samples, ± 2 standard errors")
        axes.plot(middle, grains[:4, k].mean(0), "x", color="#888888", label="mean of the first four")
        axes.set(xlabel="distance from the middle of the band, d",
                 title=f"{100 * WINDOWS[k][0]:g} to {100 * WINDOWS[k][1]:g} % strain")
    for folder, style in zip(folders[split + 1:], ("--", "-", ":")):
        law, _ = profiles(_diptych.read_nodes(folder).snapshots, frames)
        length = _diptych.resolved_scene(folder + "/scene.prm").dict()["continuum"]["internal_length"]
        for k, axes in enumerate(figure.axes):
            axes.plot(middle, law[k], style, color="#1f77b4", label=f"law, l = {length:.3g} d")
    figure.axes[0].set_ylabel("2 x rotation x d / travel")
    figure.axes[0].legend(fontsize=7)
    FigureCanvasAgg(figure).print_figure(to, dpi=110)


if __name__ == "__main__":
    main()
