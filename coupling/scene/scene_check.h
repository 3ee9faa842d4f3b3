// diptych: what a scene must not be, and what should be pointed out of it
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/scene/scene.h"
#include "coupling/scene/scene_error.h"
#include "coupling/scene/scene_text.h"

namespace diptych::coupling
{
  // Throws SceneError naming file, lines, keys and values that contradict each other.
  void check_scene(const Scene &scene, const std::string &file, const std::vector<Entry> &entries, bool compares);

  // The same of what a comparison reads alone, of a scene that has been computed: files that it names may be gone.
  void check_comparison(const Scene &scene, const std::string &file, const std::vector<Entry> &entries, bool compares);

  // Keys that the scene sets to another value than the default and that nothing reads, each with the key that says so; moduli and
  // cohesions that are probably meant in another unit; a coarse mesh that is no coarser than the first.
  std::vector<std::string> warnings_of(const Scene &scene, const std::vector<Entry> &entries);
} // namespace diptych::coupling
