// diptych: cells ready to receive grain quantities, across the edge of a periodic sample, too
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "coupling/cells/mesh_cells.h"
#include "coupling/cells/triangle_search.h"

namespace diptych::coupling
{
  // The cells of a mesh with a search through them and, in a periodic sample, through their images one period to either side.
  struct TargetCells
  {
    // period: width of the periodic cell [length]; 0: not periodic. Throws std::invalid_argument as TriangleSearch does.
    explicit TargetCells(const QuadMesh &cells, double period = 0);

    QuadMesh            mesh;
    double              period;
    Eigen::Vector2d     lower, upper; // bounding box of the mesh
    QuadMesh            images;       // the mesh itself where it is not periodic
    TriangleSearch      search;       // of images
    std::vector<double> area;         // of the cells [length^2]

    unsigned int n_cells() const { return unsigned(mesh.cell.size()); }
    unsigned int cell_of(const unsigned int triangle_of_images) const
    {
      return images.triangle[triangle_of_images].cell % n_cells();
    }

    // Image of a point within half a period of the middle of the mesh.
    Eigen::Vector2d wrapped(const Eigen::Vector2d &x) const
    {
      if (!(period > 0))
        return x;
      return {x.x() - period * std::round((x.x() - 0.5 * (lower.x() + upper.x())) / period), x.y()};
    }
  };
} // namespace diptych::coupling
