// diptych: continuous linear elements on the triangles of a mesh
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "coupling/averaging/target_cells.h"

namespace diptych::coupling
{
  // Number of the unknown at every node; hanging nodes have their own unknowns. In a periodic sample nodes that
  // are a period apart share one unknown.
  struct Unknowns
  {
    std::vector<unsigned int> of_node;
    unsigned int              n = 0;
  };
  Unknowns number_unknowns(const TargetCells &target);

  // M + l^2 K: consistent mass matrix and Laplacian without flux through the boundary. `length`: l.
  Eigen::SparseMatrix<double> helmholtz_matrix(const QuadMesh &mesh, const Unknowns &unknowns, double length);

  // N_a at x for the three nodes of a triangle of target.images. Outside the triangle, negative values become zero and the
  // others are scaled to the sum one.
  Eigen::Vector3d shape_values(const TargetCells &target, unsigned int triangle, const Eigen::Vector2d &x);
} // namespace diptych::coupling
