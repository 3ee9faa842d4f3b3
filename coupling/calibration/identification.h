// diptych: deviations of the fitted parameters, and which of them the data determine
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

namespace diptych::coupling
{
  // All in the coordinates of the fit. The prior deviation of each parameter is a quarter of its range (1/4), independently.
  struct Identification
  {
    Eigen::MatrixXd   covariance; // of the estimate, with the samples' covariance ("sandwich") and the prior
    Eigen::VectorXd   deviation;  // root of its diagonal
    Eigen::MatrixXd   correlation;
    Eigen::VectorXd   share_known; // deviation / prior deviation; above 2/3 the data say little
    std::vector<bool> is_identified;
    Eigen::VectorXd   quantile; // 97.5 % quantile of estimate / deviation: Student's, because few samples give the scatter
  };
  constexpr double deviation_beforehand = 0.25, largest_share_identified = 2. / 3;

  // jacobian: derivatives of the unweighted observables by the coordinates. weights: those of the fit. noise: covariance C of
  // the observables' means, n_observables squared. With H = J'WJ + 1/prior^2 the estimate has the covariance H^-1 (J'W C W J +
  // 1/prior^2) H^-1: the scatter that the weights omit enters through C.
  [[nodiscard]] Identification identify(const Eigen::MatrixXd &jacobian,
                                        const Eigen::VectorXd &weights,
                                        const Eigen::MatrixXd &noise);

  // Expected chi^2 of a fit with these weights if the law is right and the noise has this covariance. It differs from the
  // number of observables minus parameters, because the weights omit the scatter common to all bins.
  [[nodiscard]] double expected_chi2(const Eigen::MatrixXd &jacobian,
                                     const Eigen::VectorXd &weights,
                                     const Eigen::MatrixXd &noise);

  // Replaces the quantile by Student's. `scatter` is the part of the noise that was estimated with so many degrees of freedom
  // nu. If it contributes v to a variance V, nu (V / v)^2 degrees count (Satterthwaite, Biometrics Bull. 2 (1946) 110). 0:
  // nothing was estimated.
  void take_degrees_of_freedom(const Eigen::MatrixXd &jacobian,
                               const Eigen::VectorXd &weights,
                               const Eigen::MatrixXd &scatter,
                               int                    degrees_of_freedom,
                               Identification        &knowledge);
} // namespace diptych::coupling
