#!/usr/bin/env python3
# diptych: finite elements between the lower and upper bounds of limit analysis
# SPDX-License-Identifier: LGPL-2.1-or-later
"""limit_analysis.py PROGRAM [--only WORD] [--output DIR [--reuse]] [--figure figure.png]

Bounds the collapse loads of rough rectangles and of strip footings, runs `PROGRAM continuum` on three or four meshes of
each, and judges: bounds within 2 %, closed forms between them, the limit of fine meshes between them. --only: cases
whose name contains WORD. --output keeps results.json and the runs, --reuse takes numbers from it. Exit code 1: a claim
fails; 2: a run failed. Needs python3-cvxopt, python3-scipy, the figure matplotlib."""
import argparse
import json
import math
import os
import re
import sys
import tempfile

from bodies import Footing, Rectangle, grid_body, ray_body
from bounds import Soil, lower_bound, upper_bound
from finite_elements import collapse_load, limit

GAP = 0.02  # allowed between the bounds
# relative accuracy of a bound that meets its closed form, unbalanced tractions, violation of the flow rule
SOLVER = 1e-5
RATIOS, ANGLES = (0.5, 0.7, 1.0), (20, 30)
LEVELS = {"rectangle": {"lower": (8, 16, 32), "upper": (8, 16, 24), "elements": (4, 8, 16, 32)},
          "footing": {"lower": (12, 24, 36), "upper": (10, 20, 40), "elements": (5, 10, 20)}}


def rankine(soil):
    """Strength of a homogeneous sample under the lateral pressure 1."""
    strength = math.tan(math.radians(45 + soil.friction_angle / 2))
    return strength**2 + 2 * soil.cohesion * strength


def prandtl(soil):
    """Prandtl (1920): N_c of a strip on weightless ground."""
    phi = math.radians(soil.friction_angle)
    return (math.tan(math.pi / 4 + phi / 2)**2 * math.exp(math.pi * math.tan(phi)) - 1) / math.tan(phi)


def cases():
    """(name, shape, soil, closed form or None). Two rigid wedges under the platens fit into a slender rectangle without
    touching, so its strength is that of a homogeneous sample."""
    for angle in ANGLES:
        soil, steep = Soil(angle, 0.5), math.tan(math.radians(45 + angle / 2))
        for ratio in RATIOS:
            exact = rankine(soil) if ratio * steep <= 1 else None
            yield f"rectangle W/H {ratio:g}, phi {angle}", Rectangle(ratio), soil, exact
        yield f"friction 0.1, W/H 1, phi {angle}", Rectangle(1.0, rough=False, friction=0.1), soil, None
    for angle, half_width, depth in zip(ANGLES, (8, 12), (4, 5)):
        yield f"footing, phi {angle}", Footing(half_width, depth), Soil(angle, 1.0), prandtl(Soil(angle, 1.0))


def seconds():
    times = os.times()
    return times.user + times.children_user


def computed(kind, shape, soil, n, place):
    """Row of one level: value, number of elements and their mean size in platen widths, error, CPU seconds."""
    before = seconds()
    if kind == "elements":
        value, error, count = collapse_load(place[0], shape, soil, n, f"{place[1]}_{n}")
        count /= 2 if isinstance(shape, Footing) else 4
    else:
        low = kind == "lower"
        bound = lower_bound(ray_body(shape, n), soil, shape.pressure) if low else upper_bound(grid_body(shape, n), soil)
        value, error, count = bound.value, bound.error, bound.n_triangles
    size = math.sqrt(shape.area() / count) / (2 * shape.platen_width)
    return {"n": n, "value": value, "error": error, "elements": count, "size": size, "seconds": seconds() - before}


def levels_of(problem, place, kept):
    """Rows of all levels of a case by kind; the rows in `kept` are not computed again."""
    rows = {}
    for kind, levels in LEVELS["footing" if isinstance(problem[0], Footing) else "rectangle"].items():
        old = {row["n"]: row for row in kept.get(kind, [])}
        rows[kind] = [old[n] if n in old else computed(kind, *problem, n, place) for n in levels]
    return rows


