// diptych: checkpoint and restart of a problem on its loading path
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/equilibrium/driver.h"
#include "continuum/panel/checkpoint.h"

namespace diptych::continuum
{
  // Stores problem and driver; the panel adds stage and localisation. Collective; complete on the first process.
  Checkpoint make_checkpoint(const BoundaryValueProblem &problem, const LoadDriver &driver);

  // Broadcasts the checkpoint of the first process. Collective.
  Checkpoint of_first_process(Checkpoint checkpoint, MPI_Comm communicator);

  // Brings a fresh problem and its driver to the state of the checkpoint, which all processes must have. Their number is
  // arbitrary. Collective. Throws std::invalid_argument if the cells of the checkpoint do not belong to the problem's mesh.
  void restore(const Checkpoint &checkpoint, BoundaryValueProblem &problem, LoadDriver &driver);
} // namespace diptych::continuum
