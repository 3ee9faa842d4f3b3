// diptych: the continuum alone: meshes, run, checkpoints, resume; on one process or several
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>

#include "coupling/program/command_line.h"
#include "coupling/scene/scene_error.h"
#include "coupling/store/results.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // Results of parts that ran from their beginning in this process.
  struct ContinuumRun
  {
    std::optional<ContinuumResults> fine, coarse;
  };

  struct ContinuumTask
  {
    std::string                       grains_file;       // the sample is stage 0 of this file; empty: it is prepared
    bool                              resume = true;     // continue from checkpoints; finished parts are not run again
    std::optional<discrete::Snapshot> prepared;          // sample on the first process, if it is already prepared
    ContinuumRun                     *results = nullptr; // filled on the first process, if given
  };

  // Runs the continuum panel into scene.output.directory, and once more on the coarse mesh into its folder coarse/ (not for a
  // mesh file). Collective. Returns an ExitCode.
  int continuum_panel(const CommandLine &line, const Scene &scene, const ContinuumTask &task);

  // Folder to which the continuum is written: scene.output.directory, or next_continuum() if that holds one with other keys,
  // which stays until the new one is complete.
  std::string continuum_folder(const CommandLine &line, const Scene &scene, const SceneChanges &changes);

  // As continuum_panel(), to that folder, with the grains in scene.output.directory. Collective. Returns an ExitCode.
  int continuum_beside_grains(const CommandLine &line, const Scene &scene, const std::string &folder, ContinuumTask task);
} // namespace diptych::coupling
