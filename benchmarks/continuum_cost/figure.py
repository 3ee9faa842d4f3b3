# diptych: figure of continuum_cost.py
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Error against CPU seconds, where the time goes, growth with the number of unknowns, uniform against adaptive
meshes."""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot  # noqa: E402
from matplotlib.ticker import FuncFormatter, NullFormatter  # noqa: E402

# Okabe and Ito (2008): colours that colour-blind readers can distinguish.
COLOURS = dict(black="#000000", orange="#E69F00", sky="#56B4E9", green="#009E73", blue="#0072B2", red="#D55E00",
               purple="#CC79A7")
STYLES = {
    "element size h": ("black", "o", "-"),
    "max_step, h = 2": ("blue", "s", "-"),
    "max_step, h = 1": ("sky", "s", "--"),
    "adaptive levels, h = 2": ("red", "^", "-"),
    "adaptive levels, h = 1": ("orange", "^", "--"),
    "viscosity, h = 2": ("green", "D", "-"),
    "linear_solver = amg": ("purple", "P", ""),
    "small strain, h = 2": ("green", "X", ""),
}
ERRORS = ("peak stress ratio", "stress ratio at 8 % strain", "band thickness, 7-8 % strain")
# Labelled points and the offsets of their labels, per panel [points].
LABELLED = ({"element size h": (5, 4), "viscosity, h = 2": (6, -2)},
            {"element size h": (-4, -12), "max_step, h = 2": (-33, -2), "viscosity, h = 2": (6, -2)},
            {"element size h": (5, 4), "viscosity, h = 2": (6, -2)})
FLOOR = 0.02  # Smaller errors are drawn at this value [%].


def plain(axis, ticks):
    axis.set_ticks(ticks)
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())


def draw_error(axes, series, which):
    for name, points in series.items():
        colour, marker, line = STYLES[name]
        points = [p for p in points if not math.isnan(p[2][which]) and p[2][which] != 0 and "stages" not in p[0]]
        seconds = [run.seconds for _, run, _ in points]
        size = [max(FLOOR, abs(errors[which])) for _, _, errors in points]
        axes.loglog(seconds, size, marker=marker, linestyle=line or "none", color=COLOURS[colour], label=name,
                    markersize=5, lw=1)
        for (label, _, _), x, y in zip(points, seconds, size):
            if name in LABELLED[which]:
                axes.annotate(label, (x, y), textcoords="offset points", fontsize=7, color=COLOURS[colour],
                              xytext=LABELLED[which][name])
    for level in (1, 5):
        axes.axhline(level, color="0.5", lw=0.8, linestyle=":")
    axes.set(xlabel="CPU seconds to 8 % strain", ylabel="|error| against the finest run [%]", title=ERRORS[which])
    axes.set_xlim(0.35, 45)
    axes.set_ylim(0.7 * FLOOR, 40)
    plain(axes.yaxis, (0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20))
    plain(axes.xaxis, (0.5, 1, 2, 5, 10, 20, 40))
    axes.grid(alpha=0.25)


def draw_phases(axes, found, names):
    bottoms = {h: 0 for h in found}
    for k, (name, colour) in enumerate(zip(names, ("blue", "sky", "green", "orange", "black"))):
        share = [100 * parts[k] / sum(parts) for parts in found.values()]
        places = [f"h = {h}, {sum(parts):.1f} s" for h, parts in found.items()]
        axes.barh(places, share, left=list(bottoms.values()), color=COLOURS[colour], label=name, height=0.5,
                  edgecolor="white")
        bottoms = {h: b + s for (h, b), s in zip(bottoms.items(), share)}
    axes.set(xlabel="share of the CPU seconds [%]", xlim=(0, 100), ylim=(-0.5, 1.9), title="where the time goes")
    axes.legend(fontsize=8, ncol=3, loc="upper center")


def draw_growth(axes, found):
    for (solver, points), colour, marker in zip(found.items(), ("blue", "red"), "os"):
        n = [p[0] for p in points]
        axes.loglog(n, [p[1] for p in points], marker + "-", color=COLOURS[colour], label=f"{solver}, all",
                    markersize=5)
        axes.loglog(n, [p[2] for p in points], marker + "--", color=COLOURS[colour], label=f"{solver}, linear solves",
                    markersize=5, markerfacecolor="white", lw=1)
    first = found["direct"][0]
    axes.loglog([first[0], 100 * first[0]], [0.5 * first[1], 50 * first[1]], ":", color="0.4",
                label="proportional to unknowns")
    axes.set(xlabel="unknowns", ylabel="CPU seconds per Newton iteration", title="growth, to 1 % strain")
    plain(axes.xaxis, (2000, 5000, 10000, 20000, 50000, 100000, 200000))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value / 1000:g}k"))
    plain(axes.yaxis, (0.01, 0.03, 0.1, 0.3, 1, 3, 10))
    axes.legend(fontsize=8)
    axes.grid(alpha=0.25)


def draw_samples(axes, found):
    for (mesh, points), colour, marker in zip(found.items(), ("black", "orange", "red"), "o^v"):
        axes.loglog([width for width, _ in points], [run.seconds for _, run in points], marker + "-",
                    color=COLOURS[colour], label=mesh, markersize=6)
    axes.set(xlabel="width = height of the sample [d]", ylabel="CPU seconds to 8 % strain",
             title="larger samples, h = 2, l = 2")
    plain(axes.xaxis, (60, 120, 180))
    plain(axes.yaxis, (1, 2, 5, 10, 20, 50, 100))
    axes.legend(fontsize=8)
    axes.grid(alpha=0.25)


def draw(found, path):
    figure, axes = pyplot.subplots(2, 3, figsize=(14, 8.6), constrained_layout=True)
    for which in range(3):
        draw_error(axes[0, which], found["accuracy"], which)
    handles, labels = axes[0, 0].get_legend_handles_labels()
    axes[0, 2].legend(handles, labels, fontsize=7.5, loc="lower left", framealpha=0.9)
    draw_phases(axes[1, 0], found["phases"], ("points", "assembly", "geometry", "solve", "rest"))
    draw_growth(axes[1, 1], found["growth"])
    draw_samples(axes[1, 2], found["samples"])
    for letter, panel in zip("abcdef", axes.flat):
        panel.set_title(f"({letter}) {panel.get_title()}", fontsize=10, loc="left")
        panel.set_title("")
    figure.savefig(path, dpi=110)
