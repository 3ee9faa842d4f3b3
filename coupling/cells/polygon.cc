// diptych: area, clipping and distances of plane polygons
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/cells/polygon.h"

#include <algorithm>
#include <cmath>

#include "coupling/cells/cross_product.h"

namespace diptych::coupling
{
  double polygon_area(const std::vector<Eigen::Vector2d> &polygon)
  {
    double area = 0; // the terms are taken about the first corner: far from the origin they would cancel
    for (std::size_t k = 2; k < polygon.size(); ++k)
      area += 0.5 * cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
    return area;
  }

  bool inside_polygon(const Eigen::Vector2d &point, const std::vector<Eigen::Vector2d> &polygon)
  {
    bool inside = false; // a ray to the right crosses an odd number of edges
    for (std::size_t k = 0; k < polygon.size(); ++k)
      {
        const Eigen::Vector2d &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        if ((a.y() > point.y()) != (b.y() > point.y()) &&
            point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
          inside = !inside;
      }
    return inside;
  }

  double distance_to_edges(const Eigen::Vector2d &point, const std::vector<Eigen::Vector2d> &polygon)
  {
    double nearest = INFINITY;
    for (std::size_t k = 0; k < polygon.size(); ++k)
      {
        const Eigen::Vector2d &a = polygon[k], edge = polygon[(k + 1) % polygon.size()] - a;
        const double           size = edge.squaredNorm();
        const double           t    = size > 0 ? std::clamp((point - a).dot(edge) / size, 0., 1.) : 0;
        nearest                     = std::min(nearest, (a + t * edge - point).norm());
      }
    return nearest;
  }

  void clip_to_left(const std::vector<Eigen::Vector2d> &polygon,
                    const Eigen::Vector2d              &from,
                    const Eigen::Vector2d              &along,
                    std::vector<Eigen::Vector2d>       &kept)
  {
    kept.clear();
    cut_polygon(
      polygon, [&](const Eigen::Vector2d &x) { return cross(along, x - from); },
      [&](const std::size_t k, double, double) { kept.push_back(polygon[k]); },
      [&](std::size_t, const Eigen::Vector2d &point, bool) { kept.push_back(point); });
  }

  std::vector<Eigen::Vector2d> clipped(const std::vector<Eigen::Vector2d> &polygon, const std::vector<Eigen::Vector2d> &convex)
  {
    std::vector<Eigen::Vector2d> rest = polygon, kept;
    for (std::size_t edge = 0; edge < convex.size() && !rest.empty(); ++edge)
      {
        clip_to_left(rest, convex[edge], convex[(edge + 1) % convex.size()] - convex[edge], kept);
        rest.swap(kept);
      }
    return rest;
  }

  std::optional<std::array<double, 2>> line_span(const std::vector<Eigen::Vector2d> &polygon,
                                                 const Eigen::Vector2d              &point,
                                                 const Eigen::Vector2d              &direction)
  {
    double first = INFINITY, last = -INFINITY;
    for (std::size_t k = 0; k < polygon.size(); ++k)
      {
        const Eigen::Vector2d a = polygon[k] - point, b = polygon[(k + 1) % polygon.size()] - point;
        const double          above_a = cross(direction, a), above_b = cross(direction, b);
        if ((above_a < 0) == (above_b < 0))
          continue;
        const double t = (a + above_a / (above_a - above_b) * (b - a)).dot(direction) / direction.squaredNorm();
        first          = std::min(first, t);
        last           = std::max(last, t);
      }
    if (!(first < last))
      return std::nullopt;
    return std::array<double, 2>{{first, last}};
  }

  std::vector<Eigen::Vector2d> rectangle_corners(const Eigen::Vector2d &centre,
                                                 const Eigen::Vector2d &along,
                                                 const double           length,
                                                 const double           thickness)
  {
    const Eigen::Vector2d a = 0.5 * length * along;
    const Eigen::Vector2d b = 0.5 * thickness * Eigen::Vector2d(-along.y(), along.x());
    return {centre - a - b, centre + a - b, centre + a + b, centre - a + b};
  }
} // namespace diptych::coupling
