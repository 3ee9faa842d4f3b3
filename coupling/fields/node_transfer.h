// diptych: values of an earlier mesh at the nodes and cells of a later, refined mesh
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "continuum/snapshot.h"

namespace diptych::coupling
{
  // Displacement since the start [length] at the instant `from`, one entry for each node of `to`. If the meshes differ, the
  // biquadratic field of `from` is evaluated at the node's initial place: exact for divided cells. Throws std::invalid_argument
  // if a node lies in no cell of `from`.
  std::vector<Eigen::Vector2d> displacement_at_nodes_of(const continuum::Snapshot &from, const continuum::Snapshot &to);

  // Rotation [radians] at the instant `from`, transferred like the displacement. Both snapshots must have rotations.
  std::vector<double> rotation_at_nodes_of(const continuum::Snapshot &from, const continuum::Snapshot &to);

  // For each cell of `to`, the cell of `from` that holds its initial centre: itself, or the cell that was divided.
  std::vector<unsigned int> cells_of(const continuum::Snapshot &from, const continuum::Snapshot &to);
} // namespace diptych::coupling
