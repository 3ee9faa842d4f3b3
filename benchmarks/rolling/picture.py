#!/usr/bin/env python3
# diptych: grain rotation in a shear band without and with rolling resistance
# SPDX-License-Identifier: LGPL-2.1-or-later
"""picture.py DIR FILE [--seed 1] [--rolling 0.1]

Draws the rotation of the grains between 2 and 4 % axial strain for mu_r = 0 and another mu_r, from the folder DIR of
rolling.py. Needs numpy, matplotlib and the Python package diptych."""
import argparse

import diptych
import matplotlib
import numpy
from matplotlib.collections import EllipseCollection
from PIL import Image

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

from rolling import WINDOW  # noqa: E402

LIMIT = 30  # End of the colour scale [degrees].


def draw(axis, folder, title):
    """The grains at the end of the window, their rotation in it, the detected bands."""
    start, end = (diptych.load(folder).discrete.snapshots[k] for k in WINDOW)
    turned = numpy.degrees(end.rotation - start.rotation)
    discs = EllipseCollection(2 * end.radius, 2 * end.radius, 0, units="xy", offsets=end.position,
                              transOffset=axis.transData, array=turned, cmap="RdBu_r", clim=(-LIMIT, LIMIT),
                              edgecolor="0.6", linewidth=0.2)
    axis.add_collection(discs)
    for band in diptych.find_bands(**diptych.increment(start, end), band_resamples=0).bands:
        along = numpy.array([-100, 100])
        direction, normal = numpy.array([band.normal[1], -band.normal[0]]), band.normal
        for side in (-1, 1):
            middle = band.centre + (band.offset + side * band.width_10_90 / 2) * normal
            axis.plot(*(middle[:, None] + direction[:, None] * along), "k--", linewidth=0.9)
    low, high = end.position.min(0) - 1, end.position.max(0) + 1
    axis.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal", title=title, xticks=(), yticks=())
    return discs, turned


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("figure")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--rolling", type=float, default=0.1)
    options = parser.parse_args()
    figure, axes = pyplot.subplots(1, 2, figsize=(9.6, 5), constrained_layout=True)
    for axis, rolling in zip(axes, (0, options.rolling)):
        discs, turned = draw(axis, f"{options.folder}/band/0.4_{rolling:g}_{options.seed}", f"mu_r = {rolling:g}")
        print(f"mu_r = {rolling:g}: rms rotation {numpy.sqrt((turned ** 2).mean()):.1f} degrees, "
              f"median {numpy.median(abs(turned)):.1f}, above {LIMIT} {100 * (abs(turned) > LIMIT).mean():.1f} % of "
              "the grains")
    figure.colorbar(discs, ax=axes, shrink=0.6, label="rotation, 2 to 4 % strain (degrees, anticlockwise)",
                    extend="both")
    figure.savefig(options.figure, dpi=100)
    Image.open(options.figure).quantize(128).save(options.figure, optimize=True)


if __name__ == "__main__":
    main()
