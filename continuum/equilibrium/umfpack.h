// diptych: sparse LU factors by UMFPACK
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <vector>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

namespace diptych::continuum
{
  // UMFPACK (Davis, ACM TOMS 30, 2004) through its own interface. It keeps the symbolic analysis while the pattern does not
  // change. Its solve() does no iterative refinement, which deal.II's class always does.
  class Umfpack
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    Umfpack();

    // Factorises a matrix on one process. False: the matrix is singular, or memory ran out.
    [[nodiscard]] bool factorise(const dealii::TrilinosWrappers::SparseMatrix &matrix);
    void               solve(Vector &x, const Vector &b) const;

    // Entries of the matrix of the last symbolic analysis, and of the matrix of the last factorisation; empty if there is none.
    // `take_up()` repeats both from these entries, with the same bits. False: the entries do not fit the pattern, or a
    // factorisation failed.
    const std::vector<double> &analysed() const { return analysed_values; }
    const std::vector<double> &factorised() const { return values; }
    [[nodiscard]] bool         take_up(const dealii::TrilinosWrappers::SparseMatrix &pattern,
                                       const std::vector<double>                    &analysed,
                                       const std::vector<double>                    &factorised);

    void forget_pattern(); // the next matrix has a new pattern
    void forget_factors();

  private:
    void               take_pattern(const dealii::TrilinosWrappers::SparseMatrix &matrix);
    [[nodiscard]] bool analyse();
    [[nodiscard]] bool make_factors();

    std::vector<double>                     control;
    std::vector<int>                        row_start, columns; // of the factorised matrix; solve() needs them again
    std::vector<double>                     values, analysed_values;
    std::unique_ptr<void, void (*)(void *)> symbolic, numeric;
  };
} // namespace diptych::continuum
