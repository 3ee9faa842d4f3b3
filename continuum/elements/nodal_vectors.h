// diptych: distributed vectors and their entries on this process
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

  DistributedVector owned_values(const Discretisation &mesh, const std::vector<double> &relevant);

  // Sums the contributions of all processes to the relevant dofs. Collective.
  DistributedVector assembled(const Discretisation &mesh, const std::vector<double> &relevant);

  // The values of every process on the first one; on the others an empty list. Unlike deal.II's gather() it does not compress
  // them. Collective.
  std::vector<std::vector<double>> gathered(const std::vector<double> &mine, MPI_Comm communicator);

  // Moves forces from constrained dofs to their masters and sets those on prescribed dofs to zero.
  void condense(const Discretisation &mesh, const dealii::AffineConstraints<double> &constraints, std::vector<double> &relevant);
} // namespace diptych::continuum
