// diptych: the strip covered by a band's 10-90 % width
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "coupling/bands/band.h"
#include "coupling/cells/polygon.h"

namespace diptych::coupling
{
  // Points x with |(x - on_band).normal| <= half_thickness.
  struct BandZone
  {
    Eigen::Vector2d on_band;            // a point of the band's centre line [length]
    double          angle_deg      = 0; // angle of the band from the horizontal
    double          half_thickness = 0; // half the 10-90 % width [length]

    Eigen::Vector2d along() const { return {std::cos(angle_deg * M_PI / 180), std::sin(angle_deg * M_PI / 180)}; }
    Eigen::Vector2d normal() const { return {-along().y(), along().x()}; }
    bool            holds(const Eigen::Vector2d &x) const { return std::abs((x - on_band).dot(normal())) <= half_thickness; }

    // The strip as a rectangle that extends 2 * reach to either side of on_band.
    std::vector<Eigen::Vector2d> rectangle(const double reach) const
    {
      return rectangle_corners(on_band, along(), 4 * reach, 2 * half_thickness);
    }
  };

  inline BandZone band_zone(const SampleFrame &frame, const Band &band)
  {
    return {frame.centre + band.offset * band.normal(), band.angle_deg, 0.5 * band.width_10_90};
  }
} // namespace diptych::coupling
