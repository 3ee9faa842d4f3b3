// diptych: run SCENE --check: whether a scene can run
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/program/command_line.h"

namespace diptych::coupling
{
  // Checks the scene and its first sample and prints the resources of all samples (--seeds), as before an ensemble. With --resume
  // the sample is not prepared. Throws SceneError on wrong input, std::runtime_error without enough memory or disk.
  int check_run(const CommandLine &line);
} // namespace diptych::coupling
