// diptych: checks the files of an interrupted run of the grains before --resume changes anything
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>

#include "discrete/panel/checkpoint.h"

namespace diptych::coupling
{
  // The checkpoint of a folder; empty if there is none. `sample`: text_of(sample_identity(scene)). Throws SceneError if the
  // checkpoint belongs to another scene, std::invalid_argument with its name if it is damaged.
  std::optional<discrete::StoredCheckpoint> interrupted_grains(const std::string &directory, const std::string &sample);

  // True if provenance.json records a finished run, and the folder has snapshots.
  bool grains_are_finished(const std::string &directory);

  // Reads all files that --resume continues or accepts as finished: checkpoint, table, snapshots, provenance.json. Throws like
  // interrupted_grains(), with the name of a damaged file.
  void check_earlier_grains(const std::string &directory, const std::string &sample);

  void check_stage_count(const std::string &file, std::size_t found, std::size_t needed);
} // namespace diptych::coupling
