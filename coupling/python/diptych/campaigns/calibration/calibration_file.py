# diptych: reads and checks calibration files
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A calibration file names targets, quantities and parameters. Paths in it are relative to its folder. A scene with
seeds stands for a file with standard contents."""

import json
import os
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import Any

import numpy as np
import pandas as pd

from ... import _diptych
from ...errors import SceneError
from ...importers import read_table
from ...measurement import FACTS, FIELD, HISTORY, read_measurement
from ..measured.comparison import instants_of, not_measured
from ..runs.coordinates import ABOVE_LEAST, COORDINATES, LOGARITHMS, RATIOS, USUAL, Parameter
from .noise import ANGLE, ESTIMATED, KINDS, Noise, Observable, STRIP_PROFILE
from .profiles import PROFILE, STRIPS
from ..runs.histories import is_beyond
from ..runs.input_file import Part, Setting, is_number, name_of, value_text

FAR = 1e12
OF_FIELD = ("ln_width", ANGLE, STRIP_PROFILE)  # those of the bands of a measured field
OF_BANDS = (PROFILE, *OF_FIELD)  # taken in the windows of the comparison
STRIPS_OF = {PROFILE: list(zip(STRIPS, STRIPS[1:])), STRIP_PROFILE: list(zip(STRIPS[:6], STRIPS[1:6]))}
MOST_PARAMETERS = 12  # the starts are spread over at most so many directions
KEYS_OF_THE_SEARCH = ("mesh", "element_size", "rectangle_width", "rectangle_height", "initial_step", "max_step")
CURVE_COLUMNS = {"stress_ratio": "stress_ratio_deviation", "volumetric_strain": "volumetric_strain_deviation"}
# Names of these columns in element.csv, which holds means over samples of grains and their standard errors.
OTHER_NAMES = {f"{name}{ending}": f"grains_{name}{other}" for name in CURVE_COLUMNS
               for ending, other in (("", ""), ("_deviation", "_error"))}
# Scatter of a laboratory test whose curve brings no deviations.
USUAL_NOISE = {"stress_level": 0.01, "stress_shape": 0.005, "volume_start": 2e-4, "volume_growth": 0.02}
PRESCRIBED = 1e-9  # a smaller deviation: the path prescribes the quantity


@dataclass(kw_only=True)
class Target:
    """A loading path: one scene on several samples, on finished result folders, or with a measured curve instead of
    grains. A curve and seeds: grains are fitted to the curve. A scene with loading/mode = path is an element test."""

    name: str
    scene: str
    settings: list[Setting]
    seeds: list[int] = field(default_factory=list)
    results: list[str] = field(default_factory=list)  # result folders, one per seed, instead of runs
    curve: str = ""  # .csv file
    measured: str = ""  # folder of a measured field, whose curve is `curve`
    is_fitted: bool = True  # False: predicted
    before: list[Setting] = field(default_factory=list)  # parameters to compare with; empty: those of the scene
    kinds: list[str] = field(default_factory=list)  # those that count in a fit; empty: all of the file

    def is_same_path(self, other: "Target") -> bool:
        """True if the paths differ in their samples only."""
        here, there = ([one.text() for one in target.settings] for target in (self, other))
        return (self.scene, self.curve) == (other.scene, other.curve) and here == there


@dataclass(kw_only=True)
class Calibration:
    """The contents of a calibration file; keys as in the README."""

    name: str
    file: str
    title: str
    targets: list[Target]
    kinds: list[str]
    bins: list[float]
    parameters: list[Parameter]
    fixed: list[Setting]
    noise: Noise
    starts: int = 2
    jacobians: int = 8
    fine_jacobians: int = 2
    start_jacobians: int = 1
    load_step: float = 0.001
    coarse_element_size: float = 4.0
    check_samples: int = 2
    more_runs: int = 0  # for the emulator; 0: three per parameter, at most 20
    seed: int = 1
    remarks: list[str] = field(default_factory=list)  # on usual values that the file leaves out

    @property
    def of_grains(self) -> bool:
        """True if keys of the grains are fitted, not of the continuum."""
        return self.parameters[0].setting[0] == "discrete"

    def observables_of(self, scene: _diptych.Scene, target: Target | None = None) -> list[Observable]:
        """Bins up to the end of the loading, and windows of the comparison, but not for curves and element tests. A
        measured field gives the windows that were measured. target: None: samples of grains."""
        keys, found = scene.dict(), []
        edges = keys["comparison"]["window_edges"]
        of_bands, windows = _bands_of(scene, target), list(zip(edges, edges[1:]))
        if target and target.measured and set(of_bands) & set(self.kinds):
            measurement = read_measurement(target.measured)
            windows = list(instants_of(measurement, edges))
            if not windows:
                raise not_measured(measurement, edges)
        for kind in self.kinds:
            if kind in OF_BANDS and kind not in of_bands:
                continue
            found += [Observable(kind=kind, low=low, high=high, near=near, far=far)
                      for low, high in (windows if kind in OF_BANDS else zip(self.bins, self.bins[1:]))
                      if not is_beyond(high, keys["loading"]["axial_strain"])
                      for near, far in STRIPS_OF.get(kind, [(0.0, 0.0)])]
        if not found:
            raise ValueError("no bin and no window lies within the loading; check bins and comparison/window_edges")
        return found


def _bands_of(scene: _diptych.Scene, target: Target | None) -> tuple[str, ...]:
    """The quantities of bands that the data of a target have."""
    if is_element(scene) or (target and target.curve and not target.measured):
        return ()
    return OF_FIELD if target and target.measured else ("ln_width", PROFILE)


def is_element(scene: _diptych.Scene) -> bool:
    """True if the law's point follows the path, and not a boundary value problem."""
    return scene.dict()["loading"]["mode"] == "path"


