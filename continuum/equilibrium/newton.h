// diptych: Newton's method for one load step
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "continuum/equilibrium/boundary_value_problem.h"
#include "continuum/equilibrium/linear_solver.h"

namespace diptych::continuum
{
  struct NewtonOptions
  {
    double tolerance      = 1e-5; // relative to the reaction forces
    int    max_iterations = 20;

    StopRequest stop_requested = {}; // called before every linear solve
  };

  struct NewtonReport
  {
    bool        converged  = false;
    bool        stopped    = false; // on request
    int         iterations = 0;
    double      residual   = 0; // relative residual at the end
    std::string message;        // reason for failure
  };

  // Brings the trial state to equilibrium, starting from the first guess `increment`, which must already contain the platen
  // motion. Stores the solution in `increment` and commits nothing.
  [[nodiscard]] NewtonReport solve_step(BoundaryValueProblem &problem,
                                        LinearSolver         &solver,
                                        const NewtonOptions  &options,
                                        DistributedVector    &increment);
} // namespace diptych::continuum
