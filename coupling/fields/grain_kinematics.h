// diptych: increments and velocities of grains as fields, across the edge of a periodic sample, too
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "coupling/averaging/target_cells.h"
#include "coupling/fields/strain_increment.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // displacement_field() of the grains with their centres wrapped into the mesh and, in a periodic sample, images of those within
  // `reach` of its sides behind them: the first n_grains entries are the grains.
  DisplacementField periodic_displacement_field(const TargetCells        &target,
                                                const discrete::Snapshot &from,
                                                const discrete::Snapshot &to,
                                                double                    reach);

  // |v'|^2 / 2 of each grain [velocity^2]: v' is its velocity minus the affine field fitted by least squares to the
  // velocities of the grains within 2.5 mean diameters of it, itself included; the square divided by 1 - h, h its leverage in the
  // fit, so that independent fluctuations of equal variance are given without bias. NaN where fewer than 4 grains are there
  // or they lie on a line.
  std::vector<double> fluctuation_energy(const TargetCells &target, const discrete::Snapshot &grains);
} // namespace diptych::coupling
