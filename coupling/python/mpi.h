// diptych: MPI in a Python process
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace diptych::python
{
  // Starts MPI, and what deal.II keeps with it, unless somebody else (mpi4py) has; signal handlers stay as they are.
  void start_mpi();

  // Ends what start_mpi() began. No panel may be left.
  void end_mpi();
} // namespace diptych::python
