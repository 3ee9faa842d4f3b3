// diptych: the loop around the sweeps of any solver
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>

#include "discrete/solvers/solver_options.h"

namespace diptych::discrete
{
  // What a form of the contact problem offers to the loop.
  struct Iteration
  {
    std::function<void()>                                                           refresh; // velocities from the impulses
    std::function<void(double omega_sticking, double omega_slipping, int n_sweeps)> sweep;
    std::function<double()>                  residual;         // natural map relative to |r|, at the present velocities
    std::function<bool(const SolveReport &)> good_enough = {}; // a further condition, asked where the residual is small enough
    std::function<bool()> relieve = {}; // asked where the residual stagnates; false: it knows no remedy, and omega is changed
  };

  // Sweeps until the residual, confirmed with fresh velocities, is below options.tolerance or options.max_sweeps are done; a
  // first guess that is already good costs one residual. For psor: omega by contact status, plain sweeps now and then, stagnation
  // control.
  SolveReport iterate(const SolverOptions &options, const Iteration &iteration);
} // namespace diptych::discrete
