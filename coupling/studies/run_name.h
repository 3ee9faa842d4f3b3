// diptych: what the folder of a run is called
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "coupling/scene/scene.h"
#include "coupling/studies/study.h"

namespace diptych::coupling
{
  // A digest of what is run: the same for the same scene and command, for what changes no result of it (output, time between
  // checkpoints, the continuum's keys for grains alone), and wherever the files that the scene names lie.
  std::string run_name(const Scene &scene, StudyCommand command);
} // namespace diptych::coupling
