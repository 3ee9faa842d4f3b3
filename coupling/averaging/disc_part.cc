// diptych: area and first moment of the part of a disc inside a polygon
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/averaging/disc_part.h"

#include <algorithm>
#include <cmath>

#include "coupling/cells/cross_product.h"

namespace diptych::coupling
{
  namespace
  {
    // The sector from the direction of a to that of b. Moment: integral of r^2 (cos, sin) dr dtheta = r^3/3 [(sin, -cos)].
    void add_sector(const double radius, const Eigen::Vector2d &a, const Eigen::Vector2d &b, DiscPart &part)
    {
      const Eigen::Vector2d u = a.normalized(), v = b.normalized();
      part.area += 0.5 * radius * radius * std::atan2(cross(u, v), u.dot(v));
      part.moment += radius * radius * radius / 3 * Eigen::Vector2d(v.y() - u.y(), u.x() - v.x());
    }

    void add_triangle(const Eigen::Vector2d &a, const Eigen::Vector2d &b, DiscPart &part)
    {
      const double area = 0.5 * cross(a, b);
      part.area += area;
      part.moment += area / 3 * (a + b);
    }

    // The signed part of the disc about the origin inside the triangle origin-a-b.
    void add_side(const double radius, const Eigen::Vector2d &a, const Eigen::Vector2d &b, DiscPart &part)
    {
      // |a + t (b - a)|^2 = radius^2
      const Eigen::Vector2d d            = b - a;
      const double          half_linear  = a.dot(d);
      const double          quadratic    = d.squaredNorm();
      const double          discriminant = half_linear * half_linear - quadratic * (a.squaredNorm() - radius * radius);
      if (!(discriminant > 0))
        return add_sector(radius, a, b, part);
      const double root = std::sqrt(discriminant);
      const double from = std::max((-half_linear - root) / quadratic, 0.);
      const double to   = std::min((-half_linear + root) / quadratic, 1.);
      if (from >= to)
        return add_sector(radius, a, b, part);
      const Eigen::Vector2d enter = a + from * d, leave = a + to * d;
      if (from > 0)
        add_sector(radius, a, enter, part);
      add_triangle(enter, leave, part);
      if (to < 1)
        add_sector(radius, leave, b, part);
    }
  } // namespace

  DiscPart disc_part(const Eigen::Vector2d &centre, const double radius, const std::vector<Eigen::Vector2d> &polygon)
  {
    DiscPart part;
    for (std::size_t k = 0; k < polygon.size(); ++k)
      add_side(radius, polygon[k] - centre, polygon[(k + 1) % polygon.size()] - centre, part);
    return part;
  }
} // namespace diptych::coupling
