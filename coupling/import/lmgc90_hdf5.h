// diptych: LMGC90's HDF5 file
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/import/lmgc90_bodies.h"

namespace diptych::coupling
{
  // Frames Evolution/ID_k; the file has no geometry, which BODIES.DAT holds. Throws SceneError naming file and dataset.
  std::vector<ForeignFrame> read_lmgc90_hdf5(const std::string                   &path,
                                             const Lmgc90Bodies                  &bodies,
                                             const std::map<std::string, double> &densities);
} // namespace diptych::coupling
