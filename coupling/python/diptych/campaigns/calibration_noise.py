# diptych: observables of a calibration, scatter of the samples, and the weights that follow from it
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A few samples cannot give a full covariance, so the scatter of one sample has a fixed form. The curve t/s is shifted as a
whole (level) and varies locally, correlated in strain (shape). Volume has a constant scatter and one in proportion to strain.
Widths scatter independently. A measured curve may bring deviations of its own, which replace this form."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ..arrays import Array

KINDS = ("stress_ratio", "volumetric_strain", "ln_width")
ESTIMATED = {"stress_ratio": ("stress_level", "stress_shape"), "volumetric_strain": ("volume_start", "volume_growth"),
             "ln_width": ("ln_width",)}


@dataclass(frozen=True)
class Observable:
    """One number by which grains and continuum are compared: a mean over a bin of the progress, or ln of a width in a
    window."""

    kind: str
    low: float
    high: float

    @property
    def middle(self) -> float:
        return 0.5 * (self.low + self.high)


@dataclass
class NoiseOptions:
    """Values of the user replace the estimates; the others are the model tolerance, the misfit that the form of the law may
    have."""

    stress_level: float | None = None
    stress_shape: float | None = None
    volume_start: float | None = None
    volume_growth: float | None = None
    ln_width: float | None = None
    correlation_strain: float = 0.005
    stress_discrepancy: float = 0.008
    early_stress_discrepancy: float = 0.03
    early_strain: float = 0.002
    volume_discrepancy: float = 0.0008
    width_discrepancy: float = 0.1


@dataclass
class NoiseModel:
    """Standard deviations of one sample. degrees_of_freedom: samples minus paths; 0: nothing was estimated."""

    stress_level: float = 0.0
    stress_shape: float = 0.0
    volume_start: float = 0.0
    volume_growth: float = 0.0
    ln_width: float = 0.0
    correlation_strain: float = 0.005
    degrees_of_freedom: int = 0


@dataclass
class Data:
    """The samples of one path. values: (samples, observables), NaN if a sample has none. given: (observables) deviations that a
    measured curve brings, NaN where it brings none."""

    observables: Sequence[Observable]
    values: Array
    given: Array | None = None
    mean: Array = field(init=False)  # over the samples that have it; NaN if less than half do
    count: Array = field(init=False)

    def __post_init__(self) -> None:
        self.values = np.asarray(self.values, dtype=float).reshape(-1, len(self.observables))
        if self.given is None:
            self.given = np.full(len(self.observables), np.nan)
        finite = np.isfinite(self.values)
        self.count = finite.sum(0)
        enough = (self.count > 0) & (2 * self.count >= len(self.values))
        self.mean = np.where(enough, np.where(finite, self.values, 0).sum(0) / np.maximum(1, self.count), np.nan)

    def of(self, kind: str) -> Array:
        """(observables) bool: those of a kind."""
        return np.array([one.kind == kind for one in self.observables], dtype=bool)

    @property
    def middles(self) -> Array:
        return np.array([one.middle for one in self.observables])


def _stress_squares(paths: Iterable[Data]) -> tuple[float, float]:
    """Variances of level and shape, pooled over the paths."""
    level = shape = n_level = n_shape = 0.0
    for path in paths:
        at = path.of("stress_ratio")
        if at.any() and len(path.values) > 1:
            off = path.values[:, at] - path.mean[at]
            shift = off.mean(1)
            level += (shift**2).sum()
            shape += ((off - shift[:, None]) ** 2).sum()
            n_level += len(off) - 1
            n_shape += (len(off) - 1) * max(1, at.sum() - 1)
    return level / n_level if n_level else np.nan, shape / n_shape if n_shape else np.nan


def _volume_squares(paths: Iterable[Data]) -> Array:
    """(2): variances of start and growth in v = start^2 + growth^2 progress^2. The scatter of a variance is proportional to
    it."""
    normal, right = np.zeros((2, 2)), np.zeros(2)
    for path in paths:
        at = path.of("volumetric_strain")
        if at.any() and len(path.values) > 1:
            x = path.middles[at]
            rows, weight = np.column_stack([np.ones_like(x), x**2]), 1 / (1e-8 + x**2) ** 2
            normal += (weight * rows.T) @ rows
            right += rows.T @ (weight * path.values[:, at].var(0, ddof=1))
    if not normal.any():
        return np.full(2, np.nan)
    return np.linalg.solve(normal + 1e-12 * np.linalg.norm(normal) * np.eye(2), right)  # one bin cannot give a growth


def _width_square(paths: Iterable[Data]) -> float:
    square = freedom = 0.0
    for path in paths:
        at = path.of("ln_width") & (path.count > 1) & np.isfinite(path.mean)
        square += np.nansum((path.values[:, at] - path.mean[at]) ** 2)
        freedom += (path.count[at] - 1).sum()
    return square / freedom if freedom else np.nan


