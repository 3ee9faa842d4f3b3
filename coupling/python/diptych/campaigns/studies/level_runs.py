# diptych: --levels: the fine runs of two-level means, for ensembles and studies
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every sample runs at the cheap discrete/accuracy. The first samples run once more, grains only, at the fine one;
pilot pairs tell how many. levels.py has the statistics."""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from ... import _diptych
from ...errors import SceneError
from ..runs.engine import Options, say
from ..runs.folders import Runs, SceneRun
from ..runs.input_file import Setting
from ..runs.key_numbers import OF_PANEL
from .levels import CHEAP, FINE, LEAST_PAIRS, MOST_RATIO, Limit, limit_of, variances, weight_of
from .points import RunResult, on_sample, points_of, result_of, scene_run
from ..runs.statistics import Difference, Interval, known, words_of
from .study_file import Study, key_quantity

IN_THE_LIMIT = ", limit of short steps"
CLOSEST = 0.75  # second accuracy / first; their expected errors must then differ by MOST_RATIO


class Levels(NamedTuple):
    """discrete/accuracy of both levels."""

    cheap: float
    fine: float

    def setting(self, of: str) -> Setting:
        """The accuracy of a level: "cheap" or "fine"."""
        return Setting("discrete", "accuracy", _diptych.text_of_number(getattr(self, of)), file="--levels")


def read_levels(text: str, n_samples: int) -> Levels | None:
    """--levels: "auto" or two accuracies such as "0.05,0.01"; None without it. Raises SceneError."""
    if text and n_samples < 2:
        raise SceneError(f"--levels {text} needs at least two samples, for example --seeds 1-16", "--levels")
    if text in ("", "auto"):
        return Levels(CHEAP, FINE) if text else None
    try:
        cheap, fine = map(float, text.split(","))
    except ValueError:
        cheap = fine = math.nan
    if not (0.001 <= fine <= CLOSEST * cheap and cheap <= 0.05):
        raise SceneError(f"--levels {text} is not allowed; write auto, or two values of discrete/accuracy from 0.05 to "
                         f"0.001, the second at most {CLOSEST} times the first, such as 0.05,0.01", "--levels")
    return Levels(cheap, fine)


def demand_rule(scene: Any, levels: Levels) -> None:
    """Raises SceneError if discrete/accuracy does not set step and tolerance."""
    keys = scene.dict()["discrete"]
    for key, needed in (("method", "nscd"), ("step", "auto"), ("tolerance", "auto")):
        if keys[key] != needed:
            raise SceneError(f"--levels needs discrete/{key} = {needed}, and the scene has {keys[key]}",
                             f"discrete/{key}")
    if not math.isclose(keys["accuracy"], levels.cheap):
        raise SceneError("--levels sets discrete/accuracy; do not vary it", "discrete/accuracy")


def has_rule(asked: dict[str, Any]) -> bool:
    """True if the bias of a quantity follows the rule of the step. The angle of a band, for instance, has no rule."""
    return asked["source"] == "discrete" and (asked["key"] in OF_PANEL or asked["reduction"] == "strength"
                                              or asked["column"] in ("stress_ratio", "volumetric_strain"))


def _column(results: Sequence[RunResult], q: int, n: int) -> list[float]:
    """Values of a quantity, NaN up to n samples."""
    return [run.values[q] for run in results] + [math.nan] * (n - len(results))


class PairedPoint:
    """The runs of one point: all samples at the cheap accuracy, the first ones also at the fine one. ratio: expected
    error of the fine runs / that of the cheap ones; NaN if unknown or too close to 1."""

    def __init__(self, cheap: Sequence[RunResult], fine: Sequence[RunResult],
                 quantities: Sequence[dict[str, Any]]) -> None:
        self.cheap, self.fine, self.quantities = cheap, fine, quantities
        below, above = (known([run.expected_error.get("strength", math.nan) for run in results])
                        for results in (fine, cheap))
        ratio = float(below.mean() / above.mean()) if len(below) and len(above) else math.nan
        self.ratio = ratio if ratio <= MOST_RATIO else math.nan

    def _values(self) -> dict[int, tuple[list[float], list[float]]]:
        """{index of the quantity: values of all samples at both settings} of the quantities with a rule."""
        n = len(self.cheap)
        return {q: (_column(self.cheap, q, n), _column(self.fine, q, n))
                for q, asked in enumerate(self.quantities) if has_rule(asked)}

    def pairs_wanted(self) -> int:
        """Pairs that give the smallest error for the cost, for the quantity that needs most of them. The cost of grains
        is about inverse to their expected error (benchmarks/rigid_limit); measured times depend on the machine."""
        shares = [0.0]
        for x, y in self._values().values():
            if len(known(np.subtract(x, y))) > 1 and not math.isnan(self.ratio):
                shares.append(variances(x, y, self.ratio).share((self.ratio, 1.0)))
        return math.ceil(len(self.cheap) * max(shares))

    def limits(self) -> dict[int, tuple[Limit, list[float]]]:
        """{index of the quantity: (its limit, extrapolated values of the pairs)} of the quantities with a rule."""
        return {q: (limit_of(x, y, self.ratio), np.subtract(x, np.subtract(x, y) * weight_of(self.ratio)).tolist())
                for q, (x, y) in self._values().items()}


def paired_points(runs: Runs, fine: Sequence[Sequence[SceneRun]], cheap: Sequence[Sequence[RunResult]],
                  quantities: Sequence[dict[str, Any]], options: Options) -> list[PairedPoint]:
    """Runs the pairs. fine, cheap: [point][sample]. Raises Stopped on a stop request."""
    n, pairs = len(fine[0]), min(LEAST_PAIRS, len(fine[0]))
    while True:
        runs.finish([run for of_point in fine for run in of_point[:pairs]], options,
                    f"stopped on request, finished runs are kept in {runs.directory}")
        results = [[result_of(runs, run, quantities) for run in of_point[:pairs]] for of_point in fine]
        points = [PairedPoint(*both, quantities) for both in zip(cheap, results)]
        if all(math.isnan(point.ratio) for point in points):
            ended = [run for of_point in results for run in of_point]
            if not any(run.known and run.exit_code == 0 for run in ended):
                raise SceneError("--levels: no run with the fine step finished; the first ended with: "
                                 + ended[0].words, "--levels")
            raise SceneError("--levels: both accuracies give nearly the same step (step and step_bound in "
                             "provenance.json). Give a finer second accuracy, or leave --levels out", "--levels")
        wanted = min(n, max(point.pairs_wanted() for point in points))
        if wanted <= pairs:
            say(options, f"limit of short steps: {pairs} of {n} samples also with the fine step")
            return points
        pairs = wanted


def fine_runs(scene: str, settings: Sequence[Setting], seeds: Sequence[int], file: str) -> list[SceneRun]:
    """The fine runs of one point, grains only. settings: with the fine accuracy."""
    return [scene_run(scene, "discrete", on_sample(settings, seed, file)) for seed in seeds]


def ensemble_levels(levels: Levels, runs: Runs, members: dict[int, SceneRun], fine: Sequence[SceneRun],
                    options: Options) -> dict[str, Any]:
    """Runs the pairs of an ensemble and returns the entry `levels` of ensemble.json. members: the finished ones by
    seed. Raises Stopped."""
    wanted, n = [key_quantity(key, "discrete") for key in OF_PANEL], len(members)
    cheap = [result_of(runs, run, wanted) for run in members.values()]
    [point] = paired_points(runs, [fine], [cheap], wanted, options)
    return {**levels._asdict(), "seeds": list(members)[:len(point.fine)],
            "quantities": [{"key": point.quantities[q]["key"], "quantity": point.quantities[q]["name"],
                            "unit": point.quantities[q]["unit"], **vars(limit),
                            "relative_bias": limit.cheap / limit.limit.value - 1,
                            "fine": _column(point.fine, q, n)} for q, (limit, _) in point.limits().items()]}


def add_summary(record: dict[str, Any], levels: dict[str, Any]) -> None:
    """Adds the entry `levels` and its rows of the summary to the record of an ensemble, with the margins of the
    verdicts. Raises ValueError for levels of an earlier version, which have no keys."""
    if not all("key" in one for one in levels["quantities"]):
        raise ValueError("levels in ensemble.json: an earlier version wrote them, without keys; diptych run with "
                         "--seeds, --levels and --resume writes them again")
    record["levels"] = levels
    # The limit of short steps is free of the error of the cheap steps, of which the impacts warn.
    record["checks"] = [one for one in record["checks"] if one["key"] != "discrete_summary/impact_share"]
    rows, verdicts, validation = ({one["key"]: one for one in record[part]}
                                  for part in ("summary", "verdicts", "validation"))
    n_draws = len(record["continuum_runs"]["values"]) - 1
    for found in levels["quantities"]:
        verdict, row = verdicts[found["key"]], validation[found["key"]]
        rows[found["key"]]["quantity"] += f" (accuracy {levels['cheap']:g})"
        parts = [(row["parts"]["mesh"], math.inf), (row["parts"]["load_step"], math.inf), (row["u_input"], n_draws - 1)]
        grains, difference, words = _compared(found, verdict, [part for part in parts if math.isfinite(part[0])])
        record["summary"].append({"key": found["key"], "quantity": found["quantity"] + IN_THE_LIMIT,
                                  "unit": found["unit"], "grains": grains, "continuum": rows[found["key"]]["continuum"],
                                  "difference": difference, "verdict": words_of({**verdict, "verdict": words})})


def _compared(found: dict[str, Any], verdict: dict[str, Any],
              errors: Sequence[tuple[float, float]]) -> tuple[Interval, Interval, str]:
    """The limit, continuum minus limit, and its verdict. errors: of the continuum, as in Difference.with_errors().

    Both panels share the samples, so continuum - factor x grains has a limit of its own. With the factor q = continuum
    / limit it is 0. Its interval / limit is that of the relative difference q - 1, with the scatter of the grains."""
    values = verdict["continuum"], verdict["discrete"], found["fine"]
    continuum, cheap, fine = (np.array(one, float) for one in values)

    def difference(factor: float) -> Difference:
        both = [limit_of(continuum - factor * cheap, continuum - factor * fine, found["ratio"], confidence).limit
                for confidence in (0.95, 0.90)]
        return Difference(verdict["n"], *both).with_errors(errors)

    grains, absolute = limit_of(cheap, fine, found["ratio"]).limit, difference(1.0)
    if not verdict["relative"]:
        return grains, absolute.difference, absolute.verdict(verdict["margin"])
    factor = 1 + absolute.difference.value / grains.value
    at_zero, scale = difference(factor), abs(grains.value)
    relative = [Interval(*(factor - 1 + end / scale for end in one))
                for one in (at_zero.difference, at_zero.difference_90)]
    return grains, absolute.difference, Difference(verdict["n"], *relative).verdict(verdict["margin"])


def study_levels(study: Study, results: Sequence[Sequence[RunResult]], levels: Levels, runs: Runs,
                 options: Options) -> tuple[list[list[RunResult]], list[list[Limit]], dict[str, RunResult]]:
    """Runs the pairs of a study without a reference. Each quantity that has a rule gets a second one, in the limit. Its
    values are the pairs, extrapolated sample by sample. Returns copies of the results with these values, the limits
    [point][new quantity], and the fine runs by name."""
    fine = points_of(replace(study, settings=[*study.settings, levels.setting("fine")], command="discrete"))
    paired = paired_points(runs, [point.runs for point in fine], results, study.quantities, options)
    found = [point.limits() for point in paired]
    n = len(study.quantities)
    study.quantities += [{**study.quantities[q], "name": study.quantities[q]["name"] + IN_THE_LIMIT} for q in found[0]]
    longer = [[replace(run, values=[*run.values[:n], *(values[k] for _, values in limits.values())])
               for k, run in enumerate(of_point)] for of_point, limits in zip(results, found)]
    pairs = {run.name: result for point, both in zip(fine, paired) for run, result in zip(point.runs, both.fine)}
    return longer, [[limit for limit, _ in limits.values()] for limits in found], pairs
