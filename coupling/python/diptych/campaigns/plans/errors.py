# diptych: estimates errors and numbers of samples of a plan from a few cheap runs
# SPDX-License-Identifier: LGPL-2.1-or-later
"""All errors are relative to the mean; those of angles are relative to 45 degrees."""

from bisect import bisect_left
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..runs.statistics import Statistics, line_statistics, line_turn, statistics, student_quantile

LEAST_ORDER, LARGEST_ORDER, LEAST_SHARE_OF_EARLIER_CHANGE = 0.5, 2.0, 0.25
OF_ONE_SAMPLE = 3.18  # Student's factor for a deviation known from four samples
STILL_CONVERGING = 0.8  # of the change before; with slower convergence there may be no limit
MOST_SAMPLES = 1_000_000
COARSEST_ACCURACY, FINEST_ACCURACY = 0.05, 0.001  # of discrete/accuracy
MOST_SAMPLES_OF_A_PLAN = 2000  # if more are needed, larger samples are better
UNIT_OF_ANGLES = 45.0  # [degrees]


class Estimate(NamedTuple):
    """A number with its uncertainty."""

    mean: float
    deviation: float


def improved(prior: Estimate, evidence: Iterable[tuple[float, float, float]]) -> Estimate:
    """The factor measured / expected: the prior updated with (expected, measured, standard error) of differences
    (Gaussian, conjugate). Evidence without a standard error, or with an expected difference of 0, does not count."""
    weight = prior.deviation**-2
    total = prior.mean * weight
    for expected, measured, error in evidence:
        if error > 0 and expected != 0:
            more = (expected / error) ** 2
            weight, total = weight + more, total + more * measured / expected
    return Estimate(total / weight, weight**-0.5)


@dataclass(kw_only=True)
class Refinement:
    """Convergence of a quantity with a size: error = finest x (size / finest size)^order."""

    finest_size: float
    error: float = np.nan  # at the finest size, >= 0, in the unit of the values; NaN for less than two values
    order: float = 1.0
    sign: float = 0.0  # +1: coarse values lie above the limit
    converges: bool = True  # the last change is clearly smaller than the one before

    def error_at(self, size: float) -> float:
        return self.error * (size / self.finest_size) ** self.order

    def size_for(self, error: float) -> float:
        """The size with this error; infinite if nothing changes."""
        return self.finest_size * (error / self.error) ** (1 / self.order) if self.error > 0 else np.inf


def refinement(sizes: Sequence[float], values: Sequence[float]) -> Refinement:
    """sizes: descending, one value each. With three or more values the order follows from the last two changes; with
    two it is 1. A change that is small by chance counts at least a quarter of the one before."""
    result = Refinement(finest_size=sizes[-1])
    if len(values) < 2:
        return result
    ratio, last = sizes[-2] / sizes[-1], abs(values[-1] - values[-2])
    result.sign = float(np.sign(values[-2] - values[-1]))
    if len(values) > 2:
        earlier = abs(values[-2] - values[-3])
        result.converges = last <= STILL_CONVERGING * earlier
        if last > 0 and earlier > 0:
            result.order = float(np.clip(np.log(earlier / last) / np.log(ratio), LEAST_ORDER, LARGEST_ORDER))
        last = max(last, LEAST_SHARE_OF_EARLIER_CHANGE * earlier)
    result.error = last / (ratio**result.order - 1)
    return result


def half_interval(deviation: float, n: int) -> float:
    """Half the 95 % Student interval of the mean of n samples. For n = 1 four samples gave the deviation."""
    return float(OF_ONE_SAMPLE * deviation if n < 2 else student_quantile(0.975, n - 1) * deviation / np.sqrt(n))


def samples_for(deviation: float, half: float) -> int:
    """Smallest number of samples for an interval below `half`; 0 beyond a million, or for an unknown deviation."""
    if not (half > 0 and deviation >= 0):
        return 0
    if half_interval(deviation, 1) <= half:
        return 1
    n = bisect_left(range(MOST_SAMPLES), -half, lo=2, key=lambda n: -half_interval(deviation, n))
    return n if n < MOST_SAMPLES else 0


def summary_of(values: Sequence[float], is_line: bool) -> tuple[Statistics, float]:
    """Statistics of the samples that have a value, and the relative scatter of one sample (NaN below two)."""
    found = (line_statistics if is_line else statistics)(values)
    return found, found.deviation / (UNIT_OF_ANGLES if is_line else abs(found.mean))


def relative_difference(values: Sequence[float], others: Sequence[float], is_line: bool) -> Statistics:
    """Differences values - others, sample by sample, relative to the mean of the others, or to 45 degrees."""
    a, b = np.array(list(zip(values, others)), float).reshape(-1, 2).T
    if is_line:
        return statistics(line_turn(a, b) / UNIT_OF_ANGLES)
    return statistics((a - b) / abs(statistics(b[np.isfinite(a)]).mean))


def rounded_to_two_digits(number: float) -> float:
    return float(f"{number:.2g}")


def cost_at(measured: Sequence[tuple[float, float]], accuracy: float) -> float:
    """CPU s of one sample: interpolates (discrete/accuracy, CPU s) with descending accuracies, and extrapolates along
    the line through the two nearest points in logarithms."""
    k = 1
    while k + 1 < len(measured) and accuracy < measured[k][0]:
        k += 1
    (a, cost_a), (b, cost_b) = measured[k - 1:k + 1]
    return cost_b * (b / accuracy) ** (np.log(cost_b / cost_a) / np.log(a / b))


@dataclass
class GrainErrors:
    """Errors of a quantity: proportional to discrete/accuracy, and the relative scatter of one sample."""

    step: Estimate  # at discrete/accuracy 1
    scatter: float
    from_a_rule: bool  # False: the deviation of the estimate counts as an error, too

    def at(self, accuracy: float) -> float:
        return accuracy * (abs(self.step.mean) if self.from_a_rule else float(np.hypot(*self.step)))


def cheapest_choice(errors: Sequence[GrainErrors], cost: Callable[[float], float], target: float,
                    samples: int) -> tuple[float, int]:
    """(discrete/accuracy, samples) of least cost; 0: no number suffices. `samples`: their fixed number, or 0."""
    best, least = (0.0, 0), np.inf
    for k in range(24):
        accuracy = max(FINEST_ACCURACY, rounded_to_two_digits(COARSEST_ACCURACY * 2 ** (-k / 4)))
        left = [target - one.at(accuracy) for one in errors]
        needed = [samples or samples_for(one.scatter, rest) for one, rest in zip(errors, left)]
        n = max(1, samples, *needed)
        if min(left) > 0 and min(needed) > 0 and n <= MOST_SAMPLES_OF_A_PLAN and n * cost(accuracy) < least:
            best, least = (accuracy, n), n * cost(accuracy)
    return best
