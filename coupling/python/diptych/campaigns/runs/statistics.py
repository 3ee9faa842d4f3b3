# diptych: statistics over samples: Student's intervals, lines, equivalence, orders of convergence
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Values of independent samples. NaN marks a missing value or an interval that is unknown (fewer than two samples)."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from scipy.special import betaincinv, ndtri

from ...arrays import Interval


def student_quantile(probability: float, degrees_of_freedom: float) -> float:
    """Quantile of Student's distribution, probability in (0.5, 1); the normal one for infinite degrees of freedom.

    Through the incomplete beta function, to 1e-14; stdtrit has errors of 1e-11, and scipy.stats loads slowly.
    """
    if math.isinf(degrees_of_freedom):
        return float(ndtri(probability))
    return math.sqrt(degrees_of_freedom * (1 / betaincinv(degrees_of_freedom / 2, 0.5, 2 * (1 - probability)) - 1))


class Statistics(NamedTuple):
    """n, mean, standard deviation of one sample (n - 1), and the ends of the 95 % interval of the mean."""

    n: int
    mean: float = math.nan
    deviation: float = math.nan
    low: float = math.nan
    high: float = math.nan

    def interval(self, confidence: float = 0.95) -> Interval:
        """The mean with its Student interval."""
        if self.n < 2:
            return Interval(self.mean, math.nan, math.nan)
        half = student_quantile((1 + confidence) / 2, self.n - 1) * self.deviation / math.sqrt(self.n)
        return Interval(self.mean, self.mean - half, self.mean + half)


class LineStatistics(Statistics):
    """Those of angles [degrees]; an interval ends 90 degrees from the mean, where it holds every line."""

    __slots__ = ()

    def interval(self, confidence: float = 0.95) -> Interval:
        mean, low, high = super().interval(confidence)
        return Interval(mean, max(low, mean - 90), min(high, mean + 90)) if self.n > 1 else Interval(mean, low, high)


def _with_interval(n: int, mean: float, square: float, kind: type[Statistics] = Statistics) -> Statistics:
    s = kind(n=n, mean=mean, deviation=math.sqrt(square / (n - 1)) if n > 1 else math.nan)
    return s._replace(low=s.interval().low, high=s.interval().high)


def statistics(values: Sequence[float]) -> Statistics:
    """Statistics of the finite values."""
    x = known(values)
    return _with_interval(len(x), x.mean(), ((x - x.mean()) ** 2).sum()) if len(x) else Statistics(0)


def line_statistics(degrees: Sequence[float]) -> Statistics:
    """Statistics of angles of lines [degrees], which repeat after 180.

    The mean is half the direction of the sum of the doubled unit vectors, in (-90, 90]. The deviation is that of the
    rotations from it. NaN: no mean direction. Source: Mardia and Jupp, Directional Statistics (2000), section 2.2.
    """
    x = known(degrees)
    total = np.exp(1j * np.radians(2 * x)).sum()
    if not abs(total) > 1e-9 * len(x):
        return Statistics(len(x))
    mean = float(line_turn(np.degrees(np.angle(total)) / 2, 0.0))
    return _with_interval(len(x), mean, (line_turn(x, mean) ** 2).sum(), LineStatistics)


def line_turn(a: float | np.ndarray, b: float | np.ndarray) -> float | np.ndarray:
    """Rotation from line b to line a [degrees], in (-90, 90]."""
    turn = np.subtract(a, b)
    turn = turn - 180.0 * np.rint(turn / 180.0)
    return np.where(turn <= -90, turn + 180, turn)


def known(values: Sequence[float]) -> np.ndarray:
    """The finite values."""
    x = np.asarray(values, float)
    return x[np.isfinite(x)]


@dataclass
class Difference:
    """Second minus first, pair by pair: number of pairs, and the mean with its 95 % and its 90 % interval."""

    n: int
    difference: Interval
    difference_90: Interval

    def with_errors(self, errors: Sequence[tuple[float, float]]) -> "Difference":
        """Intervals that hold further independent errors: (standard uncertainty, degrees of freedom). Half widths add
        in squares (Abernethy, Benedict and Dowdell, J. Fluids Eng. 107 (1985) 161)."""
        def wider(found: Interval, confidence: float) -> Interval:
            more = [student_quantile((1 + confidence) / 2, freedom) * u for u, freedom in errors]
            return Interval(found.value, found.value - math.hypot(found.value - found.low, *more),
                            found.value + math.hypot(found.high - found.value, *more))
        return Difference(self.n, wider(self.difference, 0.95), wider(self.difference_90, 0.90))

    def verdict(self, margin: float) -> str:
        """ "equivalent", "different" or "cannot tell"; without a pair "not in both panels".

        Equivalent by two one-sided tests at 5 %: the 90 % interval lies within (-margin, margin). Different: the 95 %
        interval lies beyond the margin. Source: Schuirmann, J. Pharmacokinet. Biopharm. 15 (1987) 657.
        """
        if not self.n:
            return "not in both panels"
        if self.difference_90.low > -margin and self.difference_90.high < margin:
            return "equivalent"
        return "different" if self.difference.low > margin or self.difference.high < -margin else "cannot tell"


