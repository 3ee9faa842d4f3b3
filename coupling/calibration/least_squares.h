// diptych: nonlinear least squares with bounds, where every residual needs a run
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace diptych::coupling
{
  // Weighted residuals at several points, which may be computed in parallel. An empty vector: the run failed.
  using BatchResiduals = std::function<std::vector<Eigen::VectorXd>(const std::vector<Eigen::VectorXd> &)>;

  struct LeastSquaresOptions
  {
    double difference     = 0.01;  // step of the forward differences; backward at the upper bound
    double first_radius   = 0.5;   // of the trust region
    double least_decrease = 1e-3;  // relative decrease of chi^2 and
    double least_gain     = 0.05;  // absolute one: below either, a search from a fresh Jacobian has converged
    double exact          = 1e-6;  // mean square of the residuals below which the fit is exact
    int    most_steps     = 6;     // of a search with one Jacobian and its rank-one updates
    int    most_jacobians = 4;     // computed by differences
    bool   trusts_given   = false; // true: a search with the given Jacobian has converged if no step failed
  };

  struct LeastSquaresFit
  {
    Eigen::VectorXd point, residual;
    Eigen::MatrixXd jacobian; // d residual / d point, n_residuals x n_parameters
    double          chi2        = std::numeric_limits<double>::infinity();
    int             evaluations = 0;
    int             jacobians   = 0;     // computed by differences
    bool            is_fresh    = false; // the Jacobian was computed here, or at a point with almost the same chi^2
    bool            arrived     = false;
    std::string     words; // reason if the search did not converge
  };

  // Minimises the sum of squares within [0, 1]^n. The method is Gauss-Newton in a trust region (Levenberg-Marquardt as in More
  // 1978) with bounds, by ROL's Lin-More algorithm (Trilinos). The Jacobian is given or comes from forward differences, and
  // Broyden's rank-one update follows the accepted steps. It is recomputed if a step fails or the search with it ends. A point
  // without a run counts as a failed step. If `start` has no run, `words` says so. Exceptions of `residuals` pass through.
  [[nodiscard]] LeastSquaresFit least_squares(const BatchResiduals                 &residuals,
                                              const Eigen::VectorXd                &start,
                                              const LeastSquaresOptions            &options  = {},
                                              const std::optional<Eigen::MatrixXd> &jacobian = {});

  // Differences around a point with a known residual. If a run fails, the column uses the other side; it is zero if both fail.
  [[nodiscard]] Eigen::MatrixXd difference_jacobian(const BatchResiduals  &residuals,
                                                    const Eigen::VectorXd &point,
                                                    const Eigen::VectorXd &residual,
                                                    double                 difference);
} // namespace diptych::coupling
