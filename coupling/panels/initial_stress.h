// diptych: initial stress of the continuum from the prepared grains
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
  // Symmetric stress of every cell of `nodes`, positive in compression [pressure]: contact forces of the grains, mapped by
  // segments. Cells that are not covered by grains (cell_cover.h) have the isotropic `pressure`.
  std::vector<Eigen::Matrix2d> grain_stress_on_cells(const discrete::Snapshot  &grains,
                                                     const continuum::Snapshot &nodes,
                                                     double                     pressure);

  // Solid fraction of the grains around every cell [-]: area of the grains over that of the cells, with the weights of a
  // Gaussian. Its standard deviation is half of `solid_fraction_width` mean diameters. In a cell of 2 d the fraction would
  // scatter by 0.036, which reflects random places of grains and not their common strength. Over 6 d it scatters by 0.005 to
  // 0.007 (two dense samples of 4000 grains). Cells at the mesh's rim and cells that are not covered by grains do not count. The
  // mean over the mesh equals that of the sample.
  constexpr double    solid_fraction_width = 6; // [mean diameters]
  std::vector<double> grain_solid_fraction_on_cells(const discrete::Snapshot &grains, const continuum::Snapshot &nodes);

  // Call before panel.prepare(). Maps the initial stress and solid fraction if the scene asks for it. `grains`: needed on the
  // first process only, and only if something is mapped. Collective.
  void map_initial_state(const continuum::Options &options,
                         double                    pressure,
                         const discrete::Snapshot *grains,
                         continuum::Panel         &panel);
} // namespace diptych::coupling
