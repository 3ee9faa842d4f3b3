// diptych: scenes read, echoed and explained
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

  // The scene that a result folder was made with, by its scene.prm, with overrides of what a comparison reads: nothing else is
  // checked again, and files that it names may be gone. `compares` as in read_scene(). Throws SceneError, too where the file is
  // no whole echo.
  Scene read_computed_scene(const std::string &file, const std::vector<std::string> &overrides, bool compares = true);

  // As read_scene(), with changes that say where they were made and where their files are.
  Scene read_changed_scene(const std::string &file, const std::vector<Entry> &changes, bool compares);

  // A scene that stands in no file: `file` is what messages call it and gives its name. Throws SceneError.
  Scene scene_of_entries(const std::string &file, const std::vector<Entry> &entries, bool compares);

  // Throws SceneError naming the place where no scene has such a key or such a value of it.
  void check_entry(const Entry &entry);

  // Keys of a fragment as calibrate writes it (.prm), each checked. Throws SceneError naming file and line.
  std::vector<Entry> read_fragment(const std::string &file);

  // Stands in the first line of every echo, and so tells a result folder's scene.prm from one written by hand.
  inline constexpr char echo_title[] = "every parameter, as it was used";

  // The whole scene with every default, in .prm format, each key with its meaning; files by their absolute paths.
  std::string echo(const Scene &scene);

  // Names of the sections of which a scene file sets a key, each once. Throws SceneError where it is no scene file.
  std::vector<std::string> sections_set_in(const std::string &file);

  // Whether a file is the echo of a scene, of any version.
  bool is_echo(const std::string &file);

  // The scene of an echo in a result folder (scene.prm, ensemble.prm), as it was used; files that it names may be gone. Nothing
  // where there is no echo, or one of a version with other keys.
  std::optional<Scene> echoed_scene(const std::string &file);

  std::vector<std::string> section_names();

  // Every key of a section (of all, if empty): default, unit, range, meaning. Throws SceneError on an unknown section.
  std::string explain(const std::string &section);
} // namespace diptych::coupling
