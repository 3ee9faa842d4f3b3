// diptych: how the samples of a calibration scatter, and what weights that gives
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "coupling/calibration/calibration.h"

namespace diptych::coupling
{
  // One number that grains and continuum are held against each other by.
  struct Observable
  {
    ObservableKind kind;
    double         from = 0, to = 0; // of the progress
    double         middle() const { return 0.5 * (from + to); }
  };

  // One path as its samples have it.
  struct TargetData
  {
    std::vector<Observable>      observables;
    std::vector<Eigen::VectorXd> samples; // one entry an observable; NaN where a sample has none (no band)
    Eigen::VectorXd              mean;    // over the samples that have it; NaN where less than half do
    Eigen::VectorXi              count;
  };

  // Fills mean and count.
  void summarise(TargetData &data);

  // Scatter of one sample. A few samples give no full covariance, but it has a form: t/s is shifted as a whole (level) and
  // wiggles with a correlation in strain (shape); volume scatters in proportion to strain beside a constant; widths scatter each
  // by itself.
  struct NoiseModel
  {
    double stress_level = 0, stress_shape = 0, volume_start = 0, volume_growth = 0, ln_width = 0, correlation_strain = 0.005;
    int    degrees_of_freedom = 0; // samples less paths; 0: nothing could be estimated
  };

  // From the scatter within every path, pooled; what the options give is taken from there. Throws std::invalid_argument where
  // something is needed that neither the samples nor the options tell.
  [[nodiscard]] NoiseModel noise_of(const std::vector<TargetData> &paths, const NoiseOptions &options);

  // Of one sample, n_observables squared.
  [[nodiscard]] Eigen::MatrixXd covariance(const NoiseModel &noise, const std::vector<Observable> &observables);

  // Variance that the continuum's form is granted, n_observables.
  [[nodiscard]] Eigen::VectorXd discrepancy(const NoiseOptions &options, const std::vector<Observable> &observables);

  // With which the fit works, n_observables: 1 / (scatter of the mean without what all bins have in common + discrepancy). The
  // common part is left out on purpose: with it a fit may lie below all data. 0 where the mean is NaN.
  [[nodiscard]] Eigen::VectorXd working_weights(const NoiseModel &noise, const NoiseOptions &options, const TargetData &data);
} // namespace diptych::coupling
