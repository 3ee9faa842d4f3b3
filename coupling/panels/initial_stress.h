// diptych: the prepared grains' stress as the continuum's initial stress
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "continuum/panel/panel.h"
#include "continuum/snapshot.h"
#include "coupling/scene/scene.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // Symmetric stress of every cell of `nodes`, positive in compression [pressure]: contact forces of the grains mapped by
  // segments. Cells that grains cover to less than half of what is typical (cell_cover.h) take the isotropic `pressure`.
  std::vector<Eigen::Matrix2d> grain_stress_on_cells(const discrete::Snapshot  &grains,
                                                     const continuum::Snapshot &nodes,
                                                     double                     pressure);

  // Solid fraction of the grains about every cell [-]: area of the grains over that of the cells, with the weights of a Gaussian
  // of half of `solid_fraction_width` mean diameters. In a cell of 2 d it would scatter by 0.036, which says where grains happen
  // to be and not what they can carry together; over 6 d by 0.005 to 0.007 (two dense samples of 4000). Cells at the mesh's rim
  // and cells that grains cover to less than half of what is typical do not count. The mean over the mesh is the sample's own.
  constexpr double    solid_fraction_width = 6; // [mean diameters]
  std::vector<double> grain_solid_fraction_on_cells(const discrete::Snapshot &grains, const continuum::Snapshot &nodes);

  // Before panel.prepare(): what the scene wants mapped, initial stress and solid fraction. `grains`: the first process's, looked
  // at only where something is mapped. Collective.
  void map_initial_state(const Scene &scene, const discrete::Snapshot *grains, continuum::Panel &panel);
} // namespace diptych::coupling
