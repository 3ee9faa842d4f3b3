// diptych: scatter of the samples in a calibration, and the weights that follow from it
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/calibration/noise.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/LU>

namespace diptych::coupling
{
  namespace
  {
    std::vector<Eigen::Index> places_of(const std::vector<Observable> &observables, const ObservableKind kind)
    {
      std::vector<Eigen::Index> places;
      for (std::size_t k = 0; k < observables.size(); ++k)
        if (observables[k].kind == kind)
          places.push_back(Eigen::Index(k));
      return places;
    }

    // Sums over the samples of all paths.
    struct Scatter
    {
      double level = 0, shape = 0, width = 0;
      double n_level = 0, n_shape = 0, n_width = 0; // degrees of freedom
      // The variance of the volume is linear in progress^2: v = start^2 + growth^2 progress^2.
      Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
      Eigen::Vector2d right  = Eigen::Vector2d::Zero();
    };

    void add_stress(const TargetData &path, Scatter &sum)
    {
      const std::vector<Eigen::Index> places = places_of(path.observables, ObservableKind::stress_ratio);
      const double                    n = double(path.samples.size()), n_bins = double(places.size());
      if (places.empty() || n < 2)
        return;
      for (const Eigen::VectorXd &sample : path.samples)
        {
          double level = 0;
          for (const Eigen::Index k : places)
            level += (sample[k] - path.mean[k]) / n_bins;
          sum.level += level * level;
          for (const Eigen::Index k : places)
            sum.shape += std::pow(sample[k] - path.mean[k] - level, 2);
        }
      sum.n_level += n - 1;
      sum.n_shape += (n - 1) * std::max(1., n_bins - 1);
    }

    void add_volume(const TargetData &path, Scatter &sum)
    {
      const double n = double(path.samples.size());
      for (const Eigen::Index k : places_of(path.observables, ObservableKind::volumetric_strain))
        if (n > 1)
          {
            double variance = 0;
            for (const Eigen::VectorXd &sample : path.samples)
              variance += std::pow(sample[k] - path.mean[k], 2) / (n - 1);
            const double          x = path.observables[std::size_t(k)].middle();
            const Eigen::Vector2d row(1, x * x);
            // The scatter of a variance is proportional to the variance.
            const double weight = 1 / std::pow(1e-8 + x * x, 2);
            sum.normal += weight * row * row.transpose();
            sum.right += weight * variance * row;
          }
    }

    void add_width(const TargetData &path, Scatter &sum)
    {
      for (const Eigen::Index k : places_of(path.observables, ObservableKind::ln_width))
        if (path.count[k] > 1 && std::isfinite(path.mean[k]))
          {
            for (const Eigen::VectorXd &sample : path.samples)
              sum.width += std::isfinite(sample[k]) ? std::pow(sample[k] - path.mean[k], 2) : 0;
            sum.n_width += path.count[k] - 1;
          }
    }

    double given_or_estimated(const std::optional<double> &given, const double square, const double freedom, const char *key)
    {
      if (given)
        return *given;
      if (!(freedom > 0))
        throw std::invalid_argument(std::string("noise: ") + key +
                                    " must be given, because no path has two samples to estimate it from");
      return std::sqrt(std::max(0., square) / freedom);
    }

    bool has(const std::vector<TargetData> &paths, const ObservableKind kind)
    {
      return std::any_of(paths.begin(), paths.end(),
                         [&](const TargetData &path) { return !places_of(path.observables, kind).empty(); });
    }
  } // namespace

  void summarise(TargetData &data)
  {
    const Eigen::Index n = Eigen::Index(data.observables.size());
    data.mean            = Eigen::VectorXd::Zero(n);
    data.count           = Eigen::VectorXi::Zero(n);
    for (const Eigen::VectorXd &sample : data.samples)
      for (Eigen::Index k = 0; k < n; ++k)
        if (std::isfinite(sample[k]))
          data.mean[k] += sample[k], ++data.count[k];
    for (Eigen::Index k = 0; k < n; ++k)
      data.mean[k] = 2 * data.count[k] < int(data.samples.size()) || data.count[k] == 0 ? NAN : data.mean[k] / data.count[k];
  }

