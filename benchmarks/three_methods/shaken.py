# diptych: the convection roll of a shaken box, with and without friction at the side walls
# SPDX-License-Identifier: LGPL-2.1-or-later
import os

import h5py
import methods
import numpy
from matplotlib.figure import Figure
from methods import claims

SCENE = os.path.join(methods.HERE, "shaken.prm")
WIDTH, ROWS, COLUMNS = 24., 20, 22
PERIOD, REST, END = 4., 12., 140.  # The box rests first; END is that of the scene.
ACCELERATION = 3.                 # of the box, largest, in g
LAYER = 2.                        # width of the layer at a wall


def write_shaking(path):
    """Velocity of the box: at rest, then a sine."""
    time = numpy.arange(0, END - REST + PERIOD, PERIOD / 40)
    sine = ACCELERATION * PERIOD / (2 * numpy.pi) * numpy.sin(2 * numpy.pi * time / PERIOD)
    rows = numpy.vstack([(0, 0), numpy.column_stack([REST + time, sine])])
    numpy.savetxt(path, rows, delimiter=",", header="time,velocity", comments="", fmt="%.12g")
    return path


def write_grains(path, seed):
    """Discs in rows above the floor."""
    random, k = numpy.random.default_rng(seed), numpy.arange(ROWS * COLUMNS)
    place = numpy.column_stack([k % COLUMNS + 0.5, 1.25 * (k // COLUMNS) + 0.7]) * [WIDTH / COLUMNS, 1]
    place[:, 0] += random.uniform(-0.03, 0.03, len(k))
    numpy.savetxt(path, numpy.column_stack([place, random.uniform(0.4, 0.51, len(k))]), delimiter=",", header="x,y,r",
                  comments="", fmt="%.12g")
    return path


def cycles(result):
    """Places and displacements per cycle of the discs, (pairs, discs, 2) each. Waves on the surface repeat every second
    cycle, so pairs of cycles count. The first four cycles do not."""
    with h5py.File(os.path.join(result.folder, "discrete.h5"), "r") as file:
        stages = [file[name] for name in sorted(file) if name.startswith("stage_")]
        places = numpy.array([stage["grains/position"][:, :2] for stage in stages
                              if stage.attrs["time"] > REST + 3.99 * PERIOD])[::2]
    return places[:-1], 0.5 * numpy.diff(places, axis=0)


def roll(places, moved):
    """(mean, standard error over the pairs) of the rise per cycle at the walls less that elsewhere. Below 0: down at
    the walls, up in the middle."""
    at_wall = numpy.minimum(places[:, :, 0], WIDTH - places[:, :, 0]) < LAYER
    return claims.mean_and_error([dy[at].mean() - dy[~at].mean() for dy, at in zip(moved[:, :, 1], at_wall)])


def draw(found):
    """Mean displacement per cycle in squares of 2 d, where discs are in most cycles."""
    figure = Figure(figsize=(1.7 * len(found), 7), layout="constrained")
    axes = figure.subplots(2, len(found) // 2, sharex=True, sharey=True)
    edges = numpy.arange(0, WIDTH + 1, 2)
    middle = numpy.meshgrid(0.5 * (edges[1:] + edges[:-1]), 0.5 * (edges[1:] + edges[:-1]))
    for axis, ((friction, seed), (places, moved)) in zip(axes.flat, found.items()):
        number = numpy.histogram2d(*places.reshape(-1, 2).T, bins=(edges, edges))[0]
        number[number < 2 * len(places)] = numpy.nan
        u, v = (numpy.histogram2d(*places.reshape(-1, 2).T, weights=part, bins=(edges, edges))[0] / number
                for part in moved.reshape(-1, 2).T)
        arrows = axis.quiver(*middle, u.T, v.T, angles="xy", scale_units="xy", scale=0.15, width=0.006)
        axis.quiverkey(arrows, 0.55, 0.94, 0.5, "0.5 d per cycle", labelpos="E", fontproperties={"size": 8})
        axis.set(title=f"wall friction {friction:g}, sample {seed}", aspect="equal", xlim=(0, WIDTH), ylim=(0, WIDTH))
    figure.supxlabel("x / d")
    figure.supylabel("y / d")
    figure.savefig(os.path.join(methods.HERE, "shaken.png"), dpi=90)


def roll_of_the_box(options):
    """Prints the table. Returns whether friction at the side walls makes the discs sink there."""
    found = {}
    print("shaken box: rise per cycle within 2 d of the side walls less that elsewhere, in mean diameters")
    shaking = write_shaking(os.path.join(options.output, "shaking.csv"))
    drives = [f"discrete/drive_{wall}_y=velocity {shaking}" for wall in ("lower", "left", "right")]
    for friction in (0.8, 0.):
        for seed in options.shaken_seeds:
            grains = write_grains(os.path.join(options.output, f"shaken_{seed}.csv"), seed)
            result = claims.Runs(options, seed, options.output).run(
                f"shaken_{friction:g}_{seed}", "discrete", SCENE, f"sample/file={grains}", *drives,
                f"discrete/wall_friction={friction:g}")
            found[friction, seed] = cycles(result)
            mean, error = roll(*found[friction, seed])
            print(f"wall friction {friction:3g}, sample {seed}: {mean:7.3f} +- {error:.3f}, "
                  f"{methods.facts(result)['seconds']:.1f} CPU s", flush=True)
    draw(found)
    return all(mean + 2 * error < 0 for (friction, _), run in found.items() if friction for mean, error in [roll(*run)])
