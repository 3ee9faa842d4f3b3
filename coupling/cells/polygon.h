// diptych: area, clipping and distances of plane polygons
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace diptych::coupling
{
  double polygon_area(const std::vector<Eigen::Vector2d> &polygon); // positive if counter-clockwise [length^2]

  bool inside_polygon(const Eigen::Vector2d &point, const std::vector<Eigen::Vector2d> &polygon);

  double distance_to_edges(const Eigen::Vector2d &point, const std::vector<Eigen::Vector2d> &polygon); // [length]

  // Visits the corners of a polygon that a line cuts (Sutherland and Hodgman 1974). at(x) is the signed distance to the line
  // times any positive factor. Calls keep(k, at(corner), at(next corner)) for each corner with at(corner) >= 0. Calls cut(k,
  // point, leaves) where the edge from corner k crosses the line.
  template <class At, class Keep, class Cut>
  void cut_polygon(const std::vector<Eigen::Vector2d> &corner, const At &at, const Keep &keep, const Cut &cut)
  {
    for (std::size_t k = 0; k < corner.size(); ++k)
      {
        const Eigen::Vector2d &a = corner[k], &b = corner[(k + 1) % corner.size()];
        const double           here = at(a), there = at(b);
        if (here >= 0)
          keep(k, here, there);
        if ((here > 0 && there < 0) || (here < 0 && there > 0))
          cut(k, Eigen::Vector2d(a + here / (here - there) * (b - a)), here > 0);
      }
  }

  // The part of a polygon to the left of the directed line from + t along. `kept` must not be `polygon`.
  void clip_to_left(const std::vector<Eigen::Vector2d> &polygon,
                    const Eigen::Vector2d              &from,
                    const Eigen::Vector2d              &along,
                    std::vector<Eigen::Vector2d>       &kept);

  // The part of a polygon inside a convex one, both with counter-clockwise corners. The parts of a concave polygon may be joined
  // by edges that enclose no area; the area is exact nevertheless.
  std::vector<Eigen::Vector2d> clipped(const std::vector<Eigen::Vector2d> &polygon, const std::vector<Eigen::Vector2d> &convex);

  // The values t, ascending, at which the line point + t direction first and last meets the edges of the polygon. Empty if the
  // line misses the polygon.
  std::optional<std::array<double, 2>> line_span(const std::vector<Eigen::Vector2d> &polygon,
                                                 const Eigen::Vector2d              &point,
                                                 const Eigen::Vector2d              &direction);

  // Corners of a rectangle, counter-clockwise. `along`: unit vector along the side `length`.
  std::vector<Eigen::Vector2d> rectangle_corners(const Eigen::Vector2d &centre,
                                                 const Eigen::Vector2d &along,
                                                 double                 length,
                                                 double                 thickness);
} // namespace diptych::coupling
