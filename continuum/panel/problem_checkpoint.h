// diptych: the walk of a problem along its load path, put down and taken up again
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/equilibrium/driver.h"
#include "continuum/panel/checkpoint.h"

namespace diptych::continuum
{
  // What problem and driver hold; stage and localisation are the panel's. Collective; complete on the first process.
  Checkpoint make_checkpoint(const BoundaryValueProblem &problem, const LoadDriver &driver);

  // The first process's, on all of them. Collective.
  Checkpoint of_first_process(Checkpoint checkpoint, MPI_Comm communicator);

  // Brings a fresh problem and its driver to where the checkpoint was made, on any number of processes that all have it.
  // Collective. Throws std::invalid_argument when the checkpoint's cells do not belong to the problem's mesh.
  void restore(const Checkpoint &checkpoint, BoundaryValueProblem &problem, LoadDriver &driver);
} // namespace diptych::continuum
