// diptych: scatter of the samples in a calibration, and the weights that follow from it
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "coupling/calibration/calibration.h"

namespace diptych::coupling
{
  // One number by which grains and continuum are compared.
  struct Observable
  {
    ObservableKind kind;
    double         from = 0, to = 0; // of the progress
    double         middle() const { return 0.5 * (from + to); }
  };

  // The samples of one path.
  struct TargetData
  {
    std::vector<Observable>      observables;
    std::vector<Eigen::VectorXd> samples; // one entry per observable; NaN if a sample has none (no band)
    Eigen::VectorXd              mean;    // over the samples that have it; NaN if less than half do
    Eigen::VectorXi              count;
  };

  // Fills mean and count.
  void summarise(TargetData &data);

  // Scatter of one sample. A few samples cannot give a full covariance, so it has a fixed form. The curve t/s is shifted as a
  // whole (level) and varies locally, correlated in strain (shape). Volume has a constant scatter and one in proportion to
  // strain. Widths scatter independently.
  struct NoiseModel
  {
    double stress_level = 0, stress_shape = 0, volume_start = 0, volume_growth = 0, ln_width = 0, correlation_strain = 0.005;
    int    degrees_of_freedom = 0; // samples minus paths; 0: nothing was estimated
  };

  // Pools the scatter within every path; values of the options take precedence. Throws std::invalid_argument if a number is
  // neither given nor can be estimated.
  [[nodiscard]] NoiseModel noise_of(const std::vector<TargetData> &paths, const NoiseOptions &options);

  // Covariance of one sample, n_observables squared.
  [[nodiscard]] Eigen::MatrixXd covariance(const NoiseModel &noise, const std::vector<Observable> &observables);

  // Variance of the model tolerance, n_observables.
  [[nodiscard]] Eigen::VectorXd discrepancy(const NoiseOptions &options, const std::vector<Observable> &observables);

  // Weights of the fit, n_observables: 1 / (scatter of the mean without what all bins have in common + discrepancy). The common
  // part is left out on purpose, because a fit with it may lie below all data. 0 if the mean is NaN.
  [[nodiscard]] Eigen::VectorXd working_weights(const NoiseModel &noise, const NoiseOptions &options, const TargetData &data);
} // namespace diptych::coupling
