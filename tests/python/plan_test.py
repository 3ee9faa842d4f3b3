# diptych: plans of panels with known errors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Closed forms stand instead of the panels, so nothing is run."""

import math

import numpy as np
import pytest

import diptych
from diptych import scenes
from diptych.campaigns.plans import errors
from diptych.campaigns.plans import grains as plan_grains
from diptych.campaigns.studies.levels import limit_of
from diptych.campaigns.plans.continuum import ContinuumPlan
from diptych.campaigns.plans.errors import Estimate, GrainErrors
from diptych.campaigns.plans.grains import GrainsPlan
from diptych.campaigns.plans.question import Budget, PanelPlan, Part, Pilot, Question, planned, read_accuracy
from diptych.campaigns.plans.springs import try_springs
from diptych.campaigns.studies.study_file import quantity

RULE = Estimate(1, 0.5)


def last(settings, key, otherwise):
    """The last value of a key as text."""
    return next((one.value for one in reversed(settings) if f"{one.section}/{one.key}" == key), otherwise)


def question(accuracy):
    asked = [quantity("strength", step_error="strength")]
    return Question(scene="scene.prm", changes=[], accuracy=accuracy,
                    quantities={"discrete": asked, "continuum": asked})


def test_a_rule_holds_until_there_is_evidence():
    assert errors.improved(RULE, []).mean == 1
    assert errors.improved(RULE, [(0.02, 0.08, 0), (0, 0.01, 0.01)]).mean == 1  # without information
    equal = errors.improved(RULE, [(0.02, 0.04, 0.01)])  # equal weights: half way between prior and measurement
    assert equal == pytest.approx((1.5, 0.5 / math.sqrt(2)), rel=1e-12)
    assert errors.improved(RULE, [(0.02, 0.06, 1e-6)]).mean == pytest.approx(3, abs=1e-6)


@pytest.mark.parametrize("order", [0.5, 1, 1.5, 2])
def test_power_laws_are_continued_to_their_limit(order):
    r = errors.refinement([4, 2, 1], [7 - 0.1 * h**order for h in (4, 2, 1)])
    assert r.converges and r.order == pytest.approx(order, abs=1e-9)
    assert r.error_at(3) == pytest.approx(0.1 * 3**order, abs=1e-9)
    assert r.error_at(r.size_for(0.07)) == pytest.approx(0.07, abs=1e-12)


def test_changes_that_grow_or_vanish_by_chance_are_not_convergence():
    assert errors.refinement([2, 1], [5, 5.3]).error == pytest.approx(0.3)  # two values: first order
    assert math.isnan(errors.refinement([2], [5]).error)
    grows = errors.refinement([4, 2, 1], [1, 1.1, 1.25])
    assert not grows.converges and grows.error > 0.15  # the limit is at least the last change away
    assert errors.refinement([4, 2, 1], [1, 1.1, 1.1 + 1e-9]).error > 0.25 * 0.1 / 3 - 1e-9
    same = errors.refinement([4, 2, 1], [1, 1, 1])
    assert (same.error, same.sign, same.size_for(0.01)) == (0, 0, math.inf)
    assert [errors.refinement([2, 1], [5, fine]).sign for fine in (5.3, 4.9)] == [-1, 1]  # +1: coarse values lie above


def test_numbers_of_samples_are_the_least_that_suffice():
    assert errors.half_interval(1, 4) == pytest.approx(3.182446 / 2, abs=1e-6)  # Student's table: t(0.975, 3)
    for half in (0.05, 0.2, 0.5, 1, 3):
        n = errors.samples_for(1, half)
        assert errors.half_interval(1, n) <= half
        assert n == 1 or errors.half_interval(1, n - 1) > half
    assert [errors.samples_for(1, half) for half in (3.2, 1e-6, 0, -1)] == [1, 0, 0, 0]
    assert errors.samples_for(math.nan, 1) == 0  # the scatter is unknown


def test_the_choice_of_the_grains_is_the_cheapest():
    known = [GrainErrors(Estimate(1, 0.2), 0.03, True), GrainErrors(Estimate(1.5, 0.5), 0.02, True)]

    def cost(accuracy):
        return errors.cost_at([(0.05, 1), (0.025, 1.6)], accuracy)

    def total(accuracy):
        return cost(accuracy) * max(errors.samples_for(one.scatter, 0.04 - one.at(accuracy)) or 1e6 for one in known)

    accuracy, samples = errors.cheapest_choice(known, cost, 0.04, 0)
    assert samples > 0
    assert all(total(0.05 * 0.9**k) > 0.85 * total(accuracy) for k in range(37))  # the grid has four points per octave
    assert errors.cheapest_choice(known, cost, 0.0001, 0)[1] == 0


