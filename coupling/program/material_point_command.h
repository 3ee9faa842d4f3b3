// diptych: material-point SCENE: the continuum's law on one point
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/program/command_line.h"

namespace diptych::coupling
{
  // Writes material_point.csv to the result folder. Returns an ExitCode.
  int run_material_point(const CommandLine &line);
} // namespace diptych::coupling
