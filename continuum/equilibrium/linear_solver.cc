// diptych: linear solves with a preconditioner that is reused while it is effective
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/equilibrium/linear_solver.h"

#include <cmath>
#include <ctime>
#include <utility>

#include <deal.II/lac/solver_gmres.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>

namespace diptych::continuum
{
  using namespace dealii;

  namespace
  {
    // Factors by which GMRES reduces the residual. Newton's method needs no more than the first. A difficult iteration has a new
    // factorisation and takes the second.
    constexpr double reduction = 1e-2, fresh_reduction = 1e-6;
    // Number of allowed iterations, and the number above which a new preconditioner pays. Multigrid always needs many.
    struct Patience
    {
      unsigned int longest, comfortable;
    };
    Patience patience(const LinearMethod method)
    {
      return method == LinearMethod::amg ? Patience{200, 60} : Patience{25, 8};
    }

    bool is_on_one_process(const TrilinosWrappers::SparseMatrix &matrix)
    {
      return matrix.trilinos_matrix().Comm().NumProc() == 1;
    }

    std::pair<double *, std::size_t> stored_values(const TrilinosWrappers::SparseMatrix &matrix)
    {
      int    *start = nullptr, *column = nullptr;
      double *value = nullptr;
      auto   &crs   = const_cast<Epetra_CrsMatrix &>(matrix.trilinos_matrix());
      crs.OptimizeStorage();
      crs.ExtractCrsDataPointers(start, column, value);
      return {value, std::size_t(start[crs.NumMyRows()])};
    }
  } // namespace

  LinearMethod linear_method(const LinearChoice choice, const std::size_t n_unknowns, const MPI_Comm communicator)
  {
    if (choice == LinearChoice::amg || (choice == LinearChoice::automatic && n_unknowns >= 400000))
      return LinearMethod::amg;
    return Utilities::MPI::n_mpi_processes(communicator) == 1 ? LinearMethod::supernodal : LinearMethod::mumps;
  }

  LinearSolver::LinearSolver(const LinearMethod method)
      : method(method),
        direct_control(1, 0.)
  {}

  void LinearSolver::restart(const LinearMethod new_method, RigidModes modes)
  {
    method      = new_method;
    rigid_modes = std::move(modes);
    memory.reset();
    lu.forget_pattern();
    forget();
  }

  void LinearSolver::remember()
  {
    memory = Memory{is_stale, n_iterations, n_factorisations, seconds, {}};
  }

  void LinearSolver::put_back()
  {
    if (!memory)
      return;
    Memory before = *std::exchange(memory, std::nullopt);
    go_on_counting(before.n_iterations, before.n_factorisations, before.seconds);
    if (before.replaced)
      {
        forget();
        waiting = std::move(before.replaced);
        if (!waiting->factorised.empty()) // otherwise nothing is kept and the next solve() factorises
          waiting->is_stale = before.is_stale;
      }
    else
      is_stale = before.is_stale;
  }

  void LinearSolver::keep_what_is_replaced()
  {
    if (memory && !memory->replaced)
      memory->replaced = kept();
  }

  void LinearSolver::forget()
  {
    keep_what_is_replaced();
    waiting.reset();
    mumps.reset();
    amg.reset();
    factorised.reset();
    is_stale = true;
  }

  KeptPreconditioner LinearSolver::kept() const
  {
    if (waiting)
      return *waiting;
    KeptPreconditioner kept;
    if (method != LinearMethod::mumps && factorised && is_on_one_process(*factorised))
      {
        const auto [values, n] = stored_values(*factorised);
        kept                   = {is_stale, {values, values + n}, {}};
        if (method == LinearMethod::amg)
          for (const Vector &mode : rigid_modes)
            kept.rigid_modes.emplace_back(mode.begin(), mode.end());
      }
    return kept;
  }

  bool LinearSolver::take_up(const KeptPreconditioner &kept, const TrilinosWrappers::SparseMatrix &pattern)
  {
    forget();
    if (!is_on_one_process(pattern) || method == LinearMethod::mumps)
      return true;                                         // nothing to restore
    bool fits = kept.is_stale || !kept.factorised.empty(); // if not stale, it preconditions the next solve
    if (fits && !kept.factorised.empty())
      {
        factorised = std::make_unique<TrilinosWrappers::SparseMatrix>();
        factorised->copy_from(pattern);
        const auto [values, n] = stored_values(*factorised);
        fits = n == kept.factorised.size() && kept.rigid_modes.size() == (method == LinearMethod::amg ? rigid_modes.size() : 0);
        for (std::size_t k = 0; fits && k < kept.rigid_modes.size(); ++k)
          std::copy(kept.rigid_modes[k].begin(), kept.rigid_modes[k].end(), rigid_modes[k].begin());
        if (fits)
          std::copy(kept.factorised.begin(), kept.factorised.end(), values);
        fits = fits && build();
      }
    if (fits)
      is_stale = kept.is_stale;
    else
      forget();
    return fits;
  }

