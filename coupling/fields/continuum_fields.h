// diptych: the continuum's fields between two stages
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "continuum/snapshot.h"

namespace diptych::coupling
{
  // Fields on the cells of the later instant, n_cells entries each, positive in compression.
  struct ContinuumFields
  {
    std::vector<Eigen::Matrix2d> stress;                 // mean of both instants [pressure]
    std::vector<Eigen::Vector2d> couple_stress;          // at the later instant, with the sign of the grains' couple stress
                                                         // [pressure * length]
    std::vector<Eigen::Vector2d> displacement_increment; // mean of the corners [length]
    std::vector<double>          rotation_increment;     // Cosserat rotation, anticlockwise [radians]; NaN if the law has none
    std::vector<double>          dissipation;            // plastic work per area between the instants [pressure]
    std::vector<double>          volume_ratio;           // initial area over the area at the later instant [-]
  };

  // The mesh may be refined between the instants. The earlier values of a cell are those of the cell of `from` that holds its
  // centre in the initial shape.
  ContinuumFields continuum_fields(const continuum::Snapshot &from, const continuum::Snapshot &to);
} // namespace diptych::coupling
