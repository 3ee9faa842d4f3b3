#!/usr/bin/env python3
# diptych: error of the mean strength against CPU time: one level, two levels, springs, LAMMPS
# SPDX-License-Identifier: LGPL-2.1-or-later
"""levels.py [--figure FILE]

Evaluates the runs of dense_biaxial at I = 1.13e-3 that order.csv holds: forty samples, each with several steps. Checks
the interval of two-level means against all forty samples at the finest step, and compares what methods cost. Needs
h5py, numpy, pandas, scipy and the package diptych (PYTHONPATH), the figure matplotlib."""
import argparse
import os

import numpy
import pandas

import order
from diptych.campaigns.studies import levels
from order import SPRINGS

HERE = os.path.dirname(os.path.abspath(__file__))
TABLE = os.path.join(HERE, "order.csv")
# steps of the fit, with tight tolerances
FIXED = tuple(f"h={h}" for h in ("0.4", "0.1", "0.025", "0.00625", "0.0015625"))
CHEAP, FINEST = "accuracy=0.05", FIXED[-1]
FINE = ("accuracy=0.01", "accuracy=0.005", FINEST)
ONE_LEVEL = (CHEAP, "accuracy=0.02", *FINE)
TARGETS = (1.0, 0.5, 0.35)  # errors of the mean [%]


class Runs:
    """The table of stored runs. Strengths are in per cent of the limit."""

    def __init__(self, quantity="strength"):
        table = pandas.read_csv(TABLE)
        table = table[table.case == "dense"]
        mean = table.groupby("point")[["step", "cpu_s"]].mean()
        self.step, self.cpu_s = mean["step"], mean["cpu_s"]
        values = table.pivot(index="seed", columns="point", values=quantity)
        # T/S = a (1 + b sqrt(h)), fitted as in order.py: the limit of each sample and the coefficient of all.
        fit = order.Fit(values[list(FIXED)].dropna(), self.step[list(FIXED)])
        limits = values[list(FIXED)].to_numpy() @ fit.limit_weights()
        self.limit, self.coefficient = limits.mean(), 100 * fit.at(0.5)[2]
        self.values, self.of_sample = 100 * values / self.limit, 100 * pandas.Series(limits / self.limit, values.index)

    def bias(self, point):
        """Of an NSCD setting by the fit; of springs the measured one [%], which counts as 0 below two standard
        errors."""
        if point not in SPRINGS:
            return self.coefficient * self.step[point]**0.5
        difference = (self.values[point] - self.of_sample).dropna()
        error = difference.std() / len(difference)**0.5
        return abs(difference.mean()) if abs(difference.mean()) > 2 * error else 0.0

    def ratio(self, fine, cheap=CHEAP):
        """Of the expected errors; springs have no error of the step."""
        return 1e-12 if fine in SPRINGS else (self.step[fine] / self.step[cheap])**0.5

    def scatter(self):
        return self.values[list(ONE_LEVEL)].std().mean()


def one_level(runs, seconds):
    """Error [%] with the best step for each CPU time; the cost of steps between those that ran is interpolated."""
    by_step = sorted(ONE_LEVEL, key=lambda point: runs.step[point])
    h = numpy.geomspace(runs.step[by_step[0]], runs.step[by_step[-1]], 200)
    cost = numpy.exp(numpy.interp(numpy.log(h), numpy.log(runs.step[by_step]), numpy.log(runs.cpu_s[by_step])))
    return numpy.sqrt((runs.coefficient**2 * h + runs.scatter()**2 * cost
                       / numpy.maximum(seconds[:, None], cost)).min(axis=1))


def two_levels(runs, seconds, fine):
    """Error [%] with the best numbers of samples and pairs."""
    s, cost = runs.values[[CHEAP, fine]].dropna(), (runs.cpu_s[CHEAP], runs.cpu_s[fine])
    v, d = levels.variances(s[CHEAP], s[fine], runs.ratio(fine)), s[CHEAP] - s[fine]
    # forty pairs know it
    v = v._replace(many=s[CHEAP].var() - 2 * levels.weight_of(runs.ratio(fine)) * s[CHEAP].cov(d))
    of_order, bias = (0, runs.bias(fine)) if fine in SPRINGS else (v.order, 0)
    share = v.share(cost)
    error = (v.many + v.pairs / share) * (cost[0] + share * cost[1]) / seconds + of_order**2 + bias**2
    least = levels.LEAST_PAIRS * (cost[1] + cost[0] / share)  # below it there are too few pairs
    return numpy.where(seconds >= least, numpy.sqrt(error), numpy.nan), share


def springs(runs, seconds, point):
    cost = runs.cpu_s[point]
    return numpy.where(seconds >= cost, numpy.sqrt(runs.bias(point)**2 + runs.scatter()**2 * cost / seconds), numpy.nan)


def two_level_mean(runs, fine, drawn):
    """(limit with its interval, number of pairs) from some of the samples. The pairs follow from a pilot as in run
    --levels."""
    x, y = runs.values[CHEAP].to_numpy()[drawn], runs.values[fine].to_numpy()[drawn]
    pairs, ratio, cost = levels.LEAST_PAIRS, runs.ratio(fine), (runs.cpu_s[CHEAP], runs.cpu_s[fine])
    while True:
        some = numpy.where(numpy.arange(len(x)) < pairs, y, numpy.nan)
        wanted = min(len(x), int(numpy.ceil(len(x) * levels.variances(x, some, ratio).share(cost))))
        if wanted <= pairs:
            return levels.limit_of(x, some, ratio).limit, pairs
        pairs = wanted


