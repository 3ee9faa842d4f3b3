#!/usr/bin/env python3
# diptych: cost of equal error: contact dynamics, implicit and explicit springs, LAMMPS, each at its best settings
# SPDX-License-Identifier: LGPL-2.1-or-later
"""envelope.py [PROGRAM --output DIR [--samples 40]] [--cases dense,slow] [--figure FILE]

With PROGRAM it loads every sample by all settings in turn, so that the CPU times compare, and stores envelope.csv; runs
in DIR are kept. The error of a setting is its bias against the limit of short steps on the same samples (order.csv).
Two levels are many samples at accuracy 0.05, some of them again at a finer one.
Needs what order.py needs, and lmp."""
import argparse
import os

import numpy
import pandas

import order

STORED = os.path.join(order.HERE, "envelope.csv")
# Stiffness kn/P and step over sqrt(m_min/kn) of explicit springs; kn/P and discrete/accuracy of implicit ones.
EXPLICIT = [f"{k}/{f}" for k, f in (("1e3", 0.5), ("3.3e3", 0.5), ("3.3e3", 0.7), ("1e4", 0.2), ("1e4", 0.5),
                                    ("1e4", 0.7))]
METHODS = {"NSCD": [f"accuracy={a}" for a in (0.1, 0.05, 0.02, 0.01, 0.005)],
           "implicit springs": [f"implicit={k}/{a}" for k in ("1e3", "1e4") for a in (0.1, 0.05, 0.02)],
           "penalty": ["penalty=" + knobs for knobs in EXPLICIT],
           "LAMMPS": ["lammps=" + knobs for knobs in (*EXPLICIT, "1e5/0.5")]}
COARSE, TWO_LEVELS = "accuracy=0.05", "NSCD, two levels"
METHODS[TWO_LEVELS] = METHODS["NSCD"][2:]  # the finer level
QUANTITIES = {"strength": (0.03, 0.02, 0.01, 0.005), "dilation": (0.1, 0.05, 0.03)}  # and errors of the table
TICKS = (0.1, 0.3, 1, 3, 10, 30)
LOOKS = {"NSCD": ("#0072B2", "o"), TWO_LEVELS: ("#CC79A7", "v"), "implicit springs": ("#56B4E9", "D"),
         "penalty": ("#007A5E", "s"), "LAMMPS": ("#D55E00", "^")}


def measured(options):
    """Rows of envelope.csv: all points of a sample, then the next one."""
    return pandas.DataFrame([order.load(options, name, point, seed) for name in options.cases
                             for seed in order.CASES[name].seeds[:options.samples]
                             for method, points in METHODS.items() if method != TWO_LEVELS for point in points])


def table():
    """The stored runs, and those of order.csv that give the limit."""
    limit = pandas.read_csv(order.STORED)
    return pandas.concat([limit[limit.point.str.startswith("h=")], pandas.read_csv(STORED)])


def cost(table, name, quantity, method, point):
    """CPU s of a sample. Two levels share their runs in the best proportion (Giles, Operations Research 56, 2008), and
    their mean has the variance of the finer level alone."""
    seconds = table[table.case == name].groupby("point").cpu_s.mean()
    if method != TWO_LEVELS:
        return seconds[point]
    values = order.wide(table, name, quantity, [COARSE, point])
    many, pairs = values[COARSE].var(), (values[point] - values[COARSE]).var()
    both = seconds[COARSE] + seconds[point]
    return ((many * seconds[COARSE])**0.5 + (pairs * both)**0.5)**2 / values[point].var()


def settings(table, name, quantity, method):
    """[(CPU s, bias, its standard error, point)], cheapest first."""
    runs = table[table.case == name].groupby("point").size()
    return sorted((cost(table, name, quantity, method, point),
                   *order.against_limit(table, name, quantity, point), point)
                  for point in METHODS[method] if runs.get(point, 0) > 5)


def cheapest(found, error):
    """The cheapest setting with a bias of at most `error` plus one standard error, or None."""
    return next((one for one in found if abs(one[1]) <= error + one[2]), None)


def show(table, names):
    for name in names:
        for quantity, errors in QUANTITIES.items():
            print(f"\n{name}, {quantity}: CPU s of the cheapest setting with an error of at most "
                  + ", ".join(f"{100 * error:g} %" for error in errors) + "; its bias +- standard error")
            for method in METHODS:
                cells = [cheapest(settings(table, name, quantity, method), error) for error in errors]
                texts = ("-" if one is None else "{0:.2f} ({3}: {1:+.1%} +- {2:.1%})".format(*one) for one in cells)
                print(f"  {method:17}", *texts, sep=" | ")


def draw(table, names, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, grid = pyplot.subplots(len(names), 2, figsize=(10, 4.2 * len(names)), layout="constrained", squeeze=False)
    for row, name in zip(grid, names):
        for axes, quantity in zip(row, QUANTITIES):
            for method in METHODS:
                found = settings(table, name, quantity, method)
                if not found:
                    continue
                cost, bias, error = (numpy.array(column) for column in list(zip(*found))[:3])
                colour, mark = LOOKS[method]
                axes.errorbar(cost, 100 * abs(bias), 100 * error, fmt=mark, color=colour, capsize=2, markersize=4,
                              label=method)
                axes.step(cost, 100 * numpy.minimum.accumulate(abs(bias)), where="post", color=colour, linewidth=1)
            axes.set(xscale="log", xlabel="CPU s of the loading of one sample", ylabel=f"|error of the {quantity}| (%)",
                     ylim=(0, None), xticks=TICKS, xticklabels=TICKS,
                     title=f"{name}, I = {order.CASES[name].inertial:g}")
            axes.grid(alpha=0.3)
    grid[0, 0].legend(fontsize=8)
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=os.path.abspath, nargs="?")
    parser.add_argument("--output", type=os.path.abspath)
    parser.add_argument("--samples", type=int, default=40)
    parser.add_argument("--cases", type=lambda text: text.split(","), default=["dense", "slow"])
    parser.add_argument("--figure")
    options = parser.parse_args()
    if options.program:
        kept = pandas.read_csv(STORED) if os.path.exists(STORED) else pandas.DataFrame(columns=["case"])
        pandas.concat([kept[~kept.case.isin(options.cases)], measured(options)]).to_csv(STORED, index=False,
                                                                                       float_format="%.6g")
    show(table(), options.cases)
    if options.figure:
        draw(table(), options.cases, options.figure)


if __name__ == "__main__":
    main()
