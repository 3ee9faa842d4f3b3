// diptych: calibrations read and checked
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "coupling/calibration/calibration.h"
#include "coupling/scene/scene_error.h"

namespace diptych::coupling
{
  // Reads a .json file. Scenes and files that settings name are found from the file's own folder. Throws SceneError naming file,
  // line, key, value and what is allowed.
  Calibration read_calibration(const std::string &file);
} // namespace diptych::coupling
