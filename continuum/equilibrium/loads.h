// diptych: nodal forces of side pressure and weight
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "continuum/elements/discretisation.h"

namespace diptych::continuum
{
  // Each function adds the part of this process's edges or cells to `force`, which has one entry per locally relevant dof.

  // f_a = +-p int N_a dy along both sides at the given shape: horizontal, per unit of height, inwards.
  void add_side_pressure(const Discretisation               &mesh,
                         const std::vector<Eigen::Vector2d> &node_position,
                         double                              pressure,
                         std::vector<double>                &force);

  // Derivative of that force by the position of the nodes: adds int N_a dN_b/ds ds at row x of node a and column y of node b,
  // times `pressure`, of one edge, to a matrix of its cell with `row_length` entries per row.
  void add_side_stiffness(const BoundaryEdge &edge, bool has_middle, double pressure, unsigned int row_length, double *K);

  // f_a = int N_a b dA over the shape of `geometry`. For a weight this is the initial shape, because mass is conserved.
  void add_body_force(const Discretisation  &mesh,
                      const Geometry        &geometry,
                      const Eigen::Vector2d &body_force,
                      std::vector<double>   &force);
} // namespace diptych::continuum
