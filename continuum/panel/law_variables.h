// diptych: state variables of a law from a library, for output
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "continuum/equilibrium/boundary_value_problem.h"
#include "continuum/snapshot.h"

namespace diptych::continuum
{
  // Area means over a cell of this process; empty for other laws.
  std::vector<double> variables_of(const BoundaryValueProblem &problem, std::size_t cell);

  // Names, units and meanings, without values; empty for other laws.
  std::vector<LawVariable> described_variables(const Law &law);
} // namespace diptych::continuum
