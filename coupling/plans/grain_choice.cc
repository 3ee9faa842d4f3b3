// diptych: chooses the accuracy of the grains and the number of samples with the least cost
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/plans/grain_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "coupling/plans/plan_text.h"

namespace diptych::coupling
{
  namespace
  {
    constexpr int most_samples_of_a_plan = 2000; // if more are needed, larger samples are better
  }                                              // namespace

  double cost_at(const std::vector<CostPoint> &measured, const double accuracy)
  {
    std::size_t k = 1; // the enclosing pair, or the last one
    while (k + 1 < measured.size() && accuracy < measured[k].accuracy)
      ++k;
    const CostPoint &a = measured[k - 1], &b = measured[k];
    const double     order = std::log(b.cpu_s / a.cpu_s) / std::log(a.accuracy / b.accuracy);
    return b.cpu_s * std::pow(b.accuracy / accuracy, order);
  }

  double GrainErrors::at(const double accuracy) const
  {
    return accuracy * (from_a_rule ? std::abs(step.mean) : std::hypot(step.mean, step.deviation));
  }

  GrainChoice cheapest_choice(const std::vector<GrainErrors> &errors,
                              const std::vector<CostPoint>   &cost,
                              const double                    target,
                              const int                       samples)
  {
    constexpr int steps_per_halving = 4;
    GrainChoice   best;
    double        least = std::numeric_limits<double>::infinity();
    for (int k = 0;; ++k)
      {
        const double accuracy = std::max(finest_accuracy,
                                         rounded_to_two_digits(coarsest_accuracy * std::exp2(-double(k) / steps_per_halving)));
        int          n        = std::max(1, samples);
        bool         suffices = true;
        for (const GrainErrors &one : errors)
          {
            const double left = target - one.at(accuracy);
            suffices          = suffices && left > 0;
            const int needed  = samples > 0 ? samples : samples_for(one.scatter, left);
            suffices          = suffices && needed > 0;
            n                 = std::max(n, needed);
          }
        if (suffices && n <= most_samples_of_a_plan && n * cost_at(cost, accuracy) < least)
          best = {accuracy, n}, least = n * cost_at(cost, accuracy);
        if (accuracy == finest_accuracy)
          return best;
      }
  }
} // namespace diptych::coupling
