# diptych: figure of the continuum panel beside an independent Cosserat model
# SPDX-License-Identifier: LGPL-2.1-or-later
import matplotlib
import numpy

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

COLOURS = ("#0072b2", "#000000", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#999999")


def draw_fields(figure, places, ours, referee, case):
    """Plastic shear increment of both programs and the size of their difference, relative to the referee's peak."""
    peak = referee.increment.max()
    extent = (0, referee.plastic.width, 0, referee.plastic.height)
    pictures = (("continuum panel", ours.increment / peak), ("referee", referee.increment / peak),
                ("difference", numpy.log10(numpy.maximum(abs(ours.increment - referee.increment) / peak, 1e-10))))
    for axes, (title, values) in zip(places, pictures):
        limits = (-10, -2) if title == "difference" else (0, 1)
        picture = axes.imshow(values, origin="lower", extent=extent, cmap="cividis", vmin=limits[0], vmax=limits[1])
        bar = figure.colorbar(picture, ax=axes, shrink=0.9, pad=0.02)
        bar.set_label("log10 |difference| / peak" if title == "difference" else "plastic shear increment / peak")
        axes.set(title=f"{case}: {title}", xlabel="x / d", ylabel="y / d")


def draw_section(axes, ours, referee):
    """Rotation and couple stress along the vertical through the middle of the sample."""
    middle = referee.increment.shape[1] // 2
    y = (numpy.arange(referee.increment.shape[0]) + 0.5) * referee.plastic.h
    for name, label, colour in (("rotation", "rotation", COLOURS[0]), ("m_x", "couple stress m_x", COLOURS[2]),
                                ("m_y", "couple stress m_y", COLOURS[3]), ("skew", "skew stress", COLOURS[4])):
        largest = abs(referee.fields[name]).max()
        axes.plot(ours.fields[name][:, middle] / largest, y, color=colour, linewidth=1.4, label=label)
        axes.plot(referee.fields[name][:, middle] / largest, y, "o", color=colour, markersize=3.5,
                  markerfacecolor="white")
    axes.set(xlabel="value / largest in the sample", ylabel="y / d", ylim=(0, 52),
             title="column of cells at x = 10.5 d")
    axes.legend(loc="upper left", fontsize=7)


def draw_lines(curves, profiles, errors, pairs):
    """Lines: continuum panel; circles: referee."""
    for (case, (ours, referee)), colour in zip(pairs.items(), COLOURS):
        strain = 100 * referee.curve["axial_strain"]
        if not numpy.isnan(referee.band.thickness):
            curves.plot(strain, -ours.curve["upper_fy"], color=colour, linewidth=1.2, label=case)
            curves.plot(strain[::4], -referee.curve["upper_fy"][::4], "o", color=colour, markersize=3,
                        markerfacecolor="white")
            (across, mine), (_, other) = (solution.profile(referee.band) for solution in (ours, referee))
            profiles.plot(across, mine, color=colour, linewidth=1.2)
            profiles.plot(across[::3], other[::3], "o", color=colour, markersize=3, markerfacecolor="white")
        error = abs(ours.curve["upper_fy"] - referee.curve["upper_fy"]) / abs(referee.curve["upper_fy"]).max()
        errors.semilogy(strain / strain[-1], numpy.maximum(error, 1e-13), color=colour, linewidth=1, label=case)
    curves.set(xlabel="axial strain [%]", ylabel="platen force / (P d)",
               title="lines: continuum panel, circles: referee")
    profiles.set(xlabel="distance across the band / d", ylabel="plastic shear increment, 2 to 3 %", ylim=(0, None),
                 title="band profiles")
    errors.set(xlabel="axial strain / its end", ylabel="difference / largest force", title="platen force",
               ylim=(1e-13, 1e-4))
    curves.legend(fontsize=7, loc="lower right")
    errors.legend(fontsize=7, ncol=2, loc="upper left")
    for axes in (curves, profiles, errors):
        axes.grid(alpha=0.3)


def draw(pairs, path):
    """pairs: {case: (ours, referee)}; the first case must have rotations."""
    pyplot.rcParams.update({"font.size": 8.5, "axes.titlesize": 9})
    figure = pyplot.figure(figsize=(12, 8.4), constrained_layout=True)
    upper, lower = figure.subfigures(2, 1, height_ratios=(1.25, 1))
    fields, lines = upper.subplots(1, 4), lower.subplots(1, 3)
    case, (ours, referee) = next(iter(pairs.items()))
    draw_fields(upper, fields, ours, referee, case)
    draw_section(fields[3], ours, referee)
    draw_lines(*lines, pairs)
    figure.savefig(path, dpi=110)
