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
  };
  constexpr double deviation_beforehand = 0.25, largest_share_identified = 2. / 3;

  // jacobian: of the observables (not weighted) by the coordinates; weights: of the fit; noise: covariance of the observables'
  // means, n_observables squared. With H = J'WJ + 1/prior^2 the estimate has the covariance H^-1 (J'W C W J + 1/prior^2) H^-1:
  // what the weights do not know of the scatter, the samples do.
  [[nodiscard]] Identification identify(const Eigen::MatrixXd &jacobian,
                                        const Eigen::VectorXd &weights,
                                        const Eigen::MatrixXd &noise);
} // namespace diptych::coupling
