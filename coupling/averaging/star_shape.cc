// diptych: a mesh's boundary as seen from one place inside
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/averaging/star_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "coupling/cells/cross_product.h"

namespace diptych::coupling
{
  namespace
  {
    void keep_left(const Eigen::Vector2d &a, const Eigen::Vector2d &b, std::vector<Eigen::Vector2d> &polygon)
    {
      std::vector<Eigen::Vector2d> kept;
      for (std::size_t k = 0; k < polygon.size(); ++k)
        {
          const Eigen::Vector2d &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
          const double           at_p = cross(b - a, p - a), at_q = cross(b - a, q - a);
          if (at_p >= 0)
            kept.push_back(p);
          if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0))
            kept.push_back(p + at_p / (at_p - at_q) * (q - p));
        }
      polygon.swap(kept);
    }

    StarShape seen_from(const Eigen::Vector2d &centre, const QuadMesh &mesh, const std::vector<BoundaryEdge> &boundary)
    {
      StarShape  star{centre, {}, boundary, std::numeric_limits<double>::infinity()};
      double     turn  = 0;
      const auto angle = [&](const BoundaryEdge &edge) {
        const Eigen::Vector2d offset = mesh.node[edge.from] - centre;
        return std::atan2(offset.y(), offset.x());
      };
      for (const auto &edge : boundary)
        {
          const Eigen::Vector2d a = mesh.node[edge.from] - centre, b = mesh.node[edge.to] - centre;
          star.clearance = std::min(star.clearance, cross(a, b) / (b - a).norm());
          turn += std::atan2(cross(a, b), a.dot(b));
        }
      if (std::abs(turn - 2 * M_PI) > 1e-6) // the boundary has holes or separate parts
        star.clearance = 0;
      std::sort(star.edge.begin(), star.edge.end(),
                [&](const BoundaryEdge &a, const BoundaryEdge &b) { return angle(a) < angle(b); });
      for (const auto &edge : star.edge)
        star.angle.push_back(angle(edge));
      return star;
    }
  } // namespace

  std::optional<StarShape> star_shape(const QuadMesh &mesh, const std::vector<BoundaryEdge> &boundary)
  {
    if (boundary.empty())
      return std::nullopt;
    double          area   = 0;
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (unsigned int t = 0; t < mesh.triangle.size(); ++t)
      {
        const auto  &n      = mesh.triangle[t].node;
        const double weight = triangle_area(mesh, t);
        middle += weight / 3 * (mesh.node[n[0]] + mesh.node[n[1]] + mesh.node[n[2]]);
        area += weight;
      }
    const StarShape from_middle = seen_from(middle / area, mesh, boundary);
    if (from_middle.clearance > 0.05 * std::sqrt(area))
      return from_middle;

    Eigen::Vector2d lower = mesh.node[boundary[0].from], upper = lower;
    for (const auto &edge : boundary)
      {
        lower = lower.cwiseMin(mesh.node[edge.from]);
        upper = upper.cwiseMax(mesh.node[edge.from]);
      }
    std::vector<Eigen::Vector2d> kernel = {lower, {upper.x(), lower.y()}, upper, {lower.x(), upper.y()}};
    for (const auto &edge : boundary)
      keep_left(mesh.node[edge.from], mesh.node[edge.to], kernel);
    if (kernel.empty())
      return std::nullopt;
    const Eigen::Vector2d sum         = std::accumulate(kernel.begin(), kernel.end(), Eigen::Vector2d(0, 0));
    const StarShape       from_kernel = seen_from(sum / kernel.size(), mesh, boundary);
    if (from_kernel.clearance > 1e-3 * std::sqrt(area))
      return from_kernel;
    return std::nullopt;
  }

  double gauge(const StarShape &star, const QuadMesh &mesh, const Eigen::Vector2d &point)
  {
    const Eigen::Vector2d offset = point - star.centre;
    if (offset.squaredNorm() < star.clearance * star.clearance)
      return 0;
    const auto            after  = std::upper_bound(star.angle.begin(), star.angle.end(), std::atan2(offset.y(), offset.x()));
    const auto            number = after == star.angle.begin() ? star.edge.size() : std::size_t(after - star.angle.begin());
    const auto           &edge   = star.edge[number - 1];
    const Eigen::Vector2d a = mesh.node[edge.from] - star.centre, b = mesh.node[edge.to] - star.centre;
    return cross(b - a, offset) / cross(b - a, a);
  }
} // namespace diptych::coupling
