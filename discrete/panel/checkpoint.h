// diptych: a loading put down in a file, to be taken up again
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "discrete/panel/panel.h"

namespace diptych::discrete
{
  // What a loading goes on from, and what of its other files belongs to it.
  struct StoredCheckpoint
  {
    Checkpoint  panel;
    long        n_rows = 0; // of discrete.csv, written before
    std::string scene;      // the scene's identity: another one must refuse the checkpoint
  };

  // HDF5, all numbers with all bits; replaces the file only when complete. Throws std::runtime_error naming it.
  void write_checkpoint(const std::string &path, const StoredCheckpoint &checkpoint);

  // Throws std::invalid_argument naming the file and what it lacks.
  StoredCheckpoint read_checkpoint(const std::string &path);
} // namespace diptych::discrete
