// diptych: deviations of the fitted parameters, and which of them the data determine
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/calibration/identification.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "coupling/statistics/student.h"

namespace diptych::coupling
{
  namespace
  {
    Eigen::MatrixXd prior_of(const Eigen::Index n)
    {
      return Eigen::MatrixXd::Identity(n, n) / (deviation_beforehand * deviation_beforehand);
    }

    Eigen::MatrixXd inverse_of(const Eigen::MatrixXd &jacobian, const Eigen::MatrixXd &weighted)
    {
      const Eigen::Index n = jacobian.cols();
      return (jacobian.transpose() * weighted + prior_of(n)).ldlt().solve(Eigen::MatrixXd::Identity(n, n));
    }
  } // namespace

  Identification identify(const Eigen::MatrixXd &jacobian, const Eigen::VectorXd &weights, const Eigen::MatrixXd &noise)
  {
    const Eigen::Index    n        = jacobian.cols();
    const Eigen::MatrixXd prior    = prior_of(n);
    const Eigen::MatrixXd weighted = weights.asDiagonal() * jacobian, inverse = inverse_of(jacobian, weighted);
    Identification        result;
    result.covariance  = inverse * (weighted.transpose() * noise * weighted + prior) * inverse;
    result.covariance  = 0.5 * (result.covariance + result.covariance.transpose()).eval();
    result.deviation   = result.covariance.diagonal().cwiseSqrt();
    result.correlation = result.covariance.cwiseQuotient(result.deviation * result.deviation.transpose());
    result.share_known = result.deviation / deviation_beforehand;
    for (Eigen::Index k = 0; k < n; ++k)
      result.is_identified.push_back(result.share_known[k] < largest_share_identified);
    result.quantile = Eigen::VectorXd::Constant(n, normal_quantile);
    return result;
  }

  double expected_chi2(const Eigen::MatrixXd &jacobian, const Eigen::VectorXd &weights, const Eigen::MatrixXd &noise)
  {
    const Eigen::MatrixXd weighted = weights.asDiagonal() * jacobian;
    const Eigen::MatrixXd left     = Eigen::MatrixXd::Identity(jacobian.rows(), jacobian.rows()) -
                                 jacobian * inverse_of(jacobian, weighted) * weighted.transpose();
    return (left * noise * left.transpose()).diagonal().dot(weights);
  }

  void take_degrees_of_freedom(const Eigen::MatrixXd &jacobian,
                               const Eigen::VectorXd &weights,
                               const Eigen::MatrixXd &scatter,
                               const int              degrees_of_freedom,
                               Identification        &knowledge)
  {
    if (degrees_of_freedom < 1)
      return;
    const Eigen::MatrixXd weighted = weights.asDiagonal() * jacobian, inverse = inverse_of(jacobian, weighted);
    const Eigen::VectorXd estimated = (inverse * weighted.transpose() * scatter * weighted * inverse).diagonal();
    for (Eigen::Index k = 0; k < estimated.size(); ++k)
      if (estimated[k] > 0)
        knowledge.quantile[k] = student_quantile(0.975, degrees_of_freedom *
                                                          std::pow(std::max(1., knowledge.covariance(k, k) / estimated[k]), 2));
  }
} // namespace diptych::coupling
