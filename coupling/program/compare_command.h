// diptych: homogenisation and comparison of what a folder holds
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/program/command_line.h"
#include "coupling/scene/scene_error.h"
#include "coupling/store/results.h"

namespace diptych::coupling
{
  // Throws SceneError if the panels of a scene cannot be compared. Writes nothing.
  void check_comparable(const Scene &scene);

  // Compares both panels' results and draws the report if the scene asks for it. Both are written to the folder `next`; then all
  // that it holds is moved to scene.output.directory. Returns an ExitCode.
  int compare_and_report(const CommandLine &line, const Scene &scene, const Results &results, const std::string &next);
} // namespace diptych::coupling
