// diptych: what the continuum did on its cells between two stages
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "continuum/snapshot.h"

namespace diptych::coupling
{
  // On the cells of the later instant, n_cells entries each; positive in compression.
  struct ContinuumFields
  {
    std::vector<Eigen::Matrix2d> stress;                 // mean of both instants [pressure]
    std::vector<Eigen::Vector2d> couple_stress;          // of the later instant, with the sign of the grains' [pressure * length]
    std::vector<Eigen::Vector2d> displacement_increment; // mean of the corners [length]
    std::vector<double>          rotation_increment;     // Cosserat, anticlockwise [radians]; NaN where the law has none
    std::vector<double>          dissipation;            // plastic work per area in between [pressure]
  };

  // The mesh may have been refined in between: what a cell had before is what the cell of `from` had that holds its centre in
  // the initial shape.
  ContinuumFields continuum_fields(const continuum::Snapshot &from, const continuum::Snapshot &to);
} // namespace diptych::coupling
