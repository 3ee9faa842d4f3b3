// diptych: checks of a scene: contradictions are errors, doubtful values are warnings
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/scene/scene.h"
#include "coupling/scene/scene_error.h"
#include "coupling/scene/scene_text.h"

namespace diptych::coupling
{
  // Throws SceneError with file, lines, keys and values that contradict each other.
  void check_scene(const Scene &scene, const std::string &file, const std::vector<Entry> &entries, bool compares);

  // Opens the library of law = library and gives its other parameters their usual values. Throws SceneError like check_scene().
  void complete_law(Scene &scene, const std::string &file, const std::vector<Entry> &entries);

  // As check_scene() for a computed scene, but only for the keys that a comparison reads. Files of the scene may be gone.
  void check_comparison(const Scene &scene, const std::string &file, const std::vector<Entry> &entries, bool compares);

  // Warnings about
  //   keys that differ from their default but have no effect, each with the key that is the reason;
  //   moduli and cohesions that are probably meant in another unit;
  //   if both panels are compared: platens that are rough in one only, a coarse mesh that is no coarser than the first.
  std::vector<std::string> warnings_of(const Scene &scene, const std::vector<Entry> &entries, bool compares);
} // namespace diptych::coupling
