// diptych: JSON with the line of each member
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <istream>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "coupling/scene/scene_error.h"

namespace diptych::coupling
{
  // A JSON object. Its members keep the order of the text.
  struct JsonText
  {
    std::string                file;
    nlohmann::ordered_json     root;
    std::map<std::string, int> lines; // line of each member, by its JSON pointer

    Place place(const std::string &pointer) const;
  };

  // // and /* comments are allowed. Throws SceneError with file and line if the text is no JSON object, or if an object has a key
  // twice.
  JsonText read_json_text(const std::string &file, std::istream &in);

  // A value as a scene file would give it. The entries of a list are separated by ", ".
  std::string value_text(const nlohmann::ordered_json &value);
} // namespace diptych::coupling
