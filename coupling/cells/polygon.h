// diptych: plane polygons: area, inside, distance, the part within a convex one
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace diptych::coupling
{
  double polygon_area(const std::vector<Eigen::Vector2d> &polygon); // positive where counter-clockwise [length^2]

  bool inside_polygon(const Eigen::Vector2d &point, const std::vector<Eigen::Vector2d> &polygon);

  double distance_to_edges(const Eigen::Vector2d &point, const std::vector<Eigen::Vector2d> &polygon); // [length]

  // What of a polygon lies in a convex one, corners of both counter-clockwise (Sutherland and Hodgman 1974). Of a concave
  // polygon the parts may hang together by edges of no area: its area is exact all the same.
  std::vector<Eigen::Vector2d> clipped(const std::vector<Eigen::Vector2d> &polygon, const std::vector<Eigen::Vector2d> &convex);

  // Where the line point + t direction first and last meets the polygon's edges: t of both, ascending; none where it misses.
  std::optional<std::array<double, 2>> line_span(const std::vector<Eigen::Vector2d> &polygon,
                                                 const Eigen::Vector2d              &point,
                                                 const Eigen::Vector2d              &direction);

  // Corners of a rectangle, counter-clockwise. along: unit vector of the side `length`.
  std::vector<Eigen::Vector2d> rectangle_corners(const Eigen::Vector2d &centre,
                                                 const Eigen::Vector2d &along,
                                                 double                 length,
                                                 double                 thickness);
} // namespace diptych::coupling
