# diptych: the runs of a calibration
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Grains of a target are run or read. The continuum has one outline per path; an element test runs the law's point."""

import os
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ... import _diptych, operators
from ...compiled import continuum
from ...errors import NotConverged, SceneError
from ...files import read_json, read_provenance
from ...measurement import FACTS
from ..runs.engine import Options
from ..runs.folders import Runs, SceneRun
from ..runs.histories import is_beyond, panel_table
from ..runs.input_file import Setting
from ..runs.key_numbers import snapshots_at
from ..studies.points import on_sample, scene_run
from .calibration_file import Calibration, Target, is_element
from .fields import MeasuredWindow, measured_windows, observe_field, observe_levelled
from .noise import Data, Noise, Observable, covariance, noise_of
from .observations import (Observation, Outline, Path, add_bands, half_step, observe_curve, observe_history,
                           read_target, windows_of)
from .search import NORMAL


class CalibrationRuns:
    """The methods raise Stopped after a stop signal, and NotConverged if grains do not come to their end."""

    def __init__(self, calibration: Calibration, runs: Runs, options: Options) -> None:
        self.calibration, self.runs, self.options = calibration, runs, replace(options, resume=False)
        self.outlines: dict[str, Outline] = {}
        self.fields: dict[str, list[MeasuredWindow]] = {}  # of targets that were measured
        self.cpu_s = {"continuum": 0.0, "discrete": 0.0}
        self._counted: set[str] = set()

    def _do(self, runs: Sequence[SceneRun]) -> list[str]:
        """Does the runs, adds their CPU time once, and returns for each why it has no result."""
        self.runs.finish(runs, self.options)
        for run in runs:
            record = self.runs.path(run, "/provenance.json")
            if run.name not in self._counted and os.path.exists(record):
                self._counted.add(run.name)
                panel = "discrete" if run.command == "discrete" else "continuum"
                self.cpu_s[panel] += sum(phase["cpu_s"] for phase in read_provenance(record)["phases"])
        return [self.runs.failure(run) for run in runs]

    def _grains(self, target: Target, seeds: Sequence[int], more: Sequence[Setting] = (), note: str = "") -> list[str]:
        """Runs samples of a target and returns their folders."""
        runs = [scene_run(target.scene, "discrete", on_sample([*target.settings, *more], seed, self.calibration.file))
                for seed in seeds]
        for seed, failure in zip(seeds, self._do(runs)):
            if failure:
                raise NotConverged(f"{self.calibration.file}: target '{target.name}', seed {seed}{note}: "
                                   f"the grains did not come to their end: {failure}")
        return [self.runs.path(run) for run in runs]

    def _outline(self, target: Target, scene: _diptych.Scene, observables: Sequence[Observable],
                 snapshots: Sequence[Any]) -> Outline:
        for other in self.calibration.targets:
            if other.name in self.outlines and other.is_same_path(target):
                return self.outlines[other.name]
        pairs = [snapshots_at(snapshots, *window) for window in windows_of(observables)]
        if None in pairs:
            raise ValueError("an edge of comparison/window_edges is not a stage of the grains")
        frames = [{key: value for key, value in operators.increment(*pair).items()
                   if key not in ("points", "displacement", "weight")} for pair in pairs]
        keys, first = scene.dict(), snapshots[0]
        sides = np.concatenate([first.outline_left, first.outline_right])
        mesh = str(keys["continuum"]["mesh"])
        if mesh in ("outline", "rectangle"):
            os.makedirs(self.runs.directory + "/meshes", exist_ok=True)
            mesh = os.path.abspath(f"{self.runs.directory}/meshes/path_{1 + len(self.outlines)}.msh")
            continuum("calibrate").write_mesh(scene, first, mesh)
        width, height = np.ptp(sides, axis=0)
        return Outline(width=width, height=height, solid_fraction=float(np.pi * (first.radius**2).sum() / first.area),
                       frames=frames, bands=[], mesh=mesh)

    def _path(self, target: Target) -> Path:
        scene = read_target(target)
        observables = self.calibration.observables_of(scene, target)
        if target.curve:
            keys = scene.dict()
            self.outlines[target.name] = Outline(
                width=keys["continuum"]["rectangle_width"], height=keys["continuum"]["rectangle_height"],
                solid_fraction=keys["sample"]["solid_fraction"], frames=[], bands=[], mesh="")
            sample, deviations = observe_curve(scene, observables, target.curve)
            left_out = [""] * len(observables)
            if target.measured:
                self.fields[target.name] = measured_windows(scene, target.measured, windows_of(observables))
                left_out = observe_field(sample, deviations, scene, observables, self.fields[target.name])
                if read_json(os.path.join(target.measured, FACTS)).get("curves") == "field":  # of the points
                    sample.values[[one.kind == "volumetric_strain" for one in observables]] = np.nan
            left_out = [why or ("" if np.isfinite(value) else "not measured")
                        for why, value in zip(left_out, sample.values)]
            data = Data(observables=observables, values=sample.values, given=deviations)
            return Path(target=target, scene=scene, data=data, samples=[sample], left_out=left_out)
        samples = [self._observed(target, scene, observables, folder)
                   for folder in target.results or self._grains(target, target.seeds)]
        data = Data(observables=observables, values=[s.values for s in samples])
        if is_element(scene) and len(samples) > 1:  # a cell scatters more or less than the samples of other targets
            data.own = noise_of([data], Noise())
        return Path(target=target, scene=scene, data=data, samples=samples, left_out=[""] * len(observables))

    def _observed(self, target: Target, scene: _diptych.Scene, observables: Sequence[Observable],
                  folder: str) -> Observation:
        table = panel_table(folder, "discrete")
        reached = 0.0 if table is None else float(table["progress"].iloc[-1])
        if is_beyond(observables[0].high, reached) or is_beyond(scene.dict()["loading"]["axial_strain"], reached):
            raise SceneError(f"{self.calibration.file}: target '{target.name}': {folder} ends at {reached:g}, before "
                             "the end of its loading")
        o = observe_history(scene, observables, table)
        if is_element(scene):
            self.outlines.setdefault(target.name, Outline(
                width=np.nan, height=np.nan, solid_fraction=float(table["solid_fraction"].iloc[0]), frames=[], bands=[],
                mesh=""))
            return o
        snapshots = _diptych.read_grains(folder).snapshots
        if target.name not in self.outlines:
            self.outlines[target.name] = self._outline(target, scene, observables, snapshots)
        outline = self.outlines[target.name]
        add_bands(o, scene, observables, snapshots, outline, of_grains=True)
        outline.bands = outline.bands or o.bands
        return o

    def paths(self) -> list[Path]:
        """The grains of every target, run or read, with what they show."""
        return [self._path(target) for target in self.calibration.targets]

    def densest(self, paths: Sequence[Path]) -> float:
        """The largest solid fraction at the start of a path."""
        given = [path.scene.dict()["continuum"]["solid_fraction_start"] for path in paths]
        return max(self.outlines[path.target.name].solid_fraction if start == "auto" else start
                   for path, start in zip(paths, given))

    def unsteady(self, path: Path, noise: Noise) -> list[str]:
        """Runs the first samples with half the step. Why an observable is left out: it moves by more than samples
        scatter, and by more than two runs of a sample differ by chance."""
        seeds = path.target.seeds[:self.calibration.check_samples]
        finer = [self._observed(path.target, path.scene, path.data.observables, folder).values
                 for folder in self._grains(path.target, seeds, half_step(path.scene), ", with half the grains' step")]
        moved = np.mean([a - b.values for a, b in zip(finer, path.samples)], axis=0)
        scatter = np.sqrt(np.diag(covariance(noise, path.data)))
        allowed = max(1.0, NORMAL * np.sqrt(2 / len(seeds)))
        return [f"half the step of the grains moves it by {a:.3g}, samples scatter by {b:.3g}"
                if abs(a) > allowed * b else "" for a, b in zip(moved, scatter)]

    def _settings(self, path: Path, point: Sequence[Setting], fine: bool, load_step: float) -> list[Setting]:
        outline, here = self.outlines[path.target.name], list(path.target.settings)

        def add(section: str, **keys: Any) -> None:
            here.extend(Setting(section, key, str(value), file="the calibration") for key, value in keys.items())

        is_point = is_element(path.scene)
        if not fine and not is_point:
            add("continuum", mesh="rectangle", rectangle_width=outline.width, rectangle_height=outline.height,
                element_size=self.calibration.coarse_element_size)
        elif outline.mesh:
            add("continuum", mesh=outline.mesh)
        add("continuum", initial_step=load_step, max_step=load_step)
        material = path.scene.dict()["continuum"]
        if not is_point:
            add("comparison", coarse_element_size=0)
            # the meshes here have no grains, from which the platens would follow
            add("continuum", **{key: material[key] for key in ("platens", "platen_friction", "platen_slip_length")
                                if key not in path.scene.unused_keys()})
        here.extend(point)
        hardening = next((one.value for one in reversed(point) if one.key == "hardening"), material["hardening"])
        if material["solid_fraction_start"] == "auto" and continuum("calibrate").follows_solid_fraction(hardening):
            # the mean density: the meshes here have no grains
            add("continuum", solid_fraction_start=outline.solid_fraction)
        return here

    def _observed_continuum(self, path: Path, run: SceneRun, failure: str) -> Observation:
        observables = path.data.observables
        if failure:
            return Observation(values=np.full(len(observables), np.nan), failure=failure)
        folder = self.runs.path(run)
        if is_element(path.scene):
            return observe_history(path.scene, observables, panel_table(folder, "material_point"))
        o = observe_history(path.scene, observables, panel_table(folder, "continuum"), nominal=bool(path.target.curve))
        snapshots, name = _diptych.read_nodes(folder).snapshots, path.target.name
        if path.target.measured:
            return observe_levelled(o, path.scene, observables, snapshots, self.fields[name])
        return add_bands(o, path.scene, observables, snapshots, self.outlines[name], of_grains=False)

    def evaluate(self, paths: Sequence[Path], points: Sequence[Sequence[Sequence[Setting]]], fine: bool,
                  load_step: float) -> list[list[Observation]]:
        """Runs the continuum with points[point][path]; returns [point][path]."""
        runs = [scene_run(path.target.scene, "material-point" if is_element(path.scene) else "continuum",
                          self._settings(path, settings, fine, load_step))
                for point in points for path, settings in zip(paths, point)]
        seen = [self._observed_continuum(path, run, failure)
                for path, run, failure in zip(list(paths) * len(points), runs, self._do(runs))]
        return [seen[k:k + len(paths)] for k in range(0, len(seen), len(paths))]
