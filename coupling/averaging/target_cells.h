// diptych: the cells that receive grain quantities, with their periodic images
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "coupling/cells/mesh_cells.h"
#include "coupling/cells/triangle_search.h"

namespace diptych::coupling
{
  // The cells of a mesh with a search; in a periodic sample it includes the images one period to either side.
  struct TargetCells
  {
    // period: width of the periodic cell [length], or 0 if the sample is not periodic. Throws as TriangleSearch does.
    explicit TargetCells(const QuadMesh &cells, double period = 0);

    QuadMesh            mesh;
    double              period;
    Eigen::Vector2d     lower, upper; // bounding box of the mesh
    QuadMesh            images;       // the mesh itself if it is not periodic
    TriangleSearch      search;       // searches `images`
    std::vector<double> area;         // of the cells [length^2]

    unsigned int n_cells() const { return unsigned(mesh.cell.size()); }
    unsigned int cell_of(const unsigned int triangle_of_images) const
    {
      return images.triangle[triangle_of_images].cell % n_cells();
    }

    // The image of a point that lies within half a period of the middle of the mesh.
    Eigen::Vector2d wrapped(const Eigen::Vector2d &x) const
    {
      if (!(period > 0))
        return x;
      return {x.x() - period * std::round((x.x() - 0.5 * (lower.x() + upper.x())) / period), x.y()};
    }
  };
} // namespace diptych::coupling