def read_curve(file: str, bins: Sequence[tuple[float, float]] = ()) -> pd.DataFrame:
    """A measured curve: axial_strain or the progress of a path, stress_ratio (t/s), volumetric_strain and, where given,
    their deviations; compression positive. Also element.csv, whose grains count; a quantity that its path prescribes is
    left out, and other columns are ignored. Warns of `bins` (low, high) without a row. Raises SceneError."""
    rows = read_table(file)
    allowed = ["axial_strain", *CURVE_COLUMNS, *CURVE_COLUMNS.values()]
    names = {"axial_strain": ("progress", "axial_strain"), **{one[0]: one for one in OTHER_NAMES.items()}}
    table = pd.DataFrame({name: rows.numbers(*both) for name, both in names.items() if rows.find(*both) is not None})
    for name, deviation in CURVE_COLUMNS.items():
        if rows.has(OTHER_NAMES[deviation]) and table[deviation].max() < PRESCRIBED:
            table = table.drop(columns=[name, deviation])
    if not {"axial_strain", *CURVE_COLUMNS} & set(table) > {"axial_strain"}:
        raise SceneError(f"{file}: its columns are {', '.join(rows.columns)}; the line above the numbers must name "
                         f"axial_strain and stress_ratio or volumetric_strain; used are {', '.join(allowed)}")
    for name in table.filter(like="deviation"):
        rows.refuse(table[name] <= 0, lambda k: f"{name} = {table[name][k]:g} must be positive")
    strain = table["axial_strain"].to_numpy()
    rows.refuse(np.diff(strain, prepend=-np.inf) <= 0, lambda k: f"axial_strain = {strain[k]:g} must be larger than "
                "above it")
    if not rows.has("progress"):
        rows.refuse(strain >= 1, lambda k: f"axial_strain = {strain[k]:g}; give strains below 1, not per cent")
    if len(table) < 2:
        raise SceneError(f"{file}: a curve needs at least two rows of numbers")
    if "stress_ratio" in table and (table["stress_ratio"].mean() < 0 or table["stress_ratio"].abs().max() >= 1):
        raise SceneError(f"{file}: stress_ratio must be t/s = (s1 - s2) / (s1 + s2), positive in compression and below "
                         "1")
    for low, high in bins:
        if not np.any((strain >= low) & (strain <= high)):
            print(f"diptych: warning: {file}: no row lies in the bin from {low:g} to {high:g}; its mean is "
                  "interpolated between the rows beside it, or it does not count", file=sys.stderr)
    return table.rename(columns={"axial_strain": "progress"})


