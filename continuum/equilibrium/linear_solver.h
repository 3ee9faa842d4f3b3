// diptych: linear solves with a preconditioner that is kept while it still serves
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

#include "continuum/equilibrium/umfpack.h"
#include "continuum/options.h"

namespace diptych::continuum
{
  // Motions of the whole sample that cost no energy: columns of the near null space, for AMG.
  using RigidModes = std::vector<dealii::TrilinosWrappers::MPI::Vector>;

  enum class LinearMethod
  {
    umfpack, // one process
    mumps,
    amg // ML's smoothed aggregation
  };

  // automatic takes AMG from `n_unknowns` = 400000 on (at 200000 direct took 22 s, AMG 45).
  LinearMethod linear_method(LinearChoice choice, std::size_t n_unknowns, MPI_Comm communicator);

  // What of a solver outlives a checkpoint: the matrices behind its preconditioner, as values in the order of the tangent's
  // pattern. On several processes nothing is kept: the next solve() factorises afresh.
  struct KeptPreconditioner
  {
    bool                             is_stale = true;
    std::vector<double>              analysed, factorised; // UMFPACK; AMG keeps the second alone
    std::vector<std::vector<double>> rigid_modes;          // AMG
  };

  // The factors (or the multigrid hierarchy) of an earlier tangent precondition GMRES on the present one, from the right.
  // Newton needs a relative 1e-2 only. When that took more than a few iterations, the next tangent is factorised anew; when it
  // was not reached, the present one is.
  class LinearSolver
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    explicit LinearSolver(LinearMethod method);

    // For a mesh that changed.
    void restart(LinearMethod method, RigidModes modes);

    // Solves matrix * x = rhs; x is overwritten. False: no solution could be found.
    [[nodiscard]] bool solve(const dealii::TrilinosWrappers::SparseMatrix &matrix, Vector &x, const Vector &rhs);

    // The next solve() factorises afresh.
    void forget();

    KeptPreconditioner kept() const;

    // A step may be given up because somebody asked to stop, and must then leave no trace: put_back() makes the preconditioner
    // and the counts what they were at remember(), forget_memory() ends that. Matrices are copied only where they are replaced;
    // the preconditioner is made of them again when it is next needed.
    void remember();
    void put_back();
    void forget_memory() { memory.reset(); }

    // To be called after restart(). `pattern`: a matrix of the present structure. False: the matrices do not fit it.
    [[nodiscard]] bool take_up(const KeptPreconditioner &kept, const dealii::TrilinosWrappers::SparseMatrix &pattern);

    // From what an interrupted run had counted.
    void go_on_counting(int iterations, int factorisations, double cpu_s)
    {
      n_iterations     = iterations;
      n_factorisations = factorisations;
      seconds          = cpu_s;
    }

    int    linear_iterations() const { return n_iterations; }
    int    factorisations() const { return n_factorisations; }
    double cpu_s() const { return seconds; }

    // The preconditioner as deal.II's solvers want it.
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
    bool solve_iteratively(const dealii::TrilinosWrappers::SparseMatrix &matrix, Vector &x, const Vector &rhs);
    bool factorise(const dealii::TrilinosWrappers::SparseMatrix &matrix);
    bool build_amg(const dealii::TrilinosWrappers::SparseMatrix &matrix);

    LinearMethod          method;
    RigidModes            rigid_modes;
    Umfpack               umfpack;
    dealii::SolverControl direct_control;
    // What MUMPS and ML go on reading, while the problem assembles anew or changes its structure. Outlives both.
    std::unique_ptr<dealii::TrilinosWrappers::SparseMatrix>    factorised;
    std::unique_ptr<dealii::TrilinosWrappers::SolverDirect>    mumps;
    std::unique_ptr<dealii::TrilinosWrappers::PreconditionAMG> amg;
    bool                                                       is_fresh = false, is_stale = true;
    int                                                        n_iterations = 0, n_factorisations = 0;
    double                                                     seconds = 0;
    std::optional<Memory>                                      memory;
    std::optional<KeptPreconditioner>                          waiting; // to be made of these matrices by the next solve()
  };
} // namespace diptych::continuum
