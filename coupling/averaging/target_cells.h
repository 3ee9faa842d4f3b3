// diptych: the cells that receive grain quantities, with their periodic images
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "coupling/cells/period.h"
#include "coupling/cells/triangle_search.h"

namespace diptych::coupling
{
  // The cells of a mesh with a search; in a periodic sample it includes the surrounding images.
  struct TargetCells
  {
    // Throws as TriangleSearch does.
    explicit TargetCells(const QuadMesh &cells, const Period &period = {});

    QuadMesh            mesh;
    Period              period;
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
    Eigen::Vector2d wrapped(const Eigen::Vector2d &x) const { return x - period.nearest(x - 0.5 * (lower + upper)); }
  };
} // namespace diptych::coupling
