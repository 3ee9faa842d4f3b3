#!/usr/bin/env python3
# diptych: the order at which strength and dilation converge with the time step
# SPDX-License-Identifier: LGPL-2.1-or-later
"""order.py [PROGRAM --output DIR [--cases dense,slow,oblique] [--jobs 1]] [--figure FILE]

Prints and draws the results stored in order.csv. With PROGRAM it first makes the runs (80 minutes of CPU time for the
loadings; those in DIR are kept) and stores them again. Needs h5py, numpy, pandas and scipy, the figure matplotlib, the
runs of LAMMPS lmp."""
import argparse
import concurrent.futures
import functools
import json
import os
import subprocess
import sys

import numpy
import pandas
from scipy.stats import t as student

import lammps
import rigid_limit

HERE = os.path.dirname(os.path.abspath(__file__))
STORED = os.path.join(HERE, "order.csv")
STEPS = (0.4, 0.1, 0.025)
ACCURACIES = tuple(f"accuracy={a:g}" for a in (0.05, 0.02, 0.01, 0.005))
SPRINGS = {"penalty=1e4": "penalty, kn/P = 1e4", "penalty=1e5": "penalty, 1e5", "lammps=1e4": "LAMMPS, 1e4",
           "lammps=1e5": "LAMMPS, 1e5"}
RESTITUTION = ("e_n=0.5", "e_n=0.8")
# implicit springs of kn/P = 1e4, over the step
COMPLIANT = tuple(f"compliant={h:g}" for h in (0.4, 0.2, 0.1, 0.05, 0.025))
DENSE = (rigid_limit.SCENE, "loading/axial_strain=0.04")
OBLIQUE = (os.path.join(HERE, "../moreau_quick/scene.prm"), "loading/axial_strain=0.03")


class Case:
    """A loading: inertial number, seeds, scene with its settings, discrete/accuracy of the runs with a given step, more
    points."""

    def __init__(self, inertial, seeds, scene, tight, *, steps=STEPS, more=()):
        self.inertial, self.seeds, self.scene, self.tight, self.steps = inertial, seeds, scene, tight, steps
        self.points = [*(f"h={h:g}" for h in steps), *ACCURACIES, *more]
        self.end = float(scene[1].split("=")[1])


CASES = {"dense": Case(1.13e-3, range(11, 51), DENSE, 0.008, steps=(*STEPS, 0.00625, 0.0015625),
                       more=(*SPRINGS, *RESTITUTION, *COMPLIANT)),
         "slow": Case(1.13e-4, range(11, 51), DENSE, 0.02),
         "oblique": Case(1e-3, range(1, 41), OBLIQUE, 0.008)}


def seeds_of(case, point):
    """Restitution and implicit springs are measured on the first twelve samples."""
    return case.seeds[:12] if point in (*RESTITUTION, *COMPLIANT) else case.seeds


def settings(case, point):
    name, _, value = point.partition("=")
    value, _, knob = value.partition("/")
    fixed = [f"discrete/accuracy={case.tight:g}"]  # tolerance x step / I = 0.02, or 0.05 in slow flow
    return {"h": [f"discrete/step={value}", *fixed], "accuracy": [f"discrete/accuracy={value}"],
            "e_n": ["discrete/step=0.025", *fixed, f"discrete/normal_restitution={value}"],
            "compliant": ["discrete/method=compliant", "discrete/penalty_stiffness=1e4", f"discrete/step={value}",
                          *fixed],
            "implicit": ["discrete/method=compliant", f"discrete/penalty_stiffness={value}",
                         f"discrete/accuracy={knob}"],
            "penalty": ["discrete/method=penalty", f"discrete/penalty_stiffness={value}",
                        f"discrete/penalty_step_fraction={knob or 0.2}"]}[name]


def spring_knobs(point):
    """(kn/P, step over sqrt(m_min/kn)) of a point of springs; the default step is 0.2."""
    stiffness, _, fraction = point.partition("=")[2].partition("/")
    return float(stiffness), float(fraction or 0.2)


