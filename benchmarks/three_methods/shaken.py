# diptych: the convection roll of a shaken box, with and without friction at the side walls
# SPDX-License-Identifier: LGPL-2.1-or-later
import os

import h5py
import methods
import numpy
from methods import claims, stored

WIDTH, ROWS, COLUMNS = 24., 20, 22
PERIOD, REST, END = 4., 12., 140.  # The box rests first; END is that of the scene.
ACCELERATION = 3.                 # of the box, largest, in g
LAYER, SQUARE = 2., 2.            # width of the layer at a wall, and of the squares of the figure


def write_shaking(path):
    """Velocity of the box: at rest, then a sine."""
    time = numpy.arange(0, END - REST + PERIOD, PERIOD / 40)
    sine = ACCELERATION * PERIOD / (2 * numpy.pi) * numpy.sin(2 * numpy.pi * time / PERIOD)
    return methods.write(path, "time,velocity", [(0, 0), *zip(REST + time, sine)])


def write_grains(path, seed):
    """Discs in rows above the floor."""
    random, k = numpy.random.default_rng(seed), numpy.arange(ROWS * COLUMNS)
    place = numpy.column_stack([k % COLUMNS + 0.5, 1.25 * (k // COLUMNS) + 0.7]) * [WIDTH / COLUMNS, 1]
    place[:, 0] += random.uniform(-0.03, 0.03, len(k))
    return methods.write(path, "x,y,r", numpy.column_stack([place, random.uniform(0.4, 0.51, len(k))]))


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


def means(places, moved):
    """Mean displacement per cycle in squares; NaN where discs are seldom."""
    edges, places = numpy.arange(0, WIDTH + 1, SQUARE), places.reshape(-1, 2)
    number = numpy.histogram2d(*places.T, bins=(edges, edges))[0]
    number[number < 2 * len(moved)] = numpy.nan
    return [numpy.histogram2d(*places.T, weights=part, bins=(edges, edges))[0] / number
            for part in moved.reshape(-1, 2).T]


def measure(options):
    """Of each "wall friction, sample": roll, CPU seconds, mean displacements."""
    found = {}
    shaking = write_shaking(os.path.join(options.output, "shaking.csv"))
    drives = [f"discrete/drive_{wall}_y=velocity {shaking}" for wall in ("lower", "left", "right")]
    for friction in (0.8, 0.):
        for seed in (1, 2, 3):
            grains = write_grains(os.path.join(options.output, f"shaken_{seed}.csv"), seed)
            result = claims.Runs(options, seed, options.output).run(
                f"shaken_{friction:g}_{seed}", "discrete", os.path.join(methods.HERE, "shaken.prm"),
                f"sample/file={grains}", *drives, f"discrete/wall_friction={friction:g}")
            run = cycles(result)
            u, v = means(*run)
            found[f"{friction:g}, {seed}"] = {"roll": roll(*run), "seconds": result.seconds("discrete"), "u": u, "v": v}
    return {"runs": found}


def rises(found):
    """Discs must sink at side walls with friction."""
    return [f"shaken box, {name}: discs do not sink at the walls" for name, one in found["runs"].items()
            if not name.startswith("0,") and one["roll"][0] + 2 * one["roll"][1] > 0]


def tables(found):
    rows = {}
    for name, one in found["runs"].items():
        rows.setdefault(name.split(", ")[0], []).append("{:.3f} +- {:.3f} d".format(*one["roll"]))
    return {"shaken": stored.table("wall friction | sample 1 | sample 2 | sample 3",
                                   [(mu, *row) for mu, row in rows.items()])}
