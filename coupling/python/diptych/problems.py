# diptych: contact problems
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The contact solvers, for stored problems and for arrays."""

import os
from typing import Any

import numpy as np

from . import _diptych, scenes
from .arrays import Record


def _rows_of(w: Any) -> tuple[Any, Any, Any]:
    """Row pointers, columns and values of a dense or a SciPy matrix."""
    if hasattr(w, "tocsr"):
        w = w.tocsr()
    if hasattr(w, "indptr"):
        return w.indptr, w.indices, w.data
    dense = np.asarray(w, dtype=float)
    if dense.ndim != 2 or dense.shape[0] != dense.shape[1]:
        raise ValueError(f"W: a square matrix is needed, this one has shape {dense.shape}")
    row, column = np.nonzero(dense)
    return np.searchsorted(row, np.arange(len(dense) + 1)), column, dense[row, column]


def solve(problem: Any, tolerance: float = 1e-8, guess: Any = None, form: str | None = None, **options: Any) -> Record:
    """Impulses of a plane contact problem: u = W r + q [length/time], 0 <= u_n _|_ r_n >= 0, |r_t| <= mu r_n against
    u_t.

    problem    path of an FCLIB file (Acary, Bremond, Koziara & Perignon 2014), or (W, q, mu): W (2c, 2c) [1/mass],
               dense or a SciPy matrix, normal component of each contact first; q (2c) [length/time]; mu (c)
    tolerance  of the natural map residual, relative to |r|. The velocity error, by which contacts violate the laws
               relative to the free velocities of those that act, may be 100 times as large. It shows impulses that are
               far too small, as of bodies whose masses differ much
    guess      (c, 2): first guess of the impulses; default: zeros
    form       form of the problem in a file: "body" or "local"; default: "body" if the file holds it
    options    keys of the section discrete: solver ("psor" or "nsgs"), max_sweeps (default: 1000000), omega_sticking,
               omega_slipping, sweeps_per_check

    Returns r (c, 2) impulses and u (c, 2) relative velocities, normal part first; status ("converged" or
    "max_sweeps_reached", also if no solution exists), sweeps, residual, velocity_error, siconos_residual, cpu_s. A file
    whose contacts resist rolling adds rolling (c), the couples divided by the effective radii, and has no
    siconos_residual (nan). Raises SceneError for a wrong option, and ValueError with the file and dataset, or the
    array.
    """
    keys: dict[str, Any] = {"tolerance": tolerance, **{name: scenes.text_of(value) for name, value in options.items()}}
    if isinstance(problem, (str, os.PathLike)):
        return Record(_diptych.solve_file(os.fspath(problem), form, guess, keys))
    w, q, mu = problem
    return Record(_diptych.solve_arrays(_rows_of(w), np.ravel(q), mu, guess, keys))
