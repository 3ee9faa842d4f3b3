# diptych: one sample of discs by three methods: event-driven, contact dynamics, springs
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Units: mean diameter, density of the discs, first temperature (kinetic energy of a disc, without spin)."""
import json
import math
import os
import subprocess
import sys

import h5py
import numpy
from scipy.optimize import brentq

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))
import claims  # noqa: E402
import stored  # noqa: E402, F401

SCENE = os.path.join(HERE, "gas.prm")
METHODS = "contact dynamics", "springs"


def write(path, head, rows):
    numpy.savetxt(path, rows, delimiter=",", header=head, comments="", fmt="%.17g")
    return path


class Sample:
    """Discs between platens at y = 0 and y = height, with a period along x. Columns: x, y, r, vx, vy, omega."""

    def __init__(self, columns, width, height):
        self.columns, self.width, self.height = columns, float(width), float(height)

    def events(self, options, *, platens=1, e_n=1, e_t=-1, friction=0, end=math.inf, collisions=math.inf, rows=0):
        """Run from collision to collision: time, energy, collisions, collapsed, CPU seconds, history, grains."""
        words = (self.width, self.height, platens, e_n, e_t, friction, end, collisions, rows)
        text = "\n".join(" ".join(map(repr, row)) for row in self.columns.tolist())
        done = subprocess.run([options.event_driven, *map(str, words)], input=text, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"three_methods.py: {done.stderr.strip()}")
        return {key: numpy.array(value) if isinstance(value, list) else value
                for key, value in json.loads(done.stdout).items()}

    def steps(self, options, name, duration, *settings):
        """Run of the program: energy and grains at the end, history, step, CPU seconds; None if it did not converge or
        grains went through each other."""
        path = write(os.path.join(options.output, name + ".csv"), "x,y,r,vx,vy,omega", self.columns)
        try:
            result = claims.Runs(options, 1, options.output).run(
                name, "discrete", SCENE, f"sample/file={path}", f"sample/width={self.width!r}", "sample/lower_platen=0",
                f"sample/upper_platen={self.height!r}", f"loading/duration={duration!r}",
                f"loading/stage_time={duration!r}", *settings)
        except claims.RunFailed as failure:
            if "exit code 3" not in str(failure):
                raise
            return None
        return facts(result)

    def nscd(self, options, name, duration, *, step, e_n, extra=()):
        return self.steps(options, f"{name}_h_{step:.3g}", duration, f"discrete/step={step!r}",
                          f"discrete/normal_restitution={e_n!r}", *extra)

    def springs(self, options, name, duration, *, contact, e_n):
        """Springs whose undamped contact of two discs of diameter 1 lasts `contact`."""
        stiffness = 0.125 * math.pi * (math.pi / contact) ** 2
        return self.steps(options, f"{name}_tc_{contact:.3g}", duration, "discrete/method=penalty",
                          f"discrete/penalty_stiffness={stiffness!r}", f"discrete/penalty_damping={damping_of(e_n)!r}")

    def thermal(self, options, seed):
        """This sample with random velocities of the temperature 1, after 20 elastic collisions of each disc."""
        count = len(self.columns)
        velocity = numpy.random.default_rng(seed).normal(size=(count, 2))
        self.columns[:, 3:5] = velocity - velocity.mean(axis=0)
        self.columns = self.events(options, collisions=10 * count)["grains"]
        mass, velocity = math.pi * self.columns[:, 2] ** 2, self.columns[:, 3:5]
        velocity[:, 0] -= mass @ velocity[:, 0] / mass.sum()
        velocity *= math.sqrt(count / (0.5 * mass @ (velocity ** 2).sum(axis=1)))
        return self


def facts(result):
    """Numbers of a run of the program."""
    with h5py.File(os.path.join(result.folder, "discrete.h5"), "r") as file:
        last = file[max(name for name in file if name.startswith("stage_"))]["grains"]
        grains = numpy.column_stack([last[name][:] for name in ("position", "radius", "velocity", "spin")])
    rows = result.grains
    return {"energy": rows["kinetic_energy"][-1], "grains": numpy.delete(grains, (2, 6), axis=1),
            "history": numpy.column_stack([rows["time"], rows["kinetic_energy"]]),
            "step": result.provenance["discrete"]["step"], "seconds": result.seconds("discrete")}


def damping_of(e_n):
    """Damping ratio of a dashpot whose contact ends when its force is zero (Schwager & Poeschel 2007): with the ratio
    sin a the restitution is exp(-(pi - 2 a) tan a)."""
    return math.sin(brentq(lambda a: math.exp((2 * a - math.pi) * math.tan(a)) - e_n, 0, 1.57, xtol=1e-15))


def equal_discs(count, solid_fraction):
    """Discs of diameter 1 in rows in a square."""
    side, per_row = math.sqrt(0.25 * math.pi * count / solid_fraction), math.ceil(math.sqrt(count))
    place = (numpy.arange(count)[:, None] // [1, per_row] % per_row + 0.5) * side / per_row
    return Sample(numpy.column_stack([place, numpy.full(count, 0.5), numpy.zeros((count, 3))]), side, side)


def shrunk(dense, solid_fraction):
    """The discs of a prepared sample at the same places, smaller."""
    prepared = dense.prepared
    width, height = prepared["cell_width"], prepared["upper_y"] - prepared["lower_y"]
    position, radius = prepared["position"][:, :2] - [0, prepared["lower_y"]], prepared["radius"]
    factor = math.sqrt(solid_fraction * width * height / (math.pi * (radius ** 2).sum()))
    if factor >= 1:
        sys.exit(f"three_methods.py: the dense sample jams below a solid fraction of {solid_fraction}")
    scale = 1 / (2 * factor * radius.mean())
    columns = numpy.column_stack([position * scale, factor * scale * radius, numpy.zeros((len(radius), 3))])
    return Sample(columns, width * scale, height * scale)
