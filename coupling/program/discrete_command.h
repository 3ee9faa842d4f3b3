// diptych: the grains alone: run, checkpoints, resume, study of the step
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <optional>

#include "coupling/panels/recorded_grains.h"
#include "coupling/program/command_line.h"

namespace diptych::coupling
{
  // Runs the discrete panel into scene.output.directory, or goes on from its checkpoint; a finished one is not run again where
  // the line says --resume. `prepared`: what prepared_early() gave. Returns an ExitCode. `results`, if given, gets those of a run
  // that began in this process.
  int discrete_panel(const CommandLine              &line,
                     const Scene                    &scene,
                     std::unique_ptr<RecordedGrains> prepared,
                     std::optional<DiscreteResults> *results = nullptr);

  // What is wrong with a sample shows only when it is prepared, and must show before the folder is opened. Nothing where --resume
  // finds grains, or for imported ones. Throws std::invalid_argument where a wanted solid fraction is out of reach or a file
  // wrong, StoppedOnRequest.
  std::unique_ptr<RecordedGrains> prepared_early(const CommandLine &line, const Scene &scene);

  int run_discrete(const CommandLine &line); // discrete SCENE
} // namespace diptych::coupling
