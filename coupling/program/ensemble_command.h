// diptych: run SCENE --seeds: the same scene on many samples
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/program/command_line.h"
#include "coupling/scene/scene_error.h"

namespace diptych::coupling
{
  // run SCENE --seeds LIST [--jobs N]: every seed by a `diptych run` of its own, then statistics, verdicts and a report over
  // those that finished. Collective under mpirun. Returns not_converged where a seed failed or the run was stopped. Throws
  // SceneError on wrong input.
  int run_ensemble(const CommandLine &line);
} // namespace diptych::coupling
