// diptych: exports a sample as a start for other codes
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "coupling/import/exported_files.h"
#include "coupling/scene/scene.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // Returns name and text of every file. `lammps`: data file and script. `csv`: particles, contacts and walls, with the stage in
  // their names. Grains and walls come from the snapshot, friction and pressure from the scene. Rigid grains have no contact
  // stiffness and damping; the script states the values that it uses. Throws SceneError for periodic sides.
  ExportedFiles exported_sample(const std::string &format, const Scene &scene, const discrete::Snapshot &snapshot, int stage);
} // namespace diptych::coupling