@pytest.mark.parametrize("text", ["2 %", "2%", "0.02"])
def test_accuracies_are_shares_or_per_cents(text):
    assert read_accuracy(text) == pytest.approx(0.02)


@pytest.mark.parametrize("wrong", ["2", "", "%", "two", "0.02 x", "0.0001", "60 %", "nan", "-1 %", "1e"])
def test_wrong_accuracies_are_refused(wrong):
    with pytest.raises(diptych.SceneError, match="--accuracy"):
        read_accuracy(wrong)


def grains_plan(accuracy, factor=1.0, scatter=0.04, noise=0.01, file=""):
    """Grains whose strength errs by `factor` times the rule's expectation. The cost is proportional to 1/accuracy."""
    def run(_, settings, seeds, __):
        if last(settings, "discrete/method", ""):
            return Pilot(failure="springs stay out of this plan")
        a = float(last(settings, "discrete/accuracy", "nan"))
        values = [0.3 * (1 + scatter * np.random.default_rng(seed).normal()) *
                  (1 + noise * np.random.default_rng([seed, int(1e6 * a)]).normal() + factor * a) for seed in seeds
                  or [1]]
        return Pilot(values=[values], cpu_s=0.05 / a, expected_error={"strength": a, "dilation": 1.25 * a})

    scene = scenes.read({"sample": {"file": file}} if file else {})
    return GrainsPlan(question(accuracy), scene, run).make()


@pytest.mark.parametrize("accuracy", [0.02, 0.05, 0.1])
def test_method_and_samples_together_keep_to_the_accuracy(accuracy, monkeypatch):
    monkeypatch.setattr(plan_grains, "FINE_LEVELS", (0.05,))  # one level only
    plan = grains_plan(accuracy)
    budget, truth = plan.quantities[0], float(last(plan.settings, "discrete/accuracy", "nan"))
    assert plan.reaches and 0.5 * accuracy < budget.total <= accuracy * (1 + 1e-12)
    assert truth / 2 < budget.parts[0].error < truth * 2
    assert plan.cpu_s == pytest.approx(0.05 / truth, rel=0.01) and plan.seeds[0] == 1


def test_two_levels_replace_one_if_they_are_cheaper_and_keep_to_the_accuracy(monkeypatch):
    """A hundred repetitions of the planned numbers of samples and pairs, whose bias is 1.0 x accuracy."""
    plan, rng = grains_plan(0.02), np.random.default_rng(1)
    cheap, fine, n, pairs = plan.levels["cheap"], plan.levels["fine"], plan.n_samples, plan.levels["pairs"]
    errors_of_means = []
    for _ in range(100):
        of_sample = 0.3 * (1 + 0.04 * rng.normal(size=n))
        x, y = (of_sample * (1 + 0.01 * rng.normal(size=n) + a) for a in (cheap, fine))
        y[pairs:] = np.nan
        errors_of_means.append(limit_of(x, y, fine / cheap).limit.value / 0.3 - 1)
    assert np.quantile(np.abs(errors_of_means), 0.95) < 0.02 and 0 < pairs < n
    monkeypatch.setattr(plan_grains, "FINE_LEVELS", (0.05,))
    assert plan.total_cpu_s < 0.8 * grains_plan(0.02).total_cpu_s
    assert plan.quantities[0].method == 0 and 0.015 < plan.quantities[0].total <= 0.02


@pytest.mark.parametrize("method, cpu_s, used", [("penalty", 3, True), ("penalty", 60, False), ("compliant", 1, True),
                                                 ("compliant", 6, False)])
def test_springs_replace_contact_dynamics_where_they_are_cheaper(method, cpu_s, used):
    """Eight samples of 10 CPU s each; with springs 1 % of the accuracy of 3 % is taken, and more samples are needed.
    Implicit springs keep the error of the step, too."""
    asked = [quantity("strength", step_error="strength")]
    plan = PanelPlan(panel="discrete", command="discrete", settings=[planned("discrete/accuracy", 0.01)],
                     seeds=list(range(1, 9)), cpu_s=10.0,
                     quantities=[Budget(name="strength", mean=0.3, scatter=0.02,
                                        parts=[Part(cause="step, tolerance", error=0.01),
                                               Part(cause="samples", error=0.0167)])])
    try_springs(plan, question(0.03), lambda *_: Pilot(values=[[0.3]], sample_cpu_s=[cpu_s], cpu_s=cpu_s), asked,
                method)
    assert (last(plan.settings, "discrete/method", "") == method) == used
    assert (method, used) != ("compliant", True) or plan.quantities[0].method == pytest.approx(0.02)
    assert plan.quantities[0].total <= 0.03 and plan.total_cpu_s <= 80