def coverage(runs, fine, repetitions, n=20, replace=False):
    """Repeats the two-level mean with n of the samples, drawn with fixed seeds. Returns means over the repetitions:
    whether the interval holds the limit of all samples, whether it holds their mean at the finest step, half width [%],
    pairs, error [%]."""
    truths, found = (runs.of_sample.mean(), runs.values[FINEST].mean()), []
    for k in range(repetitions):
        limit, pairs = two_level_mean(runs, fine, numpy.random.default_rng(k).choice(len(runs.values), n, replace))
        held = [limit.low <= truth <= limit.high for truth in truths]
        found.append([*held, (limit.high - limit.low) / 2, pairs, limit.value - truths[0]])
    return numpy.mean(found, axis=0)


def show(runs):
    n, seconds = len(runs.values), numpy.geomspace(0.1, 1e5, 4000)
    print(f"{n} samples: T/S = {runs.limit:.4f} (1 + {runs.coefficient:.2f} % sqrt(h)); scatter of one "
          f"{runs.scatter():.2f} %")
    for point in (*FIXED, *ONE_LEVEL[:-1], *SPRINGS):
        if point in runs.values:
            d = (runs.values[point] - runs.of_sample).dropna()
            print(f"  {point:18} {runs.cpu_s[point]:6.2f} CPU s, step {runs.step[point]:8.4f}, {d.mean():+.2f} +- "
                  f"{d.std() / len(d)**0.5:.2f} % above the limit ({len(d)} samples), counted {runs.bias(point):.2f} %")
    for fine in FINE[:2]:
        subsets, resampled = coverage(runs, fine, 20), coverage(runs, fine, 500, replace=True)
        print(f"two levels {CHEAP}, {fine}, 20 samples: limit in the interval in {20 * subsets[0]:.0f} of 20 subsets, "
              "mean of "
              f"the finest step in {20 * subsets[1]:.0f}; drawn with replacement, 500 times: {resampled[0]:.1%}, "
              f"{resampled[1]:.1%}; half width {resampled[2]:.2f} %, {resampled[3]:.1f} pairs, mean error "
              f"{resampled[4]:+.2f} %")
    curves = {"NSCD, one level": one_level(runs, seconds)}
    for fine in (*FINE, "penalty=1e5"):
        if fine in runs.values:
            curves[f"two levels, fine: {fine}"], share = two_levels(runs, seconds, fine)
            print(f"{fine}: pairs for {share:.0%} of the samples")
    curves |= {SPRINGS[point]: springs(runs, seconds, point) for point in SPRINGS if point in runs.values}
    print("CPU s for an error of the mean of " + ", ".join(f"{target:g} %" for target in TARGETS))
    for name, error in curves.items():
        needed = [numpy.append(seconds[error <= target], numpy.inf)[0] for target in TARGETS]
        print(f"  {name:36}" + "".join(f"{one:9.0f}" for one in needed))
    return seconds, curves


def draw(seconds, curves, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as pyplot
    colours = {"NSCD, one level": "#0072B2", "NSCD, two levels": "#000000", "penalty": "#D55E00", "LAMMPS": "#007A5E"}
    figure, axis = pyplot.subplots(figsize=(7, 4.6), constrained_layout=True)
    best = numpy.fmin.reduce([curves[f"two levels, fine: {fine}"] for fine in FINE])
    shown = {"NSCD, one level": curves["NSCD, one level"], "NSCD, two levels": best}
    shown |= {name: error for name, error in curves.items() if "penalty" in name or "LAMMPS" in name}
    for name, error in shown.items():
        line = ":" if "two levels, fine" in name else "--" if name.endswith(", 1e5") else "-"
        colour = next(colours[key] for key in (name, "penalty" if "penalty" in name else "LAMMPS") if key in colours)
        label = name.replace("penalty=1e5", "penalty, 1e5").replace("two levels, fine:", "NSCD and, as the fine level,")
        axis.plot(seconds, error, line, color=colour, linewidth=2.2 if name in colours else 1.4, label=label)
    axis.axhline(0.5, color="#777777", linewidth=0.8)
    axis.set(xscale="log", yscale="log", xlim=(1, 3000), ylim=(0.2, 6), ylabel="error of the mean strength (%)",
             xlabel="CPU seconds for all samples, 1000 discs to 4 % strain",
             title="I = 1.13e-3: root of bias² + variance of the mean T/S over 0.5-4 %")
    axis.set_yticks([0.2, 0.3, 0.4, 0.5, 1, 2, 5], ["0.2", "0.3", "0.4", "0.5", "1", "2", "5"])
    axis.title.set_fontsize(10)
    axis.grid(alpha=0.3, which="both")
    axis.legend(fontsize=8)
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--figure", metavar="FILE")
    options = parser.parse_args()
    seconds, curves = show(Runs())
    if options.figure:
        draw(seconds, curves, options.figure)


if __name__ == "__main__":
    main()
