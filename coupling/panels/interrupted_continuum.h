// diptych: checks the files of an interrupted continuum run before --resume changes anything
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/scene/scene.h"

namespace diptych::coupling
{
  // Reads the files of all parts that --resume continues or accepts as finished: checkpoint, table, snapshots, provenance.json.
  // Throws SceneError if a checkpoint belongs to another scene or mesh. A mesh made from an outline is checked later, when it
  // exists. Throws std::invalid_argument with the name of a damaged file.
  void check_earlier_continuum(const Scene &scene);
} // namespace diptych::coupling
