// diptych: state of the continuum panel for output, positive in compression
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/equilibrium/boundary_value_problem.h"
#include "continuum/equilibrium/driver.h"
#include "continuum/history.h"
#include "continuum/snapshot.h"

namespace diptych::continuum
{
  // Only these two functions convert the sign. Both are collective; only the result on the first process is valid.
  Snapshot   make_snapshot(const BoundaryValueProblem &problem, const Loading &loading);
  HistoryRow make_history_row(const BoundaryValueProblem &problem, const LoadDriver &driver, const Loading &loading);
} // namespace diptych::continuum
