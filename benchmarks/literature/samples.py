# diptych: samples of the literature, and what is measured on them
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Each function returns the runs or the number of one seed. A run is made once and shared by all claims.
Dimensionless: mean diameter 1, pressure 1 (collapse: gravity 1), grain density 1."""
import argparse
import functools
import os
import sys

import diptych
import numpy
from scipy.optimize import minimize_scalar
from scipy.stats import lognorm

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.dirname(HERE), os.path.join(HERE, "../plane_shear")]
import claims  # noqa: E402
import plane_shear  # noqa: E402

OPTIONS = argparse.Namespace()  # of the command line
CARRIES = 1e-4  # Least normal force of a contact that counts, over the mean.
DILUTE = "sample/box_solid_fraction=0.5"  # A dense box could hold what friction would not.


def at_rest(*settings):
    """Settings of a loading that is as short as it may be: only the prepared sample counts."""
    return "loading/axial_strain=1e-6", "loading/stage_strain=1e-6", "comparison/window_edges=0,1e-6", *settings


def in_time(*stages):
    return ("loading/mode=time", f"loading/duration={stages[-1]}", f"loading/stages={', '.join(map(str, stages))}",
            f"comparison/window_edges=0,{stages[-1]}")


@functools.lru_cache(maxsize=None)
def run(seed, name, *settings, scene="scene.prm"):
    """Result of `diptych discrete`: claims.Result."""
    runs = claims.Runs(OPTIONS, seed, os.path.join(OPTIONS.output, f"seed_{seed}"))
    result = runs.run(name, "discrete", os.path.join(HERE, scene), *settings)
    result.snapshots = diptych.load(result.folder).discrete.snapshots
    return result


def table(name, radii, numbers):
    """Setting of a mixture: so many discs (shares) of these radii. Its grading curve is a file of the results."""
    path = os.path.join(OPTIONS.output, name + ".csv")
    mass = numpy.cumsum(numpy.multiply(numbers, numpy.square(radii)))
    rows = [(r * end, m / mass[-1]) for r, low, high in zip(radii, numpy.append(0, mass), mass)
            for end, m in ((0.9999, low), (1.0001, high))]
    os.makedirs(OPTIONS.output, exist_ok=True)
    numpy.savetxt(path, rows, "%.8g", ",", header="radius,passing", comments="")
    return "sample/radius_distribution=table", "sample/radius_table=" + path


def uniform(low, high):
    """Setting of radii that are uniform by number, rescaled to the mean diameter 1."""
    return f"sample/radius_min={low / (low + high):.8f}", f"sample/radius_max={1 - low / (low + high):.8f}"


def forces(snapshot):
    """(normal force, |tangential force|, i, j, direction of the normal) of the contacts that carry a force."""
    c = snapshot.contacts
    normal = numpy.einsum("ij,ij->i", c.force, c.normal)
    tangential = abs(c.force[:, 1] * c.normal[:, 0] - c.force[:, 0] * c.normal[:, 1])
    angle = numpy.arctan2(c.normal[:, 1], c.normal[:, 0])
    carries = normal > CARRIES * normal[normal > 0].mean()
    return [numpy.asarray(part)[carries] for part in (normal, tangential, c.i, c.j, angle)]


def coordination(snapshot):
    """Contacts per grain that carries a force, of grains beyond two d from platens and walls."""
    i, j = forces(snapshot)[2:4]
    n = len(snapshot.radius)
    count = numpy.bincount(i, minlength=n) + numpy.bincount(j[j < n], minlength=n)
    x, y = snapshot.position.T
    inside = (abs(y - (snapshot.lower_y + snapshot.upper_y) / 2) < (snapshot.upper_y - snapshot.lower_y) / 2 - 2)
    return count[(count > 0) & inside & (x > x.min() + 2) & (x < x.max() - 2)].mean()


def solid_fraction(snapshot):
    return numpy.pi * (snapshot.radius ** 2).sum() / snapshot.area


# Radjai et al. 1996. The base moves at 0.025 for 95 units of time and stops at 100.
RADJAI = {"A": (500, lambda: uniform(3.8, 7.5)), "B": (1200, lambda: uniform(3.8, 7.5)),
          "C": (4025, lambda: uniform(1.5, 7.5)),
          "D": (1024, lambda: table("radjai_D", (0.65, 1.05, 1.6), (512, 320, 192)))}


def radjai(seed, sample):
    """Sheared, then relaxed sample. The lid carries about the pressure."""
    grains, radii = RADJAI[sample]
    return run(seed, "radjai_" + sample, f"sample/grains={grains}", *radii(), *in_time(160),
               "sample/preparation_friction=0.2", "sample/width_over_height=1", "discrete/friction=0.2",
               "discrete/platen_friction=0.5", "discrete/wall_friction=0", "discrete/lateral=rigid_walls",
               "discrete/side_motion=velocity", f"discrete/drive_lower_x=velocity {os.path.join(HERE, 'base.csv')}",
               f"discrete/drive_upper_y=force {-grains ** 0.5:.4f}", "discrete/step=0.2",
               "discrete/tolerance=1e-4").snapshots[-1]


def pooled(seed):
    """(N/<N>, T/<T>, T/(mu N)) of the relaxed samples together."""
    parts = [forces(radjai(seed, sample))[:2] for sample in RADJAI]
    return [numpy.concatenate(part) for part in zip(*((n / n.mean(), t / t.mean(), t / (0.2 * n)) for n, t in parts))]


def weak_share(seed, sample):
    """Share of the contacts below the mean force."""
    normal = forces(radjai(seed, sample))[0]
    return (normal < normal.mean()).mean()


def power(values, low=0.01):
    """Exponent a of a density ~ x^a over low < x < 1, by largest likelihood."""
    logs = numpy.log(values[(values > low) & (values < 1)]).mean()
    return minimize_scalar(lambda a: numpy.log((1 - low ** (a + 1)) / (a + 1)) - a * logs, bounds=(-0.99, 3),
                           method="bounded").x


def decay(values):
    """Rate b of a density ~ exp(-b x) over x > 1, by largest likelihood."""
    return 1 / (values[values > 1] - 1).mean()


# CEGEO 2012: the biaxial test between smooth walls.
def biaxial(seed, name="large", *settings):
    return run(seed, "biaxial_" + name, "sample/radius_distribution=uniform_by_mass", "sample/radius_min=0.25",
               "sample/radius_max=0.75", "discrete/friction=0.5", "discrete/platen_friction=0",
               "discrete/wall_friction=0", "discrete/lateral=rigid_walls", "discrete/side_motion=pressure",
               "loading/horizontal_over_vertical=0", "loading/inertial_number=1e-3", "discrete/accuracy=0.05",
               *(settings or ("sample/grains=2000", "loading/axial_strain=0.15", "loading/stage_strain=0.01",
                              "sample/preparation_tolerance=1e-5", "sample/quiet_unbalanced_force=0.005")))


def springs_over_rigid(seed):
    """Ratio of T/S from 0.5 to 4 % of strain, on the same 1000 discs."""
    def ratio(name, *settings):
        rows = biaxial(seed, name, "sample/grains=1000", "loading/axial_strain=0.04", *settings).grains
        late = rows["axial_strain"] > 0.005
        t = numpy.hypot(rows["syy"] - rows["sxx"], rows["sxy"] + rows["syx"])[late]
        return t.mean() / (rows["syy"] + rows["sxx"])[late].mean()

    return ratio("springs", "discrete/method=penalty", "discrete/penalty_stiffness=2000") / ratio("rigid")


# Unger et al. 2005: the forces of one packing, solved again from random starts.
FRICTIONS = (0., 0.01, 0.1, 0.3, 1.)
STARTS = 3
SWEEPS = 300_000, 3_000_000  # At most, of a solution.


def unger(seed, friction):
    keys = ("sample/preparation_friction", "discrete/friction", "discrete/platen_friction")
    return run(seed, f"unger_{friction:g}", *uniform(1, 2), "sample/width=14", "sample/height=14",
               "sample/box_solid_fraction=0.6", "discrete/lateral=periodic", "discrete/side_motion=velocity",
               "discrete/drive_upper_y=force -14", "discrete/step=0.2", "discrete/tolerance=1e-6",
               "discrete/max_sweeps=100000", "discrete/store_problems=true", *in_time(20),
               *(f"{key}={friction:g}" for key in keys))


@functools.lru_cache(maxsize=None)
def ambiguity(seed, friction):
    """Scatter of the force of a contact over the starts (rms over contacts), over the mean force; after SWEEPS."""
    problem = os.path.join(unger(seed, friction).folder, "problem_0001.h5")
    random = numpy.random.default_rng(seed)
    first, found, scatter = diptych.solve(problem, tolerance=1e-6).r[:, 0], [], []
    for _ in range(STARTS):
        normal = random.exponential(first.mean(), len(first))
        found.append(numpy.stack([normal, friction * normal * random.uniform(-1, 1, len(first))], axis=1))
    for sweeps in numpy.diff(SWEEPS, prepend=0):
        found = [diptych.solve(problem, tolerance=1e-10, guess=one, max_sweeps=sweeps).r for one in found]
        scatter.append(numpy.sqrt(numpy.var(found, axis=0, ddof=1).sum(axis=1).mean())
                       / numpy.linalg.norm(found, axis=2).mean())
    return scatter


def indeterminacy(seed):
    """(2 contacts - 3 grains) / contacts of a frictionless packing, grains that carry a force."""
    snapshot = unger(seed, 0.).snapshots[1]
    i, j = forces(snapshot)[2:4]
    return 2 - 3 * len(numpy.unique(numpy.append(i, j[j < len(snapshot.radius)]))) / len(i)


# Cells under a pressure, and packings without friction.
def cell(seed, name, *settings):
    return run(seed, name, "sample/grains=1000", "sample/width_over_height=1", "loading/mode=path",
               "loading/path=drained", "discrete/lateral=cell", DILUTE, *at_rest(*settings)).snapshots[0]


def shaebani(seed, *settings):
    return cell(seed, "shaebani" + "".join("_" + s.replace("/", "_") for s in settings), *uniform(0.8, 1.2),
                "sample/preparation_friction=0.5", *settings)


def stress(seed):
    """Mean stress (2, 2), compression positive."""
    return numpy.asarray(shaebani(seed).internal_moment).sum(axis=0) / shaebani(seed).area


def harmonic(seed, k):
    """Twice the mean of cos(k angle) of the contact normals: the k-th coefficient of their distribution."""
    return 2 * numpy.cos(k * forces(shaebani(seed))[4]).mean()


def two_sizes(ratio, share=0.5):
    """share: of the number of discs that are large."""
    return lambda: table(f"two_{ratio:g}_{share:g}", (1, ratio), (1 - share, share))


MIXTURES = {"two sizes 1:1.4": two_sizes(1.4), "uniform 3:7": lambda: uniform(3, 7),
            "uniform 1:4": lambda: uniform(1, 4),
            "log-normal 0.5": lambda: table("log", lognorm.ppf((numpy.arange(200) + 0.5) / 200, 0.5), numpy.ones(200)),
            "two sizes 1:3, 10 % large": two_sizes(3, 0.1), "two sizes 1:1.1": two_sizes(1.1),
            "two sizes 1:2": two_sizes(2), "two sizes 1:1.4, 10 % large": two_sizes(1.4, 0.1),
            "two sizes 1:3": two_sizes(3)}
OTHERS = "two sizes 1:1.1", "two sizes 1:2", "two sizes 1:1.4, 10 % large"  # Neighbours of 1:1.4 in equal numbers.


def packing(seed, mixture):
    return cell(seed, "packing_" + "".join(c if c.isalnum() else "_" for c in mixture), *MIXTURES[mixture]())


def close(seed, mixture="two sizes 1:1.4"):
    return solid_fraction(packing(seed, mixture))


def slab(seed, height):
    """A packing between two smooth platens, periodic along them."""
    return run(seed, f"slab_{height}", f"sample/height={height}", "sample/width=40", *two_sizes(1.4)(),
               "discrete/platen_friction=0", "discrete/friction=0", "discrete/lateral=periodic",
               "discrete/side_motion=velocity", "loading/horizontal_over_vertical=0", DILUTE, *at_rest()).snapshots[0]


def between_walls(seed, height):
    """(height, solid fraction) of a slab."""
    snapshot = slab(seed, height)
    high = snapshot.upper_y - snapshot.lower_y
    return high, numpy.pi * (snapshot.radius ** 2).sum() / snapshot.cell_width / high


def wall_deficit(seed, height):
    """C of solid fraction = bulk - C/height."""
    high, fraction = between_walls(seed, height)
    return (close(seed) - fraction) * high


def deep_share(seed):
    """Share of the deficit of solid fraction that lies deeper than two small diameters from either platen."""
    snapshot = slab(seed, 24)
    depth = numpy.linspace(0, (snapshot.upper_y - snapshot.lower_y) / 2, 400)
    covered = [[plane_shear.covered_share(snapshot.position[:, 1], snapshot.radius, y, snapshot.cell_width)
                for y in (snapshot.lower_y + z, snapshot.upper_y - z)] for z in depth]
    deficit = close(seed) - numpy.mean(covered, axis=1)
    return deficit[depth > 4 * snapshot.radius.min()].sum() / deficit.sum()


def strength(seed, inertial):
    """Shear over normal force on the platen without friction, at shear strains of 0.12 to 0.6."""
    rows = run(seed, f"strength_{inertial:g}", "discrete/friction=0", "discrete/platen_friction=0",
               "discrete/accuracy=0.05", "sample/grains=400", "loading/axial_strain=0.6",
               f"loading/inertial_number={inertial / plane_shear.DISC:.6g}", "loading/stage_strain=0.3",
               scene="../plane_shear/scene.prm").grains
    late = rows["shear_strain"] > 0.12
    return -rows["upper_fx"][late].mean() / rows["upper_fy"][late].mean()


# Collapse of a column, which is made between smooth walls.
COLUMNS = (3, 5, 8)  # Height over half width.
HALF = 10  # Half width [mean diameters].


def profile(seed, aspect):
    """(place, height) of the deposit: area of the discs over a solid fraction of 0.8, mean over 3 d, in steps of d."""
    column = biaxial(seed, f"column_{aspect}", f"sample/width={2 * HALF}", f"sample/height={HALF * aspect}", *at_rest())
    first, last = run(seed, f"collapse_{aspect}", f"sample/file={column.folder}/discrete.h5",
                      *in_time(round(7 * (HALF * aspect) ** 0.5)), "discrete/friction=0.5",
                      "discrete/platen_friction=0.5", "discrete/platen_rolling_friction=1",
                      "discrete/lateral=none", "discrete/gravity_y=-1").snapshots
    x = last.position[:, 0] - first.position[:, 0].mean()
    edges = numpy.arange(numpy.floor(x.min()) - 3, numpy.ceil(x.max()) + 4)
    height = numpy.histogram(x, edges, weights=numpy.pi * last.radius ** 2)[0] / 0.8
    return edges[1:-2] + 0.5, numpy.convolve(height, numpy.ones(3) / 3, "valid")


def run_out(seed, aspect):
    """(front - half width) / half width, mean of the sides; a front is the first place from the top lower than d."""
    height = profile(seed, aspect)[1]
    low, top = numpy.flatnonzero(height < 1), height.argmax()
    return (low[low > top].min() - low[low < top].max() - 1) / (2 * HALF) - 1


def final_height(seed, aspect):
    return profile(seed, aspect)[1].max() / HALF


def exponent(seed, measure):
    return numpy.polyfit(numpy.log(COLUMNS), [numpy.log(measure(seed, a)) for a in COLUMNS], 1)[0]
