// diptych: division of cells, with their hanging nodes, into triangles
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "coupling/cells/cross_product.h"
#include "coupling/cells/mesh_cells.h"

namespace diptych::coupling
{
  namespace
  {
    [[noreturn]] void refuse(const std::size_t cell)
    {
      throw std::runtime_error("cell " + std::to_string(cell) + " of the deformed mesh is turned inside out");
    }

    // The corners of a cell, rotated so that the diagonal 0-2 lies inside it.
    std::array<unsigned int, 4> with_inner_diagonal(const std::vector<Eigen::Vector2d> &x,
                                                    const std::array<unsigned int, 4>  &c,
                                                    const std::size_t                   number)
    {
      for (const unsigned int shift : {0u, 1u})
        {
          const std::array<unsigned int, 4> turned = {{c[shift], c[shift + 1], c[(shift + 2) % 4], c[(shift + 3) % 4]}};
          if (signed_area(x[turned[0]], x[turned[1]], x[turned[2]]) > 0 &&
              signed_area(x[turned[0]], x[turned[2]], x[turned[3]]) > 0)
            return turned;
        }
      refuse(number);
    }

    using Edge = std::pair<unsigned int, unsigned int>; // lower node first

    std::vector<Edge> edges_of_one_cell(const QuadMesh &mesh)
    {
      std::vector<Edge> all, single;
      for (const auto &cell : mesh.cell)
        for (unsigned int k = 0; k < 4; ++k)
          all.push_back(std::minmax(cell[k], cell[(k + 1) % 4]));
      std::sort(all.begin(), all.end());
      for (std::size_t e = 0; e < all.size(); ++e)
        if ((e == 0 || all[e - 1] != all[e]) && (e + 1 == all.size() || all[e + 1] != all[e]))
          single.push_back(all[e]);
      return single;
    }

    // The nodes between the ends of each edge, sorted from its lower node to its higher node.
    std::map<Edge, std::vector<unsigned int>> hanging_nodes(const QuadMesh &mesh, const std::vector<Eigen::Vector2d> &place)
    {
      constexpr double          tolerance = 1e-9; // of an edge's length
      const std::vector<Edge>   edges     = edges_of_one_cell(mesh);
      std::vector<unsigned int> nodes; // sorted by x
      for (const auto &[a, b] : edges)
        nodes.insert(nodes.end(), {a, b});
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      std::stable_sort(nodes.begin(), nodes.end(),
                       [&](const unsigned int a, const unsigned int b) { return place[a].x() < place[b].x(); });

      std::map<Edge, std::vector<unsigned int>> hanging;
      for (const Edge &edge : edges)
        {
          const Eigen::Vector2d &from = place[edge.first], along = place[edge.second] - from;
          const double           length = along.norm(), lowest = std::min(0., along.x()) + from.x() - tolerance * length,
                       highest = std::max(0., along.x()) + from.x() + tolerance * length;
          std::vector<std::pair<double, unsigned int>> found;
          for (auto node = std::lower_bound(nodes.begin(), nodes.end(), lowest,
                                            [&](const unsigned int n, const double x) { return place[n].x() < x; });
               node != nodes.end() && place[*node].x() <= highest; ++node)
            {
              const Eigen::Vector2d offset = place[*node] - from;
              const double          t      = offset.dot(along) / (length * length);
              if (t > tolerance && t < 1 - tolerance && (offset - t * along).norm() <= tolerance * length)
                found.emplace_back(t, *node);
            }
          std::sort(found.begin(), found.end());
          for (const auto &[t, node] : found)
            hanging[edge].push_back(node);
        }
      return hanging;
    }

    std::vector<unsigned int> polygon_of(const std::array<unsigned int, 4>               &corner,
                                         const std::map<Edge, std::vector<unsigned int>> &hanging)
    {
      std::vector<unsigned int> polygon;
      for (unsigned int k = 0; k < 4; ++k)
        {
          const unsigned int a = corner[k], b = corner[(k + 1) % 4];
          polygon.push_back(a);
          if (const auto on_edge = hanging.find(std::minmax(a, b)); on_edge != hanging.end())
            {
              const auto &n = on_edge->second;
              if (a < b)
                polygon.insert(polygon.end(), n.begin(), n.end());
              else
                polygon.insert(polygon.end(), n.rbegin(), n.rend());
            }
        }
      return polygon;
    }

    // Area over the square of the longest edge: 0 for a triangle without area, sqrt(3)/4 for an equilateral one.
    double roundness(const Eigen::Vector2d &a, const Eigen::Vector2d &b, const Eigen::Vector2d &c)
    {
      return signed_area(a, b, c) / std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    }

