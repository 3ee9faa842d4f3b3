// diptych: linear solves with a preconditioner that is reused while it is effective
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_solver.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include "continuum/equilibrium/supernodal_lu.h"
#include "continuum/options.h"

namespace diptych::continuum
{
  // Motions of the whole sample without energy: the near null space for AMG.
  using RigidModes = std::vector<dealii::TrilinosWrappers::MPI::Vector>;

  enum class LinearMethod
  {
    supernodal, // own LU in single precision, on one process
    mumps,
    amg // ML's smoothed aggregation
  };

  // `automatic` selects AMG from `n_unknowns` = 400000 on. At 204000 the direct solver takes 10.5 s, AMG 14.2 s.
  LinearMethod linear_method(LinearChoice choice, std::size_t n_unknowns, MPI_Comm communicator);

  // State of a solver for a checkpoint: the matrix behind its preconditioner, as values in the order of the tangent's pattern.
  // On several processes nothing is kept, and the next solve() factorises again.
  struct KeptPreconditioner
  {
    bool                             is_stale = true;
    std::vector<double>              factorised;
    std::vector<std::vector<double>> rigid_modes; // AMG
  };

  // The factors (or the multigrid hierarchy) of an earlier tangent precondition GMRES on the present one, from the right.
  // Newton's method needs only a relative 1e-2. If GMRES takes more than a few iterations, the next tangent is factorised.
  class LinearSolver
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    explicit LinearSolver(LinearMethod method);

    void restart(LinearMethod method, RigidModes modes);

    // Solves matrix * x = rhs; x is overwritten. False: no solution was found.
    [[nodiscard]] bool solve(const dealii::TrilinosWrappers::SparseMatrix &matrix, Vector &x, const Vector &rhs);

    // Makes the next solve() factorise again.
    void forget();

    KeptPreconditioner kept() const;

    // A step stopped on request must change nothing. `remember()` saves preconditioner and counts. They are restored by
    // put_back() and dropped by forget_memory(). The matrix is copied only when replaced; the preconditioner is rebuilt when it
    // is needed.
    void remember();
    void put_back();
    void forget_memory() { memory.reset(); }

    // Restores the state from a checkpoint; to be called after restart(). `pattern` is a matrix with the present sparsity. False:
    // the kept matrices do not fit it.
    [[nodiscard]] bool take_up(const KeptPreconditioner &kept, const dealii::TrilinosWrappers::SparseMatrix &pattern);

    void go_on_counting(int iterations, int factorisations, double cpu_s)
    {
      n_iterations     = iterations;
      n_factorisations = factorisations;
      seconds          = cpu_s;
    }

    int    linear_iterations() const { return n_iterations; }
    int    factorisations() const { return n_factorisations; }
    double cpu_s() const { return seconds; }

    // The preconditioner in the form that deal.II's solvers expect.
    void vmult(Vector &x, const Vector &b) const;

  private:
    struct Memory
    {
      bool                              is_stale;
      int                               n_iterations, n_factorisations;
      double                            seconds;
      std::optional<KeptPreconditioner> replaced; // since then
    };

    void keep_what_is_replaced();
    bool solve_iteratively(const dealii::TrilinosWrappers::SparseMatrix &matrix, Vector &x, const Vector &rhs, double wanted);
    bool factorise(const dealii::TrilinosWrappers::SparseMatrix &matrix);
    bool build(); // the preconditioner, from `factorised`
    bool build_amg();

    LinearMethod          method;
    RigidModes            rigid_modes;
    SupernodalLu          lu;
    dealii::SolverControl direct_control;
    // A copy: the problem assembles again or changes its structure while MUMPS and ML continue to read this matrix.
    std::unique_ptr<dealii::TrilinosWrappers::SparseMatrix>    factorised;
    std::unique_ptr<dealii::TrilinosWrappers::SolverDirect>    mumps;
    std::unique_ptr<dealii::TrilinosWrappers::PreconditionAMG> amg;
    bool                                                       is_stale     = true;
    int                                                        n_iterations = 0, n_factorisations = 0;
    double                                                     seconds = 0;
    std::optional<Memory>                                      memory;
    std::optional<KeptPreconditioner>                          waiting; // for the next solve()
  };
} // namespace diptych::continuum
