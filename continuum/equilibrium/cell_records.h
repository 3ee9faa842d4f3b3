// diptych: the state of the sample cell by cell, as refinement and checkpoints carry it
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "continuum/equilibrium/boundary_value_problem.h"

namespace diptych::continuum
{
  // One row of numbers: the cell's level of refinement, its nodal values of displacement and of the last increment (in the
  // order of Cell::dofs), then every point's state. Independent of how cells are spread over processes.
  using CellRecord = std::vector<double>;

  std::size_t record_length(const ReferenceElement &reference);

  // One record per locally owned cell. `last_increment` on the relevant dofs.
  std::vector<CellRecord> make_records(const BoundaryValueProblem &problem, const std::vector<double> &last_increment);

  struct RestoredState
  {
    CommittedState      state;
    std::vector<double> last_increment; // relevant dofs
  };

  // The records of the present cells, or of their parents where the level tells so: then displacement is interpolated by the
  // parent's shape functions, and the points by the polynomial through the parent's points, held within their range. Stress
  // and hardening variable are carried; plastic strain only as a record of the past.
  RestoredState read_records(const BoundaryValueProblem &problem, const std::vector<CellRecord> &records, double progress);
} // namespace diptych::continuum
