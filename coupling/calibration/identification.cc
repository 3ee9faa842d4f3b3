// diptych: what the data say of the parameters, and what they do not
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/calibration/identification.h"

#include <Eigen/Cholesky>

namespace diptych::coupling
{
  Identification identify(const Eigen::MatrixXd &jacobian, const Eigen::VectorXd &weights, const Eigen::MatrixXd &noise)
  {
    const Eigen::Index    n        = jacobian.cols();
    const Eigen::MatrixXd prior    = Eigen::MatrixXd::Identity(n, n) / (deviation_beforehand * deviation_beforehand);
    const Eigen::MatrixXd weighted = weights.asDiagonal() * jacobian;
    const Eigen::MatrixXd inverse  = (jacobian.transpose() * weighted + prior).ldlt().solve(Eigen::MatrixXd::Identity(n, n));
    Identification        result;
    result.covariance  = inverse * (weighted.transpose() * noise * weighted + prior) * inverse;
    result.covariance  = 0.5 * (result.covariance + result.covariance.transpose()).eval();
    result.deviation   = result.covariance.diagonal().cwiseSqrt();
    result.correlation = result.covariance.cwiseQuotient(result.deviation * result.deviation.transpose());
    result.share_known = result.deviation / deviation_beforehand;
    for (Eigen::Index k = 0; k < n; ++k)
      result.is_identified.push_back(result.share_known[k] < largest_share_identified);
    return result;
  }
} // namespace diptych::coupling
