// diptych: writes a sample in the format of LMGC90
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/import/exported_files.h"
#include "coupling/scene/scene.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // Writes DATBOX/BODIES.DAT, DOF.INI, BULK_BEHAV.DAT, TACT_BEHAV.DAT and DRV_DOF.DAT. Grains are discs DISKx, walls are JONCx
  // half a mean diameter thick, all at rest. Numbers have seven digits, as in LMGC90.
  ExportedFiles lmgc90_datbox(const Scene &scene, const discrete::Snapshot &snapshot);
} // namespace diptych::coupling
