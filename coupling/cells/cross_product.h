// diptych: cross product of two plane vectors
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>

namespace diptych::coupling
{
  // Its out-of-plane component: twice the area of the triangle 0-a-b, positive where b lies anticlockwise of a.
  inline double cross(const Eigen::Vector2d &a, const Eigen::Vector2d &b)
  {
    return a.x() * b.y() - a.y() * b.x();
  }

  // Of the triangle a-b-c, positive where its corners are anticlockwise.
  inline double signed_area(const Eigen::Vector2d &a, const Eigen::Vector2d &b, const Eigen::Vector2d &c)
  {
    return 0.5 * cross(b - a, c - a);
  }
} // namespace diptych::coupling
