// diptych: exports a sample as a start for other codes
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "coupling/scene/scene.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  using ExportedFiles = std::vector<std::pair<std::string, std::string>>; // name and text of each file

  // Returns name and text of every file. `lammps`: data file and script. `csv`: particles, contacts and walls, with the stage in
  // their names. `dump`: all stages (exported_dump.h). Grains and walls come from the snapshot, friction and pressure from the
  // scene. Rigid grains have no contact stiffness and damping; the script states the values that it uses. Throws SceneError for
  // periodic sides.
  ExportedFiles exported_sample(const std::string                     &format,
                                const Scene                           &scene,
                                const std::vector<discrete::Snapshot> &snapshots,
                                int                                    stage);
} // namespace diptych::coupling
