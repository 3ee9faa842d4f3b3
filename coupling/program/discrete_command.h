// diptych: the grains alone: run, checkpoints, resume, study of the step
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/program/command_line.h"

namespace diptych::coupling
{
  // Runs the discrete panel into scene.output.directory, or goes on from its checkpoint; a finished one is not run again where
  // the line says --resume. Returns an ExitCode.
  int discrete_panel(const CommandLine &line, const Scene &scene);

  int run_discrete(const CommandLine &line); // discrete SCENE
} // namespace diptych::coupling
