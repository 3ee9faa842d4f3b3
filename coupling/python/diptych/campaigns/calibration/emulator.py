# diptych: an emulator of the runs of a calibration: their observables at any point of the unit cube
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A Gaussian process with a Matern 5/2 correlation, common to all observables. Runs on the coarse mesh carry it. Those
on the samples' own mesh add the difference between the meshes, a process of the same form (Kennedy & O'Hagan,
Biometrika 87 (2000) 1). Correlation lengths maximise the likelihood. Left-out runs check the variance."""

import numpy as np
import scipy.linalg
import scipy.optimize

from ...arrays import Array

LENGTHS, MESHES, NUGGET = (0.1, 20.0), (1e-6, 1.0), (1e-8, 1.0)  # ranges; the last two: variances / the process's


class Emulator:
    """points: (runs, parameters) in the unit cube; is_fine: (runs), own mesh; values: (runs, observables)."""

    def __init__(self, points: Array, is_fine: Array, values: Array) -> None:
        self.points, self.is_fine, n = points, np.asarray(is_fine, dtype=float), points.shape[1]
        self.offset = values.mean(0)
        y = values - self.offset
        self._squares, self._scaled = (points[:, None] - points) ** 2, y / np.maximum(y.std(0), 1e-12)
        self._logs = scipy.optimize.minimize(self._cost, np.log([1.0] * n + [1e-2, 1e-4]), method="L-BFGS-B",
                                             bounds=np.log([LENGTHS] * n + [MESHES, NUGGET]), options={"maxiter": 60}).x
        self.lengths = np.exp(self._logs[:n])
        self._inverse = np.linalg.inv(self._covariance(self._logs))
        self._alpha = self._inverse @ y
        variance = 1 / np.diag(self._inverse)[:, None]  # of each run, given the others
        self.left_out = self._alpha * variance  # (runs, observables): error of each run, predicted from the others
        process = y.T @ self._alpha / len(y)
        squares = self.left_out**2 / (variance * np.maximum(np.diag(process), 1e-30))
        self.covariance = process * squares.mean()  # (observables, observables): errors as large as those left out

    def _correlation(self, squares: Array, fine: Array, logs: Array) -> Array:
        r = np.sqrt(5 * squares @ np.exp(-2 * logs[:-2]))
        return (1 + (1 + r + r**2 / 3) * np.exp(-r)) * (1 + np.exp(logs[-2]) * fine)  # 1: an unknown mean

    def _covariance(self, logs: Array) -> Array:
        found = self._correlation(self._squares, np.outer(self.is_fine, self.is_fine), logs)
        return found + np.exp(logs[-1]) * np.eye(len(found))

    def _cost(self, logs: Array) -> float:
        """-2 ln likelihood / number of observables, with the best variance of every observable."""
        root = scipy.linalg.cholesky(self._covariance(logs), lower=True)
        squares = (scipy.linalg.solve_triangular(root, self._scaled, lower=True) ** 2).sum(0)
        return float(len(root) * np.log(np.maximum(squares, 1e-30)).mean() + 2 * np.log(np.diag(root)).sum())

    def predict(self, points: Array) -> tuple[Array, Array]:
        """(points, observables) on the samples' own mesh, if there was a run on it; and (points): the factor of
        `covariance` that gives the covariance of their error."""
        fine = self.is_fine.max()
        k = self._correlation((points[:, None] - self.points) ** 2, fine * self.is_fine, self._logs)
        largest = 2 * (1 + np.exp(self._logs[-2]) * fine) + np.exp(self._logs[-1])
        return self.offset + k @ self._alpha, np.maximum(largest - ((k @ self._inverse) * k).sum(1), 0)
