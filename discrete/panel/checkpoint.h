// diptych: state of an unfinished loading in a file, for a later restart
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "discrete/panel/panel.h"

namespace diptych::discrete
{
  // State of a loading and the part of its other files that belongs to it.
  struct StoredCheckpoint
  {
    Checkpoint  panel;
    long        n_rows = 0; // of discrete.csv, written before the checkpoint
    std::string scene;      // identity of the scene; a run of another scene must reject the checkpoint
  };

  // Keeps all bits of all numbers. Replaces an old file only when the new one is complete. Throws std::runtime_error with its
  // name.
  void write_checkpoint(const std::string &path, const StoredCheckpoint &checkpoint);

  // Throws std::invalid_argument with the name of the file and the missing or wrong part.
  StoredCheckpoint read_checkpoint(const std::string &path);
} // namespace diptych::discrete
