// diptych: the prepared grains' stress as the continuum's initial stress
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "continuum/snapshot.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // Symmetric stress of every cell of `nodes`, positive in compression [pressure]: contact forces of the grains mapped by
  // segments. Cells that grains cover to less than half of what is typical (cell_cover.h) take the isotropic `pressure`.
  std::vector<Eigen::Matrix2d> grain_stress_on_cells(const discrete::Snapshot  &grains,
                                                     const continuum::Snapshot &nodes,
                                                     double                     pressure);

  // Area of the grains in every cell over the cell's; cells that grains cover to less than half of what is typical take what is
  // typical [-].
  std::vector<double> grain_solid_fraction_on_cells(const discrete::Snapshot &grains, const continuum::Snapshot &nodes);
} // namespace diptych::coupling
