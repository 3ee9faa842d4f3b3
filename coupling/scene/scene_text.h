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
  // One assignment, where it was made, and where the files that it names are looked for.
  struct Entry
  {
    std::string section, key, value;
    Place       place;
    std::string folder;
    bool        of_resolved = false; // of a file that sets every key, wanted or not

    std::string name() const { return section + "/" + key; }
  };

  // The text of a file with keys, as read_input checks it. Throws SceneError naming the file.
  std::istringstream scene_input(const std::string &file);

  // subsection NAME / set KEY = VALUE / end, '#' comments and '\\' continuation: the format of deal.II's parameter files. In
  // values \# is a # and \\ at the end of a line a \. Throws SceneError naming file and line.
  std::vector<Entry> entries_of_prm(const std::string &file, std::istream &in);

  // {"section": {"key": value}}; the value may also stand as {"value": ...}. Throws SceneError naming file and line.
  std::vector<Entry> entries_of_json(const std::string &file, std::istream &in);

  // Throws SceneError naming the nearest section, where scenes have none of that name.
  void demand_section(const Place &place, const std::string &section);

  // A value as it stands in such a text. Throws SceneError where it holds a line break.
  std::string prm_value(const std::string &value);

  // "section/key=value" of the command line. Throws SceneError.
  Entry entry_of_override(const std::string &text);
} // namespace diptych::coupling
