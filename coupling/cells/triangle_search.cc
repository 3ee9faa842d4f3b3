// diptych: which triangle of a mesh holds a point, and which ones a segment runs through
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
    constexpr double edge_tolerance = 1e-12; // of an edge's length: points closer to it count as on it

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

    // Part of a-b inside a triangle: first >= second where there is none. An edge cuts exactly where it is crossed; a segment
    // that keeps within the tolerance of it, as one along the mesh's boundary does, is not cut.
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
        // so that a point within the edge tolerance is still inside the box
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

    // bins of about half a cell: a branch of one diameter then meets few triangles
    bin_size  = std::sqrt(total_area / mesh.triangle.size());
    origin    = lower;
    n_columns = 1 + static_cast<int>((upper.x() - lower.x()) / bin_size);
    n_rows    = 1 + static_cast<int>((upper.y() - lower.y()) / bin_size);

    bin_begin.assign(static_cast<std::size_t>(n_columns) * n_rows + 1, 0);
    const auto for_each_bin = [&](const Triangle &triangle, const auto &action) {
      const BinRange range = bins(triangle.lower, triangle.upper);
      for (int row = range.row_begin; row < range.row_end; ++row)
        for (int column = range.column_begin; column < range.column_end; ++column)
          action(row * n_columns + column);
    };
    for (const auto &triangle : triangles)
      for_each_bin(triangle, [&](const int bin) { ++bin_begin[bin + 1]; });
    for (std::size_t b = 1; b < bin_begin.size(); ++b)
      bin_begin[b] += bin_begin[b - 1];
    bin_triangle.resize(bin_begin.back());
    std::vector<unsigned int> next(bin_begin.begin(), bin_begin.end() - 1);
    for (unsigned int t = 0; t < triangles.size(); ++t)
      for_each_bin(triangles[t], [&](const int bin) { bin_triangle[next[bin]++] = t; });
  }

  TriangleSearch::BinRange TriangleSearch::bins(const Eigen::Vector2d &lower, const Eigen::Vector2d &upper) const
  {
    // clamped before the conversion: far points and NaN must not overflow an int
    const auto index = [this](const double distance, const int n) {
      return static_cast<int>(std::min(std::max(std::floor(distance / bin_size), -1.), double(n)));
    };
    return {std::max(0, index(lower.x() - origin.x(), n_columns)),
            std::min(n_columns, 1 + index(upper.x() - origin.x(), n_columns)), std::max(0, index(lower.y() - origin.y(), n_rows)),
            std::min(n_rows, 1 + index(upper.y() - origin.y(), n_rows))};
  }

  TriangleSearch::Place TriangleSearch::locate(const Eigen::Vector2d &point) const
  {
    const BinRange range = bins(point, point);
    if (range.column_begin < range.column_end && range.row_begin < range.row_end)
      {
        const std::size_t bin = static_cast<std::size_t>(range.row_begin) * n_columns + range.column_begin;
        for (unsigned int k = bin_begin[bin]; k < bin_begin[bin + 1]; ++k) // ascending
          if (contains(triangles[bin_triangle[k]].corner, point))
            return {bin_triangle[k], true};
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
    static thread_local std::vector<double> cuts; // one allocation a thread: this is called for every contact
    cuts.clear();

    const Eigen::Vector2d lower = a.cwiseMin(b), upper = a.cwiseMax(b);
    const BinRange        range = bins(lower, upper);
    for (int row = range.row_begin; row < range.row_end; ++row)
      for (int column = range.column_begin; column < range.column_end; ++column)
        {
          const std::size_t bin = static_cast<std::size_t>(row) * n_columns + column;
          for (unsigned int k = bin_begin[bin]; k < bin_begin[bin + 1]; ++k)
            {
              const Triangle &triangle = triangles[bin_triangle[k]];
              if ((triangle.lower.array() > upper.array()).any() || (triangle.upper.array() < lower.array()).any())
                continue;
              const auto [from, to] = clip(triangle.corner, a, b);
              if (from == 0 && to == 1 && strictly_contains(triangle.corner, a))
                {
                  pieces.push_back({bin_triangle[k], 0, 1, true});
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

    constexpr double shortest = 1e-13; // cuts of one edge seen from its two sides differ by rounding
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
    const BinRange range = bins(lower, upper);
    for (int row = range.row_begin; row < range.row_end; ++row)
      for (int column = range.column_begin; column < range.column_end; ++column)
        {
          const std::size_t bin = static_cast<std::size_t>(row) * n_columns + column;
          for (unsigned int k = bin_begin[bin]; k < bin_begin[bin + 1]; ++k)
            {
              const Triangle &triangle = triangles[bin_triangle[k]];
              if ((triangle.lower.array() <= upper.array()).all() && (triangle.upper.array() >= lower.array()).all())
                found.push_back(bin_triangle[k]);
            }
        }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
  }

  std::vector<unsigned int> TriangleSearch::in_spatial_order(const std::vector<Eigen::Vector2d> &points) const
  {
    std::vector<unsigned int> bin, begin(bin_begin.size(), 0), order(points.size());
    for (const Eigen::Vector2d &x : points)
      {
        const BinRange range  = bins(x, x); // empty outside of the grid
        const int      column = std::min(range.column_begin, n_columns - 1), row = std::min(range.row_begin, n_rows - 1);
        bin.push_back(static_cast<unsigned int>(row) * n_columns + column);
        ++begin[bin.back() + 1];
      }
    for (std::size_t b = 1; b < begin.size(); ++b)
      begin[b] += begin[b - 1];
    for (unsigned int k = 0; k < points.size(); ++k)
      order[begin[bin[k]]++] = k;
    return order;
  }
} // namespace diptych::coupling
