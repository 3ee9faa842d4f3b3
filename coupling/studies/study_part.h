// diptych: one part of a JSON input file, with checked access to its members
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/scene/json_text.h"
#include "coupling/studies/study.h"
#include "discrete/choices.h"
#include "discrete/files/words.h"

namespace diptych::coupling
{
  // The names of an enum's table.
  template <class E> std::vector<std::string> names_of(const E)
  {
    std::vector<std::string> names;
    for (const auto &[choice, name] : choices(E()))
      names.emplace_back(name);
    return names;
  }

  // Runs have their own folders. Throws SceneError naming the place of an entry that sets output/directory.
  void refuse_folder(const Entry &entry);

  // A value of the input file and its place. Access to a missing member or one of another type throws SceneError naming file,
  // line, key, value and the allowed values.
  class Part
  {
  public:
    Part(const JsonText &text, const nlohmann::ordered_json &value, std::string pointer);

    [[noreturn]] void refuse(const std::string &why) const;
    [[noreturn]] void refuse(const std::string &key, const std::string &why) const; // "KEY" + why, at the key's line

    const nlohmann::ordered_json &json() const { return value; }

    bool has(const std::string &key) const { return value.is_object() && value.contains(key); }
    void allow(const std::vector<std::string> &keys) const; // refuses other keys

    Part              at(const std::string &key) const;   // throws if it is missing
    std::vector<Part> list(const std::string &key) const; // empty if it is missing
    std::string       word(const std::string &key, const std::string &otherwise = "") const;
    double            number(const std::string &key, double low, double high) const; // throws if it is missing
    int               whole(const std::string &key, int low, int high) const;        // throws if it is missing
    bool              flag(const std::string &key) const;                            // false if it is missing

    template <class E> E choice(const std::string &key, const E otherwise) const
    {
      if (!has(key))
        return otherwise;
      if (const auto chosen = discrete::value_of<E>(word(key)))
        return *chosen;
      refuse(key, " = '" + word(key) + "' is not allowed; use one of " + discrete::listed(names_of(E())));
    }

    // As on the command line: "1-8", "1,3,5-7" or a number. Empty if it is missing.
    std::vector<int> seeds(const std::string &key) const;

    // {"section/key": value, ...}, each checked as key and value of a scene. Empty if it is missing.
    Settings settings(const std::string &key) const;

    // One setting. `key`: the member of this part that contains it.
    Entry setting(const std::string &key, const std::string &name, const nlohmann::ordered_json &to) const;

  private:
    const JsonText               &text;
    const nlohmann::ordered_json &value;
    std::string                   pointer;
  };
} // namespace diptych::coupling
