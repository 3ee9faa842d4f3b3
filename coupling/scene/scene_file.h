// diptych: scenes are read, written in full and explained
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupling/scene/scene.h"
#include "coupling/scene/scene_error.h"
#include "coupling/scene/scene_text.h"

namespace diptych::coupling
{
  // Reads a .prm or .json file, then applies `overrides` of the form section/key=value. Files that the scene names are found
  // relative to the scene's own folder, those of overrides relative to the working directory. Throws SceneError. `compares`:
  // whether both panels will be compared, so that the windows must be stages.
  Scene read_scene(const std::string &file, const std::vector<std::string> &overrides, bool compares = true);

  // The resolved scene of a result folder with overrides. Only keys that a comparison reads are checked again, and files that it
  // names may be gone. `compares` as in read_scene(). Throws SceneError, also where a key is missing.
  Scene read_computed_scene(const std::string &file, const std::vector<std::string> &overrides, bool compares = true);

  // As read_scene(), with changes that say where they were made and where their files are.
  Scene read_changed_scene(const std::string &file, const std::vector<Entry> &changes, bool compares);

  // A scene that stands in no file: `file` is what messages call it and gives its name. Throws SceneError.
  Scene scene_of_entries(const std::string &file, const std::vector<Entry> &entries, bool compares);

  // Throws SceneError naming the place where no scene has such a key or such a value of it.
  void check_entry(const Entry &entry);

  // Keys of a fragment as calibrate writes it (.prm), each checked. Throws SceneError naming file and line.
  std::vector<Entry> read_fragment(const std::string &file);

  // The resolved scene: every key with its value and meaning, in .prm format; files by their absolute paths.
  std::string resolved_text(const Scene &scene);

  // Names of the sections of which a scene file sets a key, each once. Throws SceneError where it is no scene file.
  std::vector<std::string> sections_set_in(const std::string &file);

  // Whether a file sets every key, as the resolved scene beside results does.
  bool is_resolved_scene(const std::string &file);

  // The resolved scene of a result folder (scene.prm, ensemble.prm); files that it names may be gone. Nothing where the file is
  // missing or was written by a version with other keys.
  std::optional<Scene> resolved_scene(const std::string &file);

  std::vector<std::string> section_names();

  // Every key of a section (of all, if empty): default, unit, range, meaning. Throws SceneError on an unknown section.
  std::string explain(const std::string &section);
} // namespace diptych::coupling
