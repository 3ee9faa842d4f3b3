// diptych: how many grains a cell holds and how much of it they cover
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "coupling/cells/mesh_cells.h"
#include "coupling/cells/triangle_search.h"

namespace diptych::coupling
{
  // n_cells entries each.
  struct CellCover
  {
    std::vector<int>          grain_count;    // grains with their centre in the cell; grains outside the mesh count nowhere
    std::vector<double>       solid_fraction; // area of the discs inside the cell / area of the cell, exact
    std::vector<std::uint8_t> covered;        // 1 where solid_fraction >= typical_solid_fraction / 2
    double                    typical_solid_fraction = 0;
  };

  // The typical solid fraction is the area-weighted median over the cells that hold any disc area: a cell is covered when at
  // least half of it is filled as densely as the sample. Overlaps of discs count twice.
  CellCover cell_cover(const QuadMesh                     &mesh,
                       const TriangleSearch               &search,
                       const std::vector<Eigen::Vector2d> &position,
                       const std::vector<double>          &radius);

  // Area of a disc inside a simple polygon, corners counter-clockwise (exact: signed sectors and triangles of its edges).
  double disc_polygon_area(const Eigen::Vector2d &centre, double radius, const std::vector<Eigen::Vector2d> &polygon);
} // namespace diptych::coupling
