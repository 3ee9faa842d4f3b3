// diptych: what the continuum panel shows of its state, positive in compression
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/equilibrium/boundary_value_problem.h"
#include "continuum/equilibrium/driver.h"
#include "continuum/history.h"
#include "continuum/snapshot.h"

namespace diptych::continuum
{
  // How far the loading is, in every sense that it has. Collective.
  struct Progress
  {
    double progress = 0, axial_strain = 0, shear_strain = 0, time = 0;
  };
  Progress progress_of(const BoundaryValueProblem &problem, const Loading &loading);

  // The one place where the sign is turned. Both are collective; the first process gets all, the others nothing of use.
  Snapshot   make_snapshot(const BoundaryValueProblem &problem, const Loading &loading);
  HistoryRow make_history_row(const BoundaryValueProblem &problem, const LoadDriver &driver, const Loading &loading);
} // namespace diptych::continuum
