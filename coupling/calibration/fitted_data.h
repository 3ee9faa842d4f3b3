// diptych: the data of all fitted paths, one after the other, with the weights of the fit
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "coupling/calibration/noise.h"

namespace diptych::coupling
{
  class FittedData
  {
  public:
    FittedData(const NoiseModel &noise, const NoiseOptions &options)
        : noise(noise),
          options(options)
    {}

    // left_out: one entry per observable. An observable with a reason in it has no weight.
    void add(const TargetData &path, const std::vector<std::string> &left_out);

    Eigen::Index           size() const { return weight.size(); }
    const Eigen::VectorXd &weights() const { return weight; }
    int                    n_counting() const { return int((weight.array() > 0).count()); }

    // sqrt(weight) (values - mean). Empty if there are no values or if a weighted one is not finite.
    [[nodiscard]] Eigen::VectorXd residual(const Eigen::VectorXd &values) const;

    // Turns the Jacobian of the residuals into that of the observables.
    [[nodiscard]] Eigen::MatrixXd unweighted(const Eigen::MatrixXd &jacobian) const;

    // Covariance of the means plus the model tolerance, size() squared. Samples of different paths are independent.
    [[nodiscard]] Eigen::MatrixXd noise_of_means() const;
    [[nodiscard]] Eigen::MatrixXd scatter_of_means() const; // the part estimated from the samples

  private:
    Eigen::MatrixXd of_means(bool with_granted) const;

    const NoiseModel       &noise;
    const NoiseOptions     &options;
    std::vector<TargetData> paths;
    Eigen::VectorXd         weight, mean;
  };
} // namespace diptych::coupling
