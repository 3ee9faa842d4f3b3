// diptych: the continuum panel put down in a file, to be taken up again
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "continuum/panel/checkpoint.h"

namespace diptych::coupling
{
  // What a loading goes on from, and what of its other files belongs to it.
  struct ContinuumCheckpoint
  {
    continuum::Checkpoint panel;
    long                  n_rows = 0;    // of continuum.csv, written before
    std::string           scene, sample; // identities of the scene and of the mesh: others must refuse the checkpoint
  };

  // HDF5 with checksums, all numbers with all bits (NaN, too); replaces the file only when complete. Throws std::runtime_error
  // naming it.
  void write_continuum_checkpoint(const std::string &path, const ContinuumCheckpoint &checkpoint);

  // Throws std::invalid_argument naming the file when it is missing, cut short, damaged or no checkpoint of this panel.
  ContinuumCheckpoint read_continuum_checkpoint(const std::string &path);
} // namespace diptych::coupling
