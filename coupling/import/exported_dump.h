// diptych: all stages of the grains as dump files of LAMMPS, which OVITO opens
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // `dump custom`: one section per stage, whose step is the number of the stage. Columns: id (from 1), type (1 free, 2 held, 3
  // and 4 part of the lower and upper platen), x y z, then the fields of discrete/panel/snapshot_views.h.
  std::string grain_dump(const std::vector<discrete::Snapshot> &snapshots);

  // `dump local`: the contacts of two grains that carry force. fx, fy are the normal part of the force on patom1, p1, p2 the
  // tangential part. OVITO shows the contacts as bonds.
  std::string contact_dump(const std::vector<discrete::Snapshot> &snapshots);
} // namespace diptych::coupling
