// diptych: what an earlier mesh had at the nodes and cells of a later, refined one
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "continuum/snapshot.h"

namespace diptych::coupling
{
  // Displacement since the start [length] at the instant `from`, one entry for each node of `to`. Where the meshes are the same
  // the nodes' own; else the biquadratic field of the cells of `from` at the initial place of each node of `to`, which is exact
  // where cells were divided in between. Throws std::invalid_argument for a node that lies in no cell of `from`.
  std::vector<Eigen::Vector2d> displacement_at_nodes_of(const continuum::Snapshot &from, const continuum::Snapshot &to);

  // The same for the rotation [radians]. Both snapshots must have one.
  std::vector<double> rotation_at_nodes_of(const continuum::Snapshot &from, const continuum::Snapshot &to);

  // The cell of `from` that holds the initial centre of each cell of `to`: itself or what it was divided from.
  std::vector<unsigned int> cells_of(const continuum::Snapshot &from, const continuum::Snapshot &to);
} // namespace diptych::coupling
