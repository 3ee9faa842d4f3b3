// diptych: the grains alone: run, checkpoints, resume, study of the step
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>

#include "coupling/program/command_line.h"
#include "coupling/program/recorded_grains.h"

namespace diptych::coupling
{
  // Runs the discrete panel into scene.output.directory, or goes on from its checkpoint; a finished one is not run again where
  // the line says --resume. `prepared`: what prepared_early() gave. Returns an ExitCode.
  int discrete_panel(const CommandLine &line, const Scene &scene, std::unique_ptr<RecordedGrains> prepared = {});

  // Whether a wanted solid fraction is in reach shows only when the sample is prepared, and must show before the folder is
  // opened. Nothing where the scene wants none, or where --resume finds grains. Throws std::invalid_argument where it is out of
  // reach.
  std::unique_ptr<RecordedGrains> prepared_early(const CommandLine &line, const Scene &scene);

  int run_discrete(const CommandLine &line); // discrete SCENE
} // namespace diptych::coupling
