// diptych: the folder of an ensemble
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/scene/scene.h"
#include "coupling/store/result_folder.h"

namespace diptych::coupling
{
  // DIR/seed_3, the result folder of a member, and DIR/seed_3.log, its output.
  std::string member_folder(const std::string &directory, int seed);
  std::string member_log(const std::string &directory, int seed);

  // The folder holds ensemble.prm, the resolved scene of its members.
  bool is_ensemble_folder(const std::string &directory);

  // Prepares the folder of the scene and writes ensemble.prm. Members that stand there must be of the same scene but for the
  // seed, output, margins and checkpoint_minutes. Throws as require_usable() and set_aside() do, and demand_member().
  void open_ensemble_folder(const Scene &scene, FolderLock &lock, const std::vector<int> &seeds, const Opening &opening);

  // Throws SceneError where the results in the member's folder are of another scene, other inputs or another seed.
  void demand_member(const Scene &scene, int seed);

  // Both panels and the comparison of this scene are complete, the mapping keeps the total, and the report is there if the scene
  // asks for it. Throws std::invalid_argument naming a file that was changed since.
  [[nodiscard]] bool is_finished_member(const Scene &scene, int seed);
} // namespace diptych::coupling
