# diptych: observables of a calibration, scatter of the samples, and the weights that follow from it
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A few samples cannot give a full covariance, so the scatter of one sample has a fixed form. The curve t/s is shifted
as a whole (level) and varies locally, correlated in strain (shape). Volume has a constant scatter and one in proportion
to strain. Widths scatter independently, profiles as profiles.py says. Deviations of a measurement replace this form."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import scipy.linalg

from ...arrays import Array
from .profiles import FLOOR, MISFIT_LENGTH, NOISE_LENGTH, PROFILE, shape

ANGLE, STRIP_PROFILE = "angle", "strip_profile"  # only of a measured field, which brings their deviations
KINDS = ("stress_ratio", "volumetric_strain", "ln_width", PROFILE, ANGLE, STRIP_PROFILE)
ESTIMATED = {"stress_ratio": ("stress_level", "stress_shape"), "volumetric_strain": ("volume_start", "volume_growth"),
             "ln_width": ("ln_width",), PROFILE: ("profile_stretch", "profile_noise"), ANGLE: (), STRIP_PROFILE: ()}


@dataclass(frozen=True, kw_only=True)
class Observable:
    """One number by which grains and continuum are compared: a mean over a bin of the progress, or ln of a width or a
    strip of a profile in a window. near, far: edges of the strip [mean diameters]."""

    kind: str
    low: float
    high: float
    near: float = 0.0
    far: float = 0.0


@dataclass(kw_only=True)
class Noise:
    """Standard deviations of one sample, None where they are to be estimated, and the model tolerance ("discrepancy"):
    the misfit that the form of the law may have."""

    stress_level: float | None = None
    stress_shape: float | None = None
    volume_start: float | None = None
    volume_growth: float | None = None
    ln_width: float | None = None
    profile_stretch: float | None = None  # of ln of the width of a band, in all its windows
    profile_noise: float | None = None
    correlation_strain: float = 0.005
    stress_discrepancy: float = 0.008
    early_stress_discrepancy: float = 0.03
    early_strain: float = 0.002
    volume_discrepancy: float = 0.0008
    width_discrepancy: float = 0.1
    angle_discrepancy: float = 2.0  # degrees
    strip_discrepancy: float = 0.02  # of the travel
    estimated: tuple[str, ...] = ()  # the deviations that were estimated
    degrees_of_freedom: int = 0  # samples minus paths


NO_SCATTER = Noise(**{key: 0 for keys in ESTIMATED.values() for key in keys})


@dataclass(kw_only=True)
class Data:
    """The samples of one path. values: (samples, observables), NaN if a sample has none. given: (observables)
    deviations that a measurement brings, NaN where it brings none. runs: number of samples of grains that are
    compared with the data in their mean; 0: a continuum. own: the scatter of this path; None: the calibration's."""

    observables: Sequence[Observable]
    values: Array
    given: Array | None = None
    runs: int = 0
    own: Noise | None = None
    mean: Array = field(init=False)  # over the samples that have it; NaN if less than half do
    count: Array = field(init=False)

    def __post_init__(self) -> None:
        self.values = np.asarray(self.values, dtype=float).reshape(-1, len(self.observables))
        if self.given is None:
            self.given = np.full(len(self.observables), np.nan)
        finite = np.isfinite(self.values)
        self.count = finite.sum(0)
        enough = (self.count >= min(2, len(self.values))) & (2 * self.count >= len(self.values))
        self.mean = np.where(enough, np.where(finite, self.values, 0).sum(0) / np.maximum(1, self.count), np.nan)

    def of(self, kind: str) -> Array:
        """(observables) bool: those of a kind."""
        return np.array([one.kind == kind for one in self.observables], dtype=bool)

    @property
    def middles(self) -> Array:
        return np.array([0.5 * (one.low + one.high) for one in self.observables])

    @property
    def distances(self) -> Array:
        """(observables): of the middle of a strip from the middle of the band [mean diameters]; else 0."""
        return np.array([0.5 * (one.near + one.far) for one in self.observables])

    def windows(self) -> list[list[int]]:
        """The strips of each window's profile, as indices of observables."""
        found: dict[float, list[int]] = {}
        for k, one in enumerate(self.observables):
            if one.kind == PROFILE:
                found.setdefault(one.low, []).append(k)
        return list(found.values())

    def shapes(self) -> Array:
        """(3, observables): of profiles, as shape() has them; 0 elsewhere and without a mean."""
        found = np.zeros((3, len(self.observables)))
        for at in self.windows():
            if np.isfinite(self.mean[at]).all():
                breadth = np.array([self.observables[k].far - self.observables[k].near for k in at])
                found[:, at] = shape(self.distances[at], breadth, self.mean[at])
        return found

    def beside(self, length: float) -> Array:
        """(observables, observables): exp(-distance / length) of strips of one window; else 0."""
        y, x = self.distances, self.middles
        return np.exp(-np.abs(y[:, None] - y) / length) * np.equal.outer(x, x) * np.outer(y > 0, y > 0)


