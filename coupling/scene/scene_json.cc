// diptych: the assignments in a scene that is written in JSON
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <filesystem>

#include "coupling/scene/json_text.h"
#include "coupling/scene/scene_text.h"

namespace diptych::coupling
{
  std::vector<Entry> entries_of_json(const std::string &file, std::istream &in)
  {
    const JsonText     text   = read_json_text(file, in);
    const std::string  folder = std::filesystem::path(file).parent_path().string();
    std::vector<Entry> entries;
    for (const auto &[section, content] : text.root.items())
      {
        if (!content.is_object())
          throw SceneError({text.place("/" + section), section}, "must be a section: an object of keys");
        demand_section(text.place("/" + section), section);
        for (const auto &[key, value] : content.items())
          {
            const Place place     = text.place("/" + section + "/" + key);
            const bool  long_form = value.is_object() && value.contains("value");
            if (value.is_object() && !long_form)
              throw SceneError({place, section + "/" + key}, "must be a value, not a section");
            entries.push_back({section, key, value_text(long_form ? value["value"] : value), place, folder});
          }
      }
    return entries;
  }
} // namespace diptych::coupling
