# diptych: figures of three_methods, from its stored numbers
# SPDX-License-Identifier: LGPL-2.1-or-later
import os

import numpy
from matplotlib import colormaps
from matplotlib.figure import Figure
from methods import HERE, METHODS, claims

COLOURS = dict(zip((*METHODS, "event-driven"), ("#0072B2", "#D55E00", "#007A5E")))
MARKS = {"at least": ("^", "at least: no longer step tried,\nor it ended early"), "at most": ("v", "at most"),
         "none": ("x", "none")}


def draw_cooling(found):
    figure = Figure(figsize=(10, 4), layout="constrained")
    left, right = figure.subplots(1, 2)
    times = numpy.arange(1, len(found["energy"][0]) + 1)
    left.semilogx(times, found["energy"][0], "k.", markersize=4, label="event-driven, periodic")
    for method, colour in COLOURS.items():
        named = {name: one for name, one in found["methods"].items() if name.startswith(method)}
        for (name, one), line in zip(reversed(named.items()), ("-", "--", ":")):
            left.plot(times, one["share"], line, color=colour, label=name)
        error = numpy.array([claims.mean_and_error(one["error"]) for one in named.values()]).T
        seconds = [one["seconds"] for one in named.values()]
        right.errorbar(seconds, *error, fmt="o-", color=colour, capsize=3, label=method)
        for name, x, y in zip(named, seconds, error[0]):
            right.annotate(name.split(", ")[-1], (x, y), (-8, -4), textcoords="offset points", fontsize=8, ha="right")
    left.set(ylim=(0.6, 1.1), xlabel="time / first mean time between collisions", ylabel="energy / Haff's law")
    right.set(xscale="log", xlabel="CPU seconds", ylabel="energy at 60 from event-driven [%]")
    right.margins(x=0.35)
    for axis in (left, right):
        axis.legend(fontsize=8)
        axis.grid(alpha=0.3)
    figure.savefig(os.path.join(HERE, "figure.png"), dpi=100)


def of_step(method):
    def value(one):
        step = one[method]
        return (step["step"], "at least" if step["cut"] else "") if step else (0.003, "none")
    return value


def of_cost(one):
    steps = [one[method] for method in METHODS]
    if not all(steps) or all(step["cut"] for step in steps):
        return numpy.nan, ""
    return (steps[0]["seconds"] / steps[1]["seconds"],
            "at most" if steps[0]["cut"] else "at least" if steps[1]["cut"] else "")


def of_events(one):
    step, seconds = one[METHODS[0]], one["events"]
    return (step["seconds"] / seconds, "at most" if step["cut"] else "") if step and seconds else (numpy.nan, "")


# Value of a point and its kind of mark; ticks of the axis.
PANELS = {
    "collisions of a disc until event-driven collapses": (
        lambda one: (one["collapse"], "") if one["collapse"] else (400, "none"),
        {20: "20", 50: "50", 100: "100", 400: "none"}),
    **{f"longest step of {method} /\nmean time between collisions": (
        of_step(method), {0.003: "none", **{x: x for x in (0.005, 0.02, 0.05, 0.2)}}) for method in METHODS},
    "CPU s at these steps, contact dynamics / springs": (of_cost, {x: x for x in (0.5, 1, 2, 4)}),
    "CPU s at these steps, contact dynamics / event-driven": (of_events, {x: x for x in (5, 10, 20, 40)})}


def draw_points(axis, points, value, shift, **look):
    """A mark per sample; a line through the means from one solid fraction to the next, if both have exact numbers
    only."""
    means = []
    for k, group in enumerate(points):
        found = [value(one) for one in group]
        means.append(numpy.nan if any(kind for _, kind in found) else numpy.mean([y for y, _ in found]))
        for j, (y, kind) in enumerate(found):  # Marks at the same place stand side by side.
            same = sum(other == (y, kind) for other in found[:j]) if kind == "none" else 0
            axis.plot(k + shift + 0.03 * same, y, MARKS[kind][0] if kind else "o", markersize=5 if kind else 3.5,
                      fillstyle="none" if kind else "full", **look)
    axis.plot(numpy.arange(len(means)) + shift, means, "-", linewidth=1, **look)


def draw_plane(found):
    fractions, restitutions = [*found["rates"]], sorted({name.split(", ")[1] for name in found["points"]})
    figure = Figure(figsize=(12, 7), layout="constrained")
    axes = figure.subplots(2, 3).ravel()
    colours = {e_n: colormaps["viridis"](k / len(restitutions)) for k, e_n in enumerate(restitutions)}
    for axis, (name, (value, ticks)) in zip(axes, PANELS.items()):
        for k, e_n in enumerate(restitutions):
            draw_points(axis, [found["points"][f"{fraction}, {e_n}"] for fraction in fractions], value, 0.14 * (k - 2),
                        color=colours[e_n])
        axis.set_title(name, fontsize=9)
        axis.set(yscale="log", xticks=range(len(fractions)), xticklabels=fractions, xlabel="solid fraction")
        axis.set_yticks([], minor=True)
        axis.set_yticks([*ticks], ticks.values())
        axis.grid(alpha=0.3)
    for e_n, colour in colours.items():
        axes[5].plot([], [], "o-", color=colour, markersize=3.5, label=f"restitution {e_n}")
    for mark, says in MARKS.values():
        axes[5].plot([], [], mark, color="k", fillstyle="none", label=says)
    axes[5].axis("off")
    axes[5].legend(loc="center")
    figure.savefig(os.path.join(HERE, "plane.png"), dpi=90)


def draw_shaken(found):
    """Mean displacement per cycle in squares, where discs are in most cycles."""
    found = found["runs"]
    figure = Figure(figsize=(1.7 * len(found), 7), layout="constrained")
    for axis, (name, one) in zip(figure.subplots(2, len(found) // 2, sharex=True, sharey=True).flat, found.items()):
        u, v = (numpy.array(one[key], float) for key in "uv")
        middle = 2 * numpy.arange(len(u)) + 1
        arrows = axis.quiver(*numpy.meshgrid(middle, middle), u.T, v.T, angles="xy", scale_units="xy", scale=0.15,
                             width=0.006)
        axis.quiverkey(arrows, 0.55, 0.94, 0.5, "0.5 d per cycle", labelpos="E", fontproperties={"size": 8})
        axis.set(title="wall friction {}, sample {}".format(*name.split(", ")), aspect="equal", xlim=(0, 2 * len(u)),
                 ylim=(0, 2 * len(u)))
    figure.supxlabel("x / d")
    figure.supylabel("y / d")
    figure.savefig(os.path.join(HERE, "shaken.png"), dpi=90)


def draw(found):
    draw_cooling(found["cooling"])
    draw_plane(found["plane"])
    draw_shaken(found["shaken"])