@functools.cache
def sample(program, output, seed):
    """File of a prepared dense sample: a stored one, or one that this program prepares."""
    path = rigid_limit.sample_file(seed)
    if not os.path.exists(path):
        folder = os.path.join(output, "samples")
        path = os.path.join(folder, f"seed_{seed}.h5")
        if not os.path.exists(path):
            subprocess.run([sys.executable, "-B", os.path.join(HERE, "samples.py"), program, folder, str(seed)],
                           check=True)
    return path


def load(options, name, point, seed):
    """Row of order.csv: one run."""
    case, folder = CASES[name], os.path.join(options.output, name, point, f"seed_{seed}")
    row = {"case": name, "point": point, "seed": seed}
    if point.startswith("lammps"):
        done = os.path.join(folder, "binned.json")
        if not os.path.exists(done):
            stiffness, fraction = spring_knobs(point)
            columns, seconds = lammps.run(sample(options.program, options.output, seed), folder, stiffness,
                                          case.inertial, case.end, fraction=fraction)
            with open(done, "w") as file:
                json.dump({"columns": {n: v.tolist() for n, v in rigid_limit.binned(columns).items()},
                           "seconds": seconds}, file)
        with open(done) as file:
            found = json.load(file)
        columns = {n: numpy.array(v) for n, v in found["columns"].items()}
        return row | means(columns, case.end) | {"cpu_s": found["seconds"]}
    runs = rigid_limit.claims.Runs(argparse.Namespace(program=options.program, reuse=True, set=[]), seed,
                                   os.path.dirname(folder))
    source = [f"sample/file={sample(options.program, options.output, seed)}"] if case.scene is DENSE else []
    result = runs.run(os.path.basename(folder), "discrete", case.scene[0], f"loading/inertial_number={case.inertial:g}",
                      case.scene[1],
                      "loading/stage_strain=0.01", f"comparison/window_edges=0,{case.end:g}", *source,
                      *settings(case, point))
    columns = result.grains
    columns |= {"t": numpy.hypot(columns["syy"] - columns["sxx"], columns["sxy"] + columns["syx"]) / 2,
                "s": (columns["sxx"] + columns["syy"]) / 2}
    return row | means(columns, case.end) | {"step": result.provenance["discrete"]["step"],
                                             "cpu_s": result.seconds("discrete")}


def means(columns, end):
    """T/S from 0.5 % strain on, dilation at the end, share of impacts in the dissipation in between."""
    strain = columns["axial_strain"]
    late = (strain > 0.005 + 1e-9) & (strain <= end + 1e-9)
    found = {"strength": columns["t"][late].mean() / columns["s"][late].mean(),
             "dilation": -numpy.interp(end, strain, columns["volumetric_strain"])}
    if "friction_dissipation" in columns and not numpy.isnan(columns["friction_dissipation"]).any():
        friction, impacts = (numpy.ptp(columns[n][late][[0, -1]])
                             for n in ("friction_dissipation", "impact_dissipation"))
        found["impact_share"] = impacts / (impacts + friction)
    return found


def wide(table, name, quantity, points):
    """Values of complete samples: one row a sample, one column a point."""
    part = table[(table.case == name) & table.point.isin(points)]
    return part.pivot(index="seed", columns="point", values=quantity)[list(points)].dropna()


