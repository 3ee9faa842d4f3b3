// diptych: reads, resolves and explains scenes
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupling/scene/keys.h"
#include "coupling/scene/scene.h"
#include "coupling/scene/scene_error.h"
#include "coupling/scene/scene_text.h"

namespace diptych::coupling
{
  // Reads a .prm or .json file, then applies `overrides` of the form section/key=value. File names in the scene are relative to
  // the folder of the scene, those in overrides to the working directory. If `compares` is true, both panels will be compared,
  // and the windows must be stages. Throws SceneError.
  Scene read_scene(const std::string &file, const std::vector<std::string> &overrides, bool compares = true);

  // The resolved scene of a result folder with overrides. Only keys that a comparison reads are checked again. Files that it
  // names may be gone. `compares` as in read_scene(). Throws SceneError, also if a key is missing.
  Scene read_computed_scene(const std::string &file, const std::vector<std::string> &overrides, bool compares = true);

  // As read_scene(), with changes that carry the place of their text and the folder of their files.
  Scene read_changed_scene(const std::string &file, const std::vector<Entry> &changes, bool compares);

  // A scene without a file. `file` is its name in messages, and gives the name of the scene. Throws SceneError.
  Scene scene_of_entries(const std::string &file, const std::vector<Entry> &entries, bool compares);

  // Throws SceneError with the place if scenes have no such key, or if the key cannot have this value.
  void check_entry(const Entry &entry);

  // Reads and checks the keys of a part of a scene (.prm), as calibrate writes it. Throws SceneError with file and line.
  std::vector<Entry> read_fragment(const std::string &file);

  // The resolved scene in .prm format: every key with its value and meaning. Files have absolute paths.
  std::string resolved_text(const Scene &scene);

  // The resolved scene of a result folder (scene.prm, ensemble.prm). Files that it names may be gone. Empty if the file is
  // missing or comes from a version with other keys.
  std::optional<Scene> resolved_scene(const std::string &file);

  std::vector<std::string> section_names();

  // The keys of a section (of all, if empty) with their defaults, `auto` for those that follow from others.
  std::vector<KeyDescription> described_keys(const std::string &section = "");

  // Every key of a section (of all, if empty): default, unit, range, meaning. Throws SceneError on an unknown section.
  std::string explain(const std::string &section);
} // namespace diptych::coupling
