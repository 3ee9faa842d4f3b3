// diptych: the data of all fitted paths, one after the other, with the weights of the fit
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/calibration/fitted_data.h"

#include <algorithm>
#include <cmath>

namespace diptych::coupling
{
  void FittedData::add(const TargetData &path, const std::vector<std::string> &left_out)
  {
    Eigen::VectorXd of_path = working_weights(noise, options, path);
    for (std::size_t k = 0; k < left_out.size(); ++k)
      if (!left_out[k].empty())
        of_path[Eigen::Index(k)] = 0;
    const Eigen::Index n = weight.size();
    weight.conservativeResize(n + of_path.size());
    weight.tail(of_path.size()) = of_path;
    mean.conservativeResize(n + of_path.size());
    mean.tail(of_path.size()) = path.mean;
    paths.push_back(path);
  }

  Eigen::VectorXd FittedData::residual(const Eigen::VectorXd &values) const
  {
    Eigen::VectorXd residual = Eigen::VectorXd::Zero(values.size());
    for (Eigen::Index k = 0; k < values.size(); ++k)
      if (weight[k] > 0)
        residual[k] = std::sqrt(weight[k]) * (values[k] - mean[k]);
    return residual.allFinite() ? residual : Eigen::VectorXd();
  }

  Eigen::MatrixXd FittedData::unweighted(const Eigen::MatrixXd &jacobian) const
  {
    Eigen::MatrixXd result = jacobian;
    for (Eigen::Index k = 0; k < size(); ++k)
      if (weight[k] > 0)
        result.row(k) /= std::sqrt(weight[k]);
    return result;
  }

  namespace
  {
    // Values given by the options are exact, so they do not count as estimated.
    NoiseModel estimated_part(NoiseModel noise, const NoiseOptions &options)
    {
      for (const auto &[given, value] : {std::pair(&options.stress_level, &noise.stress_level),
                                         {&options.stress_shape, &noise.stress_shape},
                                         {&options.volume_start, &noise.volume_start},
                                         {&options.volume_growth, &noise.volume_growth},
                                         {&options.ln_width, &noise.ln_width}})
        if (*given)
          *value = 0;
      return noise;
    }
  } // namespace

  Eigen::MatrixXd FittedData::noise_of_means() const
  {
    return of_means(true);
  }

  Eigen::MatrixXd FittedData::scatter_of_means() const
  {
    return of_means(false);
  }

  Eigen::MatrixXd FittedData::of_means(const bool with_granted) const
  {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(size(), size());
    Eigen::Index    at  = 0;
    for (const TargetData &path : paths)
      {
        const Eigen::VectorXd granted = discrepancy(options, path.observables);
        const Eigen::MatrixXd one     = covariance(with_granted ? noise : estimated_part(noise, options), path.observables);
        const Eigen::Index    n       = granted.size();
        for (Eigen::Index i = 0; i < n; ++i)
          for (Eigen::Index j = 0; j < n; ++j)
            all(at + i, at + j) = one(i, j) / std::sqrt(double(std::max(1, path.count[i])) * std::max(1, path.count[j])) +
                                  (with_granted && i == j ? granted[i] : 0.);
        at += n;
      }
    return all;
  }
} // namespace diptych::coupling
