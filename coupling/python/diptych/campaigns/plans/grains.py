# diptych: plans step, tolerance, snapshots and number of samples of the grains
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pilot runs eight samples at the coarsest discrete/accuracy and four of them at half of it. They give scatter and
cost, and test the rule for the errors of step and tolerance (a factor, 1 +- 0.5 beforehand). The plan takes the
accuracy that reaches the goal with the least CPU time. A coarser one is cheaper, but leaves less for the interval of
the mean and so needs more samples. Two levels (levels.py) replace it if they save a fifth of that time."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ... import _diptych
from ..runs.input_file import Setting
from ..studies.levels import LEAST_PAIRS, MOST_RATIO, Variances, numbers_for, predicted
from .errors import (COARSEST_ACCURACY, FINEST_ACCURACY, MOST_SAMPLES_OF_A_PLAN, Estimate, GrainErrors, cheapest_choice,
                     cost_at, half_interval, improved, relative_difference, rounded_to_two_digits, samples_for,
                     summary_of)
from .question import (SAMPLES, SAMPLES_AND_PAIRS, Budget, PanelPlan, Part, Pilot, Question, RunPilot, percent,
                       planned)
from .springs import try_springs
from ..runs.statistics import Statistics

PILOT_SAMPLES, PAIRED_SAMPLES = 8, 4
GRAINS_FOR_IMPLICIT_SPRINGS = 4000  # as discrete/method = auto
LARGEST_FIRST_SEED = 2_140_000_000  # leaves room for more seeds
FINER = 0.5  # second level of the pilot / first level
RULE, NO_RULE = Estimate(1, 0.5), Estimate(0, 1)
WORTH_TRYING = 0.1  # share of the time that a cheaper setting must save
SHARE_OF_A_KNOB = 0.25  # of the accuracy: the largest change by a cheaper setting
FAR_FROM_THE_PILOT = 1.5  # a choice finer by this factor is run,
FURTHEST_AHEAD = 4  # at most this factor ahead at a time
NORMAL = 1.959963984540054  # 97.5 % quantile
FINE_LEVELS = (0.02, 0.014, 0.01, 0.007, 0.005, 0.0035, 0.0025)  # discrete/accuracy of the second of two levels
WORTH_TWO_LEVELS = 0.8  # of the time of one level


@dataclass
class Level:
    accuracy: float
    point: Pilot

    @property
    def cpu_s(self) -> float:
        """Mean over the first samples, which all levels have."""
        return float(np.mean(self.point.sample_cpu_s[:PAIRED_SAMPLES] or self.point.cpu_s))


class _Unfinished(Exception):
    """A run of the pilot did not finish."""


