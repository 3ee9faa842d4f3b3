// diptych: what a few cheap runs say of the error of a setting
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <limits>
#include <vector>

namespace diptych::coupling
{
  // A number that is known to some extent.
  struct Estimate
  {
    double mean = 0, deviation = 0;
  };

  // A rule expects a difference between two settings; `measured` is what they made on the same samples.
  struct Evidence
  {
    double expected, measured, standard_error;
  };

  // The factor measured / expected: what was thought of it before, with the evidence (Gaussian, conjugate). Evidence without a
  // standard error, or of nothing expected, does not count.
  [[nodiscard]] Estimate improved(const Estimate &prior, const std::vector<Evidence> &evidence);

  // How a quantity goes to its limit as a size (of elements, of load steps) does: error = finest x (size / finest size)^order.
  struct Refinement
  {
    double finest_size = 0,
           error       = std::numeric_limits<double>::quiet_NaN(); // at the finest size, >= 0, in the unit of the values
    double order       = 1;
    double sign        = 0;    // +1: coarse values lie above the limit
    bool   converges   = true; // the last change is smaller than the one before
  };

  // sizes descending, one value each. From three on the order is that of the last changes, between 1/2 and 2, below it 1; a
  // change that happens to be small does not count for less than a quarter of the one before it. The error is NaN below two
  // values.
  [[nodiscard]] Refinement refinement(const std::vector<double> &sizes, const std::vector<double> &values);

  [[nodiscard]] double error_at(const Refinement &refinement, double size);
  [[nodiscard]] double size_for(const Refinement &refinement, double error); // infinity where nothing changes

  // Half the 95 % Student interval of the mean of n samples with this deviation; for a single one of a deviation that four
  // samples told.
  [[nodiscard]] double half_interval(double deviation, int n);

  // The least number of samples that brings it below `half`; 0 where a million do not, or where the deviation is not known.
  [[nodiscard]] int samples_for(double deviation, double half);
} // namespace diptych::coupling
