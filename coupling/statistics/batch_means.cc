// diptych: 95 % interval of the mean of a series with correlated neighbours
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/statistics/batch_means.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "coupling/statistics/student.h"

namespace diptych::coupling
{
  namespace
  {
    Interval around(const double value, const Interval &of_batches)
    {
      return {value, value + of_batches.low - of_batches.value, value + of_batches.high - of_batches.value};
    }
  } // namespace

  Interval interval_of_batches(const std::vector<double> &b)
  {
    const int n = static_cast<int>(b.size());
    Interval  result;
    result.value = n > 0 ? std::accumulate(b.begin(), b.end(), 0.) / n : NAN;
    if (n < 3 || !std::isfinite(result.value))
      return result;
    double square = 0, product = 0;
    for (int k = 0; k < n; ++k)
      {
        square += (b[k] - result.value) * (b[k] - result.value);
        if (k > 0)
          product += (b[k] - result.value) * (b[k - 1] - result.value);
      }
    const double r    = square > 0 ? std::clamp(product / square + 1. / n, 0., 0.9) : 0;
    const double half = student_quantile(0.975, n - 1) * std::sqrt(square / (n - 1) / n * (1 + r) / (1 - r));
    return {result.value, result.value - half, result.value + half};
  }

  Interval batch_mean_interval(const std::vector<double> &values, const std::vector<double> &weights, const int n_batches)
  {
    if (n_batches < 1)
      throw std::invalid_argument("the number of batches must be at least 1, not " + std::to_string(n_batches));
    if (weights.size() != values.size())
      throw std::invalid_argument("a series needs one weight per value");
    if (std::any_of(weights.begin(), weights.end(), [](const double w) { return !(w >= 0); }))
      throw std::invalid_argument("the weights of a series must not be negative");
    const double total = std::accumulate(weights.begin(), weights.end(), 0.);
    if (!(total > 0))
      throw std::invalid_argument("the weights of a series must have a positive sum");

    std::vector<double> sum(n_batches, 0.), weight(n_batches, 0.);
    double              before = 0, all = 0;
    for (std::size_t k = 0; k < values.size(); ++k)
      {
        // The value goes to the batch that holds the middle of its weight.
        const int batch = std::min(n_batches - 1, static_cast<int>((before + 0.5 * weights[k]) / total * n_batches));
        sum[batch] += weights[k] * values[k];
        weight[batch] += weights[k];
        all += weights[k] * values[k];
        before += weights[k];
      }
    for (int batch = 0; batch < n_batches; ++batch)
      sum[batch] = weight[batch] > 0 ? sum[batch] / weight[batch] : NAN;
    return around(all / total, interval_of_batches(sum));
  }

  Interval mean_interval_over_progress(const HistoryTable &table,
                                       const std::string  &name,
                                       const double        from,
                                       const double        to,
                                       const int           n_batches)
  {
    std::vector<double> batch;
    for (int k = 0; k < n_batches; ++k)
      batch.push_back(
        mean_over_progress(table, name, from + (to - from) * k / n_batches, from + (to - from) * (k + 1) / n_batches));
    const std::vector<double> &progress = column(table, "progress");
    const auto                 rows     = std::count_if(progress.begin(), progress.end(),
                                                        [&](const double at) { return is_beyond(at, from) && !is_beyond(at, to); });
    const double               value    = mean_over_progress(table, name, from, to);
    return rows >= 2 * n_batches ? around(value, interval_of_batches(batch)) : Interval{value, NAN, NAN};
  }
} // namespace diptych::coupling
