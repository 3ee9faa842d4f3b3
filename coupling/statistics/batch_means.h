// diptych: 95 % interval of the mean of a series with correlated neighbours
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/statistics/history_table.h"
#include "coupling/statistics/interval.h"

namespace diptych::coupling
{
  // Mean of equally weighted batch means b_k +- t s sqrt((1 + r) / (1 - r)) / sqrt(n). `s` is the standard deviation of the b_k,
  // and t Student's 97.5 % quantile for n - 1 degrees of freedom. r = (lag-one correlation of the b_k) + 1/n, limited to 0..0.9;
  // the term 1/n corrects the bias. The root widens the interval, because batches shorter than a few correlation lengths are not
  // independent. Ends are NaN for fewer than three batches or if a batch is NaN.
  Interval interval_of_batches(const std::vector<double> &batch_mean);

  // Weighted mean of a series that is cut into n_batches consecutive runs of (nearly) equal weight. weights: durations or strains
  // of the values. Ends are NaN if a batch would be empty. Throws std::invalid_argument for n_batches < 1, different counts, a
  // weight below 0 or a sum of weights that is not positive.
  Interval batch_mean_interval(const std::vector<double> &values, const std::vector<double> &weights, int n_batches);

  // mean_over_progress() of a column, with batches of equal progress.
  Interval mean_interval_over_progress(const HistoryTable &table,
                                       const std::string  &name,
                                       double              from,
                                       double              to,
                                       int                 n_batches = 4);
} // namespace diptych::coupling
