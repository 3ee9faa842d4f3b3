// diptych: MPI in a Python process
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace diptych::python
{
  // Starts MPI and the parts of deal.II that need it, unless mpi4py has started MPI. Signal handlers do not change.
  void start_mpi();

  // Ends what start_mpi() started. All panels must be deleted before.
  void end_mpi();
} // namespace diptych::python
