// diptych: distributes extensive quantities of grains over cells, by one of several methods
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/averaging/averaging_options.h"
#include "coupling/averaging/carriers.h"
#include "coupling/averaging/target_cells.h"

namespace diptych::coupling
{
  // Distributes grains and half branches over the cells:
  //   segments: a half branch by its pieces in the cells, as map_grains() does. A grain by the exact area of its disc in each
  //     cell; the part of a disc outside the mesh goes to the nearest boundary cell.
  //   centroid: a grain and its half branches go to the cell that holds the grain's centre.
  //   laguerre: a grain and its half branches by the area of the grain's power cell in each cell, clipped to the mesh.
  //   kernel: by the kernel's integral over each cell over its integral over the mesh, around the centre or along the half
  //     branch.
  //   projection: integrals over the cells of c, (M + l^2 K) c_a = sum of the quantities x N_a, with linear elements on the
  //     triangles. With l = width / sqrt(2) the width is the standard deviation of this smoothing, too.
  // Throws std::invalid_argument if the width is not positive or sizes do not match.
  CellSums distribute(const AveragingOptions &options, const TargetCells &target, const Carriers &carriers);
} // namespace diptych::coupling