  void LinearSolver::vmult(Vector &x, const Vector &b) const
  {
    if (method == LinearMethod::amg)
      amg->vmult(x, b);
    else if (method == LinearMethod::mumps)
      mumps->solve(x, b);
    else
      lu.solve(x, b);
  }

  bool LinearSolver::solve(const TrilinosWrappers::SparseMatrix &matrix, Vector &x, const Vector &rhs)
  {
    const auto start = std::clock();
    bool       done  = false;
    if (waiting)
      (void)take_up(KeptPreconditioner(*waiting), matrix); // it fitted before; otherwise it is rebuilt
    const bool is_fresh = is_stale;
    if (!is_stale || factorise(matrix))
      done = solve_iteratively(matrix, x, rhs, is_fresh ? fresh_reduction : reduction);
    if (!done && !is_fresh && factorise(matrix))
      done = solve_iteratively(matrix, x, rhs, fresh_reduction);
    seconds += double(std::clock() - start) / CLOCKS_PER_SEC;
    return done;
  }

  bool LinearSolver::solve_iteratively(const TrilinosWrappers::SparseMatrix &matrix,
                                       Vector                               &x,
                                       const Vector                         &rhs,
                                       const double                          wanted)
  {
    x                                         = 0;
    const auto                          limit = patience(method);
    SolverControl                       control(limit.longest, wanted * rhs.l2_norm(), false, false);
    SolverGMRES<Vector>::AdditionalData settings(std::min(limit.longest, 60u) + 3, true);
    SolverGMRES<Vector>                 gmres(control, settings);
    try
      {
        gmres.solve(matrix, x, rhs, *this);
      }
    catch (const SolverControl::NoConvergence &)
      {
        n_iterations += control.last_step();
        return false;
      }
    n_iterations += control.last_step();
    is_stale = control.last_step() > limit.comfortable;
    return std::isfinite(x.l2_norm());
  }

  bool LinearSolver::factorise(const TrilinosWrappers::SparseMatrix &matrix)
  {
    keep_what_is_replaced();
    ++n_factorisations;
    is_stale = false;
    mumps.reset();
    amg.reset();
    if (factorised && is_on_one_process(matrix))
      {
        const auto [from, n] = stored_values(matrix);
        std::copy(from, from + n, stored_values(*factorised).first);
      }
    else
      {
        factorised = std::make_unique<TrilinosWrappers::SparseMatrix>();
        factorised->copy_from(matrix);
      }
    if (build())
      return true;
    forget();
    return false;
  }

  bool LinearSolver::build()
  {
    if (method == LinearMethod::supernodal)
      return lu.factorise(*factorised);
    if (method == LinearMethod::amg)
      return build_amg();
    mumps = std::make_unique<TrilinosWrappers::SolverDirect>(
      direct_control, TrilinosWrappers::SolverDirect::AdditionalData(false, "Amesos_Mumps"));
    try
      {
        mumps->initialize(*factorised);
      }
    catch (const ExceptionBase &) // a singular tangent
      {
        return false;
      }
    return true;
  }

  // deal.II's interface accepts only modes that are constant per component. The rotation of the sample goes to ML directly.
  bool LinearSolver::build_amg()
  {
    TrilinosWrappers::PreconditionAMG::AdditionalData settings;
    settings.elliptic              = false; // not symmetric
    settings.higher_order_elements = true;
    settings.smoother_sweeps       = 2;
    settings.aggregation_threshold = 0.02;
    Teuchos::ParameterList              parameters;
    std::unique_ptr<Epetra_MultiVector> unused;
    settings.set_parameters(parameters, unused, factorised->trilinos_matrix());
    Epetra_MultiVector modes(factorised->trilinos_matrix().DomainMap(), int(rigid_modes.size()));
    for (std::size_t k = 0; k < rigid_modes.size(); ++k)
      std::copy(rigid_modes[k].begin(), rigid_modes[k].end(), modes[int(k)]);
    parameters.set("PDE equations", 1);
    parameters.set("null space: type", "pre-computed");
    parameters.set("null space: dimension", int(rigid_modes.size()));
    parameters.set("null space: vectors", modes.Values());
    amg = std::make_unique<TrilinosWrappers::PreconditionAMG>();
    try
      {
        amg->initialize(*factorised, parameters);
      }
    catch (const ExceptionBase &)
      {
        return false;
      }
    return true;
  }
} // namespace diptych::continuum
