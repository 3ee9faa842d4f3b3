// diptych: plans step, tolerance, snapshots and number of samples of the grains
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/plans/plan.h"
#include "coupling/scene/scene.h"

namespace diptych::coupling
{
  // The pilot runs eight samples at the coarsest discrete/accuracy and four of them at half of it. They give scatter and cost,
  // and test the rule for the errors of step and tolerance (a factor, 1 +- 0.5 beforehand). The plan takes the accuracy that
  // reaches the goal with the least CPU time. A coarser one is cheaper, but leaves less for the interval of the mean and so
  // needs more samples.
  PanelPlan plan_grains(const PlanQuestion &question, const Scene &scene, const RunPilot &run);
} // namespace diptych::coupling
