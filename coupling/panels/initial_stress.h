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

  // Solid fraction of the grains around every cell [-], with the weights of a Gaussian of half `solid_fraction_width` mean
  // diameters. In cells of 2 d the fraction scatters by 0.036, which reflects random places of grains and not their strength.
  // Over 6 d it scatters by 0.005 to 0.007 (two dense samples of 4000 grains). Cells at the rim and cells not covered by grains
  // do not count. The mean over the mesh equals that of the sample.
  constexpr double    solid_fraction_width = 6; // [mean diameters]
  std::vector<double> grain_solid_fraction_on_cells(const discrete::Snapshot &grains, const continuum::Snapshot &nodes);

  // Maps the initial stress and the solid fraction, if the scene asks for them. Call it before panel.prepare(). Only the first
  // process needs `grains`, and only if a field is mapped. Collective.
  void map_initial_state(const continuum::Options &options,
                         double                    pressure,
                         const discrete::Snapshot *grains,
                         continuum::Panel         &panel);
} // namespace diptych::coupling
