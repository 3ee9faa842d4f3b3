# diptych: grains whose parameters are fitted to a measured curve
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Grains stand in the place of the continuum. Every point of the search runs the same seeds, because the difference of
two runs of one sample scatters less than its runs do."""

from collections.abc import Sequence

import numpy as np
import pandas as pd

from .calibration_file import Target
from .noise import Data
from .calibration_runs import CalibrationRuns
from .observations import Observation, Path, half_step, observe_curve, observe_history, of_peak, read_target
from ..runs.folders import SceneRun
from ..runs.histories import panel_table, peak_of_running_mean
from ..runs.input_file import Setting
from ..studies.points import on_sample, scene_run


def mean_of(samples: Sequence[Observation], averaging_width: float) -> Observation:
    """Means over the samples, or one's failure. The peak is the mean curve's: single curves fluctuate above it."""
    for sample in samples:
        if sample.failure:
            return sample
    values, stress, volume = (np.mean([getattr(sample, name) for sample in samples], axis=0)
                              for name in ("values", "stress_ratio", "volumetric_strain"))
    table = pd.DataFrame({"progress": samples[0].progress, "stress_ratio": stress})
    peak = peak_of_running_mean(table, "stress_ratio", averaging_width)
    return Observation(values=values, numbers=of_peak(peak), progress=samples[0].progress, stress_ratio=stress,
                       volumetric_strain=volume, samples=list(samples))


class GrainRuns(CalibrationRuns):
    """The model is the mean over the seeds of a target, the data are its curve."""

    def _path(self, target: Target) -> Path:
        """The grains of the scene as it is give the scatter of the samples."""
        scene = read_target(target)
        observables = self.calibration.observables_of(scene, target)
        curve, deviations = observe_curve(scene, observables, target.curve)
        data = Data(observables=observables, values=curve.values, given=deviations, runs=len(target.seeds))
        path = Path(target=target, scene=scene, data=data, samples=[curve], left_out=[""] * len(observables))
        before = self._samples([path], [[target.before]])[0][0]
        path.scatter = Data(observables=observables, values=[sample.values for sample in before])
        return path

    def _samples(self, paths: Sequence[Path], points: Sequence[Sequence[Sequence[Setting]]],
                 is_halved: bool = False) -> list[list[list[Observation]]]:
        """[point][path][seed]. With half the step only the first samples run."""
        def sample(path: Path, settings: Sequence[Setting], seed: int) -> SceneRun:
            here = [*path.target.settings, *settings, *(half_step(path.scene) if is_halved else [])]
            return scene_run(path.target.scene, "discrete", on_sample(here, seed, self.calibration.file))

        n = self.calibration.check_samples if is_halved else None
        runs = [[[sample(path, settings, seed) for seed in path.target.seeds[:n]]
                 for path, settings in zip(paths, point)] for point in points]
        failures = iter(self._do([run for of_point in runs for of_path in of_point for run in of_path]))

        def observed(path: Path, run: SceneRun, failure: str) -> Observation:
            table = None if failure else panel_table(self.runs.path(run), "discrete")
            o = observe_history(path.scene, path.data.observables, table, nominal=True)
            o.failure = failure
            return o

        return [[[observed(path, run, next(failures)) for run in of_path] for path, of_path in zip(paths, of_point)]
                for of_point in runs]

    def evaluate(self, paths: Sequence[Path], points: Sequence[Sequence[Sequence[Setting]]], fine: bool,
                 load_step: float) -> list[list[Observation]]:
        """Means over the seeds, [point][path]; grains have no mesh. A smaller load step stands for half the step of the
        grains: the change of the first samples is added to the mean of all."""
        found = self._samples(paths, points)
        means = [[mean_of(samples, path.scene.averaging_width()) for path, samples in zip(paths, point)]
                 for point in found]
        if load_step < self.calibration.load_step:
            for of_point, full, half in zip(means, found, self._samples(paths, points, True)):
                for mean, before, after in zip(of_point, full, half):
                    changes = [b.values - a.values for a, b in zip(before, after)]
                    mean.values = mean.values + (np.mean(changes, axis=0) if changes else np.nan)
        return means
