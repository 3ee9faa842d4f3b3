# diptych: global sensitivity of the quantities of a study: Sobol indices of sparse polynomials
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A study with `ranges` runs a Latin hypercube of points. For each quantity orthogonal polynomials are fitted to the
values (polynomial chaos; Sudret, Reliab. Eng. Syst. Saf. 93, 2008); squared coefficients are shares of the variance.
"""

import ctypes
import importlib.util
import math
import signal
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from ...arrays import Array, Interval, ends_text
from ...entries import describe
from ..runs.coordinates import Parameter
from .effects import PANELS, text_of_quantity
from .evaluation import Results, is_finished
from ..runs.statistics import line_statistics, line_turn, student_quantile
from .study_file import FEWEST_SAMPLES, Study

FOLDS = 10  # of the cross-validation and of the jackknife
ENOUGH = 0.9  # Q2 below this: the indices say little about the quantity
_MOST_TERMS, _HIGHEST_DEGREE = 500, 12
_ROUNDING = 1e-9  # a smaller scatter, relative to the values, is none
_FIELDS = ("first", "first_low", "first_high", "total", "total_low", "total_high")

describe("sensitivity.csv", """\
quantity: name of the quantity
panel: grains, continuum, difference (continuum minus grains), material point or comparison
parameter: key of the parameter
first: first Sobol index: share of the variance that the parameter causes alone
first_low: lower end of its 95 % interval
first_high: upper end
total: total Sobol index: share that it causes alone and together with others
total_low: lower end of its 95 % interval
total_high: upper end
correlation: rank correlation of parameter and quantity
q2: share of the variance that the polynomials predict at points that their fit has not seen
used: points with a value
""", "column")


class Sobol(NamedTuple):
    """first, total: an Interval per parameter. q2: share of the variance that polynomials predict at points that their
    fit has not seen. degree: of the polynomials."""

    first: list[Interval]
    total: list[Interval]
    q2: float
    degree: int


def need_openturns() -> None:
    """Raises ImportError with the package to install if openturns is missing."""
    if importlib.util.find_spec("openturns") is None:
        raise ImportError("a study with ranges needs the Python module openturns, which is missing. Install it with: "
                          "apt-get install python3-openturns")


@contextmanager
def _ctrl_c_waits() -> Iterator[None]:
    """Functions of openturns take over Ctrl-C and then abort the process. It waits, and its handler is put back."""
    libc, handler = ctypes.CDLL(None), ctypes.create_string_buffer(256)  # larger than a struct sigaction
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    libc.sigaction(signal.SIGINT, None, handler)
    try:
        yield
    finally:
        libc.sigaction(signal.SIGINT, handler, None)
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)


@_ctrl_c_waits()
def sobol_indices(points: Array, values: Array) -> Sobol:
    """Sobol indices of values (n) at points (n, d) of the unit cube, with 95 % intervals.

    For each degree the polynomials are fitted without each tenth of the points, and at last to all. The left-out points
    choose the degree (Q2). The same fits give the intervals by the jackknife over the tenths. The share 1 - Q2 that the
    polynomials leave unexplained may belong to any parameter, which widens each interval. At least 20 values.
    """
    parts = np.array_split(np.random.default_rng(1).permutation(len(values)), FOLDS)
    best, without = Sobol(first=[], total=[], q2=-math.inf, degree=0), np.empty(0)
    for degree in range(1, _HIGHEST_DEGREE + 1):
        if math.comb(points.shape[1] + degree, degree) > _MOST_TERMS:
            break
        predicted, shares = np.empty(len(values)), []
        for part in parts:
            kept = np.setdiff1d(np.arange(len(values)), part)
            predict, found = _fitted(points[kept], values[kept], degree)
            predicted[part] = predict(points[part])
            shares.append(found)
        q2 = 1 - float(np.mean((values - predicted)**2) / values.var())
        if q2 > best.q2:
            best, without = best._replace(q2=q2, degree=degree), np.array(shares)
    _, shares = _fitted(points, values, best.degree)
    half = student_quantile(0.975, FOLDS - 1) * np.sqrt((FOLDS - 1) * without.var(axis=0))
    unknown = min(1.0, 1 - best.q2)
    low, high = np.clip([shares - half - unknown * shares, shares + half + unknown * (1 - shares)], 0, 1)
    first, total = ([Interval(*map(float, ends)) for ends in zip(*one)] for one in zip(shares, low, high))
    return best._replace(first=first, total=total)


def _fitted(points: Array, values: Array, degree: int) -> tuple[Any, Array]:
    """Sparse Legendre polynomials up to a total degree, chosen by least angles: their prediction as a function of
    points, and the first and total shares (2, d) of its variance."""
    import openturns as ot  # optional

    ot.Log.Show(ot.Log.NONE)
    d = points.shape[1]
    terms = ot.LinearEnumerateFunction(d)
    basis = ot.OrthogonalProductPolynomialFactory([ot.LegendreFactory()] * d, terms)
    choice = ot.LeastSquaresMetaModelSelectionFactory(ot.LARS(), ot.CorrectedLeaveOneOut())
    fit = ot.FunctionalChaosAlgorithm(
        ot.Sample(2 * points - 1), ot.Sample(values[:, None]), ot.ComposedDistribution([ot.Uniform(-1, 1)] * d),
        ot.FixedStrategy(basis, terms.getStrataCumulatedCardinal(degree)), ot.LeastSquaresStrategy(choice))
    fit.run()
    result = fit.getResult()
    model = result.getMetaModel()
    has = np.array([terms(int(k)) for k in result.getIndices()]) > 0  # (terms, d)
    squares = np.where(has.any(axis=1), np.array(result.getCoefficients())[:, 0]**2, 0)
    alone = has & (has.sum(axis=1) == 1)[:, None]
    shares = np.array([squares @ alone, squares @ has]) / (squares.sum() or 1)
    return lambda x: np.array(model(ot.Sample(2 * x - 1)))[:, 0], shares


def sensitivity_of(study: Study, results: Results, records: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """The entry `sensitivity` of study.json. A point has the mean of its samples; points without one are left out."""
    finished = np.array([is_finished(runs) for runs in results])
    failed = sum(any(run.exit_code for run in runs) for runs in results)
    indices = []
    for q, quantity in enumerate(study.quantities):
        values = np.array([record["quantities"][q]["mean"] for record in records], float)
        used = np.isfinite(values) & finished
        indices.append({"quantity": quantity["name"], "panel": PANELS[quantity["source"]], "unit": quantity["unit"],
                        "used": int(used.sum()), "failed": failed, "without_value": int((~used).sum()) - failed,
                        **_indices_of(study.ranges, study.design[used], values[used], quantity["line"])})
    return {"parameters": [{"key": p.key, "coordinate": p.coordinate, "of": p.other, "low": p.low, "high": p.high}
                           for p in study.ranges], "points": len(results), "indices": indices}


def _indices_of(ranges: Sequence[Parameter], points: Array, values: Array, is_line: bool) -> dict[str, Any]:
    """Indices, mean and deviation of one quantity. is_line: angles that repeat after 180 degrees."""
    if is_line and len(values):
        centre = line_statistics(values).mean
        values = centre + line_turn(values, centre)
    found = Sobol(first=[], total=[], q2=math.nan, degree=0)
    if len(values) >= FEWEST_SAMPLES and values.std() > _ROUNDING * np.abs(values).max():
        found = sobol_indices(points, values)
    return {"q2": found.q2, "degree": found.degree, "mean": values.mean() if len(values) else math.nan,
            "deviation": values.std(ddof=1) if len(values) > 1 else math.nan,
            "parameters": [{"parameter": p.key, "first": first, "total": total,
                            "correlation": float(pd.Series(x).corr(pd.Series(values), method="spearman"))}
                           for p, first, total, x in zip(ranges, found.first, found.total, points.T)]}


def sensitivity_table(record: dict[str, Any]) -> pd.DataFrame:
    """sensitivity.csv: a row per quantity, panel and parameter."""
    return pd.DataFrame([[one["quantity"], one["panel"], p["parameter"], *p["first"], *p["total"], p["correlation"],
                          one["q2"], one["used"]] for one in record["indices"] for p in one["parameters"]],
                        columns=["quantity", "panel", "parameter", *_FIELDS, "correlation", "q2", "used"])


def text_of_indices(study: Study, record: dict[str, Any]) -> list[str]:
    """ "peak t/s, continuum (128 of 128 points, Q2 0.982): friction_angle_peak 0.79 [0.74, 0.84], ...", descending."""
    lines = ["total indices from 0.01: the share of the variance that a parameter causes alone and together with "
             "others"]
    for quantity, one in zip(study.quantities, record["indices"]):
        ranked = sorted(((p["total"], p["parameter"].partition("/")[2]) for p in one["parameters"]), reverse=True)
        found = ", ".join(f"{name} {value:.2f}{ends_text(low, high, '{:.2f}'.format)}"
                          for (value, low, high), name in ranked if value >= 0.01)
        lines.append(f"{text_of_quantity(quantity)} ({one['used']} of {record['points']} points, Q2 {one['q2']:.3f}): "
                     + (found or f"none, since fewer than {FEWEST_SAMPLES} points have a value or all are equal"))
    return lines


def warnings_of(record: dict[str, Any]) -> list[str]:
    """Points that are left out, and quantities that the polynomials do not describe."""
    found = []
    for one in record["indices"]:
        name = f"{one['quantity']}, {one['panel']}"
        if one["used"] < record["points"]:
            found.append(f"{name}: {record['points'] - one['used']} of {record['points']} points are left out: "
                         f"{one['failed']} failed, {one['without_value']} have no value")
        if one["q2"] < ENOUGH:
            found.append(f"{name}: the polynomials predict only {one['q2']:.0%} of the variance (Q2); give more "
                         "samples or narrower ranges before you trust the indices")
    return found
