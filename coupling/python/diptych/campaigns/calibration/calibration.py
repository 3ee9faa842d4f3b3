# diptych: the command calibrate: parameters of a continuum from grains or curves, or of grains from curves
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Searches from several starts on coarse meshes, then continues on the samples' own meshes with the coarse Jacobian. Afterwards
it samples the posterior of the parameters, and computes the effect of load steps half as long and predictions on paths that
were not fitted. Grains in the place of the continuum have one mesh only."""

from __future__ import annotations

import argparse
import importlib
import json
import re
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import asdict
from typing import Any

import numpy as np
import pandas as pd

from ...arrays import Array
from ...errors import NotConverged, SceneError, Stopped
from ..runs.coordinates import Coordinates
from .calibration_file import OF_BANDS, Calibration, Target, is_element, read_calibration
from .findings import (discrepancy_record, discrepancy_words, parameter_records, parameter_words, path_record,
                                   posterior_table, summary, write_calibration)
from .grains import GrainRuns
from .noise import Data, FittedData, noise_of
from .posterior import Draws, Posterior
from .profiles import PROFILE
from .calibration_runs import CalibrationRuns, Observation, Path, observe_curve, read_target
from .search import DIFFERENCE, GRAINS_DIFFERENCE, PRIOR, Fit, difference_jacobian, least_squares, spread_point
from .standard import standard_calibration
from ..runs.engine import DONE, NOT_CONVERGED, Options, complain, say, tell
from ..runs.folders import Folder, draw
from ..runs.input_file import Setting, settings_of

SAME_MINIMUM = 0.05  # in every coordinate; they run over [0, 1]
HARDLY_WORSE = 4  # in chi^2: two deviations
MOST_FAILED_STARTS = 8  # replaced by further points
STEPS = 1500  # of the sampling of the posterior
MORE_RUNS, SHORT = 20, 500  # coarse runs at points of the posterior, after so many steps of a first sampling
KEYS_OF_NOISE = ("stress_level", "stress_shape", "volume_start", "volume_growth", "ln_width", "profile_stretch",
                 "profile_noise", "correlation_strain", "degrees_of_freedom")  # in calibration.json

RunModel = Callable[[Sequence[Path], Sequence[Sequence[Sequence[Setting]]], bool, float], "list[list[Observation]]"]


def empty_record(title: str, model: str = "continuum") -> dict[str, Any]:
    """calibration.json before the search. model: "grains" if their keys are fitted."""
    return {"format": 1, "title": title, "model": model, "status": "started", "settings": [], "own": [], "chi2_before": np.nan,
            "chi2_coarse": np.nan, "chi2": np.nan, "n_observables": 0, "coarse_runs": 0, "fine_runs": 0,
            "failed_runs": 0, "other_runs": 0, "noise": {}, "words": [], "parameters": [], "correlation": [], "emulator": {},
            "discrepancy": {}, "minima": [], "paths": []}


class Calibrator:
    """`record` always holds the best point so far. Raises NotConverged if no start has a run, ValueError without data."""

    def __init__(self, calibration: Calibration, coordinates: Coordinates, paths: Sequence[Path], run: RunModel,
                 record: dict[str, Any]) -> None:
        self.calibration, self.coordinates, self.paths, self.run, self.record = calibration, coordinates, paths, run, record
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
        self.posterior: pd.DataFrame | None = None
        self.failures: list[str] = []  # of coarse and fine runs
        self.tried: list[tuple[Array, bool, Array]] = []  # the same runs: point, on the samples' own mesh, values

    def _settings(self, point: Array, target: str) -> list[Setting]:
        return [*self.calibration.fixed, *self.coordinates.settings(point, target)]

    def _runs(self, points: Sequence[Array], paths: Sequence[Path], fine: bool, count: str) -> list[list[Observation]]:
        self.record[count] += len(points) * len(paths)
        settings = [[self._settings(point, path.target.name) for path in paths] for point in points]
        found = self.run(paths, settings, fine, self.calibration.load_step)
        if count != "other_runs":
            self.tried += [(point, fine, np.concatenate([one.values for one in runs])) for point, runs in zip(points, found)]
            self.failures += [one.failure for runs in found for one in runs if one.failure]
            self.record["failed_runs"] = len(self.failures)
        return found

    def _failure_words(self) -> list[str]:
        """Empty without failures. Reasons that differ in their numbers only count as one."""
        kinds = [re.sub(r"\d[\d.e+-]*", "", failure) for failure in self.failures]
        n = self.record["coarse_runs"] + self.record["fine_runs"]
        return [f"{len(kinds)} of {n} coarse and fine runs were refused or did not finish; most often ({count} times): "
                f"{self.failures[kinds.index(kind)]}" for kind, count in Counter(kinds).most_common(1)]

    def _keep(self, point: Array) -> None:
        """Records the settings that all targets share, and the values of single targets."""
        self.record["settings"] = [one.text() for one in self._settings(point, "")]
        self.record["own"] = [{"target": path.target.name, "key": p.key, "value": value} for path in self.paths
                              for p, value in zip(self.coordinates.parameters, self.coordinates.values(point))
                              if path.target.name in p.targets]

    def _chi2(self, residual: Array) -> float:
        """chi^2 of the data, without the prior."""
        return float((residual[:len(self.data.mean)] ** 2).sum())

    def _residuals(self, fine: bool) -> Callable[[Sequence[Array]], list[Array]]:
        def residuals(points: Sequence[Array]) -> list[Array]:
            found = []
            for point, runs in zip(points, self._runs(points, self.fitted, fine, "fine_runs" if fine else "coarse_runs")):
                data = self.data.residual(np.concatenate([one.values for one in runs]))
                found.append(np.concatenate([data, (point - self.coordinates.start) / PRIOR]))
                total = found[-1] @ found[-1]
                if np.isfinite(total) and (total < self.best[0] or fine > self.best[1]):
                    self.best = (total, fine)
                    self._keep(point)
                    self.record["chi2"] = self._chi2(found[-1])
            return found

        return residuals

    def calibrate(self) -> None:
        coarse = self._fit_coarse()
        fine = coarse
        if not self.calibration.of_grains:
            fine = least_squares(self._residuals(True), coarse.point, self.calibration.fine_jacobians, coarse.jacobian)
        if not np.isfinite(fine.chi2):
            self.record["words"].append("the best point of the coarse mesh did not finish on the samples' own mesh; the result "
                                        "rests on the coarse mesh")
            fine = coarse
        draws = self._sample(fine)
        self.posterior = posterior_table(self.coordinates, draws.points)
        self._report(fine, coarse, draws)
        self._predict(fine.point, fine.jacobian, draws)
        self.record["status"] = "finished"

    def _fit_coarse(self) -> Fit:
        c, residuals, fits = self.calibration, self._residuals(False), []
        for k in range(c.starts + MOST_FAILED_STARTS):
            if sum(np.isfinite(fit.chi2) for fit in fits) == c.starts:
                break
            start = spread_point(c.seed + k, len(self.coordinates)) if k else self.coordinates.start
            fit = least_squares(residuals, start, c.start_jacobians if k else c.jacobians, difference=self.difference)
            fits.append(fit)
            self.record["minima"].append({"start": self.coordinates.numbers(start), "runs": fit.evaluations, "is_best": False,
                                          "words": fit.note, **self._minimum(fit)})
        found = int(np.argmin([fit.chi2 for fit in fits]))
        if not np.isfinite(fits[found].chi2):
            raise NotConverged("; ".join(["the continuum did not finish at any start; change start, low and high",
                                     *self._failure_words()]))
        best = fits[found]
        if found > 0:  # so far with few Jacobians
            best = least_squares(residuals, best.point, c.jacobians, difference=self.difference)
        self.record["minima"][found] |= {"is_best": True, **self._minimum(best)}
        for k, fit in enumerate(fits):
            if k != found and np.isfinite(fit.chi2) and np.abs(fit.point - best.point).max() > SAME_MINIMUM:
                why = ("the data hardly distinguish the two" if fit.chi2 < best.chi2 + HARDLY_WORSE
                       else "a worse fit; other sets of parameters may fit as well")
                self.record["words"].append(f"start {k + 1} ended at another point, with chi^2 (prior included) {fit.chi2:.3g} "
                                            f"instead of {best.chi2:.3g}: {why}")
        self.record["chi2_coarse"] = self._chi2(best.residual)
        return best

    def _minimum(self, fit: Fit) -> dict[str, Any]:
        return {"numbers": self.coordinates.numbers(fit.point), "total": fit.chi2,
                "chi2": self._chi2(fit.residual) if np.isfinite(fit.chi2) else np.nan}

    def _report(self, fine: Fit, coarse: Fit, draws: Draws) -> None:
        record = self.record
        record["parameters"] = parameter_records(self.coordinates, draws.points, fine.point)
        record["correlation"] = np.corrcoef(draws.points, rowvar=False).reshape(2 * (len(self.coordinates),))
        record["discrepancy"] = discrepancy_record(self.noise, draws, len(self.fitted))
        record["words"] += parameter_words(record["parameters"]) + discrepancy_words(record["discrepancy"])
        searches = [("on the samples' own mesh ", fine, "fine_jacobians"), ("on the coarse mesh ", coarse, "jacobians")]
        if fine is coarse:
            searches = [("", fine, "jacobians")]
        record["words"] += [f"{mesh}{fit.note}; allow more Jacobians by `{key}`" for mesh, fit, key in searches if fit.note]
        record["words"] += self._failure_words()

    def _sample(self, fit: Fit) -> Draws:
        """The posterior by an emulator of all runs. A first, short sampling tells where more coarse runs improve it."""
        n = self.calibration.more_runs or min(MORE_RUNS, 3 * len(fit.point))
        first = self._posterior().sample(fit.point, fit.jacobian, self.calibration.seed, SHORT)
        more = first.points[np.linspace(0, len(first.points) - 1, n).astype(int)]
        failed = sum(any(one.failure for one in runs) for runs in self._runs(more, self.fitted, False, "coarse_runs"))
        if failed:
            self.record["words"].append(f"{failed} of {n} runs at draws of the posterior failed; it omits what is nearest to them")
        posterior = self._posterior()
        draws = posterior.sample(fit.point, fit.jacobian, self.calibration.seed, STEPS)
        self.record["emulator"] = {
            "runs": len(posterior.emulator.points), "more_runs": n, "failed": failed, "acceptance": draws.acceptance,
            "steps": STEPS, "autocorrelation": draws.autocorrelation,
            "left_out": float(np.sqrt(np.mean(posterior.left_out[~posterior.emulator.is_fine.astype(bool)][-n:] ** 2)))}
        return draws

    def _posterior(self) -> Posterior:
        return Posterior(self.data, self.coordinates, *(np.array(column) for column in zip(*self.tried)))

    def _predict(self, best: Array, jacobian: Array, draws: Draws) -> None:
        """All paths on their own meshes: before, calibrated, and calibrated with half the load step."""
        self._keep(best)
        jacobian = self.data.unweighted(jacobian[:len(self.data.mean)])
        spread, curve = np.atleast_2d(np.cov(draws.points, rowvar=False)), iter(draws.curve.T)
        self.record["other_runs"] += 3 * len(self.paths)
        calibrated = [self._settings(best, path.target.name) for path in self.paths]
        before, after = self.run(self.paths, [[path.target.before for path in self.paths], calibrated], True,
                                 self.calibration.load_step)
        halved = self.run(self.paths, [calibrated], True, 0.5 * self.calibration.load_step)[0]
        used = iter(self.data.used)
        for path, *runs in zip(self.paths, before, after, halved):
            here = self._jacobian_on(path, best, jacobian)
            deviations = np.sqrt(np.diag(here @ spread @ here.T))
            self.record["paths"].append(path_record(path, self.noise, runs, deviations))
            for one in self.record["paths"][-1]["observables"] if path.target.is_fitted else ():
                one["counts"], (one["discrepancy"], one["discrepancy_deviation"]) = bool(next(used)), next(curve)
        for key, runs in (("chi2_before", before), ("chi2", after)):
            values = [one.values for path, one in zip(self.paths, runs) if path.target.is_fitted]
            self.record[key] = self._chi2(self.data.residual(np.concatenate(values)))

    def _jacobian_on(self, path: Path, best: Array, jacobian: Array) -> Array:
        """(observables, parameters) of one path: the fit's if the path was fitted, on these or other samples; else differences
        on the coarse mesh."""
        n, at = len(path.data.observables), 0
        for other in self.fitted:
            same = all(p.is_of(path.target.name) == p.is_of(other.target.name) for p in self.coordinates.parameters)
            if same and path.target.is_same_path(other.target):
                return jacobian[at:at + n]
            at += len(other.data.observables)

        def values(points: Sequence[Array]) -> list[Array]:
            return [runs[0].values for runs in self._runs(points, [path], False, "other_runs")]

        here = values([best])[0]
        measured, result = np.isfinite(here), np.full((n, len(best)), np.nan)
        if measured.any():
            result[measured] = difference_jacobian(lambda points: [one[measured] for one in values(points)], best,
                                                   here[measured], self.difference)
        return result


def _check_target(calibration: Calibration, coordinates: Coordinates, target: Target) -> Data:
    """The start must be a scene for every target. Returns data of the same shape as the samples will give."""
    read_target(target, target.before)
    try:
        scene = read_target(target, [*calibration.fixed, *coordinates.settings(coordinates.start, target.name)])
    except SceneError as error:
        raise SceneError(f"{calibration.file}: with every parameter at its start: {error}; change start or set") from error
    if not calibration.of_grains and not is_element(scene):
        importlib.import_module("diptych._continuum").require_continuum(scene)
    if not calibration.of_grains and scene.dict()["continuum"]["initial_stress"] == "mapped":
        raise SceneError(f"{target.scene}: continuum/initial_stress = mapped has no place in a calibration: one mesh serves "
                         "all samples")
    place = f"{calibration.file}: target '{target.name}': "
    law = scene.dict()["continuum"]["law"]
    if PROFILE in calibration.kinds and not is_element(scene) and not law.startswith("cosserat"):
        raise SceneError(f"{place}{PROFILE} needs a law with rotations; continuum/law = {law} has none; use ln_width")
    try:
        observables = calibration.observables_of(scene, bool(target.curve))
    except ValueError as error:
        raise SceneError(place + str(error)) from error
    for kind in calibration.kinds:
        if target.is_fitted and not (target.curve or is_element(scene)) and kind not in [one.kind for one in observables]:
            raise SceneError(f"{place}no bin or window of {kind} lies within its loading")
    for p in coordinates.parameters:
        if p.is_of(target.name) and p.key in (unused := scene.unused_keys()):
            raise SceneError(f"{calibration.file}: parameters: {p.key} is read by no law of target '{target.name}': "
                             f"continuum/{unused[p.key]}")
    if target.curve:
        sample, deviations = observe_curve(scene, observables, target.curve)
        if not target.seeds:
            return Data(observables, sample.values, deviations)
    return Data(observables, np.zeros((len(target.seeds), len(observables))))


def _checked(calibration: Calibration) -> Coordinates:
    """Checks a calibration before anything is changed. Shares and drops refer to fixed keys, else to those of the
    first fitted scene. Whether the scatter can be estimated follows from the number of samples alone."""
    first = next(target for target in calibration.targets if target.is_fitted)
    values = {**read_target(first).dict()["continuum"], **{one.key: one.value for one in calibration.fixed}}
    try:
        coordinates = Coordinates(calibration.parameters, pd.to_numeric(pd.Series(values), errors="coerce").dropna().to_dict())
        noise_of([_check_target(calibration, coordinates, target) for target in calibration.targets], calibration.noise)
    except SceneError:
        raise
    except ValueError as error:
        raise SceneError(f"{calibration.file}: {error}") from error
    return coordinates


def _check_data(calibration: Calibration, paths: Sequence[Path], runs: CalibrationRuns, record: dict[str, Any]) -> None:
    """With coarser steps of the grains the fit would describe the step and not the material."""
    noise = noise_of([path.of_noise for path in paths], calibration.noise)
    for path in paths:
        target = path.target
        if not target.is_fitted:
            continue
        if target.curve:
            if not target.seeds:
                record["words"].append(f"target '{target.name}' is a measured curve: nothing was run again")
        elif path.scene.dict()["discrete"]["method"] == "imported":
            stages = path.scene.stages()  # between frames nothing is known of the grains
            path.left_out = ["" if one.kind in OF_BANDS or any(one.low <= at <= one.high for at in stages)
                             else "no frame lies in it" for one in path.data.observables]
            record["words"].append(f"target '{target.name}' is imported: nothing was run again, and only bins that hold a "
                                   "frame count")
        elif calibration.check_samples == 0 or target.results:
            record["words"].append(f"target '{target.name}' was not checked for the step of its grains")
        else:
            path.left_out = runs.unsteady(path, noise)
            record["words"] += [f"left out: {target.name}, {one.kind} from {one.low:.3g} to {one.high:.3g}: {why}"
                                for one, why in zip(path.data.observables, path.left_out) if why]
        if PROFILE in calibration.kinds:
            path.left_out = [why or ("the profile shows it" if one.kind == "ln_width" else "")
                             for one, why in zip(path.data.observables, path.left_out)]


def _inputs(calibration: Calibration) -> list[tuple[str, str]]:
    inputs = [("the calibration", calibration.file)]
    for target in calibration.targets:
        own = [("the scene", target.scene), *(("results", folder) for folder in target.results), ("curve", target.curve)]
        inputs += [(f"targets: '{target.name}': {what}", path) for what, path in own if path]
        inputs += read_target(target).input_files()
    return inputs


def _standard(line: argparse.Namespace) -> dict[str, Any] | None:
    """Contents of the standard calibration of a scene; None for a calibration file."""
    is_file = line.target.endswith(".json")
    if is_file and (line.seeds or line.set or line.set_file):
        raise SceneError(f"--seeds, --set and --set-file belong to a scene; {line.target} is a calibration file, whose targets "
                         "have seeds and set")
    if not is_file and not line.seeds:
        raise SceneError(f"{line.target}: a scene needs the samples of the fit, for example --seeds 1-4; it then takes the "
                         "standard parameters. Other parameters need a calibration file, .json")
    return None if is_file else standard_calibration(line.target, line.seeds, settings_of(line.set, line.set_file))


def run_calibration(line: argparse.Namespace, options: Options) -> int:
    """The command `diptych calibrate FILE`, or SCENE with --seeds. line: target, seeds, set, set_file and output. Returns its
    exit code; 3: stopped, or no convergence, with the best point so far in the folder."""
    contents = _standard(line)
    text = json.dumps(contents, indent=1) + "\n" if contents else ""
    calibration = read_calibration(line.target, contents)
    coordinates = _checked(calibration)
    directory = line.output or f"results/{calibration.name}_calibration"
    record, posterior = empty_record(calibration.title, "grains" if calibration.of_grains else "continuum"), None
    with Folder(directory) as folder:
        folder.open_runs("calibration", line.target, options, lambda: _inputs(calibration), text)
        if contents:
            say(options, f"standard parameters: {directory}/calibration_input.json")
        runs = (GrainRuns if calibration.of_grains else CalibrationRuns)(calibration, directory, options)
        try:
            paths = runs.paths()
            _check_data(calibration, paths, runs, record)
            calibrator = Calibrator(calibration, coordinates, paths, runs.evaluate, record)
            calibrator.calibrate()
            posterior = calibrator.posterior
        except (Stopped, NotConverged) as error:
            record["status"] = str(error)
        write_calibration(directory, record, runs.cpu_s, posterior)
        if record["status"] != "finished":
            complain(f"diptych: {record['status']}; what was found is kept in {directory}; to go on: {options.again}")
            return NOT_CONVERGED
        tell(summary(record, runs.cpu_s["discrete" if calibration.of_grains else "continuum"]))
        draw(options, "calibration", directory)
        say(options, f"{directory}/calibrated.prm, calibration.json, calibration.csv")
    return DONE
