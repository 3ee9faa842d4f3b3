// diptych: the grains' stress at points, smoothed by a kernel
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "coupling/averaging/averaging_options.h"
#include "coupling/averaging/carriers.h"
#include "coupling/averaging/target_cells.h"

namespace diptych::coupling
{
  // Stress at a point: sum over the half branches of -f (x) (integral of phi along it) over the integral of phi over the mesh.
  // The kernel around the point is phi. The stress is unsymmetric and positive in compression [pressure]. `width`: standard
  // deviation [length]. Images of a periodic sample count. NaN if no part of the mesh is in reach.
  // `moments`: moment_carriers() of the grains.
  std::vector<Eigen::Matrix2d> stress_at_points(const TargetCells                  &region,
                                                const Carriers                     &moments,
                                                const std::vector<Eigen::Vector2d> &points,
                                                KernelShape                         kernel,
                                                double                              width);
} // namespace diptych::coupling
