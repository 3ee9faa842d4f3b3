# diptych: a measurement and both panels, levelled, over the last window
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws benchmarks/measured/figure.png.

    python3 benchmarks/measured/figure.py RUN
"""
import json
import os
import sys

import h5py
import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt

PANES = {"measured": "measurement", "discrete": "grains, levelled", "continuum": "continuum, levelled"}


def main(run):
    with open(os.path.join(run, "levelled.json"), encoding="utf-8") as file:
        window = json.load(file)["windows"][-1]
    with h5py.File(os.path.join(run, "levelled.h5")) as file:
        fields = {name: values[()] for name, values in file[window["key"]].items()}
    (x, y), top = fields["position"].T, 100 * np.nanpercentile(fields["measured_shear_strain_increment"], 97)
    figure, axes = plt.subplots(1, 3, figsize=(9.6, 4.7), constrained_layout=True, sharey=True)
    for axis, (pane, title) in zip(axes, PANES.items()):
        drawn = axis.scatter(x, y, 48, 100 * fields[f"{pane}_shear_strain_increment"], marker="s", linewidths=0)
        drawn.set_clim(0, top)
        for band in window["levelled"][pane]["bands"]:
            angle = np.radians(band["angle_deg"]["value"])
            axis.axline(band["middle"], slope=np.tan(angle), color="white", linewidth=1.5)
        axis.set(title=title, aspect="equal", xlabel="x / d", xlim=(x.min() - 1, x.max() + 1),
                 ylim=(y.min() - 1, y.max() + 1))
    axes[0].set_ylabel("y / d")
    figure.colorbar(drawn, ax=axes, shrink=0.6, extend="max",
                    label=f"shear strain, {100 * window['from']:g} to {100 * window['to']:g} % (%)")
    figure.savefig(os.path.join(os.path.dirname(os.path.abspath(__file__)), "figure.png"), dpi=100)


if __name__ == "__main__":
    main(sys.argv[1])
