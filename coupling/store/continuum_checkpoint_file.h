// diptych: checkpoint file of the continuum panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "continuum/panel/checkpoint.h"

namespace diptych::coupling
{
  // The state from which a loading continues, and the scene to which it belongs.
  struct ContinuumCheckpoint
  {
    continuum::Checkpoint panel;
    long                  n_rows = 0;    // rows of continuum.csv that were written before
    std::string           scene, sample; // identities of scene and mesh; a run with others refuses it
  };

  // Writes HDF5 with checksums and all bits of every number, also NaN. Replaces an earlier file only when the new one is
  // complete. Throws std::runtime_error with the file's name.
  void write_continuum_checkpoint(const std::string &path, const ContinuumCheckpoint &checkpoint);

  // Throws std::invalid_argument with the file's name if it is missing, cut short, damaged or no checkpoint of this panel.
  ContinuumCheckpoint read_continuum_checkpoint(const std::string &path);
} // namespace diptych::coupling
