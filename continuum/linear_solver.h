// diptych: linear solves with a factorisation that is kept while it still serves
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>

#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/trilinos_solver.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

namespace diptych::continuum
{
  // The LU factors of an earlier tangent precondition GMRES on the present one. When that takes more than 12 iterations
  // for a relative 1e-3, which is all Newton needs, the present tangent is factorised.
  class KeptFactorisation
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    KeptFactorisation();

    // Solves matrix * x = rhs; x is overwritten. Returns false when the matrix could not be factorised.
    [[nodiscard]] bool solve(const dealii::TrilinosWrappers::SparseMatrix &matrix, Vector &x, const Vector &rhs);

    // The next solve() factorises afresh.
    void forget() { factors.reset(); }

    int    linear_iterations() const { return n_iterations; }
    int    factorisations() const { return n_factorisations; }
    double cpu_s() const { return seconds; }

  private:
    bool solve_iteratively(const dealii::TrilinosWrappers::SparseMatrix &matrix, Vector &x, const Vector &rhs);
    bool factorise(const dealii::TrilinosWrappers::SparseMatrix &matrix);

    dealii::SolverControl                                   direct_control;
    std::unique_ptr<dealii::TrilinosWrappers::SolverDirect> factors;
    int                                                     n_iterations = 0, n_factorisations = 0;
    double                                                  seconds = 0;
  };
} // namespace diptych::continuum
