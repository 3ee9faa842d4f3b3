// diptych: JSON that remembers where it was written
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <istream>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "coupling/scene/scene_error.h"

namespace diptych::coupling
{
  // An object with its members in the order of the text.
  struct JsonText
  {
    std::string                file;
    nlohmann::ordered_json     root;
    std::map<std::string, int> lines; // of a member, by its JSON pointer

    Place place(const std::string &pointer) const;
  };

  // // and /* comments are allowed. Throws SceneError naming file and line where the text is no JSON object, or an object
  // holds a key twice.
  JsonText read_json_text(const std::string &file, std::istream &in);

  // A value as the text that a scene would hold: the entries of a list separated by ", ".
  std::string value_text(const nlohmann::ordered_json &value);
} // namespace diptych::coupling
