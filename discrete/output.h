// diptych: result files of the discrete panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "discrete/snapshot.h"

namespace diptych::discrete
{
  // PATH.h5 with one group stage_NNNN a snapshot and PATH.xdmf beside it, which ParaView opens: grains as points with
  // radius, velocity, displacement, spin and internal moments (3x3 tensors, positive in compression); contacts as points
  // with normal, impulse (normal, tangential), gap and status (0 open, 1 sticking, 2 slipping). Replaces existing files
  // only when complete.
  void write_snapshots(const std::string &path_without_ending, const std::vector<Snapshot> &snapshots);

  // Throws std::runtime_error naming file and group. Window forces and all that the comparison needs are restored.
  std::vector<Snapshot> read_snapshots(const std::string &h5_path);
} // namespace diptych::discrete
