// diptych: the folder of an ensemble and its members, and what may be kept of it
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/scene/scene.h"
#include "coupling/scene/scene_error.h"

namespace diptych::coupling
{
  // DIR/seed_3 is a member's result folder; DIR/seed_3.log is its log.
  std::string member_folder(const std::string &directory, int seed);
  std::string member_log(const std::string &directory, int seed);

  // True if the folder holds ensemble.prm, the resolved scene of an ensemble.
  bool is_ensemble_folder(const std::string &directory);

  // Creates the scene's folder and writes ensemble.prm. Removes the results of these seeds unless `resume` is set. With it they
  // stay and must come from the same scene, except for seed, output, margins and checkpoint_minutes. Throws SceneError, before
  // anything is changed, if the folder or a member holds other files or comes from another scene. Throws std::runtime_error if
  // the folder cannot be made or another run writes to a member.
  void open_ensemble_folder(const Scene &scene, const std::vector<int> &seeds, bool resume);

  // Throws SceneError if the member in the folder comes from another scene or seed: means are over samples of one scene.
  void demand_member(const Scene &scene, int seed);

  // True if a member of this scene finished: both panels, a comparison whose mapping keeps the total, hashes of the files, and
  // the report if one is required.
  [[nodiscard]] bool is_finished_member(const Scene &scene, int seed);
} // namespace diptych::coupling
