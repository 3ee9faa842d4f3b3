// diptych: a mesh's boundary seen from one place inside
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "coupling/cells/mesh_cells.h"

namespace diptych::coupling
{
  // A boundary all of whose edges are seen from `centre`, in the order of their directions.
  struct StarShape
  {
    Eigen::Vector2d           centre;
    std::vector<double>       angle; // of the direction to each edge's first node, ascending [radians], (-pi, pi]
    std::vector<BoundaryEdge> edge;
    double                    clearance = 0; // least distance of the centre from the lines of the edges [length]
  };

  // Seen from the middle of the mesh if that stands clear of the edges' lines by a twentieth of the square root of its area, else
  // from the middle of all places that see every edge, the intersection of their half planes. None where they do not intersect,
  // where they leave less room than a thousandth, or where the boundary is not one closed line.
  std::optional<StarShape> star_shape(const QuadMesh &mesh, const std::vector<BoundaryEdge> &boundary);

  // How far the boundary must be scaled from the centre to pass through a point; 0 for points nearer than the clearance.
  double gauge(const StarShape &star, const QuadMesh &mesh, const Eigen::Vector2d &point);
} // namespace diptych::coupling