def smooth_rectangle():
    """Largest relative error of both bounds for smooth platens, whose closed form is Rankine's."""
    errors = []
    for angle in ANGLES:
        shape, soil = Rectangle(0.7, rough=False), Soil(angle, 0.5)
        bounds = lower_bound(ray_body(shape, 6), soil, 1.0), upper_bound(grid_body(shape, 4), soil)
        errors += [abs(bound.value / rankine(soil) - 1) for bound in bounds]
    return max(errors)


def judged(name, rows, closed_form, least=None):
    """Prints the case and returns the claims that fail. least: of the limit of the elements; default: lower bound."""
    low, high = (rows[kind][-1]["value"] for kind in ("lower", "upper"))
    loads = [row["value"] for row in rows["elements"]]
    tends_to, doubt = limit(loads)
    errors = [row["error"] for kind in ("lower", "upper") for row in rows[kind]]
    claims = {"equilibrium and flow rule": max(errors) <= SOLVER, "bounds within 2 %": 0 <= high / low - 1 <= GAP,
              "elements above the lower bound": min(loads) >= (least or low),
              "limit of the elements between the bounds": (least or low) - doubt <= tends_to <= high + doubt}
    if closed_form:
        claims["closed form between them"] = low * (1 - SOLVER) <= closed_form <= high * (1 + SOLVER)
    cost = sum(row["seconds"] for kind in LEVELS["footing"] for row in rows[kind])
    failed = [claim for claim, holds in claims.items() if not holds]
    print(f"{name:26} {low:8.4f} {high:8.4f} {100 * (high / low - 1):6.2f} % "
          + " ".join(f"{load:8.4f}" for load in loads[-2:])
          + f" {tends_to:8.4f} +- {doubt:6.4f} " + (f"{closed_form:8.4f}" if closed_form else "       -")
          + f"  {cost:6.1f}" + "".join(f"  FAILS: {claim}" for claim in failed), flush=True)
    return failed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--only", default="", help="cases whose name contains this word")
    parser.add_argument("--output", help="folder for results.json and the runs; default: a temporary one")
    parser.add_argument("--reuse", action="store_true", help="keep the numbers that are already in --output")
    parser.add_argument("--figure", help="file for the figure (matplotlib)")
    options = parser.parse_args()
    kept, failed, results = {}, [], {}
    if options.reuse:
        with open(os.path.join(options.output, "results.json")) as file:
            kept = json.load(file)
    error = smooth_rectangle()
    print(f"smooth rectangles: bounds differ from Rankine by {error:.1e}" + ("" if error <= SOLVER else "  FAILS"))
    print("case                          lower    upper      gap   elements: finest        limit  closed form  CPU s")
    with tempfile.TemporaryDirectory() as scratch:
        folder = options.output or scratch
        os.makedirs(folder, exist_ok=True)
        for name, shape, soil, closed_form in cases():
            if options.only not in name:
                continue
            place = os.path.abspath(options.program), os.path.join(folder, re.sub(r"[^\w.]+", "_", name))
            try:
                results[name] = levels_of((shape, soil), place, kept.get(name, {}))
            except RuntimeError as failure:
                sys.stderr.write(f"limit_analysis.py: {failure}\n")
                return 2
            # Friction does not dilate: its load is at most that of the bounds, and above that of smooth platens.
            failed += judged(name, results[name], closed_form, rankine(soil) if shape.friction else None)
            results[name]["closed_form"] = closed_form
            with open(os.path.join(folder, "results.json"), "w") as file:
                json.dump({**kept, **results}, file, indent=1)
        if options.figure:
            from draw import draw
            draw(results, options.figure)
    return 1 if failed or error > SOLVER else 0


if __name__ == "__main__":
    sys.exit(main())