def _results(part: Part) -> tuple[list[str], list[int]]:
    """Finished result folders and their seeds. They must come from one scene and differ in their samples only."""
    if part.has("scene") or part.has("seeds"):
        part.refuse(" replaces scene and seeds; give one or the other", "results")
    folders, seeds, samples, first = [], [], [], None
    for one in part.list("results"):
        folder = os.path.join(os.path.dirname(one.file), value_text(one.value))
        scene = _diptych.resolved_scene(folder + "/scene.prm")
        if scene is None or not all(os.path.exists(f"{folder}/discrete.{ending}") for ending in ("csv", "h5")):
            one.refuse(f"results: '{folder}' is not a result folder; it needs scene.prm, discrete.csv and discrete.h5")
        try:
            # a file that changed since its run would be fitted as if it were measured
            _diptych.check_part(folder, "discrete")
        except ValueError as error:
            one.refuse(f"results: {error}")
        folders.append(folder)
        identity, imported = dict(scene.identity("sample")), scene.dict()["discrete"]["method"] == "imported"
        seeds.append(scene.dict()["sample"]["seed"])
        samples.append(str(scene.dict()["discrete"]["file"] if imported else seeds[-1]))
        for key in ("sample/seed", *(("discrete/file", "discrete/friction", "loading/pressure") if imported else ())):
            del identity[key]
        first = first or identity
        for key in identity:
            if identity[key] != first.get(key):
                part.refuse(f": '{folder}' and '{folders[0]}' come from different scenes: {key} = '{identity[key]}' "
                            f"and '{first.get(key)}'", "results")
    if not folders:
        part.refuse(" is empty; name at least one result folder", "results")
    part.demand_distinct("results", samples)
    return folders, seeds


def _measured(part: Part) -> str:
    """The folder of a measured field."""
    if part.has("curve"):
        part.refuse(" brings its own curve; leave out curve", "measured")
    folder = os.path.normpath(os.path.join(os.path.dirname(part.file), part.word("measured")))
    for name in (FIELD, FACTS, HISTORY):
        if not os.path.isfile(f"{folder}/{name}"):
            part.refuse(f" = '{folder}' has no {name}; name a folder of diptych import field", "measured")
    return folder


def _target(part: Part) -> Target:
    part.allow("name", "scene", "set", "seeds", "results", "curve", "measured", "k0", "use", "before", "quantities")
    part.at("name")
    source = "measured" if part.has("measured") else "curve"
    target = Target(name=part.word("name"), scene="", settings=part.settings("set"),
                    is_fitted=part.choice("use", ("fit", "predict"), "fit") == "fit",
                    kinds=[value_text(one.value) for one in part.list("quantities")])
    if part.has("results"):
        target.results, target.seeds = _results(part)
        target.scene = target.results[0] + "/scene.prm"
    else:
        if part.has(source) and not part.has("scene"):
            part.refuse(" needs 'scene': this scene loads the continuum, which is compared with the data", source)
        target.scene = part.existing_file("scene")
        if not part.has(source):
            part.at("seeds")
        target.seeds = part.seeds("seeds")
    if part.has(source):
        if part.has("results"):
            part.refuse(" replaces grains; leave out results", source)
        target.measured = _measured(part) if part.has("measured") else ""
        target.curve = f"{target.measured}/{HISTORY}" if target.measured else part.existing_file("curve")
    if part.has("k0"):
        target.settings.append(part.setting("k0", "continuum/k0", part.number("k0", 0.01, 100)))
    if part.has("before"):
        fragment = part.existing_file("before")
        section = "discrete" if target.curve and target.seeds else "continuum"
        entries = [Setting(*entry) for entry in _diptych.read_fragment(fragment)]
        target.before = [entry for entry in entries if entry.key != "parameters_from"]
        for entry in target.before:
            if entry.section != section:
                part.refuse(f" = '{fragment}' sets {entry.section}/{entry.key}, which is not a key of the section "
                            f"{section}", "before")
    return target


