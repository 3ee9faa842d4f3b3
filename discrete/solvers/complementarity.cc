// diptych: linear complementarity problems by complementary pivots
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/solvers/complementarity.h"

#include <limits>
#include <numeric>

namespace diptych::discrete
{
  using Eigen::Index;
  using Eigen::MatrixXd;
  using Eigen::VectorXd;

  namespace
  {
    constexpr Index none = -1;
  } // namespace

  LinearComplementarity::LinearComplementarity(const MatrixXd &a)
      : a_(a),
        tableau_(a.rows(), 2 * a.rows() + 2),
        basic_(a.rows())
  {
    start_from_zero();
  }

  // w - A z - a0 (1, ..., 1) = q, all of w basic.
  void LinearComplementarity::start_from_zero()
  {
    const Index n = a_.rows();
    tableau_.leftCols(n).setIdentity();
    tableau_.middleCols(n, n) = -a_;
    std::iota(basic_.begin(), basic_.end(), Index(0));
  }

  void LinearComplementarity::pivot(const Index row, const Index column)
  {
    tableau_.row(row) /= tableau_(row, column);
    for (Index i = 0; i < tableau_.rows(); ++i)
      if (const double factor = tableau_(i, column); i != row && factor != 0)
        tableau_.row(i) -= factor * tableau_.row(row);
    basic_[row] = column;
    ++n_pivots_;
  }

  // Smallest ratio; among equal ones the artificial variable, whose leaving is the end.
  Index LinearComplementarity::leaving_row(const Index entering) const
  {
    constexpr double smallest_pivot = 1e-10, tie = 1e-14;
    const Index      n = a_.rows(), artificial = 2 * n, right = artificial + 1;
    double           least = std::numeric_limits<double>::infinity();
    Index            row   = none;
    for (Index i = 0; i < n; ++i)
      if (tableau_(i, entering) > smallest_pivot)
        {
          const double ratio = tableau_(i, right) / tableau_(i, entering);
          if (ratio < least - tie || (basic_[i] == artificial && ratio <= least + tie))
            least = ratio, row = i;
        }
    return row;
  }

  bool LinearComplementarity::pivot_to_solution(const VectorXd &q)
  {
    const Index n = a_.rows(), artificial = 2 * n, right = artificial + 1;
    const long  most_pivots = n_pivots_ + 60 * n;
    tableau_.col(right)     = tableau_.leftCols(n) * q; // the columns of w hold the inverse of the basis
    Index row;
    if (tableau_.col(right).minCoeff(&row) >= -1e-13 * q.cwiseAbs().maxCoeff())
      return true;
    tableau_.col(artificial).setConstant(-1);
    for (Index entering = artificial; row != none && n_pivots_ < most_pivots; row = leaving_row(entering))
      {
        const Index leaving = basic_[row];
        pivot(row, entering);
        if (leaving == artificial)
          return true;
        entering = leaving < n ? leaving + n : leaving - n; // the complement of what left
      }
    return false;
  }

  std::optional<VectorXd> LinearComplementarity::checked_solution(const VectorXd &q) const
  {
    const Index n = a_.rows();
    VectorXd    z = VectorXd::Zero(n);
    for (Index i = 0; i < n; ++i)
      if (basic_[i] >= n && basic_[i] < 2 * n)
        z[basic_[i] - n] = std::max(0., tableau_(i, 2 * n + 1));
    const VectorXd w = a_ * z + q;
    // min(w, z) vanishes at a solution.
    if (w.cwiseMin(z).cwiseAbs().maxCoeff() <= 1e-9 * q.cwiseAbs().maxCoeff())
      return z;
    return std::nullopt;
  }

  std::optional<VectorXd> LinearComplementarity::solve(const VectorXd &q)
  {
    if (pivot_to_solution(q))
      if (std::optional<VectorXd> z = checked_solution(q))
        return z;
    start_from_zero(); // away from a ray, and from the round-off of many pivots
    if (pivot_to_solution(q))
      if (std::optional<VectorXd> z = checked_solution(q))
        return z;
    start_from_zero();
    return std::nullopt;
  }
} // namespace diptych::discrete
