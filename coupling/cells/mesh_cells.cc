// diptych: the cells that receive grain quantities, and their triangles
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/cells/mesh_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "coupling/cells/cross_product.h"

namespace diptych::coupling
{
  QuadMesh quad_mesh(const continuum::Snapshot &snapshot)
  {
    constexpr unsigned int       unseen = std::numeric_limits<unsigned int>::max();
    std::vector<unsigned int>    number(snapshot.position.size(), unseen);
    std::vector<Eigen::Vector2d> initial;

    QuadMesh mesh;
    for (const auto &cell : snapshot.cells)
      {
        std::array<unsigned int, 4> corner;
        for (unsigned int k = 0; k < 4; ++k)
          {
            const unsigned int node = cell[k];
            if (number.at(node) == unseen)
              {
                number[node] = mesh.node.size();
                mesh.node.push_back(snapshot.position[node]);
                initial.push_back(snapshot.position[node]);
                if (!snapshot.displacement.empty())
                  initial.back() -= snapshot.displacement.at(node);
              }
            corner[k] = number[node];
          }
        mesh.cell.push_back(corner);
      }
    triangulate(mesh, initial);
    return mesh;
  }

  QuadMesh regular_grid(const Eigen::Vector2d &lower, const Eigen::Vector2d &upper, const double size)
  {
    const Eigen::Vector2d extent = upper - lower;
    if (!(extent.minCoeff() > 0) || !(size > 0) || !std::isfinite(extent.sum() / size))
      throw std::invalid_argument("a regular grid needs a box of positive width and height and cells of positive size");
    constexpr double most_cells = 1e8;
    if (const double cells = (1 + extent.x() / size) * (1 + extent.y() / size); !(cells <= most_cells))
      throw std::invalid_argument("a regular grid would have " + std::to_string(cells) + " cells; at most 1e8 are possible");
    const unsigned int columns = std::max(1., std::round(extent.x() / size)), rows = std::max(1., std::round(extent.y() / size));
    QuadMesh           mesh;
    for (unsigned int r = 0; r <= rows; ++r)
      for (unsigned int c = 0; c <= columns; ++c)
        mesh.node.push_back(lower + Eigen::Vector2d(c * extent.x() / columns, r * extent.y() / rows));
    for (unsigned int r = 0; r < rows; ++r)
      for (unsigned int c = 0; c < columns; ++c)
        {
          const unsigned int first = r * (columns + 1) + c, above = first + columns + 1;
          mesh.cell.push_back({{first, first + 1, above + 1, above}});
        }
    triangulate(mesh);
    return mesh;
  }

  std::array<unsigned int, 3> triangle_nodes(const QuadMesh &mesh, const unsigned int triangle)
  {
    return mesh.triangle[triangle].node;
  }

  double triangle_area(const QuadMesh &mesh, const unsigned int triangle)
  {
    const auto &n = mesh.triangle[triangle].node;
    return signed_area(mesh.node[n[0]], mesh.node[n[1]], mesh.node[n[2]]);
  }

  Eigen::Vector2d cell_centre(const QuadMesh &mesh, const unsigned int cell)
  {
    const auto &c = mesh.cell[cell];
    return 0.25 * (mesh.node[c[0]] + mesh.node[c[1]] + mesh.node[c[2]] + mesh.node[c[3]]);
  }

  std::vector<Eigen::Vector2d> cell_centres(const QuadMesh &mesh)
  {
    std::vector<Eigen::Vector2d> centres;
    for (unsigned int k = 0; k < mesh.cell.size(); ++k)
      centres.push_back(cell_centre(mesh, k));
    return centres;
  }

  std::vector<double> cell_areas(const QuadMesh &mesh)
  {
    std::vector<double> areas(mesh.cell.size(), 0.);
    for (unsigned int t = 0; t < mesh.triangle.size(); ++t)
      areas[mesh.triangle[t].cell] += triangle_area(mesh, t);
    return areas;
  }

  std::vector<std::vector<unsigned int>> cell_outlines(const QuadMesh &mesh)
  {
    std::vector<std::vector<unsigned int>> outlines(mesh.cell.size());
    for (std::size_t t = 0, end = 0; t < mesh.triangle.size(); t = end)
      {
        const unsigned int                                 cell = mesh.triangle[t].cell;
        std::vector<std::pair<unsigned int, unsigned int>> directed;
        for (end = t; end < mesh.triangle.size() && mesh.triangle[end].cell == cell; ++end)
          for (unsigned int k = 0; k < 3; ++k)
            directed.emplace_back(mesh.triangle[end].node[k], mesh.triangle[end].node[(k + 1) % 3]);
        const auto is_outer = [&](const auto &e) {
          return std::find(directed.begin(), directed.end(), std::make_pair(e.second, e.first)) == directed.end();
        };
        unsigned int node = mesh.cell[cell][0];
        do
          {
            outlines[cell].push_back(node);
            node = std::find_if(directed.begin(), directed.end(), [&](const auto &e) {
                     return e.first == node && is_outer(e);
                   })->second;
        } while (node != mesh.cell[cell][0]);
      }
    return outlines;
  }

  Eigen::Vector3d shape_values(const QuadMesh &mesh, const unsigned int triangle, const Eigen::Vector2d &point)
  {
    const auto           &n = mesh.triangle[triangle].node;
    const Eigen::Vector2d u = mesh.node[n[1]] - mesh.node[n[0]], v = mesh.node[n[2]] - mesh.node[n[0]];
    const Eigen::Vector2d offset = point - mesh.node[n[0]];
    const double          whole  = u.x() * v.y() - u.y() * v.x();
    const double          second = (offset.x() * v.y() - offset.y() * v.x()) / whole;
    const double          third  = (u.x() * offset.y() - u.y() * offset.x()) / whole;
    return {1 - second - third, second, third};
  }

  // grad N_a is normal to the edge opposite corner a. Its length is edge / (2 area).
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
} // namespace diptych::coupling
