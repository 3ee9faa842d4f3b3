// diptych: step, tolerance, snapshots and number of samples that the grains need
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/plans/error_law.h"
#include "coupling/plans/plan.h"
#include "coupling/scene/scene.h"

namespace diptych::coupling
{
  // A pilot of eight samples at the coarsest discrete/accuracy, four of them at half of it: scatter, cost, and whether step and
  // tolerance err as the rule expects (a factor, 1 +- 0.5 beforehand). Of all accuracies the one is taken that reaches what is
  // asked with the least CPU time: a coarser one is cheaper, but leaves less to the interval of the mean and so takes more
  // samples.
  PanelPlan plan_grains(const PlanQuestion &question, const Scene &scene, const RunPilot &run);

  // CPU seconds of a sample at a discrete/accuracy.
  struct CostPoint
  {
    double accuracy, cpu_s;
  };

  // Between two that were measured, and beyond, along the line through the two nearest in logarithms. Accuracies descending, two
  // or more.
  double cost_at(const std::vector<CostPoint> &measured, double accuracy);

  // A quantity's errors at discrete/accuracy 1, as a multiple of it, and of one sample.
  struct GrainErrors
  {
    Estimate step;        // per accuracy
    double   scatter;     // relative
    bool     from_a_rule; // else the deviation counts as an error, too

    double at(double accuracy) const;
  };

  struct GrainChoice
  {
    double accuracy = 0;
    int    samples  = 0; // 0: none suffices
  };

  // `samples`: 0 where their number is free.
  GrainChoice cheapest_choice(const std::vector<GrainErrors> &errors,
                              const std::vector<CostPoint>   &cost,
                              double                          target,
                              int                             samples);
} // namespace diptych::coupling