def _near(x: Array, length: float) -> Array:
    return np.exp(-np.abs(x[:, None] - x) / length)


def _squares(paths: Iterable[Data], kind: str, mode: Callable[[Array], Array], length: float) -> tuple[float, float]:
    """Variances of a sample's share of mode(strain), and of the rest, which is correlated over a length of strain."""
    shares = rest = freedom = left = 0.0
    for path in paths:
        at = path.of(kind)
        if at.any() and len(path.values) > 1:
            x, off, n = path.middles[at], path.values[:, at] - path.mean[at], len(path.values) - 1
            along = mode(x) / np.linalg.norm(mode(x))
            share = off @ along
            shares, freedom = shares + (share**2).sum() / (mode(x) ** 2).sum(), freedom + n
            rest += ((off - np.outer(share, along)) ** 2).sum()
            left += n * (len(x) - along @ _near(x, length) @ along)  # of correlated noise the share takes more than one
    return (shares / freedom, rest / left if left > 0 else 0.0) if freedom else (np.nan, np.nan)


def _width_square(paths: Iterable[Data]) -> float:
    square = freedom = 0.0
    for path in paths:
        at = path.of("ln_width") & (path.count > 1) & np.isfinite(path.mean)
        square += np.nansum((path.values[:, at] - path.mean[at]) ** 2)
        freedom += (path.count[at] - 1).sum()
    return square / freedom if freedom else np.nan


def _profile_squares(paths: Iterable[Data]) -> tuple[float, float]:
    """Variance of ln(width), from the mean stretch of a sample's windows; the factor of the noise, from the rest."""
    stretch = left = freedom = strips = 0.0
    for path in paths:
        (_, mode, variance), common = path.shapes(), []
        for at in path.windows():
            n = path.count[at].min() - 1
            if n < 1 or not variance[at].all():
                continue
            off, filter_ = np.nan_to_num(path.values[:, at] - path.mean[at]), mode[at] / variance[at]
            common.append(off @ filter_ / (mode[at] @ filter_))
            left += ((off - np.outer(common[-1], mode[at])) ** 2 / variance[at]).sum()
            strips += n * (len(at) - 1)
        if common:
            stretch, freedom = stretch + (np.mean(common, axis=0) ** 2).sum(), freedom + len(path.values) - 1
    return (stretch / freedom, left / strips) if freedom else (np.nan, np.nan)


def noise_of(paths: Sequence[Data], given: Noise) -> Noise:
    """Fills in deviations that are not given: the scatter within paths, pooled. ValueError if samples are too few."""
    paths, length = [path for path in paths if path.own is None], given.correlation_strain
    squares = dict(zip(("stress_level", "stress_shape"), _squares(paths, "stress_ratio", np.ones_like, length)))
    squares.update(zip(("volume_growth", "volume_start"), _squares(paths, "volumetric_strain", np.copy, length)),
                   ln_width=_width_square(paths))
    squares.update(zip(("profile_stretch", "profile_noise"), _profile_squares(paths)))
    # else this kind is measured with deviations, or missing
    needed = [key for kind, keys in ESTIMATED.items() for key in keys
              if any((path.of(kind) & np.isnan(path.given) & np.isfinite(path.mean)).any() for path in paths)]
    estimated = [key for key in needed if getattr(given, key) is None]
    missing = [key for key in estimated if np.isnan(squares[key])]
    if missing:
        raise ValueError(f"noise: {', '.join(missing)} must be given, because no path has two samples to estimate them "
                         "from")
    values = {key: getattr(given, key) if key in needed else 0.0 for key in squares}
    values |= {key: np.sqrt(max(0.0, squares[key])) for key in estimated}
    return replace(given, **values, estimated=tuple(estimated),
                   degrees_of_freedom=sum(len(path.values) - 1 for path in paths))


