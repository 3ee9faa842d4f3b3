// diptych: smaller elements where plastic strain gathers
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "continuum/equilibrium/boundary_value_problem.h"

namespace diptych::continuum
{
  // Plastic strain of every cell of this process in the last accepted step: the mean over its points.
  std::vector<double> plastic_increments(const BoundaryValueProblem &problem);

  struct RefinementRule
  {
    int    levels    = 1;   // an element is divided so often at most
    double threshold = 0.2; // share of the largest increment above which an element is divided
  };

  // The elements of this process that one refinement divided, as deal.II's CellId in text. deal.II numbers elements by the
  // history of their divisions: the same history, the same bits.
  using DividedCells = std::vector<std::string>;
  using Divisions    = std::vector<DividedCells>;

  // Divides elements, with one ring of neighbours, carries the state over and states it on the new mesh, where it is not quite
  // in equilibrium. `last_increment`: relevant dofs, before and after. Nothing where the mesh does not change. Collective.
  [[nodiscard]] std::optional<DividedCells> refine(BoundaryValueProblem      &problem,
                                                   const RefinementRule      &rule,
                                                   const std::vector<double> &increments,
                                                   std::vector<double>       &last_increment);

  // Divides a fresh mesh as another one was, of whose divisions every process has all. Collective.
  void divide_again(Discretisation &mesh, const Divisions &divisions);
} // namespace diptych::continuum
