// diptych: areas that the cells of two meshes share
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/cells/cell_overlap.h"

#include <array>
#include <map>

#include "coupling/cells/polygon.h"
#include "coupling/cells/triangle_search.h"

namespace diptych::coupling
{
  namespace
  {
    std::vector<Eigen::Vector2d> corners_of(const std::array<Eigen::Vector2d, 3> &triangle)
    {
      return {triangle.begin(), triangle.end()};
    }
  } // namespace

  CellOverlap cell_overlap(const QuadMesh &receiving, const QuadMesh &giving)
  {
    const TriangleSearch                        search(giving);
    std::vector<std::map<unsigned int, double>> row(receiving.cell.size());
    std::vector<unsigned int>                   near;
    for (const CellTriangle &triangle : receiving.triangle)
      {
        const std::array<Eigen::Vector2d, 3> corner = {
          {receiving.node[triangle.node[0]], receiving.node[triangle.node[1]], receiving.node[triangle.node[2]]}};
        search.triangles_in_box(corner[0].cwiseMin(corner[1]).cwiseMin(corner[2]),
                                corner[0].cwiseMax(corner[1]).cwiseMax(corner[2]), near);
        for (const unsigned int other : near)
          if (const double area = polygon_area(clipped(corners_of(corner), corners_of(search.corners(other)))); area > 0)
            row[triangle.cell][giving.triangle[other].cell] += area;
      }

    CellOverlap overlap;
    overlap.row_area = cell_areas(receiving);
    overlap.begin    = {0};
    for (const auto &entries : row)
      {
        for (const auto &[cell, area] : entries)
          {
            overlap.cell.push_back(cell);
            overlap.area.push_back(area);
          }
        overlap.begin.push_back(overlap.cell.size());
      }
    return overlap;
  }
} // namespace diptych::coupling
