// diptych: what the continuum panel shows of its state, positive in compression
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/boundary_value_problem.h"
#include "continuum/driver.h"
#include "continuum/snapshot.h"

namespace diptych::continuum
{
  // The one place where the sign is turned. Both are collective; the first process gets all, the others nothing of use.
  Snapshot   make_snapshot(const BoundaryValueProblem &problem);
  HistoryRow make_history_row(const BoundaryValueProblem &problem, const LoadDriver &driver);
} // namespace diptych::continuum
