// diptych: the cells that grain quantities are mapped onto: areas, point location, cutting of segments
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/mesh_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace diptych::coupling
{
  namespace
  {
    constexpr double edge_tolerance = 1e-12; // of an edge's length: points closer to it count as on it

    double cross(const Eigen::Vector2d &a, const Eigen::Vector2d &b)
    {
      return a.x() * b.y() - a.y() * b.x();
    }

    double area(const Eigen::Vector2d &a, const Eigen::Vector2d &b, const Eigen::Vector2d &c)
    {
      return 0.5 * cross(b - a, c - a);
    }

    // The corners of a cell whose diagonal 0-2 lies inside it.
    std::array<unsigned int, 4> with_inner_diagonal(const std::vector<Eigen::Vector2d> &x,
                                                    const std::array<unsigned int, 4>  &c,
                                                    const std::size_t                   number)
    {
      for (const unsigned int shift : {0u, 1u})
        {
          const std::array<unsigned int, 4> turned = {{c[shift], c[shift + 1], c[(shift + 2) % 4], c[(shift + 3) % 4]}};
          if (area(x[turned[0]], x[turned[1]], x[turned[2]]) > 0 && area(x[turned[0]], x[turned[2]], x[turned[3]]) > 0)
            return turned;
        }
      throw std::runtime_error("cell " + std::to_string(number) + " of the deformed mesh is turned inside out");
    }

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

  QuadMesh quad_mesh(const continuum::Snapshot &snapshot)
  {
    constexpr unsigned int    unseen = std::numeric_limits<unsigned int>::max();
    std::vector<unsigned int> number(snapshot.position.size(), unseen);

    QuadMesh mesh;
    for (const auto &cell : snapshot.cells)
      {
        std::array<unsigned int, 4> corner;
        for (unsigned int k = 0; k < 4; ++k)
          {
            if (number.at(cell[k]) == unseen)
              {
                number[cell[k]] = mesh.node.size();
                mesh.node.push_back(snapshot.position[cell[k]]);
              }
            corner[k] = number[cell[k]];
          }
        mesh.cell.push_back(with_inner_diagonal(mesh.node, corner, mesh.cell.size()));
      }
    return mesh;
  }

  std::array<unsigned int, 3> triangle_nodes(const QuadMesh &mesh, const unsigned int triangle)
  {
    const auto &c = mesh.cell[triangle / 2];
    return triangle % 2 == 0 ? std::array<unsigned int, 3>{{c[0], c[1], c[2]}} : std::array<unsigned int, 3>{{c[0], c[2], c[3]}};
  }

  double triangle_area(const QuadMesh &mesh, const unsigned int triangle)
  {
    const auto n = triangle_nodes(mesh, triangle);
    return area(mesh.node[n[0]], mesh.node[n[1]], mesh.node[n[2]]);
  }

  Eigen::Vector2d cell_centre(const QuadMesh &mesh, const unsigned int cell)
  {
    const auto &c = mesh.cell[cell];
    return 0.25 * (mesh.node[c[0]] + mesh.node[c[1]] + mesh.node[c[2]] + mesh.node[c[3]]);
  }

  std::vector<double> cell_areas(const QuadMesh &mesh)
  {
    std::vector<double> areas(mesh.cell.size());
    for (unsigned int c = 0; c < areas.size(); ++c)
      areas[c] = triangle_area(mesh, 2 * c) + triangle_area(mesh, 2 * c + 1);
    return areas;
  }

  // grad N_a is normal to the edge opposite corner a, with length edge / (2 area).
  Eigen::Matrix<double, 2, 3> shape_gradients(const QuadMesh &mesh, const unsigned int triangle)
  {
    const auto                  n          = triangle_nodes(mesh, triangle);
    const double                twice_area = 2 * triangle_area(mesh, triangle);
    Eigen::Matrix<double, 2, 3> gradients;
    for (unsigned int k = 0; k < 3; ++k)
      {
        const Eigen::Vector2d opposite = mesh.node[n[(k + 2) % 3]] - mesh.node[n[(k + 1) % 3]];
        gradients.col(k)               = Eigen::Vector2d(-opposite.y(), opposite.x()) / twice_area;
      }
    return gradients;
  }

  TriangleSearch::TriangleSearch(const QuadMesh &mesh)
  {
    if (mesh.cell.empty())
      throw std::invalid_argument("a mesh without cells cannot receive grain quantities");

    struct Edge
    {
      unsigned int low, high, triangle, corner;
    };
    std::vector<Edge> edges;
    Eigen::Vector2d   lower = mesh.node[mesh.cell[0][0]], upper = lower;
    double            total_area = 0;
    for (unsigned int t = 0; t < 2 * mesh.cell.size(); ++t)
      {
        const auto   n = triangle_nodes(mesh, t);
        Triangle     triangle{{{mesh.node[n[0]], mesh.node[n[1]], mesh.node[n[2]]}}, {}, {}};
        const double size = triangle_area(mesh, t);
        if (!(size > 0))
          throw std::invalid_argument("cell " + std::to_string(t / 2) + " has a triangle without positive area");
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
        for (unsigned int k = 0; k < 3; ++k)
          edges.push_back({std::min(n[k], n[(k + 1) % 3]), std::max(n[k], n[(k + 1) % 3]), t, k});
      }

    std::sort(edges.begin(), edges.end(), [](const Edge &a, const Edge &b) {
      return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
    });
    for (std::size_t e = 0; e < edges.size();)
      {
        std::size_t next = e + 1;
        while (next < edges.size() && edges[next].low == edges[e].low && edges[next].high == edges[e].high)
          ++next;
        const auto &corner = triangles[edges[e].triangle].corner;
        if (next == e + 1)
          boundary.push_back({edges[e].triangle, corner[edges[e].corner], corner[(edges[e].corner + 1) % 3]});
        e = next;
      }
    std::sort(boundary.begin(), boundary.end(),
              [](const BoundaryEdge &a, const BoundaryEdge &b) { return a.triangle < b.triangle; });

    // bins of about half a cell: a branch of one diameter then meets few triangles
    bin_size  = std::sqrt(0.5 * total_area / mesh.cell.size());
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
    for (const auto &edge : boundary)
      {
        const double distance = squared_distance(point, edge.from, edge.to);
        if (distance < nearest)
          {
            nearest  = distance;
            triangle = edge.triangle;
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
} // namespace diptych::coupling
