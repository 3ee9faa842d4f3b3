// diptych: the continuum alone: meshes, run, checkpoints, resume; on one process or several
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>

#include "coupling/program/command_line.h"
#include "discrete/snapshot.h"
#include "coupling/scene/scene_error.h"

namespace diptych::coupling
{
  // Whether --resume may go on from the continuum's part of the result folder: false where there is none, or one that finished
  // with other keys. To be asked before the folder is opened, which refuses an interrupted one of other keys.
  bool may_resume_continuum(const Scene &scene);

  struct ContinuumTask
  {
    bool grains_from_file = false; // the sample is stage 0 of discrete.h5; else it is prepared where the mesh needs it
    bool resume           = false; // from checkpoints; finished parts are not run again
    std::optional<discrete::Snapshot> prepared; // the first process's sample, where it is already there
  };

  // Runs the continuum panel into scene.output.directory, and once more on the coarse mesh into its folder coarse/ (not for a
  // mesh of the user's). Collective. Returns an ExitCode.
  int continuum_panel(const CommandLine &line, const Scene &scene, const ContinuumTask &task);

  int run_continuum(const CommandLine &line); // continuum SCENE; on all processes together
} // namespace diptych::coupling
