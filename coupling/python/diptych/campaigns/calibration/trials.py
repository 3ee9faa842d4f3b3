# diptych: the second phase of a calibration: the search
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Searches from several starts on coarse meshes, then continues on the samples' own meshes with the coarse Jacobian.
Grains in the place of the continuum and the law's point have one search only."""

import re
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import asdict
from typing import Any

import numpy as np

from ...arrays import Array
from ...errors import NotConverged
from ..runs.coordinates import Coordinates
from ..runs.input_file import Setting
from .calibration_file import Calibration, is_element
from .noise import FittedData, noise_of
from .observations import Observation, Path
from .search import DIFFERENCE, GRAINS_DIFFERENCE, PRIOR, Fit, least_squares, spread_point

SAME_MINIMUM = 0.05  # in every coordinate; they run over [0, 1]
HARDLY_WORSE = 4  # in chi^2: two deviations
MOST_FAILED_STARTS = 8  # replaced by further points
KEYS_OF_NOISE = ("stress_level", "stress_shape", "volume_start", "volume_growth", "ln_width", "profile_stretch",
                 "profile_noise", "correlation_strain", "degrees_of_freedom")  # in calibration.json

RunModel = Callable[[Sequence[Path], Sequence[Sequence[Sequence[Setting]]], bool, float], "list[list[Observation]]"]


class Trials:
    """Runs of the model. `record` always holds the best point so far. Raises NotConverged without data."""

    def __init__(self, calibration: Calibration, coordinates: Coordinates, paths: Sequence[Path], run: RunModel,
                 record: dict[str, Any], *, tell: Callable[[str], None] = lambda words: None) -> None:
        self.calibration, self.coordinates, self.paths = calibration, coordinates, paths
        self.run, self.record, self.tell = run, record, tell
        self.fitted = [path for path in paths if path.target.is_fitted]
        alone = len(self.fitted) == 1 and len(self.fitted[0].samples) == 1
        self.noise = noise_of([path.of_noise for path in (paths if alone else self.fitted)], calibration.noise)
        record["noise"] = {key: value for key, value in asdict(self.noise).items() if key in KEYS_OF_NOISE}
        self.data = FittedData(self.noise, [path.data for path in self.fitted], [path.left_out for path in self.fitted])
        record["n_observables"] = int(self.data.used.sum())
        if record["n_observables"] == 0:
            raise NotConverged("no observable is left to fit; check targets, quantities and bins")
        self.difference = GRAINS_DIFFERENCE if calibration.of_grains else DIFFERENCE
        self.best = (np.inf, False)  # chi^2 with the prior, on the samples' own mesh
        self.failures: list[str] = []  # of coarse and fine runs
        self.tried: list[tuple[Array, bool, Array]] = []  # the same runs: point, on the samples' own mesh, values

    def settings(self, point: Array, target: str) -> list[Setting]:
        return [*self.calibration.fixed, *self.coordinates.settings(point, target)]

    def runs(self, points: Sequence[Array], paths: Sequence[Path], fine: bool, count: str) -> list[list[Observation]]:
        self.record[count] += len(points) * len(paths)
        settings = [[self.settings(point, path.target.name) for path in paths] for point in points]
        found = self.run(paths, settings, fine, self.calibration.load_step)
        if count != "other_runs":
            self.tried += [(point, fine, np.concatenate([one.values for one in runs]))
                           for point, runs in zip(points, found)]
            self.failures += [one.failure for runs in found for one in runs if one.failure]
            self.record["failed_runs"] = len(self.failures)
        return found

    def failure_words(self) -> list[str]:
        """Empty without failures. Reasons that differ in their numbers only count as one."""
        kinds = [re.sub(r"\d[\d.e+-]*", "", failure) for failure in self.failures]
        n = self.record["coarse_runs"] + self.record["fine_runs"]
        return [f"{len(kinds)} of {n} coarse and fine runs were refused or did not finish; most often ({count} times): "
                f"{self.failures[kinds.index(kind)]}" for kind, count in Counter(kinds).most_common(1)]

    def keep(self, point: Array) -> None:
        """Records the settings that all targets share, and the values of single targets."""
        self.record["settings"] = [one.text() for one in self.settings(point, "")]
        self.record["own"] = [{"target": path.target.name, "key": p.key, "value": value} for path in self.paths
                              for p, value in zip(self.coordinates.parameters, self.coordinates.values(point))
                              if path.target.name in p.targets]

    def chi2(self, residual: Array) -> float:
        """chi^2 of the data, without the prior."""
        return float((residual[:len(self.data.mean)] ** 2).sum())

    def residuals(self, fine: bool) -> Callable[[Sequence[Array]], list[Array]]:
        def found_at(points: Sequence[Array]) -> list[Array]:
            found, count = [], "fine_runs" if fine else "coarse_runs"
            for point, runs in zip(points, self.runs(points, self.fitted, fine, count)):
                data = self.data.residual(np.concatenate([one.values for one in runs]))
                found.append(np.concatenate([data, (point - self.coordinates.start) / PRIOR]))
                total = found[-1] @ found[-1]
                if np.isfinite(total) and (total < self.best[0] or fine > self.best[1]):
                    self.best = (total, fine)
                    self.keep(point)
                    self.record["chi2"] = self.chi2(found[-1])
            return found

        return found_at


