# diptych: shear strain of both panels over one window, for the figure of a folder
# SPDX-License-Identifier: LGPL-2.1-or-later
import json
import os

import h5py
import numpy

from claims import value


def draw_bands(axis, panel, points):
    """Lines at the middle of every band and at 10 and 90 % of its jump. Offsets count from the middle of the bounding
    box of `points`."""
    centre = 0.5 * (points.min(axis=0) + points.max(axis=0))
    reach = numpy.linalg.norm(numpy.ptp(points, axis=0))
    for band in panel["bands"]:
        angle = numpy.radians(value(band["angle_deg"]))
        along, across = numpy.array([numpy.cos(angle), numpy.sin(angle)]), numpy.array([-numpy.sin(angle),
                                                                                        numpy.cos(angle)])
        for side, style in ((0, "-"), (-0.5, "--"), (0.5, "--")):
            middle = centre + across * (value(band["offset_d"]) + side * value(band["width_10_90_d"]))
            ends = numpy.stack((middle - reach * along, middle + reach * along))
            axis.plot(*ends.T, color="white", linestyle=style, linewidth=1.2 if side == 0 else 0.8)


def draw_window(folder, window, path):
    """Shear strain increment of the grains and of the continuum over one window of a result folder, on one colour
    scale, lengths in mean diameters."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as pyplot
    from matplotlib.collections import EllipseCollection, PolyCollection
    with open(os.path.join(folder, "comparison.json")) as file:
        whole = json.load(file)
    record, d = whole["windows"][window], whole["mean_diameter"]
    with h5py.File(os.path.join(folder, "comparison.h5"), "r") as file:
        group = file[f"window_{window}"]
        position, radius = group["discrete/position"][()][:, :2] / d, group["discrete/radius"][()] / d
        grains = group["discrete/shear_strain_increment"][()]
        corners = group["cells/node_position"][()][group["cells/nodes"][()]] / d
        cells = group["cells/continuum_shear_strain_increment"][()]
    top = numpy.nanpercentile(grains, 97)
    figure, axes = pyplot.subplots(1, 2, figsize=(8.4, 5.6), constrained_layout=True, sharey=True)
    axes[0].add_collection(EllipseCollection(2 * radius, 2 * radius, numpy.zeros_like(radius), units="xy",
                                             offsets=position,
                                             transOffset=axes[0].transData, array=grains, cmap="viridis",
                                             clim=(0, top)))
    drawn = axes[1].add_collection(PolyCollection(corners, array=cells, cmap="viridis", clim=(0, top),
                                                  edgecolors="face", linewidths=0.2))
    low, high = position.min(axis=0) - 2, position.max(axis=0) + 2
    for axis, name in zip(axes, ("discrete", "continuum")):
        draw_bands(axis, record[name], numpy.concatenate(corners))
        axis.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal", xlabel="x / d",
                 title="grains" if name == "discrete" else "continuum", facecolor="0.85")
    axes[0].set_ylabel("y / d")
    span = f"{100 * record['from']:g} to {100 * record['to']:g} %"
    figure.colorbar(drawn, ax=axes, shrink=0.6, label=f"shear strain increment, {span}")
    figure.savefig(path, dpi=100, bbox_inches="tight")