def paired(first: Sequence[float], second: Sequence[float], kind: str = "absolute") -> Difference:
    """The difference of two lists whose entries k belong to one sample. Pairs without both values do not count.

    kind  "absolute": second - first; "line": the rotation [degrees]; "relative": (mean of second) / (mean of first) - 1
          with Fieller's interval, in which the scatter of the first counts, too. Its ends are NaN if the mean of the
          first does not differ significantly from 0. Sources: Fieller, J. R. Stat. Soc. B 16 (1954) 175; Hauschke et
          al., J. Biopharm. Stat. 9 (1999) 89.
    """
    a, b = np.asarray(first, float), np.asarray(second, float)
    both = np.isfinite(a) & np.isfinite(b)
    a, b = a[both], b[both]
    if kind == "relative":
        return Difference(len(a), _fieller(a, b, 0.95), _fieller(a, b, 0.90))
    s = line_statistics(line_turn(b, a)) if kind == "line" else statistics(b - a)
    return Difference(len(a), s.interval(), s.interval(0.90))


def _fieller(a: np.ndarray, b: np.ndarray, confidence: float) -> Interval:
    """The ratios q that Student's test of mean(b - q a) = 0 does not reject, less 1: between roots of a parabola."""
    n, (mean_a, mean_b) = len(a), (statistics(a).mean, statistics(b).mean)
    value = mean_b / mean_a - 1 if mean_a != 0 else math.nan
    if n < 2:
        return Interval(value, math.nan, math.nan)
    (s_aa, s_ab), (_, s_bb) = np.cov(a, b)
    g = student_quantile((1 + confidence) / 2, n - 1) ** 2 / n
    square, product, constant = mean_a**2 - g * s_aa, mean_a * mean_b - g * s_ab, mean_b**2 - g * s_bb
    if not square > 0:
        return Interval(value, math.nan, math.nan)
    root = math.sqrt(max(0.0, product**2 - square * constant))
    return Interval(value, (product - root) / square - 1, (product + root) / square - 1)


class Convergence(NamedTuple):
    """value = limit + coefficient h^order"""

    limit: float
    coefficient: float
    order: float


def fit_convergence(h: Sequence[float], values: Sequence[float]) -> Convergence | None:
    """Least squares over orders from 1/4 to 6 in steps of 0.01, for at least three different h > 0.

    None if the values follow no power law: the best order is at an end of the range, the rms residual exceeds a
    twentieth of their range, or all are equal. Source: Roache, J. Fluids Eng. 116 (1994) 405: observe the order.
    """
    sizes, y = np.asarray(h, float), np.asarray(values, float)
    if len(np.unique(sizes)) < 3 or not np.ptp(y) > 0:
        return None
    orders = 0.25 + 0.01 * np.arange(576)
    x = (sizes / sizes.max()) ** orders[:, None]  # scaled: powers of small numbers lose no digits
    dx = x - x.mean(axis=1, keepdims=True)
    coefficient = dx @ (y - y.mean()) / (dx**2).sum(axis=1)
    limit = y.mean() - coefficient * x.mean(axis=1)
    squares = ((y - limit[:, None] - coefficient[:, None] * x) ** 2).sum(axis=1)
    best = int(np.argmin(squares))
    if best in (0, len(orders) - 1) or math.sqrt(squares[best] / len(y)) > 0.05 * np.ptp(y):
        return None
    return Convergence(float(limit[best]), float(coefficient[best] / sizes.max() ** orders[best]), float(orders[best]))


def jackknife_convergence(h: Sequence[float], values: np.ndarray) -> tuple[Interval, Interval, float] | None:
    """(order, limit, coefficient) of values (points, samples), with jackknife intervals over the samples (Tukey).

    They are unknown below three samples, or if there is no power law without one of them.
    """
    fit, n = fit_convergence(h, values.mean(axis=1)), values.shape[1]
    if fit is None:
        return None
    parts = [fit_convergence(h, np.delete(values, k, axis=1).mean(axis=1)) for k in range(n)] if n > 2 else [None]
    half = np.full(3, np.nan)
    if None not in parts:
        half = student_quantile(0.975, n - 1) * (n - 1) / math.sqrt(n) * np.std(parts, axis=0, ddof=1)
    limit, _, order = (Interval(value, value - reach, value + reach) for value, reach in zip(fit, half))
    return order, limit, fit.coefficient


def words_of(verdict: dict[str, Any]) -> str:
    """A verdict of ensemble.json with its margin, such as "equivalent within 5 %"."""
    margin = f"{100 * verdict['margin']:g} %" if verdict["relative"] else f"{verdict['margin']:g}"
    word = verdict["verdict"]
    return {"equivalent": f"equivalent within {margin}", "different": f"different by more than {margin}",
            "cannot tell": f"cannot tell (margin {margin})"}.get(word, word)
