// diptych: extensive quantities of grains distributed over cells, by one of several methods
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/averaging/averaging_options.h"
#include "coupling/averaging/carriers.h"
#include "coupling/averaging/target_cells.h"

namespace diptych::coupling
{
  // segments: a half branch by its pieces in the cells, as map_grains() does it, a grain by its disc's exact area in each;
  //   what of a disc lies outside the mesh goes to the nearest boundary cell.
  // centroid: a grain and its halves to the cell of the centre.
  // laguerre: a grain and its halves by the area of the grain's power cell, clipped to the mesh, in each cell.
  // kernel: the kernel's integral over each cell over its integral over the mesh, around the centre or along the half.
  // projection: integrals over the cells of c, (M + l^2 K) c_a = sum of the quantities x N_a, linear elements on the triangles,
  //   l = width / sqrt(2): the standard deviation of this smoothing is the width, too.
  // Throws std::invalid_argument for a width that is not positive, or sizes that do not match.
  CellSums distribute(const AveragingOptions &options, const TargetCells &target, const Carriers &carriers);
} // namespace diptych::coupling
