// diptych: one part of a JSON input file, with checked access to its members
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/studies/study_part.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "coupling/ensembles/seed_list.h"
#include "coupling/scene/keys.h"
#include "coupling/scene/scene_file.h"
#include "coupling/studies/study_columns.h"
#include "discrete/files/nearest_name.h"

namespace diptych::coupling
{
  using nlohmann::ordered_json;

  namespace
  {
    std::string escaped(std::string key)
    {
      if (const std::size_t slash = key.find('/'); slash != std::string::npos)
        key.replace(slash, 1, "~1");
      return key;
    }
  } // namespace

  Part::Part(const JsonText &text, const ordered_json &value, std::string pointer)
      : text(text),
        value(value),
        pointer(std::move(pointer))
  {}

  void Part::refuse(const std::string &why) const
  {
    throw SceneError({text.place(pointer), "", "", "", ""}, why);
  }

  void Part::refuse(const std::string &key, const std::string &why) const
  {
    SceneError refused(text_of(text.place(pointer + "/" + escaped(key))) + ": " + key + why);
    refused.refusal = {text.place(pointer + "/" + escaped(key)), key, "", "", ""};
    throw refused;
  }

  void Part::allow(const std::vector<std::string> &keys) const
  {
    if (!value.is_object())
      refuse("an object is needed; its keys are " + discrete::listed(keys));
    for (const auto &[key, member] : value.items())
      if (std::find(keys.begin(), keys.end(), key) == keys.end())
        refuse(key, ": unknown key; the nearest is '" + discrete::nearest_name(key, keys) + "'; allowed are " +
                      discrete::listed(keys));
  }

  Part Part::at(const std::string &key) const
  {
    if (!has(key))
      refuse("'" + key + "' is missing");
    return {text, value[key], pointer + "/" + escaped(key)};
  }

  std::vector<Part> Part::list(const std::string &key) const
  {
    std::vector<Part> parts;
    if (!has(key))
      return parts;
    if (!value[key].is_array())
      refuse(key, " must be a list");
    for (std::size_t k = 0; k < value[key].size(); ++k)
      parts.emplace_back(text, value[key][k], pointer + "/" + key + "/" + std::to_string(k));
    return parts;
  }

  std::string Part::word(const std::string &key, const std::string &otherwise) const
  {
    if (!has(key))
      return otherwise;
    if (!value[key].is_string())
      refuse(key, " = " + value[key].dump() + " must be a text");
    return value[key];
  }

  int Part::whole(const std::string &key, const int low, const int high) const
  {
    if (at(key).value.is_number() && at(key).value.get<double>() != std::floor(at(key).value.get<double>()))
      refuse(key, " = " + at(key).value.dump() + " is not allowed; use a whole number");
    return int(number(key, low, high));
  }

  double Part::number(const std::string &key, const double low, const double high) const
  {
    const ordered_json &member = at(key).value;
    if (!member.is_number() || !(member >= low) || !(member <= high))
      refuse(key, " = " + member.dump() + " is not allowed; use " + allowed_number({low, high}));
    return member;
  }

  bool Part::flag(const std::string &key) const
  {
    if (has(key) && !value[key].is_boolean())
      refuse(key, " = " + value[key].dump() + " is not allowed; use true or false");
    return has(key) && value[key];
  }

  std::vector<int> Part::seeds(const std::string &key) const
  {
    try
      {
        return has(key) ? read_seeds(value_text(value[key])) : std::vector<int>();
      }
    catch (const std::invalid_argument &error)
      {
        refuse(key, std::string(error.what()).substr(std::string("--seeds").size()));
      }
  }

  void refuse_folder(const Entry &entry)
  {
    if (entry.section == "output" && entry.key == "directory")
      throw SceneError({entry.place, entry.name(), "", "", "runs use their own folders below --output"}, "cannot be set");
  }

  Settings Part::settings(const std::string &key) const
  {
    Settings result;
    if (!has(key))
      return result;
    const Part part = at(key);
    if (!part.value.is_object())
      refuse(key, " must be an object of \"section/key\": value");
    for (const auto &[name, setting] : part.value.items())
      result.push_back(part.setting(name, name, setting));
    return result;
  }

  Entry Part::setting(const std::string &key, const std::string &name, const ordered_json &to) const
  {
    const Place       place = text.place(pointer + "/" + escaped(key));
    const std::size_t slash = name.find('/');
    if (slash == std::string::npos)
      throw SceneError({place, name, "", "", "write section/key"}, "is not a key of a scene");
    const Entry entry{name.substr(0, slash), name.substr(slash + 1), value_text(to), place,
                      std::filesystem::path(text.file).parent_path().string()};
    check_entry(with_seed(entry, "1"));
    refuse_folder(entry);
    return entry;
  }
} // namespace diptych::coupling