def test_a_wrong_rule_is_detected_and_costs_more(monkeypatch):
    monkeypatch.setattr(plan_grains, "FINE_LEVELS", (0.05,))
    usual, worse = grains_plan(0.03), grains_plan(0.03, 6, 0.04, 0.002)
    finer = float(last(worse.settings, "discrete/accuracy", "nan"))
    assert worse.reaches and finer < float(last(usual.settings, "discrete/accuracy", "nan"))
    assert 6 * finer / 2 < worse.quantities[0].parts[0].error < 6 * finer * 2


def test_one_sample_from_a_file_has_the_variation_of_one_run_instead_of_scatter(tmp_path):
    file = tmp_path / "sample.csv"
    file.write_text("x,y,r\n" + "".join(f"{k % 10},{k // 10},0.5\n" for k in range(100)))
    quiet = grains_plan(0.03, noise=0.001, file=str(file))
    assert quiet.reaches and quiet.n_samples == 1 and math.isnan(quiet.quantities[0].scatter)
    assert quiet.quantities[0].parts[-1].cause == "one run"
    assert not grains_plan(0.03, noise=0.05, file=str(file)).reaches  # one run lies 5 % from the mean of runs


def test_accuracies_out_of_reach_are_reported():
    assert not grains_plan(0.001, scatter=300).reaches
    failed = GrainsPlan(question(0.02), scenes.read({}), lambda *_: Pilot(failure="no room")).make()
    assert not failed.reaches and "no room" in failed.decisions[-1]


def elements(of_elements=0.002, of_steps=2.0, of_law=0.0, is_local=False, longest=math.inf):
    """A continuum whose strength errs with the square of its element size and linearly with its load step."""
    def run(_, settings, *__):
        h, step, tolerance = (float(last(settings, "continuum/" + key, usual))
                              for key, usual in (("element_size", "1"), ("max_step", "0.01"), ("tolerance", "1e-5")))
        law = last(settings, "continuum/law", "")
        local = is_local and law != "cosserat_mohr_coulomb"
        value = 0.4 * (1 + (0.05 * math.log2(h) if local else of_elements * h * h)) * (1 + of_steps
                                                                                       * min(step, longest))
        value *= (1 + 0.1 * tolerance) * (1 + of_law if law == "mohr_coulomb" else 1)
        return Pilot(values=[[value]], cpu_s=h**-2 / (2 if law == "mohr_coulomb" else 1))

    return run


def continuum_plan(law, accuracy=0.02, hardening="exponential", **known):
    scene = scenes.read({"continuum": {"mesh": "rectangle", "rectangle_width": 60, "rectangle_height": 80, "law": law,
                                       "geometry": "small_strain", "internal_length": 2, "hardening": hardening},
                         "loading": {"stage_strain": 0.01}})
    return ContinuumPlan(question(accuracy), scene, elements(**known)).make()


def test_every_knob_is_as_coarse_as_its_share_allows():
    plan = continuum_plan("cosserat_mohr_coulomb", of_law=0.03)
    h, step = (float(last(plan.settings, "continuum/" + key, "nan")) for key in ("element_size", "max_step"))
    truth = 0.002 * h * h + 2 * step
    assert plan.reaches and truth < 0.02 and truth / 2 < plan.quantities[0].total < truth * 2
    assert h > 1  # elements of 2 d err by 0.8 %, which is allowed
    assert last(plan.settings, "continuum/tolerance", "") == planned("continuum/tolerance", 1e-3).value
    assert plan.n_samples == 1


@pytest.mark.parametrize("of_law, used", [(0.001, True), (0.03, False)])
def test_an_internal_length_is_kept_where_it_matters(of_law, used):
    plan = continuum_plan("cosserat_mohr_coulomb", of_law=of_law)
    assert (last(plan.settings, "continuum/law", "") == "mohr_coulomb") == used  # half the cost


def test_a_mesh_dependent_law_is_replaced_and_reported():
    plan = continuum_plan("mohr_coulomb", is_local=True)
    assert plan.reaches and any("used instead: cosserat_mohr_coulomb" in one for one in plan.decisions)
    assert not any("rough platens" in one for one in plan.decisions)


def test_rough_platens_and_perfect_plasticity_are_reported_to_need_small_elements():
    plan = continuum_plan("mohr_coulomb", hardening="constant")
    assert any("rough platens" in one for one in plan.decisions)


def test_a_size_without_effect_is_not_convergence():
    """Load steps above 0.002 have no effect, so the first three values are equal and contain no information."""
    plan = continuum_plan("drucker_prager", of_elements=0.0001, of_steps=20, longest=0.002)
    # 20 x the step is to stay below a fifth of 2 %
    assert float(last(plan.settings, "continuum/max_step", "nan")) < 0.0005
