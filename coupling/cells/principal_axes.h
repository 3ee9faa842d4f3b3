// diptych: principal axes of a plane tensor, and angles between lines
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>

#include <Eigen/Core>

namespace diptych::coupling
{
  inline constexpr double degree = M_PI / 180; // [rad]

  // Angle of the major axis of the symmetric part from the horizontal, in (-90, 90] [degrees].
  inline double major_direction(const Eigen::Matrix2d &t)
  {
    const double angle = 0.5 * std::atan2(t(0, 1) + t(1, 0), t(0, 0) - t(1, 1)) * 180 / M_PI;
    return angle <= -90 ? angle + 180 : angle;
  }

  // Major minus minor principal value of the symmetric part, >= 0.
  inline double principal_difference(const Eigen::Matrix2d &t)
  {
    return std::hypot(t(0, 0) - t(1, 1), t(0, 1) + t(1, 0));
  }

  // Anticlockwise rotation from line b to line a, in (-90, 90] [degrees]. A line has no direction, so the period is 180 degrees.
  inline double line_turn(const double a_deg, const double b_deg)
  {
    const double turn = std::remainder(a_deg - b_deg, 180.);
    return turn <= -90 ? turn + 180 : turn;
  }
} // namespace diptych::coupling
