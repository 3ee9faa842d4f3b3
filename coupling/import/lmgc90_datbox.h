// diptych: a sample of ours as LMGC90 reads it
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/import/exported_files.h"
#include "coupling/scene/scene.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // DATBOX/BODIES.DAT, DOF.INI, BULK_BEHAV.DAT, TACT_BEHAV.DAT and DRV_DOF.DAT: discs DISKx, walls JONCx half a mean diameter
  // thick, at rest. Seven digits, as LMGC90 writes them.
  ExportedFiles lmgc90_datbox(const Scene &scene, const discrete::Snapshot &snapshot);
} // namespace diptych::coupling
