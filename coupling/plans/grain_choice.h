// diptych: chooses the accuracy of the grains and the number of samples with the least cost
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "coupling/plans/error_law.h"

namespace diptych::coupling
{
  constexpr double coarsest_accuracy = 0.05, finest_accuracy = 0.001; // of discrete/accuracy

  // CPU seconds of one sample at a discrete/accuracy.
  struct CostPoint
  {
    double accuracy, cpu_s;
  };

  // Interpolates, and extrapolates along the line through the two nearest points in logarithms. `measured` holds two or more
  // points with descending accuracies.
  double cost_at(const std::vector<CostPoint> &measured, double accuracy);

  // Errors of a quantity: proportional to discrete/accuracy, and the scatter of one sample.
  struct GrainErrors
  {
    Estimate step;        // at discrete/accuracy 1
    double   scatter;     // relative
    bool     from_a_rule; // false: the deviation of the estimate counts as an error, too

    double at(double accuracy) const;
  };

  struct GrainChoice
  {
    double accuracy = 0;
    int    samples  = 0; // 0: no number suffices
  };

  // `samples`: the fixed number of samples, or 0 if it is free.
  GrainChoice cheapest_choice(const std::vector<GrainErrors> &errors,
                              const std::vector<CostPoint>   &cost,
                              double                          target,
                              int                             samples);
} // namespace diptych::coupling
