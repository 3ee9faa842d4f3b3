// diptych: 95 % interval of the mean of a series whose neighbours are correlated
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/statistics/history_table.h"
#include "coupling/statistics/interval.h"

namespace diptych::coupling
{
  // Mean of equally weighted batch means b_k +- t s sqrt((1 + r) / (1 - r)) / sqrt(n): s their deviation, t Student's 97.5 %
  // quantile for n - 1 degrees of freedom, r = (lag-one correlation of the b_k) + 1/n, its bias, held within 0 and 0.9. The root
  // is what a series of lag-one correlation r adds to the error of its mean: batches shorter than a few correlation lengths are
  // not independent. Ends NaN for fewer than three batches or one that is NaN.
  Interval interval_of_batches(const std::vector<double> &batch_mean);

  // Weighted mean of a series cut into n_batches runs of (nearly) equal weight, one after another; weights: durations or strains
  // of the values. Ends NaN where a batch would be empty. Throws std::invalid_argument for n_batches < 1, counts that differ, a
  // weight below 0 or a sum of weights that is not positive.
  Interval batch_mean_interval(const std::vector<double> &values, const std::vector<double> &weights, int n_batches);

  // mean_over_progress() of a column, with batches of equal progress.
  Interval mean_interval_over_progress(const HistoryTable &table,
                                       const std::string  &name,
                                       double              from,
                                       double              to,
                                       int                 n_batches = 4);
} // namespace diptych::coupling
