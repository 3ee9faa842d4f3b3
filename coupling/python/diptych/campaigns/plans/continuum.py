# diptych: plans elements, load steps, tolerance, law and geometry of the continuum
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Starts from coarse elements and long load steps and halves one size after the other, until the estimated error is
within its share of the accuracy. Then takes the largest size that the share allows. Cheaper models (small strain, a law
without an internal length, simpler elements) are used if they change the results by less than their share. If the
results of a law without an internal length keep changing with the elements, the plan uses its Cosserat counterpart."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from ... import _diptych
from ..runs.input_file import Setting
from .errors import (Refinement, half_interval, refinement, relative_difference, rounded_to_two_digits, samples_for,
                     summary_of)
from .question import SAMPLES, Budget, PanelPlan, Part, Pilot, Question, RunPilot, percent, planned

# Shares of the accuracy. The rest, at least the last share, is for the scatter of the samples.
OF_ELEMENTS, OF_LOAD_STEPS, OF_TOLERANCE, OF_MODELS, OF_SAMPLES = 0.4, 0.2, 0.05, 0.15, 0.2
MOST_SIZES, SCATTER_SAMPLES = 6, 4
LONGEST_PILOT = 120.0  # CPU s of one run
WORTH_SAVING = 0.05
ELEMENTS_OVER_LENGTH, ELEMENTS_ACROSS = 2, 12  # start of the refinement
LONGEST_LOAD_STEP, COARSEST_TOLERANCE = 0.01, 1e-3
WITH_LENGTH = {"mohr_coulomb": "cosserat_mohr_coulomb", "drucker_prager": "cosserat_drucker_prager"}
WITHOUT_LENGTH = {"cosserat_mohr_coulomb": "mohr_coulomb",
                  "gradient_mohr_coulomb": "mohr_coulomb"}  # other laws: drucker_prager


@dataclass(kw_only=True)
class Knob:
    """A size that the plan halves."""

    name: str
    coarsest: float
    share: float  # of the accuracy
    settings: Callable[[float], list[Setting]]
    least_points: int = 2  # values needed for an error estimate
    may_have_no_limit: bool = False
    dearer_per_halving: float = 8


@dataclass(kw_only=True)
class Settled:
    """The sizes that were run. laws: one per quantity, of values relative to the finest."""

    sizes: list[float] = field(default_factory=list)
    points: list[Pilot] = field(default_factory=list)
    laws: list[Refinement] = field(default_factory=list)
    reached: bool = False
    failure: str = ""  # reason if a run did not finish


