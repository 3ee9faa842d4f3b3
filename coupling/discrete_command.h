// diptych: the grains alone: run, checkpoints, resume, study of the step
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/commands.h"
#include "coupling/scene.h"

namespace diptych::coupling
{
  // Runs the discrete panel into scene.output.directory, or goes on from its checkpoint (--resume). Returns an ExitCode.
  int discrete_panel(const CommandLine &line, const Scene &scene);

  // Throws SceneError where there is no such study or the scene does not allow it.
  void check_study(const CommandLine &line, const Scene &scene);

  // --study step: the same prepared sample at h, h/2 and h/4 in the folders step_1, step_2, step_4; study_step.csv, .json and
  // .png compare energy and stress ratio against time and give a verdict. Returns an ExitCode.
  int step_study(const CommandLine &line, const Scene &scene);
} // namespace diptych::coupling
