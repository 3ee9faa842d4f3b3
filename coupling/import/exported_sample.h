// diptych: a sample of ours as a start for other codes
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "coupling/import/exported_files.h"
#include "coupling/scene/scene.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // Name and text of every file. `lammps`: data file and script; `yade`: table of spheres and script; `lmgc90`: DATBOX with
  // DOF.INI (text); `csv`: particles, contacts, walls, the stage in their names. Grains, walls, friction and pressure are those
  // of the snapshot and the scene; contact stiffness and damping, which rigid grains do not have, are said at the head of the
  // scripts. Throws SceneError where the sample has no walls that the format needs (periodic sides).
  ExportedFiles exported_sample(const std::string &format, const Scene &scene, const discrete::Snapshot &snapshot, int stage);
} // namespace diptych::coupling
