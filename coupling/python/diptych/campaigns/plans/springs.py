# diptych: whether springs are cheaper than contact dynamics for the grains of a plan
# SPDX-License-Identifier: LGPL-2.1-or-later
"""discrete/method = auto expects which method is cheaper at a size, speed and accuracy (coupling/scene/derived_keys.h).
That estimate is right within a factor of two. Where springs may be cheaper, a plan runs one sample with them, and takes
them if they save time. Implicit springs (compliant) keep step and errors; explicit ones (penalty) have their own."""

from collections.abc import Sequence
from typing import Any

from .errors import half_interval, samples_for
from .question import SAMPLES, Budget, PanelPlan, Part, Question, RunPilot, planned

STIFFNESS = planned("discrete/penalty_stiffness", 1e4)
# Largest relative errors of these springs: of explicit ones against the limit of short steps, of implicit ones against
# contact dynamics at the same step; measured bias and its standard error (benchmarks/rigid_limit/order.py).
ERROR = {"strength": 0.01, "dilation": 0.04}


def try_springs(plan: PanelPlan, question: Question, run: RunPilot, quantities: Sequence[dict[str, Any]],
                method: str) -> None:
    """Replaces settings, samples and errors of a complete plan of the grains if springs are cheaper. method: that of
    the springs. A plan with two levels has removed the error of the step, so implicit springs are not tried there."""
    implicit = method == "compliant"
    has_rules = all(asked["step_error"] for asked in quantities)
    if not plan.reaches or not plan.seeds or not has_rules or (implicit and plan.levels):
        return
    settings = [planned("discrete/method", method), STIFFNESS]
    settings = [*plan.settings, *settings] if implicit else [*settings, planned("discrete/penalty_step_fraction", 0.5)]
    parts = [[*(part for part in q.parts if implicit and part.is_of_method),
              Part(cause="springs", error=ERROR[asked["step_error"]])] for q, asked in zip(plan.quantities, quantities)]
    needed = [samples_for(q.scatter, question.accuracy - sum(part.error for part in of_q))
              for q, of_q in zip(plan.quantities, parts)]
    name = f"springs (discrete/method = {method})"
    if min(needed) == 0:
        plan.decisions.append(f"{name}: not tried; their error is too large for this accuracy")
        return
    samples, before = max(needed), plan.total_cpu_s
    pilot = run(plan.command, [*question.changes, *settings], plan.seeds[:1], quantities)
    cpu_s = samples * pilot.cpu_s
    used = not pilot.failure and cpu_s < before
    plan.decisions.append(f"{name}: {pilot.failure or f'{cpu_s:.3g} CPU s on {samples} samples'}; "
                          f"{'used' if used else 'not used'}, without them {before:.3g} CPU s")
    if used:
        plan.settings, plan.levels = settings, {}
        plan.seeds = [plan.seeds[0] + k for k in range(samples)]
        plan.cpu_s, plan.peak_memory_mb = pilot.cpu_s, pilot.peak_memory_mb
        plan.quantities = [Budget(name=q.name, mean=q.mean, scatter=q.scatter,
                                  parts=[*of_q, Part(cause=SAMPLES, error=half_interval(q.scatter, samples))])
                           for q, of_q in zip(plan.quantities, parts)]
