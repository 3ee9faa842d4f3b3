// diptych: what --resume finds of an interrupted continuum, looked at before anything is changed
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/scene/scene.h"

namespace diptych::coupling
{
  // Of all its parts that have a checkpoint. Throws SceneError where it belongs to another scene or mesh (that of an outline is
  // known only when it is made), std::invalid_argument naming the file that is damaged: the checkpoint, the table or the
  // snapshots that it goes on from, provenance.json.
  void check_interrupted_continuum(const Scene &scene);
} // namespace diptych::coupling
