// diptych: profiles across a band: rotation, couple stress, solid fraction and fluctuation over the distance from the band
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/bands/band_profile.h"

#include <algorithm>
#include <cmath>

namespace diptych::coupling
{
  namespace
  {
    constexpr int    n_widths       = 46; // candidates for delta: 7 % apart, refined by a parabola
    constexpr double smallest_width = 0.5, largest_width = 12;

    double candidate_width(const double number)
    {
      return smallest_width * std::pow(largest_width / smallest_width, number / (n_widths - 1.));
    }

    double squared_sech(const double x)
    {
      return 1 / (std::cosh(x) * std::cosh(x));
    }

    // The derivative of sech^2 with the largest value 1.
    double gradient_shape(const double x)
    {
      return squared_sech(x) * std::tanh(x) * 1.5 * std::sqrt(3.);
    }

    Eigen::VectorXd shape_of(const std::vector<double> &distance, const double delta, double (*shape)(double))
    {
      Eigen::VectorXd values(Eigen::Index(distance.size()));
      for (Eigen::Index k = 0; k < values.size(); ++k)
        values[k] = shape(distance[std::size_t(k)] / delta);
      return values;
    }

    struct LineFit
    {
      double slope = NAN, sum_of_squares = NAN;
    };

    // y = a + b shape by least squares over the strips with a value.
    LineFit fitted(const Eigen::VectorXd &y, const Eigen::VectorXd &shape)
    {
      double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
      for (Eigen::Index k = 0; k < y.size(); ++k)
        if (std::isfinite(y[k]))
          {
            ++n;
            sx += shape[k];
            sy += y[k];
            sxx += shape[k] * shape[k];
            sxy += shape[k] * y[k];
            syy += y[k] * y[k];
          }
      const double xx = sxx - sx * sx / n, xy = sxy - sx * sy / n, yy = syy - sy * sy / n;
      if (n < 4 || !(xx > 0))
        return {};
      return {xy / xx, yy - xy * xy / xx};
    }

    // 2.197 delta of the fit a + b sech^2(x / delta) with the smallest sum of squares; NaN at an end of the range.
    double fitted_width(const Eigen::VectorXd &y, const std::vector<Eigen::VectorXd> &candidates)
    {
      std::vector<double> sum;
      for (const Eigen::VectorXd &shape : candidates)
        sum.push_back(fitted(y, shape).sum_of_squares);
      const auto best = std::min_element(sum.begin(), sum.end());
      if (best == sum.begin() || best + 1 == sum.end())
        return NAN;
      const double curvature = best[-1] - 2 * best[0] + best[1],
                   shift     = curvature > 0 ? 0.5 * (best[-1] - best[1]) / curvature : 0;
      return 2 * std::atanh(0.8) * candidate_width(double(best - sum.begin()) + shift);
    }

    // Means over the blocks that a strip has, each counted `times`; NaN without one.
    Eigen::VectorXd strip_means(const Eigen::MatrixXd &values, const std::vector<int> &times)
    {
      Eigen::VectorXd means(values.rows());
      for (Eigen::Index k = 0; k < values.rows(); ++k)
        {
          double sum = 0, n = 0;
          for (Eigen::Index b = 0; b < values.cols(); ++b)
            if (std::isfinite(values(k, b)))
              {
                sum += times[std::size_t(b)] * values(k, b);
                n += times[std::size_t(b)];
              }
          means[k] = n > 0 ? sum / n : NAN;
        }
      return means;
    }

    struct Resampled
    {
      Eigen::VectorXd              mean;  // of each strip
      std::vector<Eigen::VectorXd> drawn; // means of the strips for each resample
    };

    Resampled resampled(const Eigen::MatrixXd &values, const std::vector<std::vector<int>> &draws)
    {
      Resampled result{strip_means(values, std::vector<int>(std::size_t(values.cols()), 1)), {}};
      for (const std::vector<int> &times : draws)
        result.drawn.push_back(strip_means(values, times));
      return result;
    }

    template <class Number> Interval interval_of(const Resampled &curve, const int blocks, Number &&number)
    {
      const double        value = number(curve.mean), factor = small_sample_factor(blocks);
      std::vector<double> deviations;
      for (const Eigen::VectorXd &drawn : curve.drawn)
        deviations.push_back(factor * (number(drawn) - value));
      return interval_from(value, deviations);
    }

    ProfileCurve curve_of(const Eigen::MatrixXd &values, const Resampled &strips)
    {
      ProfileCurve curve;
      for (Eigen::Index k = 0; k < values.rows(); ++k)
        {
          const int      blocks   = int(values.row(k).array().isFinite().count());
          const Interval of_strip = interval_of(strips, blocks, [k](const Eigen::VectorXd &mean) { return mean[k]; });
          curve.value.push_back(of_strip.value);
          curve.low.push_back(of_strip.low);
          curve.high.push_back(of_strip.high);
        }
      return curve;
    }

    ProfileCurve rooted(ProfileCurve curve)
    {
      for (std::vector<double> *values : {&curve.value, &curve.low, &curve.high})
        for (double &v : *values)
          v = std::isnan(v) ? NAN : std::sqrt(std::max(0., v));
      return curve;
    }
  } // namespace

  BandProfile band_profile(const ProfileBlocks &blocks, const double half_width, const BootstrapOptions &bootstrap)
  {
    BandProfile profile;
    profile.distance               = blocks.distance;
    profile.blocks                 = int(blocks.spin.cols());
    const auto            draws    = resampled_blocks(profile.blocks, bootstrap);
    const Eigen::VectorXd strain   = shape_of(blocks.distance, half_width, squared_sech),
                          gradient = shape_of(blocks.distance, half_width, gradient_shape);
    const auto amplitude           = [](const Eigen::VectorXd &shape, const double sign) {
      return [&shape, sign](const Eigen::VectorXd &mean) { return sign * fitted(mean, shape).slope; };
    };

    const Resampled rotation = resampled(blocks.relative_rotation, draws), couple = resampled(blocks.couple_stress, draws),
                    solid = resampled(blocks.solid_fraction, draws), spin = resampled(blocks.spin, draws);
    profile.relative_rotation    = curve_of(blocks.relative_rotation, rotation);
    profile.couple_stress        = curve_of(blocks.couple_stress, couple);
    profile.solid_fraction       = curve_of(blocks.solid_fraction, solid);
    profile.spin                 = curve_of(blocks.spin, spin);
    profile.velocity_fluctuation = rooted(curve_of(blocks.squared_fluctuation, resampled(blocks.squared_fluctuation, draws)));

    profile.spin_amplitude     = interval_of(spin, profile.blocks, amplitude(strain, 1));
    profile.rotation_amplitude = interval_of(rotation, profile.blocks, amplitude(strain, 1));
    profile.couple_stress_peak = interval_of(couple, profile.blocks, amplitude(gradient, 1));
    profile.loosening          = interval_of(solid, profile.blocks, amplitude(strain, -1));
    if (bootstrap.resamples > 0 && !(profile.rotation_amplitude.low * profile.rotation_amplitude.high > 0))
      return profile;
    std::vector<Eigen::VectorXd> candidates;
    for (int k = 0; k < n_widths; ++k)
      candidates.push_back(shape_of(blocks.distance, candidate_width(k), squared_sech));
    profile.rotation_width_10_90 = interval_of(rotation, profile.blocks,
                                               [&](const Eigen::VectorXd &mean) { return fitted_width(mean, candidates); });
    return profile;
  }
} // namespace diptych::coupling
