// diptych: a part of a study's text, asked for what must stand in it
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

  // Runs have folders of their own. Throws SceneError naming the place of an entry that sets output/directory.
  void refuse_folder(const Entry &entry);

  // A member of the text: its value and where it stands. What is asked for and not there, or no such value, throws SceneError
  // naming file, line, key, value and what is allowed.
  class Part
  {
  public:
    Part(const JsonText &text, const nlohmann::ordered_json &value, std::string pointer);

    [[noreturn]] void refuse(const std::string &why) const;
    [[noreturn]] void refuse(const std::string &key, const std::string &why) const; // "KEY" + why, at the key's line

    const nlohmann::ordered_json &json() const { return value; }

    bool has(const std::string &key) const { return value.is_object() && value.contains(key); }
    void allow(const std::vector<std::string> &keys) const; // only these may stand here

    Part              at(const std::string &key) const;   // which must be there
    std::vector<Part> list(const std::string &key) const; // empty where it is not there
    std::string       word(const std::string &key, const std::string &otherwise = "") const;
    double            number(const std::string &key, double low, double high) const; // which must be there
    int               whole(const std::string &key, int low, int high) const;        // likewise
    bool              flag(const std::string &key) const;                            // false where it is not there

    template <class E> E choice(const std::string &key, const E otherwise) const
    {
      if (!has(key))
        return otherwise;
      if (const auto chosen = discrete::value_of<E>(word(key)))
        return *chosen;
      refuse(key, " = '" + word(key) + "' is not allowed: one of " + discrete::listed(names_of(E())) + " is");
    }

    // As on the command line, "1-8" or "1,3,5-7" or a number; empty where it is not there.
    std::vector<int> seeds(const std::string &key) const;

    // {"section/key": value, ...}, each checked as a key and a value of a scene. Empty where it is not there.
    Settings settings(const std::string &key) const;

    // One setting; `key`: the member of this part at which it was made.
    Entry setting(const std::string &key, const std::string &name, const nlohmann::ordered_json &to) const;

  private:
    const JsonText               &text;
    const nlohmann::ordered_json &value;
    std::string                   pointer;
  };
} // namespace diptych::coupling
