# diptych: figure of the bands, of their thickness and of its mesh dependence without an internal length
# SPDX-License-Identifier: LGPL-2.1-or-later
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot
import numpy
from matplotlib.collections import PolyCollection

from runs import ARMS, LENGTHS, LOCAL_ELEMENTS, SIZES, length_runs, power, size_runs, thicknesses
from width import Increment, measure

BLUE, VERMILION, GREEN, BLACK = "#0072b2", "#d55e00", "#009e73", "black"
STRAINS = (0.02, 0.03, 0.04, 0.05, 0.06, 0.07, 0.08)


def draw_field(figure, axes, folder, scene, title):
    increment = Increment(folder, 0.08)
    band = measure(increment, ARMS[scene])
    cells = PolyCollection(increment.corners, array=increment.means / numpy.nanmax(band.profile), cmap="cividis",
                           edgecolors="face", linewidths=0.4)
    cells.set_clim(0, 1.5)
    axes.add_collection(cells)
    angle = numpy.radians(band.angle)
    tangent, normal = numpy.array((numpy.cos(angle), numpy.sin(angle))), numpy.array((-numpy.sin(angle),
                                                                                      numpy.cos(angle)))
    for side in (-0.5, 0.5):
        line = numpy.array([band.centre + side * band.thickness * normal + end * band.half_length * tangent
                            for end in (-1, 1)])
        axes.plot(*line.T, color="black", linewidth=3.5, solid_capstyle="butt")
        axes.plot(*line.T, color="white", linewidth=1.8, solid_capstyle="butt")
    axes.autoscale_view()
    axes.set(aspect="equal", xlabel="x / d", ylabel="y / d",
             title=f"{title}\n{band.thickness:.1f} d, {abs(band.angle):.1f}° from the horizontal")
    return cells


def draw_strain(axes, runs):
    for length, colour, marker in zip(LENGTHS, (BLUE, VERMILION, GREEN), "os^"):
        for h, style in ((length / 2, "-"), (length, ":")):
            values = thicknesses(runs("oblique", internal_length=length, element_size=h), "oblique", STRAINS)
            axes.plot(100 * numpy.array(STRAINS), values, style, color=colour, marker=marker, markersize=4,
                      markerfacecolor=colour if style == "-" else "white")
        axes.annotate(f"l = {length} d", (8.25, values[-1]), color=colour, va="center")
    axes.plot([], [], "-", color=BLACK, marker="o", markersize=4, label="h = l/2")
    axes.plot([], [], ":", color=BLACK, marker="o", markersize=4, markerfacecolor="white", label="h = l")
    axes.set(xlabel="axial strain [%]", ylabel="thickness / d", xlim=(1.5, 9.9), ylim=(0, 26),
             title="oblique, W = H = 60 d")
    axes.legend(loc="upper left", ncol=2)


def draw_powers(axes, runs):
    """Thickness against l, both relative to the size: both series must lie on one curve."""
    for strain, colour in ((0.02, GREEN), (0.04, VERMILION), (0.08, BLUE)):
        by_length = [thicknesses(folder, "oblique", (strain,))[0] / 60 for folder in length_runs(runs).values()]
        by_size = [thicknesses(folder, "oblique", (strain,))[0] / size for size, folder in size_runs(runs).items()]
        x = numpy.append(numpy.array(LENGTHS) / 60, 2 / numpy.array(SIZES))
        factor, exponent, _ = power(x, numpy.append(by_length, by_size))
        line = numpy.array((x.min() / 1.15, x.max() * 1.15))
        axes.loglog(line, factor * line**exponent, "-", color=colour, linewidth=1,
                    label=f"{100 * strain:g} %: power {exponent:.2f}")
        axes.loglog(x[:len(LENGTHS)], by_length, "o", color=colour, markersize=5)
        axes.loglog(x[len(LENGTHS):], by_size, "s", color=colour, markersize=8, markerfacecolor="none")
    axes.plot([], [], "o", color=BLACK, markersize=5, label="l = 1, 2, 4 d at W = 60 d")
    axes.plot([], [], "s", color=BLACK, markersize=8, markerfacecolor="none", label="W = 40 to 120 d at l = 2 d")
    axes.set(xlabel="l / W", ylabel="thickness / W", title="oblique, W = H, h = l/2")
    axes.set_xticks([1 / 60, 1 / 30, 1 / 20, 1 / 15], ["1/60", "1/30", "1/20", "1/15"])
    axes.set_yticks([0.1, 0.15, 0.2, 0.3, 0.4], ["0.1", "0.15", "0.2", "0.3", "0.4"])
    axes.minorticks_off()
    axes.set_ylim(0.09, 0.72)
    axes.legend(loc="upper left")


def draw_failure(axes, runs):
    elements = numpy.array(sorted(LOCAL_ELEMENTS))
    series = (("no internal length", VERMILION, "s", {"law": "mohr_coulomb"}),
              ("Cosserat, l = 2 d", BLUE, "o", {"internal_length": 2}))
    for label, colour, marker, keys in series:
        for strain, style in ((0.04, "--"), (0.08, "-")):
            values = [thicknesses(runs("oblique", **keys, element_size=h), "oblique", (strain,))[0] for h in elements]
            axes.plot(elements, values, style, color=colour, marker=marker, markersize=4,
                      label=f"{label}, {100 * strain:g} %")
    axes.set(xlabel="element size h / d", ylabel="thickness / d", xlim=(0, 4.3), ylim=(0, 23),
             title="oblique: with and without internal length")
    axes.legend(loc="upper left")


def draw(runs, path):
    pyplot.rcParams.update({"font.size": 9, "axes.titlesize": 9.5, "legend.fontsize": 8})
    figure, axes = pyplot.subplots(2, 3, figsize=(11, 7.6), constrained_layout=True,
                                   gridspec_kw={"height_ratios": (1.25, 1)})
    for place, (scene, length, h) in zip(axes[0], (("oblique", 2, 1.0), ("vertical", 2, 1.0), ("smooth", 1, 0.5))):
        cells = draw_field(figure, place, runs(scene, internal_length=length, element_size=h), scene,
                           f"{scene}, l = {length} d:")
    figure.colorbar(cells, ax=axes[0], shrink=0.85, pad=0.01).set_label(
        "plastic shear increment from 7 to 8 % strain\n/ peak of the band's profile")
    draw_strain(axes[1, 0], runs)
    draw_powers(axes[1, 1], runs)
    draw_failure(axes[1, 2], runs)
    for place in axes[1]:
        place.grid(alpha=0.3)
    figure.savefig(path, dpi=120)
