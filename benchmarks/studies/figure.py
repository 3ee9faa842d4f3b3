#!/usr/bin/env python3
# diptych: figure of a shipped study
# SPDX-License-Identifier: LGPL-2.1-or-later
"""figure.py DIR FIGURE.png [--quantities strength,dilation] [--columns 3] [--no-maps]

DIR: folder of a study (`diptych study`). Draws error against CPU seconds of the given quantities (default: those with a
limit), then the maps of classes, row by row. A study with ranges: Sobol indices of the given quantities. Uses the
functions of the report (PYTHONPATH with diptych)."""
import argparse
import math
import textwrap

from diptych.report import sensitivity
from diptych.report import study as charts
from diptych.report.charts.by_matplotlib import styled
from diptych.report.studies import CLASSES, load

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure


def panels(study, names, with_maps):
    """[(title, function of axes)]"""
    if "sensitivity" in study.record:
        record = study.record["sensitivity"]
        return [(f"{one['quantity']} (Q² {one['q2']:.3f})",
                 lambda axes, one=one: sensitivity.draw_indices(axes, sensitivity.by_total(one),
                                                             sensitivity.labels(record)))
                for one in record["indices"] if one["quantity"] in names]
    found = []
    for reference in study.references:
        held = ", ".join(study.points[reference]["labels"])
        for k, quantity in enumerate(study.quantities):
            if quantity["name"] in names:
                found.append((", ".join(text for text in (quantity["name"], held) if text),
                              lambda axes, k=k, reference=reference: charts.draw_error_against_cost(axes, study, k,
                                                                                                    reference)))
    for family in study.record["families"] if with_maps else []:
        for title, pair, points in charts.parts_of(study, family):
            found.append((": ".join(text for text in (family["name"], title) if text),
                          lambda axes, family=family, pair=pair,
                          points=points: charts.draw_classes(axes, study, family, pair, points)))
    return found


@styled()
def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("figure")
    parser.add_argument("--quantities", help="names, separated by commas; empty: none")
    parser.add_argument("--columns", type=int, default=3)
    parser.add_argument("--no-maps", action="store_true", help="no maps of classes")
    options = parser.parse_args()
    study = load(options.folder)
    names = [q["name"] for q in study.quantities
             if q["limit"]] if options.quantities is None else options.quantities.split(",")
    parts = panels(study, names, not options.no_maps)
    # Leaves out parts without errors.
    parts = [(title, draw) for title, draw in parts if draw(Figure().add_subplot()) is not False]
    rows = math.ceil(len(parts) / options.columns)
    figure = Figure(figsize=(4.6 * options.columns, 3.5 * rows), layout="constrained")
    FigureCanvasAgg(figure)
    for k, (title, draw) in enumerate(parts):
        axes = figure.add_subplot(rows, options.columns, k + 1)
        draw(axes)
        axes.set_title(title, fontsize=9.5, pad=18 if "sensitivity" in study.record else None)  # above the legend
    with_maps = not options.no_maps and "sensitivity" not in study.record
    letters = "; ".join(f"{look[2]} {name}" for name, look in CLASSES.items())
    words = f"{letters}; below: the error that is largest against its limit; ?: the samples leave a doubt"
    lines = [study.record["title"], *(textwrap.wrap(words, 62 * options.columns) if with_maps else [])]
    figure.suptitle("\n".join(lines), fontsize=9)
    figure.savefig(options.figure, dpi=80)


if __name__ == "__main__":
    main()
