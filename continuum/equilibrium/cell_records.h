// diptych: state of the sample per cell, for refinement and checkpoints
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "continuum/equilibrium/boundary_value_problem.h"

namespace diptych::continuum
{
  // Motion of the nodes in the accepted steps, from which the next one is extrapolated; on the relevant dofs.
  struct LastMotion
  {
    std::vector<double> increment; // of the last step
    std::vector<double> curvature; // second derivative of the displacement by the progress
  };

  // One row of numbers per cell: refinement level, nodal displacement and last motion (as in Cell::dofs), state of every point.
  // Records do not depend on how cells are distributed over processes.
  using CellRecord = std::vector<double>;

  std::size_t record_length(const ReferenceElement &reference);

  std::vector<CellRecord> make_records(const BoundaryValueProblem &problem, const LastMotion &last);

  struct RestoredState
  {
    CommittedState state;
    LastMotion     last;
  };

  // Reads the records of the present cells, or of their parents if the level of a record is lower. Displacement of a child is
  // interpolated by the parent's shape functions. Point values follow the polynomial through the parent's points, limited to
  // their range. Stress and hardening variable enter the computation; plastic strain is only a record of the past.
  RestoredState read_records(const BoundaryValueProblem &problem, const std::vector<CellRecord> &records, double progress);
} // namespace diptych::continuum
