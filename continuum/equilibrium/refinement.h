// diptych: mesh refinement where plastic strain concentrates
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "continuum/equilibrium/cell_records.h"

namespace diptych::continuum
{
  // Plastic strain in the last accepted step for every cell of this process: the mean over its points.
  std::vector<double> plastic_increments(const BoundaryValueProblem &problem);

  struct RefinementRule
  {
    int    levels    = 1;   // largest number of divisions of an element
    double threshold = 0.2; // an element is divided above this share of the largest increment
  };

  // The elements of this process that one refinement divided, as deal.II's CellId in text. deal.II numbers elements by the
  // history of their divisions. Bitwise equal results therefore need the same history.
  using DividedCells = std::vector<std::string>;
  using Divisions    = std::vector<DividedCells>;

  // Divides elements with one ring of neighbours and transfers the state to the new mesh, where it is not exactly in
  // equilibrium. `last`: before and after. Returns nothing if the mesh does not change.
  // Collective.
  [[nodiscard]] std::optional<DividedCells> refine(BoundaryValueProblem      &problem,
                                                   const RefinementRule      &rule,
                                                   const std::vector<double> &increments,
                                                   LastMotion                &last);

  // Repeats the divisions of another mesh on a fresh one. Every process must have all divisions. Collective.
  void divide_again(Discretisation &mesh, const Divisions &divisions);
} // namespace diptych::continuum
