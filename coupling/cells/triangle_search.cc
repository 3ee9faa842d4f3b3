// diptych: finds the triangle that holds a point, and the triangles that a segment crosses
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/cells/triangle_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "coupling/cells/cross_product.h"

namespace diptych::coupling
{
  namespace
  {
    constexpr double edge_tolerance = 1e-12; // times an edge's length: points closer than this are on the edge

    bool contains(const std::array<Eigen::Vector2d, 3> &corner, const Eigen::Vector2d &point)
    {
      for (unsigned int k = 0; k < 3; ++k)
        {
          const Eigen::Vector2d edge = corner[(k + 1) % 3] - corner[k];
          if (cross(edge, point - corner[k]) < -edge_tolerance * edge.squaredNorm())
            return false;
        }
      return true;
    }

    // Part of a-b inside a triangle; first >= second if there is none. An edge cuts the segment exactly where it crosses it. A
    // segment within the tolerance of an edge, such as one along the mesh's boundary, is not cut by this edge.
    std::pair<double, double> clip(const std::array<Eigen::Vector2d, 3> &corner,
                                   const Eigen::Vector2d                &a,
                                   const Eigen::Vector2d                &b)
    {
      constexpr std::pair<double, double> nothing(1, 0);
      double                              from = 0, to = 1;
      for (unsigned int k = 0; k < 3; ++k)
        {
          const Eigen::Vector2d edge   = corner[(k + 1) % 3] - corner[k];
          const double          margin = edge_tolerance * edge.squaredNorm();
          const double          at_a = cross(edge, a - corner[k]), at_b = cross(edge, b - corner[k]);
          if (at_a < -margin)
            {
              if (at_b <= 0)
                return nothing;
              from = std::max(from, at_a / (at_a - at_b));
            }
          else if (at_b < -margin)
            {
              if (at_a <= 0)
                return nothing;
              to = std::min(to, at_a / (at_a - at_b));
            }
        }
      return {from, to};
    }

    bool strictly_contains(const std::array<Eigen::Vector2d, 3> &corner, const Eigen::Vector2d &point)
    {
      for (unsigned int k = 0; k < 3; ++k)
        {
          const Eigen::Vector2d edge = corner[(k + 1) % 3] - corner[k];
          if (cross(edge, point - corner[k]) < edge_tolerance * edge.squaredNorm())
            return false;
        }
      return true;
    }

    double squared_distance(const Eigen::Vector2d &point, const Eigen::Vector2d &from, const Eigen::Vector2d &to)
    {
      const Eigen::Vector2d edge = to - from;
      const double          t    = std::clamp((point - from).dot(edge) / edge.squaredNorm(), 0., 1.);
      return (from + t * edge - point).squaredNorm();
    }
  } // namespace

  TriangleSearch::TriangleSearch(const QuadMesh &mesh)
  {
    if (mesh.triangle.empty())
      throw std::invalid_argument("a mesh without triangles cannot receive grain quantities");

    Eigen::Vector2d lower = mesh.node[mesh.triangle[0].node[0]], upper = lower;
    double          total_area = 0;
    for (unsigned int t = 0; t < mesh.triangle.size(); ++t)
      {
        const auto   n = triangle_nodes(mesh, t);
        Triangle     triangle{{{mesh.node[n[0]], mesh.node[n[1]], mesh.node[n[2]]}}, {}, {}};
        const double size = triangle_area(mesh, t);
        if (!(size > 0))
          throw std::invalid_argument("cell " + std::to_string(mesh.triangle[t].cell) + " has a triangle without positive area");
        total_area += size;

        triangle.lower = triangle.corner[0].cwiseMin(triangle.corner[1]).cwiseMin(triangle.corner[2]);
        triangle.upper = triangle.corner[0].cwiseMax(triangle.corner[1]).cwiseMax(triangle.corner[2]);
        // A point within the edge tolerance must still lie inside the box.
        const Eigen::Vector2d margin = Eigen::Vector2d::Constant(1e-9 * (triangle.upper - triangle.lower).sum());
        triangle.lower -= margin;
        triangle.upper += margin;
        lower = lower.cwiseMin(triangle.lower);
        upper = upper.cwiseMax(triangle.upper);
        triangles.push_back(triangle);
      }

    boundary = boundary_edges(mesh);
    for (const auto &edge : boundary)
      boundary_ends.push_back({{mesh.node[edge.from], mesh.node[edge.to]}});

    // The bins are about half a cell wide, so that a branch of one diameter meets few triangles.
    bins = BinGrid(lower, upper, std::sqrt(total_area / mesh.triangle.size()));
    bins.sort(triangles.size(), [&](const unsigned int t, const auto &into) {
      const BinRange range = bins.range(triangles[t].lower, triangles[t].upper);
      for (int row = range.row_begin; row < range.row_end; ++row)
        for (int column = range.column_begin; column < range.column_end; ++column)
          into(bins.number(row, column));
    });
  }