def noise_of(paths: Sequence[Data], options: NoiseOptions) -> NoiseModel:
    """Pools the scatter within every path; values of the options take precedence. Raises ValueError if a number is needed and
    neither given nor can be estimated."""
    squares = dict(zip(("stress_level", "stress_shape"), _stress_squares(paths)))
    squares.update(zip(("volume_start", "volume_growth"), _volume_squares(paths)), ln_width=_width_square(paths))
    noise = NoiseModel(correlation_strain=options.correlation_strain,
                       degrees_of_freedom=sum(len(path.values) - 1 for path in paths))
    for kind, keys in ESTIMATED.items():
        if not any((path.of(kind) & np.isnan(path.given)).any() for path in paths):
            continue  # all deviations of this kind are measured
        for key in keys:
            value = getattr(options, key)
            if value is None and np.isnan(squares[key]):
                raise ValueError(f"noise: {key} must be given, because no path has two samples to estimate it from")
            setattr(noise, key, np.sqrt(max(0.0, squares[key])) if value is None else value)
    return noise


def covariance(noise: NoiseModel, data: Data) -> Array:
    """(observables, observables): covariance of one sample."""
    x = data.middles
    near = np.exp(-np.abs(x[:, None] - x) / noise.correlation_strain)
    result = np.zeros_like(near)
    for kind, form in (("stress_ratio", noise.stress_level**2 + noise.stress_shape**2 * near),
                       ("volumetric_strain", noise.volume_start**2 * near + noise.volume_growth**2 * np.outer(x, x)),
                       ("ln_width", noise.ln_width**2 * np.eye(len(x)))):
        at = data.of(kind)
        block, measured = np.outer(at, at), np.outer(at, at) & np.isfinite(np.outer(data.given, data.given))
        result[block] = form[block]
        result[measured] = (np.outer(data.given, data.given) * near)[measured]
    return result


def discrepancy(options: NoiseOptions, data: Data) -> Array:
    """(observables): variance of the model tolerance."""
    early = options.early_stress_discrepancy * np.exp(-data.middles / options.early_strain)
    return np.select([data.of("stress_ratio"), data.of("volumetric_strain")],
                     [options.stress_discrepancy + early, np.full_like(early, options.volume_discrepancy)],
                     options.width_discrepancy) ** 2


def working_weights(noise: NoiseModel, options: NoiseOptions, data: Data) -> Array:
    """(observables): 1 / (scatter of the mean without what all bins have in common + model tolerance). The common part is left
    out on purpose, because a fit with it may lie below all data. 0 if the mean is NaN."""
    own = np.diag(covariance(replace(noise, stress_level=0.0), data))
    variance = discrepancy(options, data) + own / np.maximum(1, data.count)
    return np.where(np.isfinite(data.mean) & (variance > 0), 1 / np.where(variance > 0, variance, 1), 0.0)


class FittedData:
    """The data of all fitted paths, one after the other, with the weights of the fit. left_out: a reason per observable of each
    path; one with a reason has no weight."""

    def __init__(self, noise: NoiseModel, options: NoiseOptions, paths: Sequence[Data],
                 left_out: Sequence[Sequence[str]]) -> None:
        self.noise, self.options, self.paths = noise, options, paths
        self.weights = np.concatenate([np.where([bool(why) for why in reasons], 0, working_weights(noise, options, path))
                                       for path, reasons in zip(paths, left_out)])
        self.mean = np.concatenate([path.mean for path in paths])

    def residual(self, values: Array) -> Array:
        """sqrt(weight) (values - mean); NaN where a weighted value is missing."""
        return np.where(self.weights > 0, np.sqrt(self.weights) * (values - np.nan_to_num(self.mean)), 0.0)

    def unweighted(self, jacobian: Array) -> Array:
        """Turns the Jacobian of the residuals into that of the observables."""
        return jacobian / np.sqrt(np.where(self.weights > 0, self.weights, 1))[:, None]

    def of_means(self, with_tolerance: bool) -> Array:
        """(n, n): covariance of the means with the model tolerance; without it only the part estimated from the samples."""
        noise = self.noise
        if not with_tolerance:
            given = [key for keys in ESTIMATED.values() for key in keys if getattr(self.options, key) is not None]
            noise = replace(noise, **dict.fromkeys(given, 0.0))
        result, at = np.zeros((len(self.mean),) * 2), 0
        for path in self.paths:
            here = path if with_tolerance else replace_given(path)
            block = covariance(noise, here) / np.sqrt(np.outer(np.maximum(1, path.count), np.maximum(1, path.count)))
            block += np.diag(discrepancy(self.options, path)) if with_tolerance else 0
            result[at:at + len(block), at:at + len(block)] = block
            at += len(block)
        return result


def replace_given(path: Data) -> Data:
    """The same path with measured deviations of zero: they are known and not estimated."""
    return Data(path.observables, path.values, np.where(np.isfinite(path.given), 0.0, np.nan))
