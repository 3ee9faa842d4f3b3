// diptych: a mesh's boundary as seen from one place inside
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "coupling/cells/mesh_cells.h"

namespace diptych::coupling
{
  // A boundary whose edges are all seen from `centre`, sorted by direction.
  struct StarShape
  {
    Eigen::Vector2d           centre;
    std::vector<double>       angle; // of the direction to each edge's first node, ascending [radians], (-pi, pi]
    std::vector<BoundaryEdge> edge;
    double                    clearance = 0; // smallest distance of the centre from the lines of the edges [length]
  };

  // Uses the middle of the mesh if its clearance from the edges' lines exceeds a twentieth of the root of the mesh's area.
  // Otherwise uses the middle of all places that see every edge, that is, of the intersection of the edges' half planes. Empty
  // if they do not intersect, the clearance is at most a thousandth of that square root, or the boundary is not one line.
  std::optional<StarShape> star_shape(const QuadMesh &mesh, const std::vector<BoundaryEdge> &boundary);

  // The scale about the centre at which the boundary passes through a point; 0 for points nearer than the clearance.
  double gauge(const StarShape &star, const QuadMesh &mesh, const Eigen::Vector2d &point);
} // namespace diptych::coupling
