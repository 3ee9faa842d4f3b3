// diptych: one stored contact problem, solved and measured
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/program/command_line.h"

namespace diptych::coupling
{
  // solve PROBLEM.h5: reads a problem in the layout of FCLIB, solves it from r = 0 to line.tolerance (natural map relative to
  // |r|) and prints what it took, one `name: value` a line. With --output the problem and what was reached, converged or not,
  // are written. Returns done or not_converged. Throws std::invalid_argument on a malformed file or a form
  // that the file does not have.
  int solve_stored_problem(const CommandLine &line);
} // namespace diptych::coupling
