// diptych: what stands in the place of an earlier run of the grains
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "coupling/program/command_line.h"

namespace diptych::coupling
{
  // "/problem_0003.h5": a stored contact problem in a result folder.
  std::string problem_name(int stage);

  // Frames of another code in the place of a run: copied, so that the folder is whole without the import's. Exit code.
  int take_imported(const CommandLine &line, const Scene &scene);
} // namespace diptych::coupling
