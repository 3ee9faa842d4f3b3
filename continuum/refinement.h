// diptych: smaller elements where plastic strain gathers
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "continuum/boundary_value_problem.h"

namespace diptych::continuum
{
  // Plastic strain of every cell of this process in the last accepted step: the mean over its points.
  std::vector<double> plastic_increments(const BoundaryValueProblem &problem);

  struct RefinementRule
  {
    int    levels    = 1;   // an element is divided so often at most
    double threshold = 0.2; // share of the largest increment above which an element is divided
  };

  // Divides elements, with one ring of neighbours, carries the state over and states it on the new mesh, where it is not quite
  // in equilibrium. `last_increment`: relevant dofs, before and after. Returns whether the mesh changed. Collective.
  bool refine(BoundaryValueProblem      &problem,
              const RefinementRule      &rule,
              const std::vector<double> &increments,
              std::vector<double>       &last_increment);
} // namespace diptych::continuum
