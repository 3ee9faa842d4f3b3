// diptych: nonlinear least squares within bounds, where every residual is a run
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
  // Weighted residuals at several points, which may be run side by side. An empty vector: there is no such run.
  using BatchResiduals = std::function<std::vector<Eigen::VectorXd>(const std::vector<Eigen::VectorXd> &)>;

  struct LeastSquaresOptions
  {
    double difference     = 0.01; // of the forward differences; backward at the upper bound
    double first_radius   = 0.5;  // of the trust region
    double least_decrease = 1e-3; // of chi^2, relative, and
    double least_gain = 0.05;  // absolute: below it a search from a fresh Jacobian has arrived; no datum tells the points apart
    double exact      = 1e-6;  // mean square of the residuals below which there is nothing left to explain
    int    most_steps = 6;     // of a search with one Jacobian and its rank-one updates
    int    most_jacobians = 4; // by differences
    bool   trusts_given   = false; // a search with the Jacobian that was handed in has arrived where no step of it failed
  };

  struct LeastSquaresFit
  {
    Eigen::VectorXd point, residual;
    Eigen::MatrixXd jacobian; // d residual / d point, n_residuals x n_parameters
    double          chi2        = std::numeric_limits<double>::infinity();
    int             evaluations = 0;
    int             jacobians   = 0;  // by differences
    bool            is_fresh = false; // the Jacobian was made by differences at this point, or so near that chi^2 did not change
    bool            arrived  = false;
    std::string     words; // why not
  };

  // Least sum of squares within [0, 1]^n: Gauss-Newton steps in a trust region (Levenberg-Marquardt as More 1978 has it) with
  // bounds, by ROL's Lin-More algorithm (Trilinos). The Jacobian comes from forward differences, or is handed in, follows the
  // accepted steps by Broyden's rank-one update; where a step fails, or the search with it ends, it is made anew. A point without
  // a run counts as a failed step. `start` must have a run: else `words` says so. What `residuals` throws goes through.
  [[nodiscard]] LeastSquaresFit least_squares(const BatchResiduals                 &residuals,
                                              const Eigen::VectorXd                &start,
                                              const LeastSquaresOptions            &options  = {},
                                              const std::optional<Eigen::MatrixXd> &jacobian = {});

  // By differences around a point with a known residual; a column without a run is taken from the other side, and is zero where
  // there is none either.
  [[nodiscard]] Eigen::MatrixXd difference_jacobian(const BatchResiduals  &residuals,
                                                    const Eigen::VectorXd &point,
                                                    const Eigen::VectorXd &residual,
                                                    double                 difference);
} // namespace diptych::coupling
