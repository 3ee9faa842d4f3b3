// diptych: step, tolerance, snapshots and number of samples that the grains need
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/plans/plan.h"
#include "coupling/scene/scene.h"

namespace diptych::coupling
{
  // A pilot of eight samples at the coarsest discrete/accuracy, four of them at half of it: scatter, cost, and whether step and
  // tolerance err as the rule expects (a factor, 1 +- 0.5 beforehand). Of all accuracies the one is taken that reaches what is
  // asked with the least CPU time: a coarser one is cheaper, but leaves less to the interval of the mean and so takes more
  // samples.
  PanelPlan plan_grains(const PlanQuestion &question, const Scene &scene, const RunPilot &run);
} // namespace diptych::coupling
