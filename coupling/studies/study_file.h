// diptych: studies read and checked
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/scene/scene_error.h"
#include "coupling/studies/study.h"

namespace diptych::coupling
{
  // Reads a .json file; `overrides` (section/key=value) are settings of all points. The scene and files that settings name are
  // found from the study's own folder, those of overrides from the working directory. Every key and every value by itself is
  // checked; what values mean together is asked of each point. Throws SceneError naming file, line, key, value and what is
  // allowed.
  Study read_study(const std::string &file, const std::vector<std::string> &overrides);
} // namespace diptych::coupling
