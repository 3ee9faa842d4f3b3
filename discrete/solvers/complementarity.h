// diptych: linear complementarity problems by complementary pivots
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace diptych::discrete
{
  // w = A z + q,  w >= 0,  z >= 0,  w.z = 0, dense (Lemke 1965; Cottle, Pang & Stone 1992). The basis of a solution is where the
  // next one begins: for a q nearby it mostly holds, at the price of one product, or is a few pivots away.
  class LinearComplementarity
  {
  public:
    explicit LinearComplementarity(const Eigen::MatrixXd &a); // n x n, entries of order 1

    // z, exact to 1e-9 of the largest |q|. None where the pivots end on a ray or do not end, from the last basis and from z = 0.
    [[nodiscard]] std::optional<Eigen::VectorXd> solve(const Eigen::VectorXd &q);

    long n_pivots() const { return n_pivots_; } // of all solutions so far

  private:
    using Tableau = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    void                           start_from_zero();
    bool                           pivot_to_solution(const Eigen::VectorXd &q);
    void                           pivot(Eigen::Index row, Eigen::Index column);
    Eigen::Index                   leaving_row(Eigen::Index entering) const;
    std::optional<Eigen::VectorXd> checked_solution(const Eigen::VectorXd &q) const;

    Eigen::MatrixXd           a_;
    Tableau                   tableau_; // columns w, z, the artificial variable, right-hand side
    std::vector<Eigen::Index> basic_;   // column that is basic in each row
    long                      n_pivots_ = 0;
  };
} // namespace diptych::discrete
