// diptych: detection of shear bands in a displacement field, the same for grains and nodes
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/bands/band_detection.h"

#include <algorithm>
#include <stdexcept>

#include "coupling/bands/band_candidates.h"
#include "coupling/bands/band_intervals.h"
#include "coupling/bands/packs.h"
#include "coupling/bands/strips.h"
#include "coupling/cells/principal_axes.h"

namespace diptych::coupling
{
  namespace
  {
    using Shapes = std::vector<BandShape>;

    struct Candidate
    {
      BandShape shape;
      double    gain; // decrease of the sum of squares
    };

    BandData scaled_data(const DisplacementField &field, const SampleFrame &frame)
    {
      if (field.increment.size() != field.position.size() || field.weight.size() != field.position.size())
        throw std::invalid_argument("a displacement field needs one increment and one weight per point");
      const double platen = frame.platen_increment.norm();
      if (!(platen > 0) || !(frame.width > 0) || !(frame.height > 0) || !(frame.mean_diameter > 0))
        throw std::invalid_argument("the band search needs a platen increment, a sample size and a mean diameter above zero");

      BandData data;
      for (std::size_t i = 0; i < field.position.size(); ++i)
        if (field.weight[i] > 0)
          {
            data.x.push_back((field.position[i] - frame.centre) / frame.mean_diameter);
            data.u.push_back(field.increment[i] / platen);
            data.w.push_back(field.weight[i]);
          }
      if (data.x.size() < std::size_t(fewest_band_points))
        throw std::invalid_argument("the band search needs at least " + std::to_string(fewest_band_points) +
                                    " points of positive weight");
      return data;
    }

    std::string objection(const BandFit &fit, const std::size_t b, const BandFitOptions &sample, const double minimum_jump)
    {
      const BandShape &shape = fit.shape[b];
      if (2 * fit.coefficient.row(3 + b).norm() < minimum_jump)
        return "the jump is below minimum_jump";
      if (2 * fit.coefficient.row(3 + b).norm() / (2 * shape.half_width) < 1 / sample.height)
        return "it shears less than the sample does on average";
      if (shape.half_width >= 0.999 * largest_half_width(sample, shape.angle))
        return "the transition is as wide as half the sample";
      if (std::abs(shape.offset) > 2 * largest_half_width(sample, shape.angle))
        return "the line lies outside the sample";
      if (fit.shape.size() == 2 &&
          !distinct(fit.shape[0], fit.shape[1], 20 * degree, 2 * (fit.shape[0].half_width + fit.shape[1].half_width)))
        return "the two lines are parts of one band";
      return "";
    }

    std::string objection(const BandFit &fit, const BandFitOptions &sample, const double minimum_jump)
    {
      std::string text;
      for (std::size_t b = 0; b < fit.shape.size() && text.empty(); ++b)
        text = objection(fit, b, sample, minimum_jump);
      return text;
    }

    // Starts are compared on block means, which cost a tenth. The best one without objection is then fitted to all points. If
    // there is an objection to every start, the best one is. A fit without objection is preferred to one that explains more.
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
          const bool    is_valid = objection(fit, sample, options.minimum_jump).empty();
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

    // Describes the fitted field with angles in (-90, 90] degrees. Half a turn reverses the normal, and with it offset and jump.
    BandFit with_folded_angles(BandFit fit)
    {
      for (std::size_t b = 0; b < fit.shape.size(); ++b)
        {
          BandShape &shape = fit.shape[b];
          double     turns = std::round(shape.angle / M_PI);
          if (shape.angle - turns * M_PI <= -0.5 * M_PI)
            turns -= 1;
          shape.angle -= turns * M_PI;
          if (std::fmod(std::abs(turns), 2.) == 1)
            {
              shape.offset = -shape.offset;
              fit.coefficient.row(3 + b) *= -1;
            }
        }
      return fit;
    }

    Interval ended(const Interval &i, const double low, const double high) // NaN stays
    {
      return {i.value, i.low < low ? low : i.low, i.high > high ? high : i.high};
    }

    // Intervals end at the sample's narrower side, or at the value if this is larger, and 90 degrees from an angle.
    Band reported_band(const BandIntervals &numbers, const SampleFrame &frame)
    {
      const double mean_diameter = frame.mean_diameter, side = std::min(frame.width, frame.height);
      Band         band;
      band.interval             = numbers;
      const double longest      = std::max(side / mean_diameter, numbers.width_10_90.value);
      band.interval.width_10_90 = times(mean_diameter, ended(numbers.width_10_90, 0, longest));
      band.interval.half_width  = times(mean_diameter, ended(numbers.half_width, 0, longest / (2 * std::atanh(0.8))));
      band.interval.offset      = times(mean_diameter, numbers.offset);

      band.angle_deg  = band.interval.angle_deg.value;
      band.is_diffuse = band.interval.width_10_90.value > widest_band * side;
      for (Interval *angle : {&band.interval.angle_deg, &band.interval.dilation_deg})
        *angle = ended(*angle, angle->value - 90, angle->value + 90);
      band.half_width   = band.interval.half_width.value;
      band.width_10_90  = band.interval.width_10_90.value;
      band.offset       = band.interval.offset.value;
      band.jump         = band.interval.jump.value;
      band.dilation_deg = band.interval.dilation_deg.value;
      return band;
    }

