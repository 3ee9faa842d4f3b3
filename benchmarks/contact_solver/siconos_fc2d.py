#!/usr/bin/env python3
# diptych: the stored contact problems, solved by the 2D NSGS of Siconos and by this program in the same run
# SPDX-License-Identifier: LGPL-2.1-or-later
"""siconos_fc2d.py PROGRAM [--limit SECONDS] [--repeats N] [--figure FILE.png]

PROGRAM: diptych. Needs python3 with siconos, h5py, numpy and scipy (Debian: python3-siconos, not a dependency of this
project). If one is missing, prints a message and ends with 0. Siconos stops on its own residual, which is scaled by
max(|r|, |u|, |q|). The table therefore also shows the natural map, relative to |r|, of the impulses that it returns.
--figure: natural map against CPU seconds for tolerances of 1e-3 to 1e-8 (needs matplotlib)."""
import argparse
import os
import statistics
import subprocess
import sys
import time

TOLERANCES, CHARTED = (1e-4, 1e-8), (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)
PROBLEMS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../tests/discrete/contact_problems")


def read_problem(path):
    import h5py
    import numpy
    import scipy.sparse
    with h5py.File(path) as file:
        w, vectors = file["fclib_local/W"], file["fclib_local/vectors"]
        size = int(w["m"][0])
        matrix = scipy.sparse.csr_matrix((w["x"][:], w["i"][:].astype(numpy.int64), w["p"][:].astype(numpy.int64)),
                                         shape=(size, size))
        return matrix, vectors["q"][:], vectors["mu"][:]


def natural_map(matrix, q, mu, r):
    """||r - P(r)|| / ||r||, where P solves each contact by itself, as in discrete/contacts/contact_problem.h."""
    import numpy
    u, diagonal = matrix @ r + q, matrix.diagonal()
    normal = numpy.maximum(0, r[0::2] - u[0::2] / diagonal[0::2])
    tangential = numpy.clip(r[1::2] - u[1::2] / diagonal[1::2], -mu * normal, mu * normal)
    return numpy.sqrt(((r[0::2] - normal)**2).sum() + ((r[1::2] - tangential)**2).sum()) / numpy.linalg.norm(r)


def solve_here(path, tolerance):
    """Solves with Siconos from zero impulses. Prints sweeps, CPU seconds, its residual, natural map and info."""
    import numpy
    import siconos.numerics as siconos
    matrix, q, mu = read_problem(path)
    columns = matrix.tocsc()
    columns.indices, columns.indptr = columns.indices.astype(numpy.int64), columns.indptr.astype(numpy.int64)
    _, blocks = siconos.SBM_from_csparse(2, columns)
    problem = siconos.FrictionContactProblem(2, blocks, q, mu)
    options = siconos.SolverOptions(siconos.SICONOS_FRICTION_2D_NSGS)
    options.dparam[siconos.SICONOS_DPARAM_TOL] = tolerance
    options.iparam[siconos.SICONOS_IPARAM_MAX_ITER] = 100000000
    r, u = numpy.zeros_like(q), numpy.zeros_like(q)
    begin = time.process_time()
    info = siconos.fc2d_driver(problem, r, u, options)
    seconds = time.process_time() - begin
    print(options.iparam[siconos.SICONOS_IPARAM_ITER_DONE], seconds, options.dparam[siconos.SICONOS_DPARAM_RESIDU],
          natural_map(matrix, q, mu, r), info)


def siconos_solve(path, tolerance, limit):
    """[sweeps, seconds, residual, natural map, info] of a solve in a separate process; None after `limit` seconds."""
    try:
        done = subprocess.run([sys.executable, os.path.abspath(__file__), "--one", path, str(tolerance)],
                              capture_output=True, text=True, timeout=limit + 5, check=True)
    except subprocess.TimeoutExpired:
        return None
    return [float(x) for x in done.stdout.split()]


