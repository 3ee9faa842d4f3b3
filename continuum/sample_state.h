// diptych: what the continuum panel shows of its state, positive in compression
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/boundary_value_problem.h"
#include "continuum/driver.h"
#include "continuum/panel.h"

namespace diptych::continuum
{
  // Committed state of the problem. The one place where the mechanics sign of the material points is turned round.
  Snapshot make_snapshot(const BoundaryValueProblem &problem);

  // Committed state as a line of the history, with the driver's counters.
  HistoryRow make_history_row(const BoundaryValueProblem &problem, const LoadDriver &driver);
} // namespace diptych::continuum