class ContinuumPlan:
    """The pilot for one question."""

    def __init__(self, question: Question, scene: _diptych.Scene, run: RunPilot) -> None:
        self.question, self.run, self.keys = question, run, scene.dict()
        self.quantities = question.quantities["continuum"]
        command = "run" if any(q["source"] == "comparison" for q in self.quantities) else "continuum"
        self.plan = PanelPlan(panel="continuum", command=command)
        self.chosen = [planned("comparison/coarse_element_size", "0")]
        if command == "run":
            self.chosen += [planned("comparison/" + key, "0") for key in ("band_resamples", "probe_resamples")]
        self.options = self.keys["continuum"]
        self.has_changed_law = False
        self.parts: list[list[Part]] = [[] for _ in self.quantities]
        self.scatter = [np.nan] * len(self.quantities)
        self.now = Pilot()  # with the chosen settings
        self.left_for_models = OF_MODELS * question.accuracy

    def _note(self, text: str) -> None:
        self.plan.decisions.append(text)

    def make(self) -> PanelPlan:
        if self.options["platens"] == "rough" and self.options["hardening"] == "constant":
            self._note("rough platens with continuum/hardening = constant: the error of the force in fully plastic "
                       "flow falls with the element size to the power 0.9; 16 elements per side leave 9 % "
                       "(benchmarks/referee)")
        if self.options["mesh"] not in ("outline", "rectangle"):
            self._note("elements: from the mesh file; their error is unknown and not in the budget")
        elif not self._settle_elements():
            return self.plan
        steps = Knob(name="continuum/max_step", coarsest=min(LONGEST_LOAD_STEP, self.keys["loading"]["stage_strain"]),
                     share=OF_LOAD_STEPS, least_points=3, dearer_per_halving=2,
                     settings=lambda size: [planned("continuum/max_step", size),
                                            planned("continuum/initial_step", min(size, 0.001))])
        if self._settle(steps, self._refine(steps)):
            self._settle_tolerance()
            self._try_models()
            self._settle_samples()
            self._conclude()
        return self.plan

    def _run_with(self, more: Sequence[Setting] = (), seeds: Sequence[int] = ()) -> Pilot:
        settings = [*self.question.changes, *self.chosen]
        if self.plan.command == "run":  # the windows of the bands need a run of the grains
            settings.append(planned("discrete/accuracy", "0.05"))
        return self.run(self.plan.command, [*settings, *more], seeds, self.quantities)

    def _shifts(self, a: Pilot, b: Pilot) -> list[float]:
        """Differences of two points on one sample, relative to the second."""
        return [relative_difference(*both, asked["line"]).mean
                for *both, asked in zip(a.values, b.values, self.quantities)]

    def _refine(self, knob: Knob) -> Settled:
        settled, allowed = Settled(), knob.share * self.question.accuracy
        for size in knob.coarsest * 0.5 ** np.arange(MOST_SIZES):
            point = self._run_with(knob.settings(float(size)))
            if point.failure:
                settled.failure = f"{knob.name} = {_diptych.text_of_number(size)}: {point.failure}"
                if settled.points:
                    break
                continue  # too coarse to run
            values = ", ".join(f"{asked['name']} {of_samples[0]:.4g}"
                               for asked, of_samples in zip(self.quantities, point.values))
            self._note(f"{knob.name} = {_diptych.text_of_number(size)}: {values}; {point.cpu_s:.3g} CPU s")
            if settled.points and settled.points[-1].values == point.values:
                settled.sizes.pop(), settled.points.pop()  # the previous size limited nothing
            settled.sizes.append(float(size))
            settled.points.append(point)
            shifts = zip(*(self._shifts(one, point) for one in settled.points))
            settled.laws = [refinement(settled.sizes, list(relative)) for relative in shifts]
            settled.reached = len(settled.points) >= knob.least_points and all(
                law.error <= allowed and law.converges for law in settled.laws)
            keeps_changing = any(not law.converges and law.error > allowed for law in settled.laws)
            if (settled.reached or knob.dearer_per_halving * point.cpu_s > LONGEST_PILOT
                    or (knob.may_have_no_limit and keeps_changing)):
                break
        return settled

    def _settle(self, knob: Knob, settled: Settled) -> bool:
        """Takes the largest size within the share, limited to the sizes that were run."""
        if len(settled.points) < 2:
            self.plan.reaches = False
            self._note(settled.failure or f"{knob.name}: not refined, because a second size would take more than "
                                          f"{LONGEST_PILOT:.3g} CPU s")
            return False
        size = settled.sizes[-1]
        if settled.reached:
            wanted = [law.size_for(knob.share * self.question.accuracy) for law in settled.laws if law.error > 0]
            size = rounded_to_two_digits(max(min([settled.sizes[0], *wanted]), size))
        self.chosen += knob.settings(size)
        errors = [law.error_at(size) for law in settled.laws]
        for parts, law, error in zip(self.parts, settled.laws, errors):
            parts.append(Part(cause=knob.name, error=error, bias=law.sign * error))
        self._note(f"  used: {knob.name} = {_diptych.text_of_number(size)}; error {', '.join(map(percent, errors))}"
                   f"{'' if settled.reached else '; this exceeds its share of the accuracy'}")
        self.plan.reaches = self.plan.reaches and settled.reached
        return True

    def _first_elements(self, has_length: bool) -> float:
        o = self.options
        side = (min(o["rectangle_width"], o["rectangle_height"]) / self.keys["sample"]["mean_diameter"]
                if o["mesh"] == "rectangle" else np.sqrt(self.keys["sample"]["grains"]))
        across = side / ELEMENTS_ACROSS
        return rounded_to_two_digits(min(across, ELEMENTS_OVER_LENGTH * o["internal_length"]) if has_length else across)

    def _settle_elements(self) -> bool:
        law = self.options["law"]
        other = WITH_LENGTH.get(law)
        knob = Knob(name="continuum/element_size",
                    coarsest=self._first_elements(law.startswith(("cosserat", "gradient"))), share=OF_ELEMENTS,
                    settings=lambda size: [planned("continuum/element_size", size)], may_have_no_limit=bool(other),
                    least_points=3 if other else 2)  # one small change of a law without a length may be chance
        settled = self._refine(knob)
        if not settled.reached and other:
            why = settled.failure or ("the results keep changing with the elements, or small enough elements cost too "
                                      "much")
            self._note(f"continuum/law = {law}: {why}; this law has no internal length; used instead: {other} with "
                       f"continuum/internal_length = {_diptych.text_of_number(self.options['internal_length'])}")
            self.chosen.append(planned("continuum/law", other))
            self.has_changed_law = True
            knob.coarsest, knob.may_have_no_limit, knob.least_points = self._first_elements(True), False, 2
            settled = self._refine(knob)
        return self._settle(knob, settled)

    def _settle_tolerance(self) -> None:
        """Uses the loosest tolerance that does not change the results."""
        def at(tolerance: float) -> Pilot:
            return self._run_with([planned("continuum/tolerance", tolerance)])

        reference, tolerance = at(1e-2 * min(1e-5, self.options["tolerance"])), COARSEST_TOLERANCE
        while not reference.failure and tolerance > 5e-6:
            point = at(tolerance)
            shifts = [1.0] if point.failure else self._shifts(point, reference)
            worst = max(map(abs, shifts))
            if worst <= OF_TOLERANCE * self.question.accuracy:
                self.chosen.append(planned("continuum/tolerance", tolerance))
                for parts, shift in zip(self.parts, shifts):
                    parts.append(Part(cause="continuum/tolerance", error=abs(shift), bias=shift))
                self._note(f"used: continuum/tolerance = {_diptych.text_of_number(tolerance)}; error {percent(worst)}")
                self.now = point
                return
            tolerance /= 10
        self.now = self._run_with()
        self._note("continuum/tolerance: unchanged, because looser values change the results")

    def _try_model(self, name: str, key: str, value: str) -> None:
        """Tries a cheaper model instead of the scene's."""
        point = self._run_with([planned(key, value)])
        if point.failure:
            self._note(f"{name}: not possible, {point.failure}")
            return
        shifts = self._shifts(point, self.now)
        worst, saving = max(map(abs, shifts)), 1 - point.cpu_s / self.now.cpu_s
        if worst > self.left_for_models or saving < WORTH_SAVING:
            self._note(f"{name}: not used; it would save {f'{percent(saving)} of the' if saving > 0 else 'no'} time "
                       f"and change a quantity by up to {percent(worst)}")
            return
        for parts, shift in zip(self.parts, shifts):
            parts.append(Part(cause=name, error=abs(shift), bias=shift))
        self.chosen.append(planned(key, value))
        self.left_for_models -= worst
        self.now = point
        self._note(f"{name}: used; it saves {percent(saving)} of the time and changes a quantity by up to "
                   f"{percent(worst)}")

    def _try_models(self) -> None:
        law = self.options["law"]
        has_length = law.startswith(("cosserat", "gradient")) or self.has_changed_law
        if has_length and not self.has_changed_law:
            self._try_model("law without an internal length", "continuum/law",
                            WITHOUT_LENGTH.get(law, "drucker_prager"))
        if not has_length and self.options["element"] != "q1_bbar":
            self._try_model("bilinear elements", "continuum/element", "q1_bbar")
        if self.options["geometry"] == "updated":
            self._try_model("small strain", "continuum/geometry", "small_strain")

    def _settle_samples(self) -> None:
        """The outline of the continuum comes from a sample."""
        if self.options["mesh"] != "outline" or self.keys["sample"]["file"]:
            return
        first, accuracy = self.keys["sample"]["seed"], self.question.accuracy
        point = self._run_with(seeds=range(first, first + SCATTER_SAMPLES))
        if point.failure:
            self._note(f"the scatter of the samples is unknown: {point.failure}")
            return
        self.scatter = [summary_of(point.values[q], asked["line"])[1] for q, asked in enumerate(self.quantities)]
        needed = [samples_for(scatter, max(OF_SAMPLES * accuracy, accuracy - sum(part.error for part in parts)))
                  for scatter, parts in zip(self.scatter, self.parts)]
        self.plan.reaches = self.plan.reaches and min(needed) > 0
        n = max(1, *needed)
        self.now, self.plan.seeds = point, list(range(first, first + n))
        for parts, scatter in zip(self.parts, self.scatter):
            parts.append(Part(cause=SAMPLES, error=half_interval(scatter, n)))

    def _conclude(self) -> None:
        plan, now = self.plan, self.now
        plan.settings, plan.cpu_s, plan.peak_memory_mb = self.chosen, now.cpu_s, now.peak_memory_mb
        for q, asked in enumerate(self.quantities):
            mean = summary_of(now.values[q], asked["line"])[0].mean
            plan.quantities.append(Budget(name=asked["name"], mean=mean, scatter=self.scatter[q], parts=self.parts[q]))
