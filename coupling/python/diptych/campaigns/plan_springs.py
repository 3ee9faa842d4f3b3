# diptych: whether springs are cheaper than contact dynamics for the grains of a plan
# SPDX-License-Identifier: LGPL-2.1-or-later
"""discrete/method = auto expects which method is cheaper at a size, speed and accuracy (coupling/scene/derived_keys.h). That
estimate is right within a factor of two. Where springs may be cheaper, a plan runs one sample with them, and takes them if they
save time."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from .plan_errors import half_interval, samples_for
from .plan_question import Budget, PanelPlan, Part, Question, RunPilot, Task, planned

SPRINGS = [planned("discrete/method", "penalty"), planned("discrete/penalty_stiffness", 1e4),
           planned("discrete/penalty_step_fraction", 0.5)]
# Largest relative errors of these springs, measured bias and its standard error (benchmarks/rigid_limit/order.py).
ERROR = {"strength": 0.01, "dilation": 0.04}


def try_springs(plan: PanelPlan, question: Question, run: RunPilot, quantities: Sequence[dict[str, Any]]) -> None:
    """Replaces the settings, samples and errors of a complete plan of the grains if springs are cheaper."""
    if not plan.reaches or not plan.seeds or not all(asked["step_error"] for asked in quantities):
        return
    errors = [ERROR[asked["step_error"]] for asked in quantities]
    needed = [samples_for(q.scatter, question.accuracy - error) for q, error in zip(plan.quantities, errors)]
    if min(needed) == 0:
        plan.decisions.append("springs (discrete/method = penalty): not tried; their error is too large for this accuracy")
        return
    samples, contact_dynamics = max(needed), plan.total_cpu_s
    pilot = run(Task(plan.command, [*question.changes, *SPRINGS], plan.seeds[:1], quantities))
    cpu_s = samples * pilot.cpu_s
    used = not pilot.failure and cpu_s < contact_dynamics
    plan.decisions.append(f"springs (discrete/method = penalty): {pilot.failure or f'{cpu_s:.3g} CPU s on {samples} samples'}; "
                          f"{'used' if used else 'not used'}, contact dynamics takes {contact_dynamics:.3g} CPU s")
    if used:
        plan.settings, plan.levels = list(SPRINGS), {}
        plan.seeds = [plan.seeds[0] + k for k in range(samples)]
        plan.cpu_s, plan.peak_memory_mb = pilot.cpu_s, pilot.peak_memory_mb
        plan.quantities = [Budget(q.name, q.mean, q.scatter,
                                  [Part("springs", error), Part("samples", half_interval(q.scatter, samples))])
                           for q, error in zip(plan.quantities, errors)]