  NoiseModel noise_of(const std::vector<TargetData> &paths, const NoiseOptions &options)
  {
    Scatter    sum;
    NoiseModel noise;
    noise.correlation_strain = options.correlation_strain;
    for (const TargetData &path : paths)
      {
        add_stress(path, sum), add_volume(path, sum), add_width(path, sum);
        noise.degrees_of_freedom += int(path.samples.size()) - 1;
      }
    if (has(paths, ObservableKind::stress_ratio))
      {
        noise.stress_level = given_or_estimated(options.stress_level, sum.level, sum.n_level, "stress_level");
        noise.stress_shape = given_or_estimated(options.stress_shape, sum.shape, sum.n_shape, "stress_shape");
      }
    if (has(paths, ObservableKind::volumetric_strain))
      {
        const double          seen   = noise.degrees_of_freedom;
        const double          scale  = 1e-12 * sum.normal.norm(); // one bin cannot give a growth
        const Eigen::Vector2d square = seen > 0 ? Eigen::Vector2d((sum.normal + scale * Eigen::Matrix2d::Identity()).inverse() *
                                                                  sum.right)
                                                : Eigen::Vector2d::Zero();
        noise.volume_start           = given_or_estimated(options.volume_start, square[0], seen > 0 ? 1 : 0, "volume_start");
        noise.volume_growth          = given_or_estimated(options.volume_growth, square[1], seen > 0 ? 1 : 0, "volume_growth");
      }
    if (has(paths, ObservableKind::ln_width))
      noise.ln_width = given_or_estimated(options.ln_width, sum.width, sum.n_width, "ln_width");
    return noise;
  }

  Eigen::MatrixXd covariance(const NoiseModel &noise, const std::vector<Observable> &observables)
  {
    const Eigen::Index n = Eigen::Index(observables.size());
    Eigen::MatrixXd    c = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j)
        {
          const Observable &a = observables[std::size_t(i)], &b = observables[std::size_t(j)];
          if (a.kind != b.kind)
            continue;
          const double near = std::exp(-std::abs(a.middle() - b.middle()) / noise.correlation_strain);
          if (a.kind == ObservableKind::stress_ratio)
            c(i, j) = std::pow(noise.stress_level, 2) + std::pow(noise.stress_shape, 2) * near;
          else if (a.kind == ObservableKind::volumetric_strain)
            c(i, j) = std::pow(noise.volume_start, 2) * near + std::pow(noise.volume_growth, 2) * a.middle() * b.middle();
          else if (i == j)
            c(i, j) = std::pow(noise.ln_width, 2);
        }
    return c;
  }

  Eigen::VectorXd discrepancy(const NoiseOptions &o, const std::vector<Observable> &observables)
  {
    Eigen::VectorXd variance(Eigen::Index(observables.size()));
    for (std::size_t k = 0; k < observables.size(); ++k)
      {
        const Observable &one       = observables[k];
        const double      early     = o.early_stress_discrepancy * std::exp(-one.middle() / o.early_strain);
        const double      deviation = one.kind == ObservableKind::stress_ratio        ? o.stress_discrepancy + early
                                      : one.kind == ObservableKind::volumetric_strain ? o.volume_discrepancy
                                                                                      : o.width_discrepancy;
        variance[Eigen::Index(k)]   = deviation * deviation;
      }
    return variance;
  }

  Eigen::VectorXd working_weights(const NoiseModel &noise, const NoiseOptions &options, const TargetData &data)
  {
    NoiseModel without_level      = noise;
    without_level.stress_level    = 0;
    const Eigen::VectorXd own     = covariance(without_level, data.observables).diagonal();
    Eigen::VectorXd       weights = discrepancy(options, data.observables);
    for (Eigen::Index k = 0; k < weights.size(); ++k)
      {
        weights[k] += own[k] / std::max(1, data.count[k]);
        weights[k] = std::isfinite(data.mean[k]) && weights[k] > 0 ? 1 / weights[k] : 0;
      }
    return weights;
  }
} // namespace diptych::coupling
