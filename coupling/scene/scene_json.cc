// diptych: the assignments in a scene that is written in JSON
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <filesystem>
#include <sstream>

#include <nlohmann/json.hpp>

#include "coupling/scene/scene_error.h"
#include "coupling/scene/scene_text.h"

namespace diptych::coupling
{
  // Lines are found again by the key's text, because the parser keeps none.
  std::vector<Entry> entries_of_json(const std::string &file, std::istream &in)
  {
    std::ostringstream buffer;
    buffer << in.rdbuf();
    const std::string text = buffer.str();
    nlohmann::json    root;
    try
      {
        root = nlohmann::json::parse(text, nullptr, true, /* comments */ true);
      }
    catch (const nlohmann::json::parse_error &error)
      {
        const auto line = 1 + std::count(text.begin(), text.begin() + std::min(text.size(), std::size_t(error.byte)), '\n');
        throw SceneError(file + ", line " + std::to_string(line) + ": no JSON: " + error.what());
      }
    if (!root.is_object())
      throw SceneError(file + ", line 1: a scene is an object of sections");

    const auto line_of = [&](const std::string &name, const std::size_t from) {
      const std::size_t at = std::min(text.find('"' + name + '"', from), text.size());
      return std::pair<std::size_t, std::string>(at, file + ", line " +
                                                       std::to_string(1 + std::count(text.begin(), text.begin() + at, '\n')));
    };
    const auto value_text = [](const nlohmann::json &value) {
      const auto plain = [](const nlohmann::json &v) { return v.is_string() ? v.get<std::string>() : v.dump(); };
      if (!value.is_array())
        return plain(value);
      std::string list;
      for (const nlohmann::json &item : value)
        list += (list.empty() ? "" : ", ") + plain(item);
      return list;
    };
    std::vector<Entry> entries;
    for (const auto &[section, content] : root.items())
      {
        const auto [at, section_place] = line_of(section, 0);
        if (!content.is_object())
          throw SceneError(section_place + ": '" + section + "' must be a section: an object of keys");
        for (const auto &[key, value] : content.items())
          {
            const bool long_form = value.is_object() && value.contains("value");
            if (value.is_object() && !long_form)
              throw SceneError(line_of(key, at).second + ": '" + section + "/" + key + "' must be a value, not a section");
            entries.push_back({section, key, value_text(long_form ? value["value"] : value), line_of(key, at).second,
                               std::filesystem::path(file).parent_path().string()});
          }
      }
    return entries;
  }
} // namespace diptych::coupling