    // A refit must still be a band. Its jump may be arbitrarily weak, because half a jump is a possible value of the
    // resampling.
    std::vector<BandIntervals> intervals_of(const BandData       &data,
                                            const BandFit        &fit,
                                            const BandFitOptions &sample,
                                            const BandOptions    &options,
                                            const std::uint64_t   seed)
    {
      return band_intervals(data, fit, sample, {options.correlation_length, options.resamples, seed},
                            [&](const BandFit &refit, const std::size_t b) { return objection(refit, b, sample, 0).empty(); });
    }

    BandFitOptions fit_options_of(const SampleFrame &frame, const BandOptions &options)
    {
      BandFitOptions fit;
      fit.width           = frame.width / frame.mean_diameter;
      fit.height          = frame.height / frame.mean_diameter;
      fit.huber_threshold = options.huber_threshold;
      fit.scale_floor     = options.residual_floor;
      return fit;
    }

    std::vector<BandFit> fits_of(const BandData &data, const BandFitOptions &sample, const BandOptions &options)
    {
      const BandData       blocks = block_means(data, std::min(4., std::min(sample.width, sample.height) / 10));
      std::vector<BandFit> fits   = {fit_bands(data, {}, sample)};
      if (options.max_bands < 1)
        return fits;
      const LineScan      scan(blocks, sample);
      std::vector<Shapes> starts;
      for (const auto &line : scan.best_lines({}, 3))
        starts.push_back({line});
      fits.push_back(best_fit(data, blocks, starts, sample, options));
      if (options.max_bands < 2)
        return fits;
      starts.clear();
      for (const auto &line : scan.best_lines(fits[1].shape, 2))
        starts.push_back({fits[1].shape[0], line});
      if (const Shapes pair = scan.best_pair(); !pair.empty())
        starts.push_back(pair);
      fits.push_back(best_fit(data, blocks, starts, sample, options));
      return fits;
    }

    // The chosen number of bands, and why not more: one objection for each fit, empty if the fit is acceptable.
    struct Choice
    {
      std::size_t                best = 0;
      std::array<std::string, 3> objections;
    };

    // BIC = n log(variance) + p log(n); p = 6 affine coefficients and 5 for each band
    Choice choose(const std::vector<BandFit> &fits, const BandFitOptions &sample, const BandOptions &options, BandReport &report)
    {
      Choice choice;
      for (std::size_t k = 0; k < fits.size(); ++k)
        {
          choice.objections[k] = objection(fits[k], sample, options.minimum_jump);
          if (!choice.objections[k].empty())
            continue;
          report.residual[k]    = std::sqrt(fits[k].robust_variance);
          const double variance = fits[k].robust_variance + std::pow(options.residual_floor, 2);
          report.bic[k]         = report.n_effective * std::log(variance) + (6 + 5. * k) * std::log(report.n_effective);
          if (report.bic[k] < report.bic[choice.best])
            choice.best = k;
        }
      return choice;
    }

    std::string verdict(const Choice &choice, const std::size_t n_fits, const BandReport &report)
    {
      const std::array<std::string, 3> names = {{"diffuse", "one band", "two bands"}};
      std::string                      text  = names[choice.best];
      if (choice.best == 1)
        text += report.bands[0].between_packs() ? " between two packs"
                                                : ", no zone between two packs: " + report.bands[0].no_packs_because;
      if (const auto n = std::count_if(report.bands.begin(), report.bands.end(), [](const Band &b) { return b.is_diffuse; }))
        text += std::string(n < std::ptrdiff_t(report.bands.size()) ? "; one of them" : "") +
                "; diffuse: wider than a third of the sample";
      if (choice.best + 1 < n_fits)
        {
          const std::string &objection = choice.objections[choice.best + 1];
          text += "; no further band: " + (objection.empty() ? "it lowers the misfit too little" : objection);
        }
      if (!report.converged && choice.best != 1)
        text += " (fit not converged)";
      return text;
    }
  } // namespace

  BandReport find_bands(const DisplacementField &field,
                        const SampleFrame       &frame,
                        const BandOptions       &options,
                        const std::uint64_t      seed)
  {
    const BandData       data   = scaled_data(field, frame);
    const BandFitOptions sample = fit_options_of(frame, options);
    BandReport           report;
    // Two components in each block of one correlation length.
    report.n_effective = std::clamp(2 * sample.width * sample.height / std::pow(options.correlation_length, 2), 8.,
                                    2. * data.x.size());

    const std::vector<BandFit> fits   = fits_of(data, sample, options);
    const Choice               choice = choose(fits, sample, options, report);
    const BandFit              fit    = with_folded_angles(fits[choice.best]);
    report.converged                  = fit.converged;
    for (const BandIntervals &numbers : intervals_of(data, fit, sample, options, seed))
      {
        Band band = reported_band(numbers, frame);
        add_r_squared(data, fit, frame, band);
        band.no_packs_because = objection_to_packs(band, frame, fit.converged);
        report.bands.push_back(band);
      }
    std::stable_sort(report.bands.begin(), report.bands.end(),
                     [](const Band &a, const Band &b) { return std::abs(a.jump) > std::abs(b.jump); });
    report.verdict = verdict(choice, fits.size(), report);
    return report;
  }
} // namespace diptych::coupling
