// diptych: reads and checks calibration files
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "coupling/calibration/calibration.h"
#include "coupling/scene/scene_error.h"

namespace diptych::coupling
{
  // Reads a .json file. Paths of scenes and files are relative to its folder. Throws SceneError naming file, line, key, value
  // and the allowed values.
  Calibration read_calibration(const std::string &file);
} // namespace diptych::coupling
