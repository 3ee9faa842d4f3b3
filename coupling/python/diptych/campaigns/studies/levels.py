# diptych: means in the limit of short steps from many cheap samples and a few pairs with a finer setting
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Two-level means. X[i] is the value of sample i at a cheap setting (long steps), i = 1 ... N. Y[i] is that of the same
sample at a fine setting, for n of the samples. Both settings have a bias, which is proportional to an expected error e,
the entry expected_strength_error of provenance.json. The dilation takes the same e: its bias has two parts of opposite
sign, which both fall with discrete/accuracy nearly as e does, and whose sum would give no ratio. With r = e(fine) /
e(cheap) the estimate of the limit is

    mean of X over all N  -  w x mean of (X - Y) over the n pairs,     w = 1 / (1 - r).

The first mean has the scatter of the samples, which falls with N; the second has only that of the differences. The
variance of the estimate is v_many / N + v_pairs / n with v_many = var X - 2 w cov(X, X - Y) and v_pairs = w^2 var(X -
Y). For a given cost it is least if n / N = sqrt((v_pairs / c_fine) / (v_many / c_cheap)), c the cost of a run.

Sources: Giles, Operations Research 56 (2008) 607; weights: Lemaire and Pages, Bernoulli 23 (2017) 2643.
"""

import math
from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..runs.statistics import Interval, student_quantile

CHEAP, FINE = 0.05, 0.01  # discrete/accuracy of --levels auto
LEAST_PAIRS = 6  # of the pilot and of every estimate; four leave too many intervals too narrow (benchmarks/rigid_limit)
MOST_RATIO = 0.8  # of the expected errors: closer settings leave too much to the extrapolation
# Standard deviation of the order of the bias in the step / the order: 0.5 +- 0.1 (benchmarks/rigid_limit).
ORDER_DEVIATION = 0.2


def weight_of(ratio: float) -> float:
    """Factor of the pairs' difference. ratio: expected error of the fine setting / that of the cheap one, in (0, 1)."""
    return 1 / (1 - ratio)


def order_error(ratio: float, difference: float) -> float:
    """Standard error of the limit due to the order. An order p instead of q makes the ratio r^(p / q)."""
    weights = [weight_of(ratio ** (1 + sign * ORDER_DEVIATION)) for sign in (-1, 1)]
    return abs(difference) * (weights[0] - weights[1]) / 2


class Variances(NamedTuple):
    """The limit has the variance many / N + pairs / n, and in addition order^2. Squares of the unit of the values."""

    many: float
    pairs: float
    order: float  # standard error

    def share(self, costs: tuple[float, float]) -> float:
        """n / N that gives the least variance for the cost. costs: of one run, cheap and fine."""
        if self.many <= 0:  # the noise of the runs dominates: only pairs help
            return 1.0
        return min(1.0, math.sqrt(self.pairs / costs[1] / (self.many / costs[0])))

    def half_interval(self, n_cheap: int, n_pairs: int) -> float:
        """Half the 95 % interval of the limit."""
        # Sum of two independent groups: the pairs with all of their variance, the other samples with that of X.
        of_rest = max(self.many, 0.0) / n_cheap
        of_pairs = self.pairs / n_pairs
        return _half_interval((of_pairs, n_pairs), (of_rest, n_cheap), self.order)


def _half_interval(pairs: tuple[float, int], rest: tuple[float, int], order: float, confidence: float = 0.95) -> float:
    """pairs, rest: (variance of their part, samples that tell it). Degrees of freedom by Welch and Satterthwaite."""
    square, probability = pairs[0] + rest[0], (1 + confidence) / 2
    of_order = student_quantile(probability, math.inf) * order
    if square == 0:
        return of_order
    freedom = square**2 / sum(variance**2 / (n - 1) for variance, n in (pairs, rest))
    return math.hypot(student_quantile(probability, freedom) * math.sqrt(square), of_order)


def _pairs(cheap: Sequence[float], fine: Sequence[float]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """All known X, and X and Y of the pairs."""
    x, y = np.asarray(cheap, float), np.asarray(fine, float)
    both = np.isfinite(x) & np.isfinite(y)
    return x[np.isfinite(x)], x[both], y[both]


def variances(cheap: Sequence[float], fine: Sequence[float], ratio: float) -> Variances:
    """cheap, fine: as in limit_of(), at least two pairs. cov(X, X - Y) is taken as var(X - Y) / 2: the runs of a sample
    diverge by chance, equally far at both settings. The covariance of a few pairs would be too uncertain."""
    known, x, y = _pairs(cheap, fine)
    return predicted(float(known.var(ddof=1)), float((x - y).var(ddof=1)), ratio, float((x - y).mean()))


def predicted(scatter: float, divergence: float, ratio: float, difference: float) -> Variances:
    """From var X, var(X - Y), the ratio of the expected errors and the mean difference."""
    w = weight_of(ratio)
    return Variances(scatter - w * divergence, w**2 * divergence, order_error(ratio, difference))


def numbers_for(found: Sequence[Variances], costs: tuple[float, float], half: float, most: int) -> tuple[int, int]:
    """The cheapest (N, n) whose 95 % intervals are all narrower than +- half; (0, 0): more than `most` samples."""
    share = max(one.share(costs) for one in found)

    def pairs(n: int) -> int:
        return min(n, max(LEAST_PAIRS, math.ceil(share * n)))

    def suffices(n: int) -> bool:
        return all(one.half_interval(n, pairs(n)) <= half for one in found)

    n = bisect_left(range(most), True, lo=LEAST_PAIRS, key=suffices)
    return (n, pairs(n)) if n < most else (0, 0)


@dataclass(kw_only=True)
class Limit:
    """A mean in the limit of short steps. Standard errors are those of the limit, in its unit."""

    n: int  # cheap samples
    pairs: int
    ratio: float
    cheap: float  # mean of the cheap samples
    difference: float  # mean of cheap - fine over the pairs
    limit: Interval  # with its interval
    error_samples: float  # scatter of samples and differences
    error_order: float


def limit_of(cheap: Sequence[float], fine: Sequence[float], ratio: float, confidence: float = 0.95) -> Limit:
    """The two-level mean. cheap, fine: values whose entries k belong to one sample; NaN where a sample has none.

    The interval holds the scatter of the samples, that of the differences with its weight, their covariance and the
    order. NaN for less than two pairs."""
    known, x, y = _pairs(cheap, fine)
    n, m, w = len(known), len(x), weight_of(ratio)
    if m < 2:
        mean = float(known.mean()) if n else math.nan
        return Limit(n=n, pairs=m, ratio=ratio, cheap=mean, difference=math.nan,
                     limit=Interval(math.nan, math.nan, math.nan), error_samples=math.nan, error_order=math.nan)
    # A sample with a pair adds z to the estimate, any other sample x / n. The two groups are independent.
    z = x / n - w * (x - y) / m
    difference, cheap_mean = float((x - y).mean()), float(known.mean())
    value = cheap_mean - w * difference
    of_pairs, of_rest = m * float(z.var(ddof=1)), (n - m) * float(known.var(ddof=1)) / n**2
    order = order_error(ratio, difference)
    half = _half_interval((of_pairs, m), (of_rest, n), order, confidence)
    limit = Interval(value, value - half, value + half)
    return Limit(n=n, pairs=m, ratio=ratio, cheap=cheap_mean, difference=difference, limit=limit,
                 error_samples=math.sqrt(of_pairs + of_rest), error_order=order)
