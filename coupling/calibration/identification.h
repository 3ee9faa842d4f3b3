// diptych: what the data say of the parameters, and what they do not
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

namespace diptych::coupling
{
  // Everything in the coordinates of the fit. Before the data a parameter is known to a quarter of its range (1/4), each by
  // itself.
  struct Identification
  {
    Eigen::MatrixXd   covariance; // of the estimate, by the samples' own scatter ("sandwich"), with the knowledge beforehand
    Eigen::VectorXd   deviation;  // its root
    Eigen::MatrixXd   correlation;
    Eigen::VectorXd   share_known; // deviation / deviation beforehand; above 2/3 the data say little
    std::vector<bool> is_identified;
    Eigen::VectorXd   quantile; // 97.5 % of the estimate over its deviation: Student's, as few samples told the scatter
  };
  constexpr double deviation_beforehand = 0.25, largest_share_identified = 2. / 3;

  // jacobian: of the observables (not weighted) by the coordinates; weights: of the fit; noise: covariance of the observables'
  // means, n_observables squared. With H = J'WJ + 1/prior^2 the estimate has the covariance H^-1 (J'W C W J + 1/prior^2) H^-1:
  // what the weights do not know of the scatter, the samples do.
  [[nodiscard]] Identification identify(const Eigen::MatrixXd &jacobian,
                                        const Eigen::VectorXd &weights,
                                        const Eigen::MatrixXd &noise);

  // What chi^2 of a fit with these weights is expected to be where the law is right and the noise is this: the weights leave out
  // what all bins have in common, so it is not the number of observables less that of parameters.
  [[nodiscard]] double expected_chi2(const Eigen::MatrixXd &jacobian,
                                     const Eigen::VectorXd &weights,
                                     const Eigen::MatrixXd &noise);

  // Replaces the quantile where `scatter`, the part of the noise that samples told, has so many degrees of freedom: with v of the
  // variance from it, of V in all, nu (V / v)^2 count (Satterthwaite, Biometrics Bull. 2 (1946) 110). 0: all was given.
  void take_degrees_of_freedom(const Eigen::MatrixXd &jacobian,
                               const Eigen::VectorXd &weights,
                               const Eigen::MatrixXd &scatter,
                               int                    degrees_of_freedom,
                               Identification        &knowledge);
} // namespace diptych::coupling
