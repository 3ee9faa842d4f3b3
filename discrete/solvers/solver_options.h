// diptych: options and report of the contact solver
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>

#include "discrete/choices.h"

namespace diptych::discrete
{
  enum class ContactSolver
  {
    psor, // over-relaxed Gauss-Seidel, omega by contact status
    nsgs  // plain Gauss-Seidel, the reference
  };

  constexpr auto choices(ContactSolver)
  {
    return std::array{std::pair{ContactSolver::psor, "psor"}, std::pair{ContactSolver::nsgs, "nsgs"}};
  }

  struct SolverOptions
  {
    ContactSolver solver    = ContactSolver::psor;
    double        tolerance = 2e-5; // residual (natural map relative to |r|) at which a step ends; set by the rule or by the user
    // Largest velocity error (natural_map.h). A step only needs the impulses of bodies that stop: jammed grains press on each
    // other with forces that are large against their free velocities, so its error is limited by `tolerance`.
    double velocity_tolerance = 0.5;
    int    max_sweeps         = 50000;
    double omega_sticking     = 1.8;
    double omega_slipping     = 1.0;
    int    sweeps_per_check   = 20;

    // Called at every check of the residual; true ends the solve. For callers that discard the step.
    std::function<bool()> stop_requested;
  };

  template <class Visitor> void visit_parameters(SolverOptions &o, Visitor &&visitor)
  {
    visitor("solver", o.solver, "-",
            "psor: over-relaxed Gauss-Seidel, omega by contact status; nsgs: plain Gauss-Seidel, the reference");
    visitor(
      "max_sweeps", o.max_sweeps, "-", {1, 100000000},
      "sweeps after which a step counts as not converged; the run then halves the step, up to three times, before it stops with "
      "exit code 3");
    visitor(
      "omega_sticking", o.omega_sticking, "-", {0.1, 1.99},
      "psor: relaxation of sticking and open contacts; if the residual stagnates, the solver tries other values between 1 and "
      "this one in turn");
    visitor("omega_slipping", o.omega_slipping, "-", {0.1, 1.99},
            "psor: relaxation of contacts at their Coulomb bound; above 1 the sweeps may end in limit cycles");
    visitor("sweeps_per_check", o.sweeps_per_check, "-", {1, 10000}, "sweeps between two evaluations of the residual");
  }

  enum class SolveStatus
  {
    converged,
    max_sweeps_reached,
    stopped, // SolverOptions::stop_requested
    blown_up // explicit springs, which need no sweeps: a body moved too fast
  };

  constexpr auto choices(SolveStatus)
  {
    return std::array{std::pair{SolveStatus::converged, "converged"},
                      std::pair{SolveStatus::max_sweeps_reached, "max_sweeps_reached"},
                      std::pair{SolveStatus::stopped, "stopped"}, std::pair{SolveStatus::blown_up, "blown_up"}};
  }

  struct [[nodiscard]] SolveReport
  {
    SolveStatus status         = SolveStatus::converged;
    long        sweeps         = 0;
    double      residual       = 0; // natural map, relative to |r|, measured outside the solver
    double      velocity_error = 0; // as above; not measured where explicit springs make the step
    int         relieved       = 0; // psor: contacts swept by themselves at the end, because the sweeps had stalled on them
    double      cpu_s          = 0; // of all threads, including batch construction and residual checks
  };
} // namespace diptych::discrete
