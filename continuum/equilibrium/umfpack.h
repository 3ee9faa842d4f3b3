// diptych: sparse LU factors by UMFPACK
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <vector>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

namespace diptych::continuum
{
  // UMFPACK (Davis, ACM TOMS 30, 2004) through its own interface: the symbolic analysis is kept while the pattern stays, and
  // solve() does no iterative refinement, which deal.II's class always does.
  class Umfpack
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    Umfpack();

    // Of a matrix on one process. False: it is singular, or memory ran out.
    [[nodiscard]] bool factorise(const dealii::TrilinosWrappers::SparseMatrix &matrix);
    void               solve(Vector &x, const Vector &b) const;

    // Values of the matrices that the analysis and the factors were made of; empty where there are none. Analysis and factors
    // made of them again have the same bits.
    const std::vector<double> &analysed() const { return analysed_values; }
    const std::vector<double> &factorised() const { return values; }
    [[nodiscard]] bool         take_up(const dealii::TrilinosWrappers::SparseMatrix &pattern,
                                       const std::vector<double>                    &analysed,
                                       const std::vector<double>                    &factorised);

    void forget_pattern(); // the next matrix has another one
    void forget_factors();
    bool has_factors() const { return numeric != nullptr; }

  private:
    void               take_pattern(const dealii::TrilinosWrappers::SparseMatrix &matrix);
    [[nodiscard]] bool analyse();
    [[nodiscard]] bool make_factors();

    std::vector<double>                     control;
    std::vector<int>                        row_start, columns; // of the matrix that was factorised: solving reads them again
    std::vector<double>                     values, analysed_values;
    std::unique_ptr<void, void (*)(void *)> symbolic, numeric;
  };
} // namespace diptych::continuum
