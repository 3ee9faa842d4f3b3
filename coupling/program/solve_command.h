// diptych: one stored contact problem, solved and measured
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/program/command_line.h"

namespace diptych::coupling
{
  // solve PROBLEM.h5: reads a problem in the layout of FCLIB and solves it from r = 0 to line.tolerance (natural map relative to
  // |r|). Prints the cost, one `name: value` per line. With --output it writes the problem and the reached solution, converged or
  // not. Returns done or not_converged. Throws std::invalid_argument if the file is malformed or does not have the form.
  int solve_stored_problem(const CommandLine &line);
} // namespace diptych::coupling
