// diptych: the accuracy of the grains and the number of samples that cost least
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "coupling/plans/error_law.h"

namespace diptych::coupling
{
  constexpr double coarsest_accuracy = 0.05, finest_accuracy = 0.001; // of discrete/accuracy

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
