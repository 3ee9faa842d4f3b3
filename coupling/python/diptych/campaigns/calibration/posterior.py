# diptych: the posterior of a calibration: parameters, size and correlation of the discrepancy, scatter of the samples
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The data are emulator + discrepancy + scatter (Kennedy & O'Hagan, J. R. Stat. Soc. B 63 (2001) 425). The discrepancy
of t/s and volume is a process over strain, independent between paths; the data of all paths tell its size and its
correlation length. emcee samples them with the parameters and the variances that a few samples gave."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import scipy.linalg
import scipy.spatial
import scipy.stats

try:
    import emcee
except ImportError as error:
    raise ImportError("diptych calibrate needs the Python package emcee; install python3-emcee (Debian)") from error

from ...arrays import Array
from ..runs.coordinates import Coordinates
from .emulator import Emulator
from .noise import KINDS, Data, FittedData, discrepancy, tolerance_covariance
from .search import PRIOR, Fit
from .trials import Trials

SPREAD = 0.7  # deviation of ln(size) and of ln(correlation strain) before the data: a factor of two
SHARE_OF_STRAIN = 0.25  # correlation strain of the discrepancy before the data / largest strain
# With a sampled factor if samples gave them: one number a sample. The other deviations have one in every bin.
SCALED = ("stress_level", "volume_growth", "profile_stretch")
WALKERS, DRAWS = 48, 1000
STEPS = 1500  # of the sampling
MORE_RUNS, SHORT = 20, 500  # coarse runs at points of the posterior, after so many steps of a first sampling
CANDIDATES, HEAT = 1000, 3.0  # for the starts of the walkers; they are drawn with the posterior^(1 / heat)
FARTHEST, LARGE = 6.0, 1e30  # ln of a factor of a variance: two samples bound it nowhere; a number without effect


@dataclass(kw_only=True)
class Draws:
    """Thinned draws of the posterior. points: (draws, parameters). sizes: (draws, 3), the factors of the tolerance of
    t/s and of volume, and the correlation strain. strain: correlation strain before the data. curve: (2, observables),
    the discrepancy model - truth and its deviation; NaN: does not count. autocorrelation: in steps. mode: the most
    probable of the points."""

    points: Array
    mode: Array
    sizes: Array
    strain: float
    curve: Array
    acceptance: float
    autocorrelation: float


class Posterior:
    """Log-probability of points (n, parameters + 3 + 3): logarithms of the factors of t/s and volume, of the
    correlation strain / its value before, and of three variances follow. It is zero where the nearest run failed."""

    def __init__(self, data: FittedData, coordinates: Coordinates, points: Array, is_fine: Array,
                 values: Array) -> None:
        """points, is_fine, values: of all runs; a value is NaN if its run failed."""
        self.start, self.used = coordinates.start, data.used
        good = np.isfinite(values[:, self.used]).all(1)
        self.emulator = emulator = Emulator(points[good], is_fine[good], values[good][:, self.used])
        self._failed, self._nearest = ~good, scipy.spatial.KDTree(points / emulator.lengths)
        square = np.ix_(self.used, self.used)

        def of_all(values: Callable[[Data], Array]) -> Array:
            return np.concatenate([values(path) for path in data.paths])[self.used]

        noise, x = data.noise, of_all(lambda path: path.middles)
        variance = of_all(lambda path: discrepancy(noise, path))
        self.mean, self.strain = data.mean[self.used], SHARE_OF_STRAIN * x.max()
        self._far = np.abs(x[:, None] - x) / self.strain
        stress, volume = (of_all(lambda path, kind=kind: path.of(kind)) for kind in KINDS[:2])
        same_path = scipy.linalg.block_diag(*[np.ones((len(path.observables),) * 2) for path in data.paths])[square]
        self._sizes = [same_path * np.outer(of, of) * np.sqrt(np.outer(variance, variance)) for of in (stress, volume)]
        self._scatter = [data.of_scatter([key] if key in noise.estimated else [])[square] for key in SCALED]
        self.freedom = np.array([noise.degrees_of_freedom if part.any() else 0 for part in self._scatter])
        everything = data.of_means()[square]
        of_paths = [tolerance_covariance(path, discrepancy(noise, path)) for path in data.paths]
        tolerance = scipy.linalg.block_diag(*of_paths)[square] * np.outer(~(stress | volume), ~(stress | volume))
        self._fixed = everything - sum(self._scatter) + tolerance + np.diag(1e-9 * np.diag(everything))
        self.left_out = emulator.left_out / np.sqrt(np.diag(everything) + variance)  # in deviations of the data

    def _parts(self, z: Array) -> tuple[Array, Array, Array]:
        """Residual emulator - data (n, observables), its covariance, and the discrepancy's part of that."""
        n = len(self.start)
        values, factor = self.emulator.predict(z[:, :n])
        stress, volume, strain = np.exp(z[:, n:n + 3].T)[..., None, None]
        of_law = (stress**2 * self._sizes[0] + volume**2 * self._sizes[1]) * np.exp(-self._far / strain)
        q = np.exp(z[:, n + 3:, None, None])
        everything = self._fixed + of_law + sum(q[:, k] * part for k, part in enumerate(self._scatter))
        return values - self.mean, everything + factor[:, None, None] * self.emulator.covariance, of_law

    def prior(self, z: Array) -> Array:
        """Logarithm of the prior (n)."""
        n = len(self.start)
        found = -0.5 * (((z[:, :n] - self.start) / PRIOR) ** 2).sum(1) - 0.5 * (z[:, n:n + 3] ** 2).sum(1) / SPREAD**2
        q, nu = z[:, n + 3:], self.freedom
        # freedom / factor of a variance has a chi^2 distribution. A factor that scales nothing has a normal prior.
        found += np.where(nu > 0, -0.5 * nu * (q + np.exp(-q)), -0.5 * q**2).sum(1)
        outside = ((z[:, :n] < 0) | (z[:, :n] > 1)).any(1) | (np.abs(q) > FARTHEST).any(1)
        return np.where(outside, -np.inf, found)

    def __call__(self, z: Array) -> Array:
        found = self.prior(z)
        found[self._failed[self._nearest.query(z[:, :len(self.start)] / self.emulator.lengths)[1]]] = -np.inf
        inside = np.isfinite(found)
        residual, covariance, _ = self._parts(z[inside])
        n, m = residual.shape
        bordered = np.empty((n, m + 1, m + 1))  # the last row of its root is (root of covariance)^-1 residual
        bordered[:, :m, :m], bordered[:, m, m] = covariance, LARGE
        bordered[:, m, :m] = bordered[:, :m, m] = residual
        root = np.linalg.cholesky(bordered)
        found[inside] -= 0.5 * (root[:, m, :m] ** 2).sum(1) + np.log(np.diagonal(root, axis1=1, axis2=2)[:, :m]).sum(1)
        return found

    def sample(self, best: Array, jacobian: Array, seed: int, steps: int) -> Draws:
        """Walkers start at probable points, drawn around the best point of the search, as far as its Jacobian with the
        prior tells, and from the prior, which may hold a better valley. The second half of their steps is kept."""
        random, n = np.random.RandomState(seed), len(best)
        points = np.vstack([random.multivariate_normal(best, np.linalg.inv(jacobian.T @ jacobian), CANDIDATES),
                            random.normal(self.start, PRIOR, (CANDIDATES, n))])
        start = np.hstack([np.clip(points, 0.001, 0.999), 0.2 * random.normal(size=(len(points), 3 + len(SCALED)))])
        start = start[np.argsort(self(start) / HEAT + random.gumbel(size=len(start)))[-WALKERS:]]
        sampler = emcee.EnsembleSampler(WALKERS, start.shape[1], self, vectorize=True,
                                        moves=[(emcee.moves.DEMove(), 0.8), (emcee.moves.DESnookerMove(), 0.2)])
        sampler.run_mcmc(emcee.State(start, random_state=random.get_state()), steps)
        flat = sampler.get_chain(discard=steps // 2, flat=True)
        at = np.linspace(0, len(flat) - 1, DRAWS).astype(int)
        z, mode = flat[at], flat[at[np.argmax(sampler.get_log_prob(discard=steps // 2, flat=True)[at])], :n]
        residual, covariance, of_law = self._parts(z)
        gain = np.linalg.solve(covariance, of_law).swapaxes(1, 2)
        means = (gain @ residual[..., None])[..., 0]
        left, curve = np.diagonal(of_law - gain @ of_law, axis1=1, axis2=2), np.full((2, len(self.used)), np.nan)
        curve[:, self.used] = means.mean(0), np.sqrt(means.var(0) + left.mean(0))
        return Draws(points=z[:, :n], mode=mode, sizes=np.exp(z[:, n:n + 3]) * [1, 1, self.strain], strain=self.strain,
                     curve=curve, acceptance=float(sampler.acceptance_fraction.mean()),
                     autocorrelation=float(sampler.get_autocorr_time(tol=0, quiet=True)[:n].max()))


def sample_posterior(trials: Trials, fit: Fit) -> Draws:
    """The posterior by an emulator of all runs. A first, short sampling tells where more coarse runs improve it."""
    n = trials.calibration.more_runs or min(MORE_RUNS, 3 * len(fit.point))
    first = _posterior(trials).sample(fit.point, fit.jacobian, trials.calibration.seed, SHORT)
    more = first.points[np.linspace(0, len(first.points) - 1, n).astype(int)]
    failed = sum(any(one.failure for one in runs) for runs in trials.runs(more, trials.fitted, False, "coarse_runs"))
    if failed:
        trials.record["words"].append(f"{failed} of {n} runs at draws of the posterior failed; it omits what is "
                                      "nearest to them")
    posterior = _posterior(trials)
    draws = posterior.sample(fit.point, fit.jacobian, trials.calibration.seed, STEPS)
    trials.record["emulator"] = {
        "runs": len(posterior.emulator.points), "more_runs": n, "failed": failed, "acceptance": draws.acceptance,
        "steps": STEPS, "autocorrelation": draws.autocorrelation,
        "left_out": float(np.sqrt(np.mean(posterior.left_out[~posterior.emulator.is_fine.astype(bool)][-n:] ** 2)))}
    return draws


def confirmed(trials: Trials, fit: Fit, draws: Draws, is_fine: bool) -> Fit:
    """The most probable point instead of that of the search, if a run there shows that it lies in the joint 95 % region
    of the search, which ignores the scatter common to all bins and the correlation of the discrepancy."""
    residual = trials.residuals(is_fine)([draws.mode])[0]
    fits = np.isfinite(residual).all() and residual @ residual < fit.chi2 + scipy.stats.chi2.ppf(0.95, len(fit.point))
    return replace(fit, point=draws.mode, residual=residual) if fits else fit


def _posterior(trials: Trials) -> Posterior:
    return Posterior(trials.data, trials.coordinates, *(np.array(column) for column in zip(*trials.tried)))
