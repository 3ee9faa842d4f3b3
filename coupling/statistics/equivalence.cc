// diptych: statistics over realisations, and the equivalence of two panels within a margin
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/statistics/equivalence.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "coupling/cells/principal_axes.h"
#include "coupling/statistics/student.h"

namespace diptych::coupling
{
  namespace
  {
    double mean_of(const std::vector<double> &values)
    {
      double sum = 0;
      for (const double value : values)
        sum += value;
      return sum / double(values.size());
    }

    // Sum of products of the deviations / (n - 1).
    double covariance(const std::vector<double> &a, const std::vector<double> &b)
    {
      const double mean_a = mean_of(a), mean_b = mean_of(b);
      double       sum = 0;
      for (std::size_t k = 0; k < a.size(); ++k)
        sum += (a[k] - mean_a) * (b[k] - mean_b);
      return sum / double(a.size() - 1);
    }

    Interval student_interval(const SampleStatistics &s, const double confidence)
    {
      if (s.n < 2)
        return {s.mean};
      const double half = student_quantile((1 + confidence) / 2, s.n - 1) * s.deviation / std::sqrt(double(s.n));
      return {s.mean, s.mean - half, s.mean + half};
    }

    SampleStatistics with_interval(SampleStatistics s)
    {
      const Interval interval = student_interval(s, 0.95);
      s.low                   = interval.low;
      s.high                  = interval.high;
      return s;
    }

    // Comparisons with NaN are false, so an unknown interval gives no verdict.
    Verdict verdict_of(const Equivalence &e, const double margin)
    {
      if (e.difference_90.low > -margin && e.difference_90.high < margin)
        return Verdict::equivalent;
      if (e.difference.low > margin || e.difference.high < -margin)
        return Verdict::different;
      return Verdict::cannot_tell;
    }

    Equivalence judged(const SampleStatistics &s, const double margin)
    {
      Equivalence result{s.n, student_interval(s, 0.95), student_interval(s, 0.90)};
      result.verdict = verdict_of(result, margin);
      return result;
    }

    // The ratios q of means that Student's test of mean(b - q a) = 0 does not reject. They satisfy (mean_b - q mean_a)^2 <=
    // (t^2/n) (s_bb - 2 q s_ab + q^2 s_aa), an interval if mean_a differs significantly from 0.
    Interval fieller_interval(const std::vector<double> &a, const std::vector<double> &b, const double confidence)
    {
      const int    n      = int(a.size());
      const double mean_a = mean_of(a), mean_b = mean_of(b), t = student_quantile((1 + confidence) / 2, n - 1), g = t * t / n;
      const double square = mean_a * mean_a - g * covariance(a, a), product = mean_a * mean_b - g * covariance(a, b),
                   constant = mean_b * mean_b - g * covariance(b, b);
      if (!(square > 0))
        return {mean_b / mean_a - 1};
      const double root = std::sqrt(std::max(0., product * product - square * constant));
      return {mean_b / mean_a - 1, (product - root) / square - 1, (product + root) / square - 1};
    }
  } // namespace

  SampleStatistics statistics(const std::vector<double> &values)
  {
    SampleStatistics s;
    s.n = int(values.size());
    if (s.n > 0)
      s.mean = mean_of(values);
    if (s.n > 1)
      s.deviation = std::sqrt(covariance(values, values));
    return with_interval(s);
  }

  SampleStatistics line_statistics(const std::vector<double> &degrees)
  {
    constexpr double doubled = M_PI / 90, no_direction = 1e-9;
    SampleStatistics s;
    s.n      = int(degrees.size());
    double x = 0, y = 0;
    for (const double angle : degrees)
      {
        x += std::cos(doubled * angle);
        y += std::sin(doubled * angle);
      }
    if (!(std::hypot(x, y) > no_direction * s.n))
      return s;
    s.mean     = line_turn(std::atan2(y, x) / doubled, 0);
    double sum = 0;
    for (const double angle : degrees)
      sum += line_turn(angle, s.mean) * line_turn(angle, s.mean);
    if (s.n > 1)
      s.deviation = std::sqrt(sum / (s.n - 1));
    return with_interval(s);
  }

  std::string text_of(const Verdict verdict)
  {
    if (verdict == Verdict::equivalent)
      return "equivalent";
    return verdict == Verdict::different ? "different" : "cannot tell";
  }

  Equivalence compare_differences(const std::vector<double> &differences, const double margin)
  {
    return judged(statistics(differences), margin);
  }

  Equivalence widened(Equivalence result, const double deviation, const double quantile, const double margin)
  {
    const auto widen = [&](Interval &interval, const double half) {
      const double value = interval.value;
      interval.low       = value - std::hypot(value - interval.low, half);
      interval.high      = value + std::hypot(interval.high - value, half);
    };
    constexpr double normal_95 =
      1.6448536269514722; // 95 % quantile. Student's quantile shrinks more from 97.5 to 95 %, so this is conservative.
    widen(result.difference, quantile * deviation);
    widen(result.difference_90, quantile * normal_95 / normal_quantile * deviation);
    result.verdict = verdict_of(result, margin);
    return result;
  }

  Equivalence compare_turns(const std::vector<double> &turns, const double margin)
  {
    return judged(line_statistics(turns), margin);
  }

  Equivalence compare_relative(const std::vector<double> &first, const std::vector<double> &second, const double margin)
  {
    if (first.size() != second.size())
      throw std::invalid_argument("compare_relative: " + std::to_string(first.size()) + " values against " +
                                  std::to_string(second.size()) + "; both lists need the same length");
    Equivalence result;
    result.n = int(first.size());
    if (first.empty())
      return result;
    result.difference.value = result.difference_90.value = mean_of(second) / mean_of(first) - 1;
    if (result.n < 2)
      return result;
    result.difference    = fieller_interval(first, second, 0.95);
    result.difference_90 = fieller_interval(first, second, 0.90);
    result.verdict       = verdict_of(result, margin);
    return result;
  }
} // namespace diptych::coupling
