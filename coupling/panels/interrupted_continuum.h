// diptych: what --resume finds of an interrupted continuum, looked at before anything is changed
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/scene/scene.h"

namespace diptych::coupling
{
  // Reads all that --resume goes on from, or takes for finished, of all parts: checkpoint, table, snapshots, provenance.json.
  // Throws SceneError where a checkpoint belongs to another scene or mesh (that of an outline is known only when it is made),
  // std::invalid_argument naming the file that is damaged.
  void check_earlier_continuum(const Scene &scene);
} // namespace diptych::coupling