def own_solve(program, path, tolerance, form):
    done = subprocess.run([program, "solve", path, "--solver", "psor", "--tolerance", str(tolerance), "--form", form],
                          capture_output=True, text=True)
    values = dict(line.split(": ", 1) for line in done.stdout.splitlines() if ": " in line)
    if "cpu_s" not in values:
        sys.exit(f"siconos_fc2d.py: {program} solve failed: {done.stderr.strip()}")
    return int(values["sweeps"]), float(values["cpu_s"]), float(values["siconos_residual"])


def print_problem(options, name, tolerance):
    """{solver: (seconds, natural map relative to |r|)}"""
    found, path = {}, os.path.join(PROBLEMS, name + ".h5")
    runs = []
    while len(runs) < options.repeats and (not runs or runs[-1] is not None and runs[-1][1] < 5):
        runs.append(siconos_solve(path, tolerance, options.limit))
    theirs = None if runs[-1] is None else statistics.median(run[1] for run in runs)
    if theirs is None:
        print(f"{name:7} {tolerance:7.0e}  siconos          -  > {options.limit:g} s")
    else:
        sweeps, _, residual, natural, info = runs[0]
        found["Siconos"] = theirs, natural
        print(f"{name:7} {tolerance:7.0e}  siconos  {sweeps:9.0f} {theirs:9.4f}  {residual:8.1e} {natural:8.1e}"
              + ("" if info == 0 else "  NOT converged"))
    for form in ("body", "local"):
        ours = [own_solve(options.program, path, tolerance, form) for _ in range(options.repeats)]
        seconds = statistics.median(run[1] for run in ours)
        ratio = f"> {options.limit / seconds:.0f}" if theirs is None else f"{theirs / seconds:.1f}"
        print(f"{name:7} {tolerance:7.0e}  {form:7}  {ours[0][0]:9d} {seconds:9.4f}  {ours[0][2]:8.1e} "
              f"<={tolerance:7.0e}  siconos / this: {ratio}", flush=True)
        found[f"psor, {form} form"] = seconds, tolerance
    return found


def draw(by_problem, path):
    """by_problem: {name: [{solver: (seconds, natural map)}]}, from loose to tight."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    figure = Figure(figsize=(4.4 * len(by_problem), 3.6), layout="constrained")
    FigureCanvasAgg(figure)
    looks = {"Siconos": ("*-", "#8a1c7c"), "psor, body form": ("o-", "#0072b2"), "psor, local form": ("s-", "#d55e00")}
    for place, (name, rows) in enumerate(by_problem.items()):
        axes = figure.add_subplot(1, len(by_problem), place + 1)
        for solver, (mark, colour) in looks.items():
            points = [row[solver] for row in rows if solver in row]
            axes.plot(*zip(*points), mark, color=colour, markersize=5, linewidth=1, label=solver)
        axes.set(xscale="log", yscale="log", xlabel="CPU seconds", ylabel="|r − P(r)| / |r|", title=f"{name}.h5")
        axes.grid(alpha=0.3)
        axes.legend(fontsize=8)
    figure.savefig(path, dpi=90)



def main():
    if len(sys.argv) == 4 and sys.argv[1] == "--one":
        return solve_here(sys.argv[2], float(sys.argv[3]))
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--limit", type=float, default=120, help="seconds for one solve of Siconos")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--figure")
    options = parser.parse_args()
    try:
        import h5py, numpy, scipy.sparse, siconos.numerics  # noqa: F401, E401
    except ImportError as missing:
        print(f"siconos_fc2d.py: skipped, {sys.executable} has no {missing.name} (Debian: apt-get install "
              "python3-siconos, and run this with /usr/bin/python3)")
        return None
    print("from zero impulses, CPU seconds, median of", options.repeats)
    print("problem     tol  solver      sweeps   seconds  its test  nat / |r|")
    by_problem = {name: [print_problem(options, name, tolerance)
                         for tolerance in (CHARTED if options.figure else TOLERANCES)]
                  for name in ("small", "medium")}
    if options.figure:
        draw(by_problem, options.figure)
    return None


if __name__ == "__main__":
    sys.exit(main())
