// diptych: run SCENE --seeds: the same scene on many samples
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/commands.h"

namespace diptych::coupling
{
  // run SCENE --seeds LIST [--jobs N]: every seed by a `diptych run` of its own, then statistics, verdicts and a report over
  // those that finished. Collective under mpirun. Returns not_converged where a seed failed or the run was stopped. Throws
  // SceneError on wrong input.
  int run_ensemble(const CommandLine &line);

  // compare DIR of an ensemble: statistics and verdicts again from the members' comparison.json; margins may be changed.
  int compare_ensemble_again(const CommandLine &line);

  // report DIR of an ensemble.
  int report_ensemble_again(const CommandLine &line);
} // namespace diptych::coupling
