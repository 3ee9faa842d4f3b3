// diptych: shear bands in a displacement field, one operator for grains and nodes
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/band.h"

#include <algorithm>
#include <stdexcept>

#include "coupling/band_candidates.h"
#include "coupling/strips.h"

namespace diptych::coupling
{
  namespace
  {
    using Shapes = std::vector<BandShape>;

    constexpr double degree = M_PI / 180;

    struct Candidate
    {
      BandShape shape;
      double    gain; // decrease of the sum of squares
    };

    BandData scaled_data(const DisplacementField &field, const SampleFrame &frame)
    {
      if (field.increment.size() != field.position.size() || field.weight.size() != field.position.size())
        throw std::invalid_argument("a displacement field needs one increment and one weight a point");
      const double platen = frame.platen_increment.norm();
      if (!(platen > 0) || !(frame.width > 0) || !(frame.height > 0) || !(frame.mean_diameter > 0))
        throw std::invalid_argument("bands need a platen increment, an extent of the sample and a mean diameter above zero");

      BandData data;
      for (std::size_t i = 0; i < field.position.size(); ++i)
        if (field.weight[i] > 0)
          {
            data.x.push_back((field.position[i] - frame.centre) / frame.mean_diameter);
            data.u.push_back(field.increment[i] / platen);
            data.w.push_back(field.weight[i]);
          }
      if (data.x.size() < 30)
        throw std::invalid_argument("fewer than 30 points of positive weight: no band can be looked for");
      return data;
    }

    // Empty when every band of a fit is one; else what is wrong.
    std::string objection(const BandFit &fit, const BandFitOptions &sample, const BandOptions &options)
    {
      for (std::size_t b = 0; b < fit.shape.size(); ++b)
        {
          const BandShape &shape = fit.shape[b];
          if (2 * fit.coefficient.row(3 + b).norm() < options.minimum_jump)
            return "the jump is below minimum_jump";
          if (shape.half_width >= 0.999 * largest_half_width(sample, shape.angle))
            return "the transition is as wide as half the sample";
          if (std::abs(shape.offset) > 2 * largest_half_width(sample, shape.angle))
            return "the line lies outside the sample";
        }
      if (fit.shape.size() == 2 &&
          !distinct(fit.shape[0], fit.shape[1], 20 * degree, 2 * (fit.shape[0].half_width + fit.shape[1].half_width)))
        return "the two lines are parts of one band";
      return "";
    }

    // Starts are compared on block means, which cost a tenth; the best is then fitted to all points, unless there is an objection
    // to every one. A fit without objection is preferred to one that explains more.
    BandFit best_fit(const BandData            &data,
                     const BandData            &blocks,
                     const std::vector<Shapes> &starts,
                     const BandFitOptions      &sample,
                     const BandOptions         &options)
    {
      BandFit best;
      bool    valid = false;
      for (const auto &start : starts)
        {
          const BandFit fit      = fit_bands(blocks, start, sample);
          const bool    is_valid = objection(fit, sample, options).empty();
          if (best.shape.empty() || (is_valid && !valid) || (is_valid == valid && fit.mean_misfit < best.mean_misfit))
            {
              best  = fit;
              valid = is_valid;
            }
        }
      return valid ? fit_bands(data, best.shape, sample) : best;
    }

    double r_squared(const std::vector<double> &value, const std::vector<double> &fitted, const std::vector<double> &weight)
    {
      double sum = 0, mean = 0, residual = 0, total = 0;
      for (std::size_t i = 0; i < value.size(); ++i)
        {
          sum += weight[i];
          mean += weight[i] * value[i];
        }
      mean /= sum;
      for (std::size_t i = 0; i < value.size(); ++i)
        {
          residual += weight[i] * (value[i] - fitted[i]) * (value[i] - fitted[i]);
          total += weight[i] * (value[i] - mean) * (value[i] - mean);
        }
      return total > 0 ? 1 - residual / total : 0;
    }

    void add_r_squared(const BandData &data, const BandFit &fit, const SampleFrame &frame, Band &band)
    {
      std::vector<double> value(data.x.size()), fitted(data.x.size());
      const auto          edges = strip_edges(frame, band.angle_deg, band.offset);
      const std::size_t   n     = edges.size() - 1;
      std::vector<double> strip_value(n, 0.), strip_fitted(n, 0.), strip_weight(n, 0.);
      for (std::size_t i = 0; i < data.x.size(); ++i)
        {
          value[i]  = data.u[i].dot(band.direction());
          fitted[i] = fit.at(data.x[i]).dot(band.direction());

          const double across = frame.mean_diameter * data.x[i].dot(band.normal());
          const auto   strip  = std::upper_bound(edges.begin(), edges.end(), across) - edges.begin();
          if (strip == 0 || strip > static_cast<std::ptrdiff_t>(n))
            continue;
          strip_value[strip - 1] += data.w[i] * value[i];
          strip_fitted[strip - 1] += data.w[i] * fitted[i];
          strip_weight[strip - 1] += data.w[i];
        }
      for (std::size_t k = 0; k < n; ++k)
        if (strip_weight[k] > 0)
          {
            strip_value[k] /= strip_weight[k];
            strip_fitted[k] /= strip_weight[k];
          }
      band.r_squared        = r_squared(value, fitted, data.w);
      band.r_squared_strips = r_squared(strip_value, strip_fitted, strip_weight);
    }

