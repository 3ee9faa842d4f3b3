// diptych: linear solves with a factorisation that is kept while it still serves
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/linear_solver.h"

#include <cmath>
#include <ctime>

#include <deal.II/lac/solver_gmres.h>

namespace diptych::continuum
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int max_iterations = 12;
    constexpr double       reduction      = 1e-3;

    struct FactorsAsPreconditioner
    {
      TrilinosWrappers::SolverDirect &factors;
      void vmult(KeptFactorisation::Vector &x, const KeptFactorisation::Vector &b) const { factors.solve(x, b); }
    };
  } // namespace

  KeptFactorisation::KeptFactorisation()
      : direct_control(1, 0.)
  {}

  bool KeptFactorisation::solve(const TrilinosWrappers::SparseMatrix &matrix, Vector &x, const Vector &rhs)
  {
    const auto start = std::clock();
    bool       done  = factors && solve_iteratively(matrix, x, rhs);
    if (!done && factorise(matrix))
      {
        factors->solve(x, rhs);
        done = std::isfinite(x.l2_norm());
      }
    seconds += double(std::clock() - start) / CLOCKS_PER_SEC;
    return done;
  }

  bool KeptFactorisation::solve_iteratively(const TrilinosWrappers::SparseMatrix &matrix, Vector &x, const Vector &rhs)
  {
    SolverControl                       control(max_iterations, reduction * rhs.l2_norm(), false, false);
    SolverGMRES<Vector>::AdditionalData settings(max_iterations + 3, true);
    SolverGMRES<Vector>                 gmres(control, settings);
    x = 0;
    try
      {
        gmres.solve(matrix, x, rhs, FactorsAsPreconditioner{*factors});
      }
    catch (const SolverControl::NoConvergence &)
      {
        n_iterations += control.last_step();
        return false;
      }
    n_iterations += control.last_step();
    return std::isfinite(x.l2_norm());
  }

  bool KeptFactorisation::factorise(const TrilinosWrappers::SparseMatrix &matrix)
  {
    factors = std::make_unique<TrilinosWrappers::SolverDirect>(
      direct_control, TrilinosWrappers::SolverDirect::AdditionalData(false, "Amesos_Klu"));
    ++n_factorisations;
    try
      {
        factors->initialize(matrix);
      }
    catch (const ExceptionBase &) // a singular tangent
      {
        factors.reset();
        return false;
      }
    return true;
  }
} // namespace diptych::continuum
