# diptych: study files: points, samples, quantities and the reference
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads and checks study files. The keys are described in README.md of this folder."""

import math
import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ... import _diptych
from ...arrays import Array
from ..runs.coordinates import COORDINATES, Coordinates, Parameter
from ..runs.histories import SOURCES
from ..runs.key_numbers import QUANTITIES
from ..runs.input_file import Part, Setting, is_number, name_of, value_text
from ..runs.members import described

COMMANDS = {"discrete": ("discrete",), "continuum": ("continuum",), "run": ("discrete", "continuum"),
            "material-point": ("material_point",)}  # the panels that each command runs
REDUCTIONS = ("strength", "mean", "at", "peak", "largest", "last", "number")
PHASES = ("preparation", "discrete", "continuum", "continuum_coarse", "comparison", "report", "material_point")
FEWEST_SAMPLES, MOST_SAMPLES = 20, 100000  # of the parameters of a sensitivity study; a fit needs 20 values
_FAR = 1e12


@dataclass
class AxisPoint:
    """One or several keys that are set together. `value` is that of a single key that is a number."""

    label: str
    settings: list[Setting] = field(default_factory=list)
    value: float = math.nan


@dataclass(kw_only=True)
class Axis:
    """`converges`: results have a limit as values go to 0. `own_reference`: every point has its own reference."""

    name: str
    points: list[AxisPoint] = field(default_factory=list)
    converges: bool = False
    own_reference: bool = False


@dataclass(kw_only=True)
class Family:
    """Points that share settings and axes: all combinations (grid), or the k-th points of all axes together."""

    name: str = ""
    settings: list[Setting] = field(default_factory=list)
    grid: bool = True
    axes: list[Axis] = field(default_factory=list)


def quantity(name: str = "", **changes: Any) -> dict[str, Any]:
    """A quantity with the entries that study.json has. `line`: an angle that repeats after 180 degrees."""
    return {"name": name, "key": "", "unit": "-", "source": "discrete", "reduction": "last", "column": "",
            "from": math.nan, "to": math.nan, "relative": True, "limit": None, "line": False, **changes}


@dataclass(kw_only=True)
class Study:
    """The contents of a study file."""

    name: str = ""
    file: str = ""
    title: str = ""
    scene: str = ""
    command: str = "run"
    settings: list[Setting] = field(default_factory=list)  # of all points
    seeds: list[int] = field(default_factory=list)  # empty: the one sample of the scene
    reference: list[Setting] | None = None  # None: values are reported, nothing is judged
    families: list[Family] = field(default_factory=list)
    quantities: list[dict[str, Any]] = field(default_factory=list)
    cost: list[str] = field(default_factory=list)  # phases that count; empty: all except the report
    borders: list[dict[str, Any]] = field(default_factory=list)
    ranges: list[Parameter] = field(default_factory=list)  # of a sensitivity study
    design: Array = field(default_factory=lambda: np.empty((0, 0)))  # its points in the unit cube, (points, ranges)


def _axis(part: Part) -> Axis:
    part.allow("name", "key", "values", "points", "converges", "own_reference")
    if part.has("key") == part.has("points"):
        part.refuse("an axis needs either key and values, or points with label and set")
    key, points = part.word("key", "points"), []
    for value in part.list("values") if part.has("key") else []:
        number = float(value.value) if is_number(value.value) else math.nan
        points.append(AxisPoint(value_text(value.value), [part.setting("values", key, value.value)], number))
    for one in part.list("points"):
        one.allow("label", "set")
        one.at("label")
        points.append(AxisPoint(one.word("label"), one.settings("set")))
    if not points:
        part.refuse("this axis has no points; give values or points")
    axis = Axis(name=part.word("name", key.partition("/")[2] or key), points=points, converges=part.flag("converges"),
                own_reference=part.flag("own_reference"))
    part.demand_distinct("values" if part.has("key") else "points", [point.label for point in points], key)
    for point in points if axis.converges else []:
        if not point.value > 0:
            part.refuse(f" needs values above 0, which '{point.label}' is not", "converges")
    return axis


def _family(part: Part, settings: list[Setting]) -> Family:
    axes = [_axis(one) for one in part.list("axes")]
    part.demand_distinct("axes", [axis.name for axis in axes])
    is_grid = part.choice("combine", ("grid", "list"), "grid") == "grid" or not axes
    for axis in [] if is_grid else axes:
        if len(axis.points) != len(axes[0].points):
            part.refuse(f": a list needs equally many points; '{axes[0].name}' has {len(axes[0].points)}, "
                        f"'{axis.name}' {len(axis.points)}", "axes")
    return Family(name=part.word("name"), settings=settings, grid=is_grid, axes=axes)


def _families(root: Part) -> list[Family]:
    if not root.has("families"):
        return [_family(root, [])]
    if root.has("axes"):
        root.refuse(" cannot be used together with families; put axes into each family", "axes")
    for part in root.list("families"):
        part.allow("name", "set", "axes", "combine")
        part.at("name")
    return [_family(part, part.settings("set")) for part in root.list("families")]


def _range(part: Part) -> Parameter:
    """A key that varies between low and high, or its share of another key."""
    part.allow("key", "low", "high", "coordinate", "of")
    part.at("key")
    key, (low, high) = part.word("key"), (part.number(name, -_FAR, _FAR) for name in ("low", "high"))
    coordinate = part.choice("coordinate", COORDINATES, "share_of" if part.has("of") else "value")
    is_ratio = coordinate in ("share_of", "drop_from")
    if is_ratio != part.has("of"):
        part.refuse("'of' names the key that coordinate = share_of or drop_from refers to; give both or neither")
    if not low < high:
        part.refuse(f" = {low:g} and high = {high:g}: a range must ascend", "low")
    if low < 0 and is_ratio or low <= 0 and coordinate == "logarithm":
        part.refuse(f" = {low:g}: a logarithm needs bounds above 0, a share or drop bounds of at least 0", "low")
    for value in (0.3,) if is_ratio else (low, high):  # checks that the key exists and takes such values
        part.setting("key" if is_ratio else "low", key, value)
    return Parameter(key=key, coordinate=coordinate, start=low, low=low, high=high, other=part.word("of"))


def _sample_ranges(root: Part, study: Study) -> list[Family]:
    """A Latin hypercube over the ranges, as a family with one axis."""
    from scipy.stats import qmc  # loads slowly

    for name in ("axes", "families", "combine", "reference", "borders"):
        if root.has(name):
            root.refuse(" cannot be used together with ranges", name)
    study.ranges = [_range(part) for part in root.list("ranges")]
    root.demand_distinct("ranges", [p.key for p in study.ranges])
    read = _diptych.read_changed_scene(study.scene, study.settings, study.command == "run").dict()
    others = {f"{section}/{key}": value for section, keys in read.items() for key, value in keys.items()
              if is_number(value)}
    try:
        coordinates = Coordinates(study.ranges, others)
    except ValueError as error:
        root.refuse(f": {error}", "ranges")
    n = root.number("samples", FEWEST_SAMPLES, MOST_SAMPLES, True)
    study.design = qmc.LatinHypercube(len(study.ranges), seed=1).random(n)
    points = [AxisPoint(str(k), [one._replace(file=study.file) for one in coordinates.settings(point, "")])
              for k, point in enumerate(study.design, 1)]
    return [Family(axes=[Axis(name="sample of the ranges", points=points)])]


def _reduction(part: Part) -> dict[str, Any]:
    given = [name for name in REDUCTIONS if part.has(name)]
    if len(given) != 1:
        part.refuse(f"a quantity needs exactly one of {', '.join(REDUCTIONS)}")
    how = given[0]
    if how in ("strength", "mean"):
        ends = [end.value for end in part.list(how)]
        if len(ends) != 2 or not all(map(is_number, ends)) or not ends[0] < ends[1]:
            part.refuse(f" = {value_text(part.value[how])} is not allowed; give two ascending values of the progress",
                        how)
        return {"reduction": how, "from": float(ends[0]), "to": float(ends[1])}
    if how == "at":
        return {"reduction": how, "from": part.number("at", 0, _FAR)}
    if how == "peak":
        return {"reduction": how, "to": part.number("peak", 1e-12, _FAR)}
    if how in ("largest", "last") and not part.flag(how):
        part.refuse(" must be true or left out", how)
    return {"reduction": how}


def _describe_number(part: Part, name: str) -> dict[str, Any]:
    """Unit and kind of a number of comparison.json."""
    if found := described(name):
        return {"column": name, "unit": found[1], "line": found[2]}
    key, keys = name.rpartition(" ")[2], [place.rpartition("/")[2] for place in _diptych.comparison_numbers()]
    nearest = min((one for one in keys if key and one.startswith(key)), key=len,
                  default=_diptych.nearest_name(key, keys))
    part.refuse(f" = '{name}': no number of a comparison has such a name; the nearest to '{key}' is '{nearest}'. Use a "
                "name from the first column of ensemble.csv, such as 'window 0.01-0.03 discrete band angle_deg'",
                "number")


def _quantity(part: Part, command: str) -> dict[str, Any]:
    part.allow("name", "of", "column", "limit", *REDUCTIONS)
    source = "comparison" if part.has("number") else part.choice("of", (*SOURCES, "comparison"), COMMANDS[command][0])
    if source not in (*COMMANDS[command], "comparison" if command == "run" else ""):
        part.refuse(f"command {command} does not write what '{source}' is read from; change command or of")
    q = quantity(source=source, column=part.word("column"), **_reduction(part))
    if part.has("limit"):
        limit = part.at("limit")
        limit.allow("relative", "absolute")
        if len(limit.value) != 1:
            limit.refuse("a limit needs one of relative and absolute")
        q["relative"] = limit.has("relative")
        q["limit"] = limit.number("relative" if q["relative"] else "absolute", 1e-12, _FAR)
    if q["reduction"] in ("strength", "number"):
        if part.has("column"):
            part.refuse(" has no effect here; remove it", "column")
        if q["reduction"] == "number":
            q.update(_describe_number(part, part.word("number")))
    else:
        columns = _diptych.numeric_columns().get(source, {})
        if q["column"] not in columns:
            part.refuse(f" = '{q['column']}': {source}.csv has no such column; the nearest is "
                        f"'{_diptych.nearest_name(q['column'], list(columns))}'",
                        "column" if part.has("column") else "name")
        q["unit"] = columns[q["column"]]
    begin, end = _diptych.text_of_number(q["from"]), _diptych.text_of_number(q["to"])
    names = {"strength": f"{source} strength {begin}-{end}", "mean": f"{source} {q['column']} {begin}-{end}",
             "at": f"{source} {q['column']} at {begin}", "number": q["column"]}
    q["name"] = part.word("name", names.get(q["reduction"], f"{source} {q['reduction']} {q['column']}"))
    return q


def key_quantity(key: str, panel: str) -> dict[str, Any]:
    """A key number of a panel, or of the difference, as a quantity."""
    one = QUANTITIES[key]
    return quantity(one["name"], key=key, unit=one["unit"], line=one["difference"] == "line", source=panel,
                    reduction="key number", relative=False)


def _quantities(root: Part, study: Study) -> list[dict[str, Any]]:
    """The quantities of the file. A study without a reference may name none, and sets no limit."""
    quantities = [_quantity(part, study.command) for part in root.list("quantities")]
    if study.reference is None:
        for part in root.list("quantities"):
            if part.has("limit"):
                part.refuse(" is an error against a reference, and 'reference' is missing", "limit")
        if any(axis.own_reference for family in study.families for axis in family.axes):
            root.refuse("own_reference needs a reference, and 'reference' is missing")
        if not root.has("quantities") and study.command != "material-point":
            panels = (*COMMANDS[study.command], *(["difference"] if study.command == "run" else []))
            quantities = [key_quantity(key, panel) for key, one in QUANTITIES.items() for panel in panels
                          if not (one["is_of_band"] and study.command == "discrete")]  # grains alone have none here
    if not quantities:
        root.refuse(" is missing or empty; name at least one quantity", "quantities")
    root.demand_distinct("quantities", [q["name"] + q["source"] * (q["reduction"] == "key number") for q in quantities])
    return quantities


def _border(part: Part, families: Sequence[Family]) -> dict[str, Any]:
    part.allow("label", "family", "x", "y", "coefficient", "exponent")
    border = {key: part.word(key) for key in ("label", "family", "x", "y")}
    border |= {"coefficient": part.number("coefficient", -1e300, 1e300), "exponent": part.number("exponent", -100, 100)}
    family = next((one for one in families if one.name == border["family"]), None)
    if family is None:
        part.refuse(f" = '{border['family']}': there is no such family", "family")
    for name in (border["x"], border["y"]):
        if all(axis.name != name for axis in family.axes):
            part.refuse(f"'{name}' is not an axis of this family")
    return border


def read_study(file: str, overrides: Sequence[Setting] = ()) -> Study:
    """Reads a study file. `overrides` are settings of all points.

    Paths are relative to the folder of the study; those of overrides to the working directory. Keys and values are
    checked one by one, the combinations with the points. Raises SceneError with file, line, key and allowed values.
    """
    return study_of(Part.read(file, "scene and axes"), name_of(file, "study"), overrides)


def study_of(root: Part, name: str, overrides: Sequence[Setting]) -> Study:
    """The study of an input file or of the words of a command line."""
    root.allow("title", "scene", "command", "set", "seeds", "reference", "families", "axes", "combine", "quantities",
               "cost", "borders", "ranges", "samples")
    study = Study(name=name, file=root.file, scene=os.path.abspath(root.existing_file("scene")))
    study.command = root.choice("command", tuple(COMMANDS), "run")
    study.settings = [*root.settings("set"), *(setting.check() for setting in overrides)]
    study.seeds = root.seeds("seeds")
    study.reference = root.settings("reference") if root.has("reference") else None
    study.families = _sample_ranges(root, study) if root.has("ranges") else _families(root)
    root.demand_distinct("families", [family.name for family in study.families])
    varied = dict.fromkeys(axis.name for family in study.families for axis in family.axes)
    effect = f"{name_of(study.scene, 'scene')}: effect of {', '.join(varied)}"
    if study.ranges:
        effect = f"{name_of(study.scene, 'scene')}: sensitivity to {len(study.ranges)} parameters"
    study.title = root.word("title", effect if study.reference is None else name)
    study.quantities = _quantities(root, study)
    study.cost = [value_text(part.value) for part in root.list("cost")]
    for name in set(study.cost) - set(PHASES):  # a wrong name would count as a cost of zero
        root.refuse(f": '{name}' is not a phase; the nearest is '{_diptych.nearest_name(name, list(PHASES))}'", "cost")
    study.borders = [_border(part, study.families) for part in root.list("borders")]
    points = [point for family in study.families for axis in family.axes for point in axis.points]
    everything = [study.settings, study.reference or [], *(one.settings for one in (*study.families, *points))]
    for setting in sum(everything, []) if study.seeds else ():  # a seed of the study would replace a fixed one
        if (setting.section, setting.key) == ("sample", "seed"):
            place = f"{setting.file}, line {setting.line}" if setting.line else setting.file
            root.refuse(f" cannot be used together with sample/seed = {setting.value}, set at {place}", "seeds")
    return study