    Band reported_band(const BandShape &shape, const Eigen::Vector2d &half_jump, const double mean_diameter)
    {
      Band band;
      // the angle folded to (-90, 90]: an odd number of half turns reverses the normal, and with it offset and jump
      double turns   = std::round(shape.angle / M_PI);
      band.angle_deg = (shape.angle - turns * M_PI) / degree;
      if (band.angle_deg <= -90)
        {
          band.angle_deg += 180;
          turns -= 1;
        }
      const double          sign  = std::fmod(std::abs(turns), 2.) == 1 ? -1 : 1;
      const Eigen::Vector2d jump  = 2 * sign * half_jump;
      const double          along = jump.dot(band.direction()), opening = jump.dot(band.normal());
      band.offset       = sign * shape.offset * mean_diameter;
      band.half_width   = shape.half_width * mean_diameter;
      band.width_10_90  = 2 * std::atanh(0.8) * band.half_width;
      band.jump         = std::copysign(jump.norm(), along);
      band.dilation_deg = std::atan2(opening, std::abs(along)) / degree;
      return band;
    }
  } // namespace

  BandReport find_bands(const DisplacementField &field, const SampleFrame &frame, const BandOptions &options)
  {
    const BandData data = scaled_data(field, frame);
    BandFitOptions fit_options;
    fit_options.width           = frame.width / frame.mean_diameter;
    fit_options.height          = frame.height / frame.mean_diameter;
    fit_options.huber_threshold = options.huber_threshold;
    fit_options.scale_floor     = options.residual_floor;

    BandReport report;
    // two components in each block of one correlation length
    report.n_effective = std::clamp(2 * fit_options.width * fit_options.height / std::pow(options.correlation_length, 2), 8.,
                                    2. * data.x.size());

    const BandData       blocks = block_means(data, std::min(4., std::min(fit_options.width, fit_options.height) / 10));
    std::vector<BandFit> fits   = {fit_bands(data, {}, fit_options)};
    if (options.max_bands >= 1)
      {
        const LineScan      scan(blocks, fit_options);
        std::vector<Shapes> starts;
        for (const auto &line : scan.best_lines({}, 3))
          starts.push_back({line});
        fits.push_back(best_fit(data, blocks, starts, fit_options, options));
        if (options.max_bands >= 2)
          {
            starts.clear();
            for (const auto &line : scan.best_lines(fits[1].shape, 2))
              starts.push_back({fits[1].shape[0], line});
            if (const Shapes pair = scan.best_pair(); !pair.empty())
              starts.push_back(pair);
            fits.push_back(best_fit(data, blocks, starts, fit_options, options));
          }
      }

    // BIC = n log(variance) + p log(n); p = 6 affine coefficients and 5 for each band
    std::size_t                best = 0;
    std::array<std::string, 3> objections;
    for (std::size_t k = 0; k < fits.size(); ++k)
      {
        objections[k] = objection(fits[k], fit_options, options);
        if (!objections[k].empty())
          continue;
        report.residual[k]    = std::sqrt(fits[k].robust_variance);
        const double variance = fits[k].robust_variance + std::pow(options.residual_floor, 2);
        report.bic[k]         = report.n_effective * std::log(variance) + (6 + 5. * k) * std::log(report.n_effective);
        if (report.bic[k] < report.bic[best])
          best = k;
      }

    const BandFit &fit = fits[best];
    report.converged   = fit.converged;
    for (std::size_t b = 0; b < fit.shape.size(); ++b)
      {
        Band band = reported_band(fit.shape[b], fit.coefficient.row(3 + b).transpose(), frame.mean_diameter);
        add_r_squared(data, fit, frame, band);
        report.bands.push_back(band);
      }
    std::stable_sort(report.bands.begin(), report.bands.end(),
                     [](const Band &a, const Band &b) { return std::abs(a.jump) > std::abs(b.jump); });

    const std::array<std::string, 3> names = {{"diffuse", "one band", "two bands"}};
    report.verdict                         = names[best];
    if (best + 1 < fits.size())
      report.verdict += "; no further band: " +
                        (objections[best + 1].empty() ? std::string("it lowers the misfit too little") : objections[best + 1]);
    if (!fit.converged)
      report.verdict += " (fit not converged)";
    return report;
  }
} // namespace diptych::coupling
