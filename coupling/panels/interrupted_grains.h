// diptych: what --resume finds of interrupted grains, looked at before anything is changed
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>

#include "discrete/panel/checkpoint.h"

namespace diptych::coupling
{
  // The checkpoint of a folder, or nothing where there is none. sample: text_of(sample_identity(scene)). Throws SceneError if the
  // checkpoint belongs to another scene, std::invalid_argument with its name if it is damaged.
  std::optional<discrete::StoredCheckpoint> interrupted_grains(const std::string &directory, const std::string &sample);

  // The provenance says so, and there are snapshots.
  bool grains_are_finished(const std::string &directory);

  // Reads all that --resume goes on from, or takes for finished: checkpoint, table, snapshots, provenance.json. Throws as
  // interrupted_grains(), naming what is damaged.
  void check_earlier_grains(const std::string &directory, const std::string &sample);

  // Throws std::invalid_argument where `file` holds fewer stages than a checkpoint goes on from.
  void check_stage_count(const std::string &file, std::size_t found, std::size_t needed);
} // namespace diptych::coupling
