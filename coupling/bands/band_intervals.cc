// diptych: 95 % intervals of the numbers of a band by block bootstrap
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/bands/band_intervals.h"

#include <algorithm>
#include <cmath>

#include "coupling/bands/band_calibration.h"
#include "coupling/bands/band_candidates.h"
#include "coupling/cells/principal_axes.h"

namespace diptych::coupling
{
  namespace
  {
    // Fine enough for the narrowest profile. A cell of half the half width adds 2.5 % to the variance of tanh's slope, pi^2/12
    // delta^2.
    double cell_size(const BandFit &fit)
    {
      double narrowest = INFINITY;
      for (const BandShape &shape : fit.shape)
        narrowest = std::min(narrowest, shape.half_width);
      return std::clamp(0.5 * narrowest, 0.5, 2.);
    }

    Tiles tiles_of(const BandFitOptions &sample, const double block)
    {
      const double x = 0.5 * sample.width, y = 0.5 * sample.height;
      return tiles_over({{-x, -y}, {x, -y}, {x, y}, {-x, y}}, 0, block);
    }

    BandData drawn_data(const BandData &cells, const std::vector<int> &tile, const std::vector<int> &drawn)
    {
      BandData data;
      for (std::size_t i = 0; i < cells.x.size(); ++i)
        if (const int times = drawn[tile[i]]; times > 0)
          {
            data.x.push_back(cells.x[i]);
            data.u.push_back(cells.u[i]);
            data.w.push_back(times * cells.w[i]);
          }
      return data;
    }

    // Deviations of each number of each band, [5 * band + number][resample]; NaN if the band is lost.
    std::vector<std::vector<double>> resampled_deviations(const BandData         &cells,
                                                          const BandFit          &fit,
                                                          const BandFitOptions   &sample,
                                                          const BootstrapOptions &bootstrap,
                                                          const HoldsBand        &holds_band)
    {
      const Tiles      tiles = tiles_of(sample, bootstrap.block);
      std::vector<int> tile;
      for (const Eigen::Vector2d &x : cells.x)
        tile.push_back(tiles.tile(x));

      const BandFit                    centre = refit_bands(cells, fit, sample, 1e-6);
      std::vector<std::vector<double>> deviations(5 * fit.shape.size());
      for (const std::vector<int> &drawn : resampled_blocks(tiles.count(), bootstrap))
        {
          const BandFit refit = refit_bands(drawn_data(cells, tile, drawn), centre, sample);
          for (std::size_t b = 0; b < fit.shape.size(); ++b)
            {
              const bool        kept = refit.converged && holds_band(refit, b);
              const BandNumbers from = band_numbers(centre, b), to = band_numbers(refit, b);
              for (std::size_t k = 0; k < from.size(); ++k)
                deviations[5 * b + k].push_back(kept ? to[k] - from[k] : NAN);
            }
        }
      return deviations;
    }

    // A refit with fixed weights moves too little. Beyond the threshold k, Huber's force k r/|r| has the derivative zero along
    // r and the weight k/|r| across it. That is half the weight on average. The refit counts the whole weight.
    double fixed_weight_factor(const std::vector<double> &plain, const std::vector<double> &huber)
    {
      double whole = 0, moving = 0;
      for (std::size_t i = 0; i < plain.size(); ++i)
        {
          whole += huber[i];
          moving += huber[i] < plain[i] ? 0.5 * huber[i] : huber[i];
        }
      return whole / moving;
    }

    Interval stretched(const double value, const double factor, const std::vector<double> &deviations)
    {
      Interval interval = interval_from(0, deviations);
      return {value, value + factor * interval.low, value + factor * interval.high};
    }

    Interval exponential(const Interval &logarithm)
    {
      return {std::exp(logarithm.value), std::exp(logarithm.low), std::exp(logarithm.high)};
    }
  } // namespace

  std::vector<BandIntervals> band_intervals(const BandData         &data,
                                            const BandFit          &fit,
                                            const BandFitOptions   &sample,
                                            const BootstrapOptions &bootstrap,
                                            const HoldsBand        &holds_band)
  {
    BandData weighted     = data;
    weighted.w            = huber_weights(data, fit, sample);
    const auto deviations = resampled_deviations(block_means(weighted, cell_size(fit)), fit, sample, bootstrap, holds_band);

    const double             fixed = fixed_weight_factor(data.w, weighted.w);
    std::vector<BandNumbers> factors(fit.shape.size());
    if (!fit.shape.empty() && !deviations[0].empty())
      factors = bootstrap_factors(weighted, fit, tiles_of(sample, bootstrap.block), bootstrap);

    std::vector<BandIntervals> intervals(fit.shape.size());
    for (std::size_t b = 0; b < fit.shape.size(); ++b)
      {
        const BandNumbers value  = band_numbers(fit, b);
        const auto        number = [&](const int k) { return stretched(value[k], fixed * factors[b][k], deviations[5 * b + k]); };
        BandIntervals    &band   = intervals[b];
        band.angle_deg           = times(1 / degree, number(0));
        band.half_width          = exponential(number(1));
        band.width_10_90         = times(2 * std::atanh(0.8), band.half_width);
        band.offset              = number(2);
        band.jump                = number(3);
        band.dilation_deg        = times(1 / degree, number(4));

        const std::vector<double> &all = deviations[5 * b];
        band.resamples                 = std::count_if(all.begin(), all.end(), [](const double d) { return std::isfinite(d); });
        band.lost_share                = all.empty() ? NAN : 1 - double(band.resamples) / all.size();
      }
    return intervals;
  }
} // namespace diptych::coupling
