// diptych: reads and checks study files
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/scene/scene_error.h"
#include "coupling/studies/study.h"

namespace diptych::coupling
{
  // Reads a .json file. `overrides` (section/key=value) are settings of all points. Paths are relative to the study's folder;
  // those of overrides to the working directory. Every key and value is checked by itself; points_of() checks their
  // combinations. Throws SceneError naming file, line, key, value and the allowed values.
  Study read_study(const std::string &file, const std::vector<std::string> &overrides);
} // namespace diptych::coupling
