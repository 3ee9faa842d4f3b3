// diptych: the grains alone: run, checkpoints, resume
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <optional>

#include "coupling/grains/recorded_grains.h"
#include "coupling/program/command_line.h"
#include "coupling/store/result_folder.h"

namespace diptych::coupling
{
  // Runs the discrete panel into scene.output.directory, or continues from its checkpoint. With --resume finished grains are not
  // run again. `prepared`: result of prepared_early(). `results`, if given, receives the results of a run that began in this
  // process. Returns an ExitCode.
  int discrete_panel(const CommandLine              &line,
                     const Scene                    &scene,
                     std::unique_ptr<RecordedGrains> prepared,
                     std::optional<DiscreteResults> *results = nullptr);

  // What the other processes of an MPI job do meanwhile: the same, without files.
  struct FollowedGrains
  {
    const Scene                   &scene;
    discrete::Processes           &processes;
    std::optional<discrete::Panel> panel = {};

    void follow(Followers::Task task); // of the grains
  };

  // True, and says so, if the folder holds the finished `part` of the scene and no option asks for it again.
  bool is_held(const CommandLine &line, const Scene &scene, const std::string &part, bool (ResultFolder::*holds)() const);

  // Prepares the sample before the folder is changed, because some faults of a sample show only during its preparation. Empty if
  // --resume finds grains, or for imported grains. Throws std::invalid_argument if a wanted solid fraction cannot be reached or a
  // file is wrong, and StoppedOnRequest.
  std::unique_ptr<RecordedGrains> prepared_early(const CommandLine &line, const Scene &scene);
} // namespace diptych::coupling
