// diptych: area and first moment of the part of a disc inside a polygon
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

namespace diptych::coupling
{
  struct DiscPart
  {
    double          area   = 0;                       // [length^2]
    Eigen::Vector2d moment = Eigen::Vector2d::Zero(); // integral of x - centre over the part [length^3]
  };

  // Exact for a simple polygon with counter-clockwise corners: sums signed sectors and triangles about the centre, one per side.
  DiscPart disc_part(const Eigen::Vector2d &centre, double radius, const std::vector<Eigen::Vector2d> &polygon);
} // namespace diptych::coupling