    // Divides a polygon of n nodes into n - 2 triangles of positive area. Such triangles do not overlap and lie inside the
    // polygon, because their winding numbers add up to that of the polygon. Let best(i, j) be the roundness of the flattest
    // triangle in the best division of the part i, i+1, .., j. It is the largest over k of min(best(i, k), roundness(i, k, j),
    // best(k, j)).
    std::vector<CellTriangle> divide(const std::vector<Eigen::Vector2d> &x,
                                     const std::vector<unsigned int>    &polygon,
                                     const unsigned int                  number)
    {
      const std::size_t         n    = polygon.size();
      Eigen::MatrixXd           best = Eigen::MatrixXd::Constant(n, n, std::numeric_limits<double>::infinity());
      Eigen::MatrixXi           apex = Eigen::MatrixXi::Zero(n, n);
      std::vector<CellTriangle> triangles;
      for (std::size_t span = 2; span < n; ++span)
        for (std::size_t i = 0; i + span < n; ++i)
          {
            const std::size_t j = i + span;
            best(i, j)          = 0;
            for (std::size_t k = i + 1; k < j; ++k)
              if (const double worst = std::min({best(i, k), roundness(x[polygon[i]], x[polygon[k]], x[polygon[j]]), best(k, j)});
                  worst > best(i, j))
                {
                  best(i, j) = worst;
                  apex(i, j) = k;
                }
          }
      if (!(best(0, n - 1) > 0))
        refuse(number);
      std::vector<std::pair<std::size_t, std::size_t>> parts = {{0, n - 1}};
      while (!parts.empty())
        {
          const auto [i, j] = parts.back();
          parts.pop_back();
          if (j - i < 2)
            continue;
          const std::size_t k = apex(i, j);
          triangles.push_back({{{polygon[i], polygon[k], polygon[j]}}, number});
          parts.insert(parts.end(), {{i, k}, {k, j}});
        }
      return triangles;
    }
  } // namespace

  void triangulate(QuadMesh &mesh)
  {
    triangulate(mesh, mesh.node);
  }

  void triangulate(QuadMesh &mesh, const std::vector<Eigen::Vector2d> &initial)
  {
    if (initial.size() != mesh.node.size())
      throw std::invalid_argument("the mesh needs one initial place per node");
    const auto hanging = hanging_nodes(mesh, initial);
    mesh.triangle.clear();
    for (unsigned int c = 0; c < mesh.cell.size(); ++c)
      {
        const std::vector<unsigned int> polygon = polygon_of(mesh.cell[c], hanging);
        if (polygon.size() > 4)
          {
            const std::vector<CellTriangle> triangles = divide(mesh.node, polygon, c);
            mesh.triangle.insert(mesh.triangle.end(), triangles.begin(), triangles.end());
            continue;
          }
        const auto &n = mesh.cell[c] = with_inner_diagonal(mesh.node, mesh.cell[c], c);
        mesh.triangle.push_back({{{n[0], n[1], n[2]}}, c});
        mesh.triangle.push_back({{{n[0], n[2], n[3]}}, c});
      }
  }

  std::vector<BoundaryEdge> boundary_edges(const QuadMesh &mesh)
  {
    struct Side
    {
      Edge         ends;
      BoundaryEdge directed;
    };
    std::vector<Side> sides;
    for (unsigned int t = 0; t < mesh.triangle.size(); ++t)
      for (unsigned int k = 0; k < 3; ++k)
        {
          const unsigned int a = mesh.triangle[t].node[k], b = mesh.triangle[t].node[(k + 1) % 3];
          sides.push_back({std::minmax(a, b), {a, b, t}});
        }
    std::sort(sides.begin(), sides.end(), [](const Side &a, const Side &b) {
      return std::tie(a.ends, a.directed.triangle) < std::tie(b.ends, b.directed.triangle);
    });
    std::vector<BoundaryEdge> boundary;
    for (std::size_t e = 0; e < sides.size(); ++e)
      if ((e == 0 || sides[e - 1].ends != sides[e].ends) && (e + 1 == sides.size() || sides[e + 1].ends != sides[e].ends))
        boundary.push_back(sides[e].directed);
    std::sort(boundary.begin(), boundary.end(), [](const BoundaryEdge &a, const BoundaryEdge &b) {
      return std::tie(a.triangle, a.from) < std::tie(b.triangle, b.from);
    });
    return boundary;
  }
} // namespace diptych::coupling
