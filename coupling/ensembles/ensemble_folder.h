// diptych: the folder of an ensemble: what is in it, what of it may stay
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/scene/scene.h"
#include "coupling/scene/scene_error.h"

namespace diptych::coupling
{
  // DIR/seed_3, a result folder of its own; its output is in DIR/seed_3.log.
  std::string member_folder(const std::string &directory, int seed);
  std::string member_log(const std::string &directory, int seed);

  // Whether a folder holds an ensemble: ensemble.prm, the echo of its scene.
  bool is_ensemble_folder(const std::string &directory);

  // Makes the folder of the scene and writes ensemble.prm. Without `resume` results of these seeds are taken away; with it they
  // stay, and must belong to the same scene but for seed, output, margins and checkpoint_minutes. Throws SceneError, before
  // anything is changed, where the folder or a member's holds foreign content or (resume) belongs to another scene,
  // std::runtime_error where it cannot be made or another run writes to a member's.
  void open_ensemble_folder(const Scene &scene, const std::vector<int> &seeds, bool resume);

  // Means are over samples of one scene. Throws SceneError where the member that stands there is of another one, or of another
  // seed.
  void demand_member(const Scene &scene, int seed);

  // Whether a member of this scene ran to its end: both panels, a comparison whose mapping keeps the total, sums over what they
  // left, and the report where one is asked for.
  [[nodiscard]] bool is_finished_member(const Scene &scene, int seed);
} // namespace diptych::coupling
