#!/usr/bin/env python3
# diptych: cost of equal error: contact dynamics, implicit and explicit springs, LAMMPS, each at its best settings
# SPDX-License-Identifier: LGPL-2.1-or-later
"""envelope.py [--cases dense,slow] [--figure FILE]

Takes the runs of order.csv, which order.py makes in one go. The error of a setting is its bias against the limit of
short steps on the same samples. For each method the cheapest settings of every error are its lower envelope. Needs
numpy, pandas and scipy, the figure matplotlib."""
import argparse

import numpy
import pandas

import order

# method -> its points in order.csv
METHODS = {"NSCD": order.ACCURACIES, "implicit springs": order.IMPLICIT,
           "penalty": [p for p in (*order.SPRINGS, *order.CHEAP_SPRINGS) if p.startswith("penalty")],
           "LAMMPS": [p for p in (*order.SPRINGS, *order.CHEAP_SPRINGS) if p.startswith("lammps")]}
QUANTITIES = {"strength": (0.03, 0.02, 0.01), "dilation": (0.1, 0.05, 0.03)}  # and errors of the table
LOOKS = {"NSCD": ("#0072B2", "o"), "implicit springs": ("#56B4E9", "D"), "penalty": ("#007A5E", "s"),
         "LAMMPS": ("#D55E00", "^")}


def settings(table, name, quantity, points):
    """[(CPU s, bias, its standard error, point)] of the measured points, cheapest first."""
    rows = table[table.case == name]
    return sorted((rows[rows.point == point].cpu_s.mean(), *order.against_limit(table, name, quantity, point), point)
                  for point in points if (rows.point == point).sum() > 5)


def cheapest(found, error):
    """The cheapest setting with a bias of at most `error` plus one standard error, or None."""
    return next((one for one in found if abs(one[1]) <= error + one[2]), None)


def show(table, names):
    for name in names:
        for quantity, errors in QUANTITIES.items():
            print(f"\n{name}, {quantity}: CPU s of the cheapest setting with an error of at most "
                  + ", ".join(f"{error:.0%}" for error in errors) + "; its bias +- standard error")
            for method, points in METHODS.items():
                cells = [cheapest(settings(table, name, quantity, points), error) for error in errors]
                texts = ("-" if one is None else "{0:.2f} ({3}: {1:+.1%} +- {2:.1%})".format(*one) for one in cells)
                print(f"  {method:17}", *texts, sep=" | ")


def draw(table, names, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, grid = pyplot.subplots(len(names), 2, figsize=(10, 4.2 * len(names)), layout="constrained", squeeze=False)
    for row, name in zip(grid, names):
        for axes, quantity in zip(row, QUANTITIES):
            for method, points in METHODS.items():
                found = settings(table, name, quantity, points)
                if not found:
                    continue
                cost, bias, error = (numpy.array(column) for column in list(zip(*found))[:3])
                colour, mark = LOOKS[method]
                axes.errorbar(cost, 100 * abs(bias), 100 * error, fmt=mark, color=colour, capsize=2, markersize=4,
                              label=method)
                axes.step(cost, 100 * numpy.minimum.accumulate(abs(bias)), where="post", color=colour, linewidth=1)
            axes.set(xscale="log", xlabel="CPU s of the loading of one sample", ylabel=f"|error of the {quantity}| (%)",
                     ylim=(0, None), title=f"{name}, I = {order.CASES[name].inertial:g}")
            axes.grid(alpha=0.3)
    figure.legend(*grid[0, 0].get_legend_handles_labels(), loc="outside upper center", ncols=len(METHODS))
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", type=lambda text: text.split(","), default=["dense", "slow"])
    parser.add_argument("--figure")
    options = parser.parse_args()
    table = pandas.read_csv(order.STORED)
    show(table, options.cases)
    if options.figure:
        draw(table, options.cases, options.figure)


if __name__ == "__main__":
    main()
