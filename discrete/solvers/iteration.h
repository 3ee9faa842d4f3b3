// diptych: the loop around the sweeps of any solver
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>

#include "discrete/solvers/solver_options.h"

namespace diptych::discrete
{
  // Operations that a form of the contact problem provides to the loop.
  struct Iteration
  {
    std::function<void()>                                                           refresh; // velocities from the impulses
    std::function<void(double omega_sticking, double omega_slipping, int n_sweeps)> sweep;
    std::function<double()>                  residual;         // natural map relative to |r|, at the present velocities
    std::function<double()>                  velocity_error;   // the same for velocities, called if the residual is small enough
    std::function<bool(const SolveReport &)> good_enough = {}; // a further condition, called last
    std::function<bool()> relieve = {}; // called if the residual stagnates; false: no remedy, so omega is changed
  };

  // Sweeps until the residual, confirmed with fresh velocities, is below options.tolerance and the velocity error below
  // options.velocity_tolerance, or options.max_sweeps are done. A first guess that is good enough costs one residual. For psor,
  // omega depends on the contact status, some sweeps are plain, and stagnation is controlled.
  SolveReport iterate(const SolverOptions &options, const Iteration &iteration);
} // namespace diptych::discrete
