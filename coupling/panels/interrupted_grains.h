// diptych: what --resume finds of interrupted grains, looked at before anything is changed
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>

#include "coupling/scene/scene.h"
#include "discrete/panel/checkpoint.h"

namespace diptych::coupling
{
  // The checkpoint, or nothing where there is none. Throws SceneError where it belongs to another scene, std::invalid_argument
  // naming it where it is damaged.
  std::optional<discrete::StoredCheckpoint> interrupted_grains(const Scene &scene);

  // The provenance says so, and there are snapshots.
  bool grains_are_finished(const Scene &scene);

  // Reads all that --resume goes on from, or takes for finished: checkpoint, table, snapshots, provenance.json. Throws as
  // interrupted_grains(), naming what is damaged.
  void check_earlier_grains(const Scene &scene);

  // Throws std::invalid_argument where `file` holds fewer stages than a checkpoint goes on from.
  void check_stage_count(const std::string &file, std::size_t found, std::size_t needed);
} // namespace diptych::coupling
