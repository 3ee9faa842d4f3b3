// diptych: continuous linear elements on the triangles of a mesh
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "coupling/averaging/target_cells.h"

namespace diptych::coupling
{
  // Number of the unknown of every node; hanging nodes are nodes as all others. In a periodic sample a node of the left side and
  // the one a period to its right have the same.
  struct Unknowns
  {
    std::vector<unsigned int> of_node;
    unsigned int              n = 0;
  };
  Unknowns number_unknowns(const TargetCells &target);

  // M + l^2 K: consistent mass and the Laplacian, no flux through the boundary. length: l.
  Eigen::SparseMatrix<double> helmholtz_matrix(const QuadMesh &mesh, const Unknowns &unknowns, double length);

  // N_a at x of the three nodes of a triangle of target.images. In a triangle that does not hold x, as outside the mesh: at the
  // point found by dropping the negative ones, so that they add up to one still.
  Eigen::Vector3d shape_values(const TargetCells &target, unsigned int triangle, const Eigen::Vector2d &x);
} // namespace diptych::coupling
