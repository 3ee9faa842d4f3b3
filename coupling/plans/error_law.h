// diptych: estimates the error of a setting from a few cheap runs
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <limits>
#include <vector>

namespace diptych::coupling
{
  // A number with its uncertainty.
  struct Estimate
  {
    double mean = 0, deviation = 0;
  };

  // The difference that a rule expects between two settings, and the one measured on the same samples.
  struct Evidence
  {
    double expected, measured, standard_error;
  };

  // The factor measured / expected: the prior updated with the evidence (Gaussian, conjugate). Evidence without a standard
  // error, or with an expected difference of 0, does not count.
  [[nodiscard]] Estimate improved(const Estimate &prior, const std::vector<Evidence> &evidence);

  // Convergence of a quantity with a size (of elements, of load steps): error = finest x (size / finest size)^order.
  struct Refinement
  {
    double finest_size = 0,
           error       = std::numeric_limits<double>::quiet_NaN(); // at the finest size, >= 0, in the unit of the values
    double order       = 1;
    double sign        = 0;    // +1: coarse values lie above the limit
    bool   converges   = true; // the last change is clearly smaller than the one before
  };

  // sizes descending, one value each. With three or more values, the order follows from the last two changes, limited to [1/2,
  // 2]; with two values it is 1. A change that is small by chance counts at least a quarter of the one before. The error is NaN
  // for less than two values.
  [[nodiscard]] Refinement refinement(const std::vector<double> &sizes, const std::vector<double> &values);

  [[nodiscard]] double error_at(const Refinement &refinement, double size);
  [[nodiscard]] double size_for(const Refinement &refinement, double error); // infinity if nothing changes

  // Half the 95 % Student interval of the mean of n samples with this deviation. For n = 1 the deviation is taken as known from
  // four samples.
  [[nodiscard]] double half_interval(double deviation, int n);

  // Smallest number of samples for an interval below `half`. 0 if a million samples do not suffice or the deviation is unknown.
  [[nodiscard]] int samples_for(double deviation, double half);
} // namespace diptych::coupling
