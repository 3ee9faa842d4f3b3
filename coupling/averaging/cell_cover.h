// diptych: the number of grains in a cell and the area that they cover
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
  // Each vector has n_cells entries.
  struct CellCover
  {
    std::vector<int>          grain_count;    // grains whose centre is in the cell; a grain outside the mesh is not counted
    std::vector<double>       solid_fraction; // exact area of the discs inside the cell / area of the cell
    std::vector<std::uint8_t> covered;        // 1 where solid_fraction >= typical_solid_fraction / 2
    double                    typical_solid_fraction = 0;
  };

  // The typical solid fraction is the area-weighted median over the cells that hold disc area. Overlaps of discs count twice.
  CellCover cell_cover(const QuadMesh                     &mesh,
                       const TriangleSearch               &search,
                       const std::vector<Eigen::Vector2d> &position,
                       const std::vector<double>          &radius);

  // Exact area of a disc inside a simple polygon with counter-clockwise corners, from signed sectors and triangles of its edges.
  double disc_polygon_area(const Eigen::Vector2d &centre, double radius, const std::vector<Eigen::Vector2d> &polygon);
} // namespace diptych::coupling