class Fit:
    """Fits a (1 + b h^p) to the mean over samples by least squares, weighted by the covariance of the mean. p: best
    value and ends of the 95 % interval, on a grid from 0.05 to 2."""

    def __init__(self, values, steps):
        self.h, self.mean, self.n = numpy.array(steps), values.mean().to_numpy(), len(values)
        self.weight = numpy.linalg.inv(numpy.cov(values.T) / self.n)
        grid = numpy.arange(0.05, 2.001, 0.01)
        misfit = numpy.array([self.at(p)[0] for p in grid])
        inside = grid[misfit <= misfit.min() + student.ppf(0.975, self.n - 1) ** 2]
        self.p = grid[misfit.argmin()], inside[0], inside[-1]
        self.misfit = {p: self.at(p)[0] for p in (self.p[0], 0.5, 1)}

    def limit_weights(self):
        """Weights of the steps whose sum gives a for p = 1/2, for the mean or for one sample."""
        shape = numpy.stack([numpy.ones_like(self.h), self.h ** 0.5], 1)
        return (numpy.linalg.inv(shape.T @ self.weight @ shape) @ shape.T @ self.weight)[0]

    def interval_of_p(self):
        """As text; an end of the grid is no bound."""
        low, high = ("" if end in (0.05, 2) else f"{end:.2f}" for end in numpy.round(self.p[1:], 2))
        return f"p in [{low}, {high}]" if low and high else f"p below {high}" if high else "p unknown"

    def at(self, p):
        """(chi^2, a, b, standard errors of a and b)."""
        shape = numpy.stack([numpy.ones_like(self.h), self.h ** p], 1)
        covariance = numpy.linalg.inv(shape.T @ self.weight @ shape)
        a, c = covariance @ shape.T @ self.weight @ self.mean
        rest, slope = self.mean - shape @ [a, c], numpy.array([-c / a ** 2, 1 / a])
        return rest @ self.weight @ rest, a, c / a, covariance[0, 0] ** 0.5, (slope @ covariance @ slope) ** 0.5


def paired(table, name, quantity, point, other):
    """Mean of `point` minus `other` with its standard error, over samples that have both."""
    values = wide(table, name, quantity, [point, other])
    return rigid_limit.claims.mean_and_error((values[point] - values[other]).to_numpy())


def against_limit(table, name, quantity, point):
    """Mean of `point` relative to the limit of short steps at p = 1/2, with its standard error: on each sample the
    limit is the weighted sum of the runs with a given step whose mean is a."""
    case = CASES[name]
    steps = [f"h={h:g}" for h in case.steps]
    weights = Fit(wide(table, name, quantity, steps), case.steps).limit_weights()
    values = wide(table, name, quantity, [*steps, *([] if point in steps else [point])])
    limit = values[steps].to_numpy() @ weights
    mean, error = rigid_limit.claims.mean_and_error(values[point].to_numpy() - limit)
    return mean / limit.mean(), error / limit.mean()


def show(table):
    for name, case in CASES.items():
        print(f"\n{name}, I = {case.inertial:g}: mean over samples; difference from the limit of short steps (p = 1/2) "
              "+- standard error")
        for quantity in ("strength", "dilation"):
            fit = Fit(wide(table, name, quantity, [f"h={h:g}" for h in case.steps]), case.steps)
            chi, a, b, a_error, b_error = fit.at(0.5)
            print(f"  {quantity}, {fit.n} samples: p = {fit.p[0]:.2f} [{fit.p[1]:.2f}, {fit.p[2]:.2f}]; p = 1/2: a = "
                  f"{a:.5f} +- {a_error:.5f}, "
                  f"b = {b:.2%} +- {b_error:.2%}; chi^2 of {len(fit.h) - 3}: "
                  + ", ".join(f"{c:.1f} (p = {p:.2g})" for p, c in fit.misfit.items()))
        for point in case.points:
            rows = table[(table.case == name) & (table.point == point)]
            if len(rows):
                texts = ["{:+.2%} +- {:.2%}".format(*against_limit(table, name, q, point))
                         for q in ("strength", "dilation")]
                print(f"  {point:14} n {len(rows):2}  CPU s {rows.cpu_s.mean():6.2f}  T/S {rows.strength.mean():.4f} "
                      f"({texts[0]})  dilation "
                      f"{rows.dilation.mean():.5f} ({texts[1]})  impacts {rows.impact_share.mean():.1%}")
    for one, other in (("penalty=1e5", "penalty=1e4"), ("lammps=1e5", "lammps=1e4"),
                       *((e, "h=0.025") for e in RESTITUTION)):
        print(f"{one} - {other}: T/S " + "{:+.5f} +- {:.5f}".format(*paired(table, "dense", "strength", one, other)))