  TriangleSearch::Place TriangleSearch::locate(const Eigen::Vector2d &point) const
  {
    const BinRange range = bins.range(point, point);
    if (range.column_begin < range.column_end && range.row_begin < range.row_end)
      {
        const std::size_t bin = bins.number(range.row_begin, range.column_begin);
        for (unsigned int k = bins.begins(bin); k < bins.begins(bin + 1); ++k) // ascending
          if (contains(triangles[bins.sorted()[k]].corner, point))
            return {bins.sorted()[k], true};
      }
    return {nearest_boundary_triangle(point), false};
  }

  unsigned int TriangleSearch::nearest_boundary_triangle(const Eigen::Vector2d &point) const
  {
    double       nearest  = std::numeric_limits<double>::infinity();
    unsigned int triangle = boundary.front().triangle;
    for (std::size_t e = 0; e < boundary.size(); ++e)
      {
        const double distance = squared_distance(point, boundary_ends[e][0], boundary_ends[e][1]);
        if (distance < nearest)
          {
            nearest  = distance;
            triangle = boundary[e].triangle;
          }
      }
    return triangle;
  }

  void TriangleSearch::cut(const Eigen::Vector2d &a, const Eigen::Vector2d &b, std::vector<Piece> &pieces) const
  {
    pieces.clear();
    static thread_local std::vector<double> cuts; // allocated once per thread, because this is called for every contact
    cuts.clear();

    const Eigen::Vector2d lower = a.cwiseMin(b), upper = a.cwiseMax(b);
    const BinRange        range = bins.range(lower, upper);
    for (int row = range.row_begin; row < range.row_end; ++row)
      for (int column = range.column_begin; column < range.column_end; ++column)
        {
          const std::size_t bin = bins.number(row, column);
          for (unsigned int k = bins.begins(bin); k < bins.begins(bin + 1); ++k)
            {
              const Triangle &triangle = triangles[bins.sorted()[k]];
              if ((triangle.lower.array() > upper.array()).any() || (triangle.upper.array() < lower.array()).any())
                continue;
              const auto [from, to] = clip(triangle.corner, a, b);
              if (from == 0 && to == 1 && strictly_contains(triangle.corner, a))
                {
                  pieces.push_back({bins.sorted()[k], 0, 1, true});
                  return;
                }
              if (from < to)
                {
                  cuts.push_back(from);
                  cuts.push_back(to);
                }
            }
        }
    cuts.push_back(1.);
    std::sort(cuts.begin(), cuts.end());

    constexpr double shortest = 1e-13; // rounding makes the cuts of one edge differ between its two triangles
    double           from     = 0;
    for (const double cut : cuts)
      {
        if (cut - from < shortest)
          continue;
        const double to    = 1 - cut < shortest ? 1 : cut;
        const Place  place = locate(a + 0.5 * (from + to) * (b - a));
        if (!pieces.empty() && pieces.back().triangle == place.triangle && pieces.back().inside == place.inside)
          pieces.back().to = to;
        else
          pieces.push_back({place.triangle, from, to, place.inside});
        from = to;
      }
  }

  void TriangleSearch::triangles_in_box(const Eigen::Vector2d     &lower,
                                        const Eigen::Vector2d     &upper,
                                        std::vector<unsigned int> &found) const
  {
    found.clear();
    bins.for_each_in(bins.range(lower, upper), [&](const unsigned int t) {
      const Triangle &triangle = triangles[t];
      if ((triangle.lower.array() <= upper.array()).all() && (triangle.upper.array() >= lower.array()).all())
        found.push_back(t);
    });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
  }

  std::vector<unsigned int> TriangleSearch::in_spatial_order(const std::vector<Eigen::Vector2d> &points) const
  {
    BinGrid ordered = bins;
    ordered.sort(points.size(), [&](const unsigned int k, const auto &into) {
      const BinRange range = bins.range(points[k], points[k]); // empty outside the grid
      into(bins.number(std::min(range.row_begin, bins.n_rows() - 1), std::min(range.column_begin, bins.n_columns() - 1)));
    });
    return ordered.sorted();
  }
} // namespace diptych::coupling
