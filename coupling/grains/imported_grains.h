// diptych: frames of another code as the grains of a run
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/processes/run_options.h"
#include "coupling/scene/scene.h"

namespace diptych::coupling
{
  // Copies the frames of discrete/file into the result folder, which is then independent of the imported folder.
  void take_imported(const RunOptions &options, const Scene &scene);
} // namespace diptych::coupling