def draw(table, path):
    """Strength and dilation over the step with both fits; bias over the share of impacts."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(1, 3, figsize=(13, 4.2), constrained_layout=True)
    h = numpy.linspace(0, 0.42, 400)
    for (name, case), colour, shift in zip(CASES.items(), ("#0072B2", "#D55E00", "#007A5E"), (0, 0.004, -0.004)):
        steps = [f"h={h:g}" for h in case.steps]
        for axis, quantity in zip(axes, ("strength", "dilation")):
            fit = Fit(wide(table, name, quantity, steps), case.steps)
            _, a, b, a_error, _ = fit.at(0.5)
            found = [against_limit(table, name, quantity, point) for point in steps]
            axis.errorbar(fit.h ** 0.5 + shift, [100 * m for m, _ in found], [100 * e for _, e in found], fmt="o",
                          color=colour, capsize=3,
                          label=f"{name}, I = {case.inertial:g}, {fit.n} samples: {fit.interval_of_p()}")
            axis.plot(h ** 0.5, 100 * b * h ** 0.5, "-", color=colour, linewidth=1)
            axis.set(xlabel=r"root of the step, $\sqrt{h\,/\,(d\sqrt{\rho/P})}$",
                     ylabel=f"{quantity} against the limit (%)")
            for k, point in enumerate(SPRINGS if name == "dense" else ()):
                mean, error = against_limit(table, name, quantity, point)
                axis.errorbar(-0.025 - 0.02 * k, 100 * mean, 100 * error, fmt="s^"[k // 2], color="#777777", capsize=3,
                              markersize=4,
                              markerfacecolor="white" if k % 2 == 0 else None,
                              label=SPRINGS[point] if quantity == "strength" else None)
        bias = [(100 * table[(table.case == name) & (table.point == p)].impact_share.mean(),
                 100 * against_limit(table, name, "strength", p)[0])
                for p in (*steps, *ACCURACIES) if len(table[(table.case == name) & (table.point == p)])]
        n = len(steps)
        axes[2].plot(*zip(*bias[:n]), "o", color=colour, label=f"{name}, given step")
        axes[2].plot(*zip(*bias[n:]), "x", color=colour, label=f"{name}, accuracy")
    axes[0].plot(h ** 0.5, 6 * h ** 0.5, "k--", linewidth=1, label=r"rule of step = auto: 6 % $\sqrt{h}$")
    axes[2].set(xlabel="dissipated by impacts (% of the dissipation)", ylabel="strength against the limit (%)")
    for axis in axes:
        axis.axhline(0, color="black", linewidth=0.7)
        axis.grid(alpha=0.3)
        axis.legend(fontsize=7.5, loc="upper left")
    axes[0].set_ylim(top=6.6)
    axes[1].set_ylim(top=13)
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=os.path.abspath, nargs="?")
    parser.add_argument("--output", type=os.path.abspath)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--cases", type=lambda text: text.split(","), default=list(CASES))
    parser.add_argument("--figure")
    options = parser.parse_args()
    if options.program:
        runs = [(name, point, seed) for name in options.cases for point in CASES[name].points
                for seed in seeds_of(CASES[name], point)]
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            rows = list(pool.map(lambda run: load(options, *run), runs))
        kept = pandas.read_csv(STORED) if os.path.exists(STORED) else pandas.DataFrame(columns=["case"])
        pandas.concat([kept[~kept.case.isin(options.cases)], pandas.DataFrame(rows)]).to_csv(STORED, index=False,
                                                                                             float_format="%.6g")
    table = pandas.read_csv(STORED)
    show(table)
    if options.figure:
        draw(table, options.figure)


if __name__ == "__main__":
    main()
