// diptych: the folder of an ensemble
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "coupling/scene/scene_file.h"

namespace diptych::coupling
{
  // The folder holds ensemble.prm, the resolved scene of its members.
  inline bool is_ensemble_folder(const std::string &directory)
  {
    return is_resolved_scene(directory + "/ensemble.prm");
  }
} // namespace diptych::coupling
