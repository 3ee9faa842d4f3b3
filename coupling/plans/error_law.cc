// diptych: estimates the error of a setting from a few cheap runs
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/plans/error_law.h"

#include <algorithm>
#include <cmath>

#include "coupling/statistics/student.h"

namespace diptych::coupling
{
  namespace
  {
    constexpr double least_order = 0.5, largest_order = 2, least_share_of_earlier_change = 0.25;
    constexpr double of_one_sample    = 3.18; // Student's factor for a deviation known from four samples
    constexpr double still_converging = 0.8;  // of the change before; with slower convergence there may be no limit
    constexpr int    most_samples     = 1000000;
  } // namespace

  Estimate improved(const Estimate &prior, const std::vector<Evidence> &evidence)
  {
    double weight = 1 / (prior.deviation * prior.deviation), sum = prior.mean * weight;
    for (const Evidence &one : evidence)
      if (one.standard_error > 0 && one.expected != 0)
        {
          const double w = std::pow(one.expected / one.standard_error, 2);
          weight += w, sum += w * one.measured / one.expected;
        }
    return {sum / weight, 1 / std::sqrt(weight)};
  }

  Refinement refinement(const std::vector<double> &sizes, const std::vector<double> &values)
  {
    Refinement        result;
    const std::size_t n = values.size();
    result.finest_size  = sizes.back();
    if (n < 2)
      return result;
    const double ratio = sizes[n - 2] / sizes[n - 1];
    result.sign        = values[n - 2] == values[n - 1] ? 0 : std::copysign(1., values[n - 2] - values[n - 1]);
    double last        = std::abs(values[n - 1] - values[n - 2]);
    if (n > 2)
      {
        const double earlier = std::abs(values[n - 2] - values[n - 3]);
        result.converges     = last <= still_converging * earlier;
        if (last > 0 && earlier > 0)
          result.order = std::clamp(std::log(earlier / last) / std::log(ratio), least_order, largest_order);
        last = std::max(last, least_share_of_earlier_change * earlier);
      }
    result.error = last / (std::pow(ratio, result.order) - 1);
    return result;
  }

  double error_at(const Refinement &refinement, const double size)
  {
    return refinement.error * std::pow(size / refinement.finest_size, refinement.order);
  }

  double size_for(const Refinement &refinement, const double error)
  {
    return refinement.finest_size * std::pow(error / refinement.error, 1 / refinement.order);
  }

  double half_interval(const double deviation, const int n)
  {
    return n < 2 ? of_one_sample * deviation : student_quantile(0.975, n - 1) * deviation / std::sqrt(double(n));
  }

  int samples_for(const double deviation, const double half)
  {
    if (!(half > 0 && deviation >= 0))
      return 0;
    if (half_interval(deviation, 1) <= half)
      return 1;
    int low = 1, high = 2; // `low` samples are too few
    while (high < most_samples && half_interval(deviation, high) > half)
      low = high, high *= 2;
    if (half_interval(deviation, high) > half)
      return 0;
    while (high - low > 1)
      {
        const int middle                                       = low + (high - low) / 2;
        (half_interval(deviation, middle) > half ? low : high) = middle;
      }
    return high;
  }
} // namespace diptych::coupling