def _parameter(part: Part, targets: Sequence[Target]) -> Parameter:
    part.allow("key", "coordinate", "of", "start", "low", "high", "targets")
    for name in ("key", "start", "low", "high"):
        part.at(name)
    key, fitted = part.word("key"), {target.name: target.is_fitted for target in targets}
    names = [value_text(one.value) for one in part.list("targets")]
    if part.has("targets") and not (set(names) <= set(fitted) and any(fitted[name] for name in names)):
        part.refuse(f" = '{', '.join(names)}' is not allowed; name some of {', '.join(fitted)}, one of them fitted",
                    "targets")
    section = key.rpartition("/")[0] or "continuum"
    if section not in ("continuum", "discrete"):
        part.refuse(f" = {key} is not allowed; name a key of the section continuum, or of the grains as discrete/KEY",
                    "key")
    path = key if "/" in key else "continuum/" + key
    allowed = [one for one in COORDINATES if section == "continuum" or one not in RATIOS]
    allowed += [ABOVE_LEAST] if key == "dilatancy_ratio" else []
    coordinate = part.choice("coordinate", allowed, USUAL.get(key, "logarithm"))
    is_ratio = coordinate in RATIOS
    if not is_ratio and part.has("of"):
        part.refuse(" is only allowed with coordinate = share_of or drop_from", "of")
    part.setting("key", path, 0.3)  # checks that the key exists
    if key in KEYS_OF_THE_SEARCH:
        part.refuse(f" = {key} is set by the calibration itself and cannot be a parameter", "key")
    numbers = {name: part.number(name, -FAR, FAR) for name in ("start", "low", "high")}
    p = Parameter(key=key, coordinate=coordinate, **numbers,
                  other=part.word("of", "friction_angle_peak") if is_ratio else "", targets=tuple(names))
    if not p.low < p.high:
        part.refuse(f" = {p.low:g} and high = {p.high:g}: bounds must ascend", "low")
    if not p.low <= p.start <= p.high:
        part.refuse(f" = {p.start:g} lies outside its bounds [{p.low:g}, {p.high:g}]", "start")
    if is_ratio and not (p.low >= 0 and p.high <= 1):
        part.refuse(f" = {p.low:g} and high = {p.high:g}: shares and drops lie between 0 and 1", "low")
    if coordinate in LOGARITHMS and not p.low > 0:
        part.refuse(f" = {p.low:g}: a logarithm needs bounds above 0", "low")
    for name in () if is_ratio else ("low", "high"):  # both must lie in the range of the key
        part.setting(name, path, part.value[name])
    return p


def _fixed(root: Part, parameters: Sequence[Parameter]) -> list[Setting]:
    fixed = root.settings("set")
    for entry in fixed:
        if entry.section != "continuum":
            root.refuse(f": {entry.section}/{entry.key} is not a key of the continuum; set keys of the grains in the "
                        "targets", "set")
        if entry.key in KEYS_OF_THE_SEARCH:
            root.refuse(f": continuum/{entry.key} is set by the calibration itself; set it in a target, or use "
                        "load_step and coarse_element_size", "set")
        if any(p.key == entry.key for p in parameters):
            root.refuse(f": continuum/{entry.key} is already one of the parameters", "set")
    return fixed


def _check_curves(root: Part, targets: Sequence[Target], parameters: Sequence[Parameter], kinds: Sequence[str]) -> None:
    """Grains are fitted to curves, a continuum to grains, curves or measured fields."""
    sections = {p.setting[0] for p in parameters}
    if len(sections) > 1:
        root.refuse(": a file has either keys of the continuum or discrete/ keys of the grains; use two files",
                    "parameters")
    for part, target in zip(root.list("targets"), targets):
        if sections == {"discrete"} and not (target.curve and target.seeds):
            part.refuse(": parameters of the grains are fitted to a measured curve; a target needs scene, curve and "
                        "seeds")
        if sections == {"continuum"} and target.curve and target.seeds:
            part.refuse(" replaces grains; leave out seeds, or name parameters of the grains as discrete/KEY",
                        "measured" if target.measured else "curve")
        if sections == {"discrete"} and target.measured and (wrong := [kind for kind in kinds if kind in OF_FIELD]):
            part.refuse(f": grains are fitted to its curves only; leave {', '.join(wrong)} out of quantities",
                        "measured")
    if not any(target.measured for target in targets) and {ANGLE, STRIP_PROFILE} & set(kinds):
        root.refuse(f": {ANGLE} and {STRIP_PROFILE} need a target with 'measured', a folder of diptych import field",
                    "quantities")