class GrainsPlan:
    """The pilot for one question."""

    def __init__(self, question: Question, scene: _diptych.Scene, run: RunPilot) -> None:
        self.question, self.run, self.quantities = question, run, question.quantities["discrete"]
        self.keys = keys = scene.dict()
        command = "run" if any(q["source"] == "comparison" for q in self.quantities) else "discrete"
        self.plan = PanelPlan(panel="discrete", command=command)
        first = min(keys["sample"]["seed"], LARGEST_FIRST_SEED)
        self.seeds = [] if keys["sample"]["file"] else list(range(first, first + PILOT_SAMPLES))
        self.common = [planned("discrete/step", "auto"), planned("discrete/tolerance", "auto")]
        if keys["discrete"]["step"] != "auto" or keys["discrete"]["tolerance"] != "auto":
            self._note("step and tolerance: auto instead of the scene's values, so that discrete/accuracy sets both")
        if keys["discrete"]["snapshot_max_sweeps"] > 0:
            self.common.append(planned("discrete/snapshot_max_sweeps", "0"))
            self._note("sampled snapshots: off, because no quantity needs single grains")
        if command == "run":
            self.common += [planned("comparison/" + key, "0")
                            for key in ("coarse_element_size", "band_resamples", "probe_resamples")]
        self.cost_over_springs = scene.cost_over_springs
        self.levels: list[Level] = []
        self.cheaper: dict[str, list[float]] = {}  # cheaper settings in use: effect on each quantity, with sign
        self.one_run = [0.0] * len(self.quantities)  # half an interval of a single run, for a single sample

    def _note(self, text: str) -> None:
        self.plan.decisions.append(text)

    def make(self) -> PanelPlan:
        try:
            self._add_level(COARSEST_ACCURACY, self.seeds)
            self._add_level(FINER * COARSEST_ACCURACY, self.seeds[:PAIRED_SAMPLES])
            if self.seeds:
                self._try_less_preparation()
                if self.keys["discrete"]["penetration_correction"] != "none":
                    self._try_without_correction()
            else:
                self._find_repeatability()
            choice = self._choose()
            while choice[1] > 0 and choice[0] * FAR_FROM_THE_PILOT < self.levels[-1].accuracy:
                ahead = rounded_to_two_digits(self.levels[-1].accuracy / FURTHEST_AHEAD)
                self._add_level(max(choice[0], ahead), self.seeds[:PAIRED_SAMPLES])
                choice = self._choose()
            two = self._two_levels(choice)
            self._conclude(*choice, two)
            implicit = self.keys["sample"]["grains"] >= GRAINS_FOR_IMPLICIT_SPRINGS
            if self.keys["discrete"]["method"] == "nscd" and implicit:
                try_springs(self.plan, self.question, self.run, self.quantities, "compliant")
            if self.cost_over_springs(choice[0]) > 0.5:
                try_springs(self.plan, self.question, self.run, self.quantities, "penalty")
        except _Unfinished:
            self.plan.reaches = False
        return self.plan

    def _run_at(self, accuracy: float, seeds: Sequence[int], more: Sequence[Setting] = ()) -> Pilot:
        settings = [*self.question.changes, *self.common, planned("discrete/accuracy", accuracy), *more]
        return self.run(self.plan.command, settings, seeds, self.quantities)

    def _add_level(self, accuracy: float, seeds: Sequence[int]) -> None:
        point = self._run_at(accuracy, seeds)
        self.levels.append(Level(accuracy, point))
        at = f"discrete/accuracy = {_diptych.text_of_number(accuracy)}: "
        if point.remark:
            self._note(f"{at}some samples are left out: {point.remark}")
        if point.failure:
            self._note(at + point.failure)
            raise _Unfinished

    def _difference(self, one: Pilot, other: Pilot, q: int) -> Statistics:
        return relative_difference(one.values[q], other.values[q], self.quantities[q]["line"])

    def _expected(self, level: Level, q: int) -> float:
        """Long steps increase the strength and the dilation, which is negative."""
        errors = level.point.expected_error
        return -errors["dilation"] if self.quantities[q]["step_error"] == "dilation" else errors["strength"]

    def _errors(self) -> list[GrainErrors]:
        found = []
        for q, asked in enumerate(self.quantities):
            evidence = []
            for coarse, fine in zip(self.levels, self.levels[1:] if self.seeds else ()):
                d = self._difference(coarse.point, fine.point, q)
                evidence.append((self._expected(coarse, q) - self._expected(fine, q), d.mean,
                                 half_interval(d.deviation, d.n) / NORMAL))
            factor = improved(RULE if asked["step_error"] else NO_RULE, evidence)
            slope = self._expected(self.levels[-1], q) / self.levels[-1].accuracy
            scatter = summary_of(self.levels[0].point.values[q], asked["line"])[1] if self.seeds else 0.0
            found.append(GrainErrors(Estimate(factor.mean * slope, factor.deviation * slope), scatter,
                                     bool(asked["step_error"])))
        return found

    def _cost_at(self, accuracy: float) -> float:
        return cost_at([(level.accuracy, level.cpu_s) for level in self.levels], accuracy)

    def _choose(self) -> tuple[float, int]:
        left = self.question.accuracy - max(self._taken())
        return cheapest_choice(self._errors(), self._cost_at, left, 0 if self.seeds else 1)

    def _variances(self, fine: float) -> list[Variances]:
        """Variances of the relative means with levels at 0.05 and fine; empty if both have nearly the same step. The
        runs of a sample diverge equally far at any fine accuracy, so all levels of the pilot count."""
        found, cheap, last = [], self.levels[0].point, self.levels[-1]
        ratio = last.point.expected_error["strength"] * fine / last.accuracy / cheap.expected_error["strength"]
        for q, errors in enumerate(self._errors() if ratio <= MOST_RATIO else ()):
            squares = [self._difference(cheap, level.point, q).deviation**2 for level in self.levels[1:]]
            difference = errors.step.mean * fine * (1 / ratio - 1)  # a bias of step.mean x fine at the fine level
            found.append(predicted(errors.scatter**2, float(np.mean(squares)), ratio, difference))
        return found

    def _numbers(self, fine: float) -> tuple[int, int, float]:
        """(samples, pairs, CPU s) of a plan with two levels; infinite CPU s: no number suffices."""
        found, costs = self._variances(fine), (self.levels[0].cpu_s, self._cost_at(fine))
        half = self.question.accuracy - max(self._taken())
        samples, pairs = numbers_for(found, costs, half, MOST_SAMPLES_OF_A_PLAN) if found else (0, 0)
        return samples, pairs, samples * costs[0] + pairs * costs[1] if samples else np.inf

    def _two_levels(self, one: tuple[float, int]) -> tuple[float, int, int] | None:
        """(fine accuracy, samples, pairs) if two levels are clearly cheaper than one; one: its accuracy and samples.
        Quantities without a rule have no known order. The fine accuracy is run before it is chosen."""
        if not self.seeds or not all(asked["step_error"] for asked in self.quantities):
            return None
        fine = min(FINE_LEVELS, key=lambda fine: self._numbers(fine)[2])
        limit = WORTH_TWO_LEVELS * one[1] * self._cost_at(one[0]) if one[1] else np.inf
        if self._numbers(fine)[2] < limit and all(level.accuracy != fine for level in self.levels):
            self._add_level(fine, self.seeds[:LEAST_PAIRS])
            self.levels.sort(key=lambda level: -level.accuracy)
        samples, pairs, cpu_s = self._numbers(fine)
        used = cpu_s < limit
        if samples:
            cost = limit / WORTH_TWO_LEVELS  # of one level; infinite if it does not reach the accuracy
            self._note(f"two levels are used: {samples} samples at discrete/accuracy = {COARSEST_ACCURACY} and {pairs} "
                       f"of them at {fine} take {cpu_s:.3g} CPU s; one level "
                       + (f"takes {cost:.3g} CPU s" if one[1] else "does not reach the accuracy") if used else
                       f"two levels would save {percent(max(0.0, 1 - cpu_s / cost))} of the CPU time, so one level is "
                       "used")
        return (fine, samples, pairs) if used else None

    def _taken(self) -> list[float]:
        """The part of the accuracy that cheaper settings and a single run use up, for each quantity."""
        return [sum(abs(shifts[q]) for shifts in self.cheaper.values()) + alone for q, alone in enumerate(self.one_run)]

    def _conclude(self, accuracy: float, samples: int, two: tuple[float, int, int] | None = None) -> None:
        plan = self.plan
        if two:
            accuracy, samples = COARSEST_ACCURACY, two[1]
            plan.levels = {"cheap": accuracy, "fine": two[0], "pairs": two[2], "fine_cpu_s": self._cost_at(two[0])}
        plan.reaches = samples > 0
        if not plan.reaches:
            accuracy = float(np.clip(self.question.accuracy / 2, FINEST_ACCURACY, COARSEST_ACCURACY))
            samples = PILOT_SAMPLES if self.seeds else 1
        plan.settings = [*self.common, planned("discrete/accuracy", accuracy)]
        plan.seeds = [self.seeds[0] + k for k in range(samples)] if self.seeds else []
        plan.cpu_s = self._cost_at(accuracy)
        plan.peak_memory_mb = self.levels[-1].point.peak_memory_mb
        for q, errors in enumerate(self._errors()):
            mean = summary_of(self.levels[0].point.values[q], self.quantities[q]["line"])[0].mean
            if two:
                half = self._variances(two[0])[q].half_interval(*two[1:])
                parts = [Part(cause=SAMPLES_AND_PAIRS, error=half)]
            else:
                parts = [Part(cause="step, tolerance", error=errors.at(accuracy), bias=errors.step.mean * accuracy,
                              deviation=errors.step.deviation * accuracy),
                         Part(cause=SAMPLES, error=half_interval(errors.scatter, samples)) if self.seeds
                         else Part(cause="one run", error=self.one_run[q])]
            parts += [Part(cause=name, error=abs(shifts[q]), bias=shifts[q]) for name, shifts in self.cheaper.items()]
            plan.quantities.append(Budget(name=self.quantities[q]["name"], mean=mean,
                                          scatter=errors.scatter if self.seeds else np.nan, parts=parts))
        self._report_levels()
        self._advise()

    def _find_repeatability(self) -> None:
        """Runs diverge from the last digit on. Almost equal accuracies show how far a run may lie from their mean."""
        points = [self._run_at(share * self.levels[-1].accuracy, ()) for share in (1, 0.98, 0.96, 0.94)]
        for q, asked in enumerate(self.quantities):
            values = [point.values[q][0] for point in points if not point.failure]
            self.one_run[q] = half_interval(summary_of(values, asked["line"])[1], 1)

    def _report_levels(self) -> None:
        for level in self.levels:
            at = _diptych.text_of_number(level.accuracy)
            self._note(f"discrete/accuracy = {at}: {level.point.cpu_s:.3g} CPU s per sample")
        for q, asked in enumerate(self.quantities if self.seeds else ()):
            first, second = self.levels[:2]
            d = self._difference(first.point, second.point, q)
            ends = " to ".join(_diptych.text_of_number(level.accuracy) for level in (first, second))
            half = percent(half_interval(d.deviation, d.n))
            self._note(f"  {asked['name']}: {percent(d.mean)} +- {half} from {ends} on {d.n} samples")

    def _try_knob(self, name: str, cheaper: Setting, saving: float, deviations: Sequence[float]) -> None:
        """Runs a cheaper setting if it may be worth it and eight samples can measure its effect. Keeps it if the effect
        is small. deviations: expected deviations of the differences, one per quantity."""
        interval = half_interval(max(deviations), len(self.seeds))
        if saving < WORTH_TRYING:
            verdict = f"not tried; it would save {f'only {percent(saving)} of the' if saving > 0 else 'no'} time"
        elif not interval <= SHARE_OF_A_KNOB * self.question.accuracy:
            verdict = (f"not used; it would save {percent(saving)} of the time, but {len(self.seeds)} samples give its "
                       f"error only to +- {percent(interval)}")
        else:
            verdict = self._verdict_on(name, cheaper, saving)
        self._note(f"{name}: {verdict}")

    def _verdict_on(self, name: str, cheaper: Setting, saving: float) -> str:
        point = self._run_at(COARSEST_ACCURACY, self.seeds, [cheaper])
        if point.failure:
            return point.failure
        found = [self._difference(point, self.levels[0].point, q) for q in range(len(self.quantities))]
        reach = max(abs(d.mean) + half_interval(d.deviation, d.n) for d in found)
        if not reach <= SHARE_OF_A_KNOB * self.question.accuracy:
            return f"not used; it changes a quantity by up to {percent(reach)}"
        self.common.append(cheaper)
        second = self._run_at(self.levels[1].accuracy, self.seeds[:PAIRED_SAMPLES])
        if second.failure:
            self.common.pop()
            return second.failure
        self.cheaper[name] = [d.mean for d in found]
        self.levels[0].point, self.levels[1].point = point, second  # the samples have changed
        return f"used; it saves {percent(saving)}"

    def _try_less_preparation(self) -> None:
        """Another preparation makes different samples, so pairing brings nothing."""
        less, point = self.keys["sample"]["preparation_steps"] // 3, self.levels[-1].point
        if less > 0:
            self._try_knob(f"preparation of {less} steps", planned("sample/preparation_steps", str(less)),
                           2 / 3 * point.preparation_cpu_s / point.cpu_s,
                           [np.sqrt(2) * errors.scatter for errors in self._errors()])

    def _try_without_correction(self) -> None:
        """One sample gives the cost. The runs diverge as much as between two steps."""
        name, none = "no penetration correction", planned("discrete/penetration_correction", "none")
        without, usual = (self._run_at(COARSEST_ACCURACY, self.seeds[:1], more) for more in ([none], []))
        if without.failure or usual.failure:
            self._note(f"{name}: {without.failure or usual.failure}")
            return
        self._try_knob(name, none, 1 - without.cpu_s / usual.cpu_s,
                       [self._difference(self.levels[0].point, self.levels[1].point, q).deviation
                        for q in range(len(self.quantities))])

    def _advise(self) -> None:
        if not self.seeds:
            self._note("there is one sample from a file: the scatter of samples is unknown and not in the budget")
            return
        deciding = max(self.plan.quantities, key=lambda q: q.scatter)
        left = self.question.accuracy - deciding.method
        low, high = (samples_for(factor * deciding.scatter, left) or "more than a million" for factor in (0.66, 2.0))
        self._note(f"eight samples give the scatter to within a factor of 0.66 to 2.0: {low} to {high} samples may be "
                   "needed")
        self._note(f"{deciding.name} determines the number of samples; one sample scatters by "
                   f"{percent(deciding.scatter)}; the scatter falls with the square root of the number of grains")
