# diptych: least squares of a calibration
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The search works in the unit cube, where every residual needs a run. scipy's dogleg with bounds ("dogbox") does
Gauss-Newton steps in a trust region. The Jacobian comes from forward differences, which run in parallel, and Broyden's
rank-one update follows the accepted steps."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
import scipy.optimize
import scipy.stats

from ...arrays import Array

Residuals = Callable[[Sequence[Array]], "list[Array]"]  # of several points at once; NaN: the run failed
DIFFERENCE = 0.005  # step of the forward differences; backward at the upper bound
GRAINS_DIFFERENCE = 0.12  # the same where runs scatter; 0.1 of a friction of 0.4 between 0.1 and 0.9
SMALLEST_STEP = 0.02  # of the search, in differences; the runs do not resolve a smaller one
LEAST_GAIN, LEAST_DECREASE = 0.05, 1e-3  # of chi^2, absolute and relative: below either, a search has converged
RADIUS_OF_FRESH, RADIUS_OF_GIVEN = 0.25, 0.1  # of the first trust region, with a Jacobian computed here or given
EXACT = 1e-6  # mean square of the residuals below which the fit is exact
MOST_STEPS = 6  # of a search with one Jacobian and its updates
PRIOR = 0.25  # deviation of every coordinate before the data
NORMAL = float(scipy.stats.norm.ppf(0.975))


def difference_jacobian(residuals: Residuals, point: Array, residual: Array, difference: float = DIFFERENCE) -> Array:
    """(residuals, parameters): differences around a point, from the other side if a run fails, zero if both fail."""
    def columns(numbers: Sequence[int], steps: Array) -> Array:
        values = residuals([point + steps[k] * np.eye(len(point))[k] for k in numbers])
        return np.array([(value - residual) / steps[k] for k, value in zip(numbers, values)])

    steps = np.where(point + difference <= 1, difference, -difference)
    jacobian = columns(range(len(point)), steps)
    failed = [k for k in range(len(point)) if not np.isfinite(jacobian[k]).all() and 0 <= point[k] - steps[k] <= 1]
    if failed:
        jacobian[failed] = columns(failed, -steps)
    jacobian[~np.isfinite(jacobian).all(1)] = 0
    return jacobian.T


class _Ended(Exception):
    """Ends a search with one Jacobian."""


@dataclass(kw_only=True)
class Fit:
    """Best point, its residuals and d residual / d point. note: the reason if the search did not converge."""

    point: Array
    residual: Array = field(default_factory=lambda: np.array([np.nan]))
    jacobian: Array | None = None
    evaluations: int = 0
    jacobians: int = 0  # computed by differences
    note: str = ""

    @property
    def chi2(self) -> float:
        """Sum of squares; infinite if the start has no run."""
        return float(self.residual @ self.residual) if np.isfinite(self.residual).all() else np.inf

    @property
    def is_exact(self) -> bool:
        return self.chi2 < EXACT * len(self.residual)


class _Search:
    """Steps with one Jacobian, fresh or old, and its updates. Steps below `shortest` do not update it: they show the
    scatter of the runs and not their slope."""

    def __init__(self, residuals: Residuals, fit: Fit, shortest: float) -> None:
        self.residuals, self.fit, self.shortest = residuals, fit, shortest
        self.trial, self.failed, self.fresh = (fit.point, fit.residual), False, False

    def value(self, x: Array) -> Array:
        if np.array_equal(x, self.fit.point):
            return self.fit.residual
        if self.trial[0] is not self.fit.point:  # scipy rejected the step before
            self.failed = True
            if not self.fresh:
                raise _Ended
        if np.linalg.norm(x - self.fit.point) < SMALLEST_STEP * self.shortest:
            raise _Ended
        self.trial = (x.copy(), self.residuals([x])[0])
        self.fit.evaluations += 1
        return self.trial[1]

    def jacobian(self, x: Array) -> Array:
        """scipy asks for it at the start and at every accepted step."""
        fit = self.fit
        if not np.array_equal(x, fit.point):
            step, change = self.trial[0] - fit.point, self.trial[1] - fit.residual
            gain, before = fit.chi2 - self.trial[1] @ self.trial[1], fit.chi2
            if step @ step >= self.shortest**2:
                fit.jacobian = fit.jacobian + np.outer(change - fit.jacobian @ step, step) / (step @ step)
            fit.point, fit.residual = self.trial
            self.fresh = False
            if gain < max(LEAST_GAIN, LEAST_DECREASE * before) or fit.is_exact:
                raise _Ended
        self.trial = (fit.point, fit.residual)
        return fit.jacobian

    def run(self, fresh: bool) -> bool:
        """True if no step was rejected and the last one lowered chi^2 no more."""
        self.fresh, settled = fresh, True
        start, radius = self.fit.point, RADIUS_OF_FRESH if fresh else RADIUS_OF_GIVEN

        def point(y: Array) -> Array:  # from 0 on, scipy's first trust region is 1
            return np.clip(start + radius * y, 0, 1)

        try:
            found = scipy.optimize.least_squares(
                lambda y: self.value(point(y)), np.zeros_like(start), lambda y: radius * self.jacobian(point(y)),
                bounds=(-start / radius, (1 - start) / radius), method="dogbox", x_scale=1.0, ftol=None, gtol=1e-10,
                xtol=None, max_nfev=MOST_STEPS + 1)
            settled = found.status != 0  # 0: the steps ran out
        except _Ended:
            pass
        if self.trial[0] is not self.fit.point:
            self.failed = True
        return settled and not self.failed


def least_squares(residuals: Residuals, start: Array, most_jacobians: int = 4, jacobian: Array | None = None,
                  difference: float = DIFFERENCE) -> Fit:
    """Minimises the sum of squares within [0, 1]^n. A given Jacobian is used until a step fails or the steps run out;
    then a new one is computed. A point without a run counts as a failed step. If `start` has no run, `note` says so.
    Exceptions of `residuals` pass through."""
    fit = Fit(point=np.clip(np.asarray(start, dtype=float), 0, 1), evaluations=1)
    fit.residual = residuals([fit.point])[0]
    if not np.isfinite(fit.residual).all():
        fit.note = "the run at the start failed"
        return fit
    fit.jacobian = jacobian
    while True:
        fresh = fit.jacobian is None or fit.jacobians > 0
        if fresh:
            if fit.jacobians >= most_jacobians:
                fit.note = f"the last of {fit.jacobians} Jacobians still lowered chi^2; the search has not converged"
                return fit
            fit.jacobian = difference_jacobian(residuals, fit.point, fit.residual, difference)
            fit.evaluations, fit.jacobians = fit.evaluations + len(fit.point), fit.jacobians + 1
        before = fit.chi2
        went_well = fit.is_exact or _Search(residuals, fit, difference).run(fresh)
        if (fresh and before - fit.chi2 < max(LEAST_GAIN, LEAST_DECREASE * before)) or (not fresh and went_well):
            return fit
        if not fresh:
            fit.jacobian = None


def spread_point(k: int, n: int) -> Array:
    """(n): the k-th point of the Halton sequence, in the middle four fifths of the cube."""
    return 0.1 + 0.8 * scipy.stats.qmc.Halton(n, scramble=False).fast_forward(k).random(1)[0]