def _take_usual_noise(c: Calibration) -> None:
    """Curves without deviations get the usual scatter, unless the file or samples of grains give another."""
    if any(len(target.seeds) > 1 for target in c.targets):
        return
    bare = {kind: target.curve for target in c.targets if target.curve for kind, column in CURVE_COLUMNS.items()
            if kind in c.kinds and kind in (table := read_curve(target.curve)) and column not in table}
    for kind, curve in bare.items():
        usual = {key: USUAL_NOISE[key] for key in ESTIMATED[kind] if getattr(c.noise, key) is None}
        for key, value in usual.items():
            setattr(c.noise, key, value)
        if usual:
            c.remarks.append(f"{os.path.basename(curve)} has no {CURVE_COLUMNS[kind]}: the usual scatter counts; to "
                             f"change it: \"noise\": {json.dumps(usual)}")


def read_calibration(file: str, contents: Mapping[str, Any] | None = None) -> Calibration:
    """Reads a .json file, or its contents, whose paths begin at the folder of `file`. Raises SceneError."""
    root = Part(file, {}, contents) if contents else Part.read(file, "targets, quantities, bins and parameters")
    root.allow("title", "targets", "quantities", "bins", "set", "parameters", "noise", "starts", "jacobians",
               "fine_jacobians",
               "start_jacobians", "load_step", "coarse_element_size", "check_samples", "more_runs", "seed")
    name = name_of(file, "calibration")
    targets = [_target(part) for part in root.list("targets")]
    if not any(target.is_fitted for target in targets):
        root.refuse(" is missing, or none of the targets is fitted", "targets")
    root.demand_distinct("targets", [target.name for target in targets])
    kinds = [value_text(part.value) for part in root.list("quantities")]
    if not kinds or not set(kinds) <= set(KINDS):
        root.refuse(f" = '{', '.join(kinds)}' is not allowed; use some of {', '.join(KINDS)}", "quantities")
    root.demand_distinct("quantities", kinds)
    for part, target in zip(root.list("targets"), targets):
        if not set(target.kinds) <= set(kinds):
            part.refuse(f" = '{', '.join(target.kinds)}' is not allowed; use some of the file's: {', '.join(kinds)}",
                        "quantities")
    bins = [part.value for part in root.list("bins")]
    has_bins = not set(kinds) <= set(OF_BANDS)
    ascend = len(bins) > 1 and all(map(is_number, bins)) and bins[0] >= 0 and np.all(np.diff(bins) > 0)
    if has_bins and not ascend:
        root.refuse(f" = {bins} is not allowed; give at least two edges that ascend from 0 or above", "bins")
    for target in targets:
        if target.curve:
            read_curve(target.curve, list(zip(bins, bins[1:])) if has_bins else [])
    parameters = [_parameter(part, targets) for part in root.list("parameters")]
    if not 0 < len(parameters) <= MOST_PARAMETERS:
        root.refuse(f" is missing or empty; name 1 to {MOST_PARAMETERS} keys to be fitted", "parameters")
    _check_curves(root, targets, parameters, kinds)
    for target in targets:  # each target uses a key once
        root.demand_distinct("parameters", [p.key for p in parameters if p.is_of(target.name)])
    c = Calibration(name=name, file=file, title=root.word("title", name), targets=targets, kinds=kinds,
                    bins=[float(edge) for edge in bins], parameters=parameters, fixed=_fixed(root, parameters),
                    noise=Noise())
    if root.has("noise"):
        part, names = root.at("noise"), [one.name for one in fields(Noise)[:-2]]
        part.allow(*names)
        for name in filter(part.has, names):
            setattr(c.noise, name, part.number(name, 1e-9 if name in ("correlation_strain", "early_strain") else 0,
                                               FAR))
    for key, low, high in (("starts", 1, 20), ("jacobians", 1, 100), ("fine_jacobians", 1, 100),
                           ("start_jacobians", 1, 20), ("check_samples", 0, 1000), ("more_runs", 0, 1000),
                           ("seed", 0, 1_000_000), ("load_step", 1e-9, 1), ("coarse_element_size", 0.01, 1e3)):
        if root.has(key):
            setattr(c, key, root.number(key, low, high, isinstance(getattr(c, key), int)))
    _take_usual_noise(c)
    return c
