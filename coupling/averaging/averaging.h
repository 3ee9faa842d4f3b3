// diptych: distributes extensive quantities of grains over cells, by one of several methods
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/averaging/averaging_options.h"
#include "coupling/averaging/carriers.h"
#include "coupling/averaging/target_cells.h"

namespace diptych::coupling
{
  // Distributes grains and half branches over the cells by the method of `options` (README.md, Other methods). Throws
  // std::invalid_argument if the width is not positive or sizes do not match.
  CellSums distribute(const AveragingOptions &options, const TargetCells &target, const Carriers &carriers);
} // namespace diptych::coupling
