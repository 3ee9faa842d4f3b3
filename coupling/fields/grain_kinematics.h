// diptych: displacement increments and velocity fluctuations of grains, also in periodic samples
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "coupling/averaging/target_cells.h"
#include "coupling/fields/strain_increment.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // displacement_field() of the grains with their centres wrapped into the mesh. The first n_grains entries are the grains. In a
  // periodic sample, images of the grains within `reach` of the mesh's sides follow.
  DisplacementField periodic_displacement_field(const TargetCells        &target,
                                                const discrete::Snapshot &from,
                                                const discrete::Snapshot &to,
                                                double                    reach);

  // |v'|^2 / 2 of each grain [velocity^2], with v' its velocity minus an affine field. The field is the least squares fit to
  // the grains within 2.5 mean diameters, with the grain itself. The square is divided by 1 - h, h the grain's leverage in the
  // fit, so that independent fluctuations have no bias. NaN if the fit has fewer than 4 grains or they lie on a line.
  std::vector<double> fluctuation_energy(const TargetCells &target, const discrete::Snapshot &grains);
} // namespace diptych::coupling