def covariance(noise: Noise, data: Data) -> Array:
    """(observables, observables): covariance of one sample."""
    x, noise = data.middles, data.own or noise
    near = _near(x, noise.correlation_strain)
    alone = np.eye(len(x))
    result, (_, mode, variance) = np.zeros_like(near), data.shapes()
    for kind, form, of_given in (
            ("stress_ratio", noise.stress_level**2 + noise.stress_shape**2 * near, near),
            ("volumetric_strain", noise.volume_start**2 * near + noise.volume_growth**2 * np.outer(x, x), near),
            ("ln_width", noise.ln_width**2 * alone, alone),
            (PROFILE, noise.profile_stretch**2 * np.outer(mode, mode) + noise.profile_noise**2
             * np.sqrt(np.outer(variance, variance)) * data.beside(NOISE_LENGTH), alone),
            # all strips show the same errors of width and jump
            (ANGLE, 0 * alone, alone), (STRIP_PROFILE, 0 * alone, data.beside(MISFIT_LENGTH))):
        at = data.of(kind)
        block, measured = np.outer(at, at), np.outer(at, at) & np.isfinite(np.outer(data.given, data.given))
        result[block] = form[block]
        result[measured] = (np.outer(data.given, data.given) * of_given)[measured]
    return result


def covariance_of_mean(noise: Noise, data: Data) -> Array:
    """(observables, observables): of the mean of the data, plus that of the runs they are compared with."""
    n = np.maximum(1, data.count)
    result = covariance(noise, data) / np.sqrt(np.outer(n, n))
    return result + covariance(noise, replace(data, given=None)) / data.runs if data.runs else result


def discrepancy(noise: Noise, data: Data) -> Array:
    """(observables): variance of the model tolerance. That of a profile has the floor of its noise."""
    early = noise.early_stress_discrepancy * np.exp(-data.middles / noise.early_strain)
    profile = data.shapes()[0]  # a relative tolerance
    for at in data.windows():
        profile[at] += FLOOR * profile[at].max()
    return np.select([data.of(kind) for kind in ("stress_ratio", "volumetric_strain", PROFILE, ANGLE, STRIP_PROFILE)],
                     [noise.stress_discrepancy + early, np.full_like(early, noise.volume_discrepancy),
                      noise.width_discrepancy * profile, noise.angle_discrepancy, noise.strip_discrepancy],
                     noise.width_discrepancy) ** 2


def working_covariance(noise: Noise, data: Data) -> Array:
    """(observables, observables): scatter of the mean + model tolerance, for the search. Neighbouring strips of a
    profile are correlated; other observables count as independent. The scatter common to all bins or strips is left
    out: a fit with it can lie below every data point (Peelle's puzzle)."""
    common = {"stress_level": 0.0, "profile_stretch": 0.0}
    scatter = covariance_of_mean(replace(noise, **common), replace(data, own=data.own and replace(data.own, **common)))
    tolerance = discrepancy(noise, data)
    counts = np.eye(len(tolerance), dtype=bool) | (data.beside(1) > 0)
    return np.where(counts, scatter, 0) + tolerance_covariance(data, tolerance)


def tolerance_covariance(data: Data, variance: Array) -> Array:
    """(observables, observables): of the model tolerance; strips of one window are correlated."""
    return np.sqrt(np.outer(variance, variance)) * np.maximum(np.eye(len(variance)), data.beside(MISFIT_LENGTH))


class FittedData:
    """The data of all fitted paths, one after the other, with the weights of the fit. left_out: a reason per observable
    of each path; one with a reason has no weight."""

    def __init__(self, noise: Noise, paths: Sequence[Data], left_out: Sequence[Sequence[str]]) -> None:
        self.noise, self.paths, self.mean = noise, paths, np.concatenate([path.mean for path in paths])
        working = scipy.linalg.block_diag(*[working_covariance(noise, path) for path in paths])
        has_reason = np.concatenate([np.array(why, bool) for why in left_out])
        self.used = np.isfinite(self.mean) & (np.diag(working) > 0) & ~has_reason
        self.root = np.eye(len(self.mean))  # root^T root = inverse of the working covariance
        square = np.ix_(self.used, self.used)
        self.root[square] = np.linalg.inv(np.linalg.cholesky(working[square]))

    def residual(self, values: Array) -> Array:
        """root (values - mean), 0 for unused observables; all NaN if a used value is missing."""
        return self.root @ np.where(self.used, values - np.nan_to_num(self.mean), 0.0)

    def of_means(self) -> Array:
        """(n, n): covariance of the means."""
        return scipy.linalg.block_diag(*[covariance_of_mean(self.noise, path) for path in self.paths])

    def of_scatter(self, keys: Sequence[str]) -> Array:
        """(n, n): the part of it due to these deviations of one sample."""
        others = {key: 0.0 for of_kind in ESTIMATED.values() for key in of_kind if key not in keys}
        noise = replace(self.noise, **others)
        known = [replace(path, given=np.where(np.isfinite(path.given), 0.0, np.nan), own=path.own and NO_SCATTER)
                 for path in self.paths]  # not this scatter
        return scipy.linalg.block_diag(*[covariance_of_mean(noise, path) for path in known])