def search(trials: Trials) -> tuple[Fit, Fit]:
    """The fits on the samples' own meshes and on the coarse mesh: the same one if there is no other."""
    coarse = _fit_coarse(trials)
    if trials.calibration.of_grains or all(is_element(path.scene) for path in trials.fitted):
        return coarse, coarse
    known = None if coarse.note else coarse.jacobian  # that of a search which has not converged may hide a slope
    fine = least_squares(trials.residuals(True), coarse.point, trials.calibration.fine_jacobians, known)
    trials.tell(f"search on the samples' own mesh: chi^2 {fine.chi2:.4g}; next: posterior and predictions")
    if np.isfinite(fine.chi2):
        return fine, coarse
    trials.record["words"].append("the best point of the coarse mesh did not finish on the samples' own mesh; the "
                                  "result rests on the coarse mesh")
    return coarse, coarse


def _fit_coarse(trials: Trials) -> Fit:
    c, record, residuals, fits = trials.calibration, trials.record, trials.residuals(False), []
    for k in range(c.starts + MOST_FAILED_STARTS):
        if sum(np.isfinite(fit.chi2) for fit in fits) == c.starts:
            break
        start = spread_point(c.seed + k, len(trials.coordinates)) if k else trials.coordinates.start
        fit = least_squares(residuals, start, c.start_jacobians if k else c.jacobians, difference=trials.difference)
        fits.append(fit)
        trials.tell(f"search from start {k + 1}: chi^2 {fit.chi2:.4g}{f'; {fit.note}' if fit.note else ''}")
        record["minima"].append({"start": trials.coordinates.numbers(start), "runs": fit.evaluations, "is_best": False,
                                 "words": fit.note, **_minimum(trials, fit)})
    found = int(np.argmin([fit.chi2 for fit in fits]))
    if not np.isfinite(fits[found].chi2):
        raise NotConverged("; ".join([f"the {record['model']} did not finish at any start; change start, low and high",
                                      *trials.failure_words()]))
    best = fits[found]
    if found > 0:  # so far with few Jacobians
        best = least_squares(residuals, best.point, c.jacobians, difference=trials.difference)
        trials.tell(f"search from the best of them: chi^2 {best.chi2:.4g}")
    record["minima"][found] |= {"is_best": True, **_minimum(trials, best)}
    for k, fit in enumerate(fits):
        if k != found and np.isfinite(fit.chi2) and np.abs(fit.point - best.point).max() > SAME_MINIMUM:
            why = ("the data hardly distinguish the two" if fit.chi2 < best.chi2 + HARDLY_WORSE
                   else "it did not converge; more `start_jacobians` show whether the result depends on the start"
                   if fit.note else "a worse minimum; the result may depend on the start")
            record["words"].append(f"start {k + 1} ended elsewhere, with chi^2 {fit.chi2:.3g} instead of "
                                   f"{best.chi2:.3g} (prior included): {why}")
    record["chi2_coarse"] = trials.chi2(best.residual)
    return best


def _minimum(trials: Trials, fit: Fit) -> dict[str, Any]:
    return {"numbers": trials.coordinates.numbers(fit.point), "total": fit.chi2,
            "chi2": trials.chi2(fit.residual) if np.isfinite(fit.chi2) else np.nan}
