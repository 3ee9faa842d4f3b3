#!/usr/bin/env python3
# diptych: computes the cases with the independent model in dolfinx
# SPDX-License-Identifier: LGPL-2.1-or-later
"""referee.py [--cases NAMES] [--output DIR]

Writes NAME_curve.csv and NAME_cells.csv for each case of cases.py, by default over the stored files beside this script.
Forces act on the sample, skew and couple stresses have the sign of the equations. Needs python3-dolfinx."""
import argparse
import os
import sys

import numpy

from cases import CASES, HERE, keys, stages


def run(case):
    """(curve, columns of the cells, number of points at the tip in the end) of a case. Throws ArithmeticError."""
    from model import Model
    words = keys(case)
    model = Model(words)
    step, end = float(words["max_step"]), float(words["axial_strain"])
    curve, fields = [(0.0, *model.initialise(), 0.0, 0)], []
    for target in step * (1 + numpy.arange(round(end / step))):
        force, iterations = model.step(target)
        curve.append((target, *force, model.volumetric_strain(), iterations))
        if any(abs(target - stage) < step / 2 for stage in stages(case)):
            fields.append(model.means())
    before, after = fields
    row, column = numpy.indices(after["kappa"].shape)
    n_tip = (abs(model.state["q"]).max(axis=1) < 1e-12).sum()
    return curve, {"row": row, "column": column, "kappa_before": before["kappa"], **after}, n_tip


def store(folder, case, curve, fields):
    for name, header, rows, form in (
            ("curve", "axial_strain,upper_fx,upper_fy,volumetric_strain,iterations", curve, "%.10g"),
            ("cells", ",".join(fields), numpy.stack([field.ravel() for field in fields.values()], axis=1), "%.7g")):
        path = os.path.join(folder, f"{case}_{name}.csv")
        numpy.savetxt(path + ".part", rows, fmt=form, delimiter=",", header=header, comments="")
        os.replace(path + ".part", path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", default=",".join(CASES))
    parser.add_argument("--output", default=os.path.join(HERE, "results"))
    options = parser.parse_args()
    os.makedirs(options.output, exist_ok=True)
    for case in options.cases.split(","):
        before = os.times()
        curve, fields, n_tip = run(case)
        store(options.output, case, curve, fields)
        print(f"{case}: {len(curve) - 1} steps, {sum(row[-1] for row in curve)} iterations, {n_tip} points at the tip, "
              f"{os.times().user - before.user:.1f} CPU s", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
