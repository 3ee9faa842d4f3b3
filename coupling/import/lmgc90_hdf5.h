// diptych: reads LMGC90's HDF5 file
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/import/lmgc90_bodies.h"

namespace diptych::coupling
{
  // Reads the frames Evolution/ID_k. The file has no geometry; `bodies` come from BODIES.DAT. Throws SceneError naming file and
  // dataset.
  std::vector<ForeignFrame> read_lmgc90_hdf5(const std::string                   &path,
                                             const Lmgc90Bodies                  &bodies,
                                             const std::map<std::string, double> &densities);
} // namespace diptych::coupling
