// diptych: cross product of two plane vectors
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>

namespace diptych::coupling
{
  // Out-of-plane component: twice the area of the triangle 0-a-b. It is positive if b lies anticlockwise of a.
  inline double cross(const Eigen::Vector2d &a, const Eigen::Vector2d &b)
  {
    return a.x() * b.y() - a.y() * b.x();
  }

  // Area of the triangle a-b-c, positive if its corners are anticlockwise.
  inline double signed_area(const Eigen::Vector2d &a, const Eigen::Vector2d &b, const Eigen::Vector2d &c)
  {
    return 0.5 * cross(b - a, c - a);
  }
} // namespace diptych::coupling
