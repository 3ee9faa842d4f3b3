// diptych: the name of a run's folder
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "coupling/scene/scene.h"
#include "coupling/studies/study.h"

namespace diptych::coupling
{
  // A hash of scene and command. It omits keys that change no result: output, time between checkpoints, and the continuum's
  // keys for a run of the grains only. It does not depend on the folders of the scene's files.
  std::string run_name(const Scene &scene, StudyCommand command);
} // namespace diptych::coupling
