#!/usr/bin/env python3
# diptych: figure and tables of a calibration
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: figure.py DIR FIGURE.png. DIR: folder of `diptych calibrate`. Draws every path and prints all tables as
Markdown. PYTHONPATH with diptych."""
import json
import sys

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from diptych.report import calibration as page
from diptych.report.charts.by_matplotlib import ruled, styled


@styled()
def draw(calibration, to):
    figure = Figure(figsize=(3.3 * len(calibration.paths), 5.2), layout="constrained")
    axes = figure.subplots(2, len(calibration.paths), squeeze=False)
    for k, path in enumerate(calibration.paths):
        for row, kind in enumerate(page.CURVES):
            page.draw_curve(ruled(axes[row][k]), path, kind, calibration.model)
        fitted = any(one["counts"] and one["kind"] in page.CURVES for one in path["observables"])
        use = "predicted" if path["use"] == "predict" else "fitted" if fitted else "band width fitted"
        axes[0][k].set_title(f"{path['name']}, {use}", fontsize=9)
    axes[0][0].legend(loc="lower right", fontsize=7)
    FigureCanvasAgg(figure).print_figure(to, dpi=110)


def printed(table):
    return "\n".join(["| " + " | ".join(table["head"]) + " |", "|" + "---|" * len(table["head"]),
                      *("| " + " | ".join(row) + " |" for row in table["rows"])])


def main():
    calibration = page.load(sys.argv[1])
    draw(calibration, sys.argv[2])
    record = calibration.record
    print(f"chi^2 of {record['n_observables']} observables {record['chi2_before']:.3g} -> {record['chi2']:.3g}; "
          f"{record['coarse_runs']} coarse, "
          f"{record['fine_runs']} fine, {record['other_runs']} runs of predictions; CPU s: "
          f"{json.dumps(calibration.cost)}\n")
    for table in (page.parameters(calibration), page.predictions(calibration), page.misfits(calibration)):
        print(printed(table) + "\n")
    print("\n".join(f"- {words}" for words in record["words"]))


if __name__ == "__main__":
    main()
