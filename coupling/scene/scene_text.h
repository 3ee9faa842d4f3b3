// diptych: the assignments in the text of a scene
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <istream>
#include <sstream>
#include <string>
#include <vector>

#include "coupling/scene/scene_error.h"

namespace diptych::coupling
{
  // One assignment with its place in the text, and the folder to which file names in it refer.
  struct Entry
  {
    std::string section, key, value;
    Place       place;
    std::string folder;
    bool        of_resolved = false; // true if it comes from a resolved scene, which sets every key, also the defaults

    std::string name() const { return section + "/" + key; }
  };

  // The text of a file with keys, checked by read_input(). Throws SceneError with the file's name.
  std::istringstream scene_input(const std::string &file);

  // subsection NAME / set KEY = VALUE / end, '#' comments and '\\' continuation: the format of deal.II's parameter files. In
  // values \# is a # and \\ at the end of a line a \. Throws SceneError with file and line.
  std::vector<Entry> entries_of_prm(const std::string &file, std::istream &in);

  // {"section": {"key": value}}; the value may also be written as {"value": ...}. Throws SceneError with file and line.
  std::vector<Entry> entries_of_json(const std::string &file, std::istream &in);

  // Throws SceneError if scenes have no such section. The message proposes keys whose name contains the word, or the nearest
  // section.
  void demand_section(const Place &place, const std::string &section);

  // "keys with 'friction': discrete/friction, discrete/platen_friction"; empty if no key contains the word, or for fewer than
  // three letters. Equal names come first.
  std::string keys_with(const std::string &word);

  // A value in the form that a .prm text needs. Throws SceneError if it contains a line break.
  std::string prm_value(const std::string &value);

  // Reads "section/key=value" from the command line. Throws SceneError.
  Entry entry_of_override(const std::string &text);
} // namespace diptych::coupling
