// diptych: vectors over all processes and their entries on this one
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_vector.h>

#include "continuum/elements/discretisation.h"

namespace diptych::continuum
{
  // Entries of the dofs that a process owns.
  using DistributedVector = dealii::TrilinosWrappers::MPI::Vector;

  DistributedVector zero_vector(const Discretisation &mesh);

  // Entries of all dofs that this process reads, in the order of Discretisation::relevant. Collective.
  std::vector<double> relevant_values(const Discretisation &mesh, const DistributedVector &vector);

  // Its inverse.
  DistributedVector owned_values(const Discretisation &mesh, const std::vector<double> &relevant);

  // Sum over the processes of what each has for its relevant dofs. Collective.
  DistributedVector assembled(const Discretisation &mesh, const std::vector<double> &relevant);

  // Forces on dofs that follow others go to those; on prescribed ones they vanish.
  void condense(const Discretisation &mesh, const dealii::AffineConstraints<double> &constraints, std::vector<double> &relevant);
} // namespace diptych::continuum
