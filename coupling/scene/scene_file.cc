// diptych: reads, resolves and explains scenes
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/scene/scene_file.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <set>
#include <sstream>

#include "coupling/scene/derived_keys.h"
#include "coupling/scene/scene_check.h"
#include "discrete/files/nearest_name.h"
#include "discrete/files/words.h"

namespace diptych::coupling
{
  namespace
  {
    [[noreturn]] void refuse_section(const Place                    &place,
                                     const std::string              &section,
                                     const std::vector<std::string> &known = section_names())
    {
      std::vector<std::string> names = known;
      for (const KeyDescription &key : described_keys(""))
        names.push_back(key.name);
      const std::string asked   = section.substr(section.find('/') + 1); // a key may be meant
      const std::string nearest = discrete::nearest_name(asked, names), keys = keys_with(asked);
      const bool        is_key = std::find(known.begin(), known.end(), nearest) == known.end();
      Refusal           refusal{place, section};
      refusal.hint = !is_key ? "the nearest is '" + nearest + "'" : keys.empty() ? keys_with(nearest) : keys;
      throw SceneError(refusal, "is not a section");
    }

    [[noreturn]] void refuse_key(const Entry &entry)
    {
      std::vector<std::string> names;
      for (const KeyDescription &key : described_keys(entry.section))
        names.push_back(key.name);
      Refusal refusal{entry.place, entry.name()};
      refusal.hint = "the nearest is '" + entry.section + "/" + discrete::nearest_name(entry.key, names) + "'";
      throw SceneError(refusal, "is not a key");
    }

    [[noreturn]] void refuse_value(const Entry &entry)
    {
      Refusal refusal{entry.place, entry.name(), entry.value};
      refusal.allowed = "a number"; // of a library
      for (const KeyDescription &key : described_keys(entry.section))
        if (key.name == entry.key)
          {
            refusal.allowed = key.allowed + " [" + key.unit + "]";
            if (entry.value.find(',') != std::string::npos)
              refusal.hint = "decimals have a point, and only lists have commas";
            const std::size_t sign = entry.value.find_last_not_of("% ") + 1;
            if (const auto n = read_number(entry.value.substr(0, sign), {-1e12, 1e12}); n && sign < entry.value.size())
              refusal.hint = entry.value + " is " + text_of(*n / 100);
          }
      throw SceneError(refusal, "is not allowed");
    }

    void demand_one_line(const Entry &entry)
    {
      if (entry.value.find_first_of("\n\r") != std::string::npos || entry.value.find('\0') != std::string::npos)
        throw SceneError({entry.place, entry.name()}, "holds a line break or a zero byte");
      if (!entry.value.empty() && (std::strchr(" \t", entry.value.front()) || std::strchr(" \t", entry.value.back())))
        throw SceneError({entry.place, entry.name(), entry.value}, "begins or ends with a blank, which a scene file cannot hold");
    }

    bool is_left_to_others(const Entry &entry)
    {
      return entry.value == "auto" && is_derived(entry.name());
    }

    void set(Scene &scene, const Entry &entry)
    {
      if (is_left_to_others(entry))
        return;
      bool is_section = false;
      for_each_section(scene, [&](const std::string &section, auto &options) {
        if (section != entry.section)
          return;
        is_section = true;
        SetKey set{entry.key, entry.value, entry.folder};
        visit_parameters(options, set);
        if (!set.found)
          refuse_key(entry);
        if (!set.good)
          refuse_value(entry);
      });
      if (!is_section)
        refuse_section(entry.place, entry.section);
    }

    // results/moreau_1997 for .../moreau_1997/scene.prm, results/mine for mine.prm.
    std::string scene_name(const std::string &file)
    {
      const std::filesystem::path path = std::filesystem::absolute(file);
      return path.stem() == "scene" ? path.parent_path().filename().string() : path.stem().string();
    }
    std::vector<Entry> entries_of(const std::string &file, std::istream &in)
    {
      const bool json = std::filesystem::path(file).extension() == ".json";
      return json ? entries_of_json(file, in) : entries_of_prm(file, in);
    }

    bool sets_every_key(const std::vector<Entry> &entries)
    {
      std::set<std::string> set;
      for (const Entry &entry : entries)
        set.insert(entry.name());
      const std::vector<KeyDescription> keys = described_keys("");
      return std::all_of(keys.begin(), keys.end(), [&](const KeyDescription &key) { return set.count(key.full_name()) > 0; });
    }

    std::vector<Entry> entries_with(const std::string &file, const std::vector<Entry> &changes)
    {
      if (std::error_code none; std::filesystem::is_directory(file, none))
        throw SceneError(file + ": is a folder; give a scene file, .prm or .json");
      std::istringstream in      = scene_input(file);
      std::vector<Entry> entries = entries_of(file, in);
      if (sets_every_key(entries))
        for (Entry &entry : entries)
          entry.of_resolved = true;
      entries.insert(entries.end(), changes.begin(), changes.end());
      return entries;
    }

    std::vector<Entry> entries_of_overrides(const std::vector<std::string> &overrides)
    {
      std::vector<Entry> changes;
      for (const std::string &text : overrides)
        changes.push_back(entry_of_override(text));
      return changes;
    }

    // Keys whose section/name contains a word of at least three letters.
    std::vector<KeyDescription> keys_like(const std::string &word)
    {
      std::vector<KeyDescription> keys = described_keys("");
      keys.erase(std::remove_if(keys.begin(), keys.end(),
                                [&](const KeyDescription &key) {
                                  const std::string text = word.find('/') == std::string::npos ? key.name : key.full_name();
                                  return word.size() < 3 || text.find(word) == std::string::npos;
                                }),
                 keys.end());
      return keys;
    }

    // `check`: check_scene() or part of it.
    template <class Check>
    Scene checked_scene(const std::string &file, const std::vector<Entry> &entries, const bool compares, const Check &check)
    {
      Scene                 scene;
      std::set<std::string> given;
      for (const Entry &entry : entries)
        {
          demand_one_line(entry);
          set(scene, entry);
          if (is_left_to_others(entry))
            given.erase(entry.name());
          else
            given.insert(entry.name());
        }
      derive_keys(scene, given);
      scene.name = scene_name(file);
      if (scene.output.directory.empty())
        scene.output.directory = "results/" + scene.name;
      check(scene);
      scene.warnings = warnings_of(scene, entries, compares);
      return scene;
    }
  } // namespace

  std::vector<KeyDescription> described_keys(const std::string &wanted_section)
  {
    std::vector<KeyDescription> keys;
    for (KeyDescription &key : keys_of({}))
      {
        if (!wanted_section.empty() && wanted_section != key.section)
          continue;
        if (is_derived(key.full_name()))
          {
            key.value   = "auto";
            key.allowed = "auto or " + key.allowed;
            key.meaning += "; auto: " + rule_of(key.full_name());
            if (!key.choices.empty())
              key.choices.insert(key.choices.begin(), "auto");
          }
        keys.push_back(std::move(key));
      }
    return keys;
  }

  std::string keys_with(const std::string &word)
  {
    std::vector<std::string> names;
    for (const KeyDescription &key : keys_like(word))
      names.insert(key.name == word ? names.begin() : names.end(), key.full_name());
    return names.empty() ? "" : "keys with '" + word + "': " + discrete::listed(names);
  }

  void demand_section(const Place &place, const std::string &section)
  {
    const std::vector<std::string> known = section_names();
    if (std::find(known.begin(), known.end(), section) == known.end())
      refuse_section(place, section);
  }

  std::vector<std::string> section_names()
  {
    std::vector<std::string> names;
    Scene                    scene;
    for_each_section(scene, [&](const char *section, auto &) { names.push_back(section); });
    return names;
  }

  void check_entry(const Entry &entry)
  {
    demand_one_line(entry);
    Scene scratch;
    set(scratch, entry);
  }

  Scene read_scene(const std::string &file, const std::vector<std::string> &overrides, const bool compares)
  {
    return read_changed_scene(file, entries_of_overrides(overrides), compares);
  }

  Scene read_changed_scene(const std::string &file, const std::vector<Entry> &changes, const bool compares)
  {
    return scene_of_entries(file, entries_with(file, changes), compares);
  }

  Scene scene_of_entries(const std::string &file, const std::vector<Entry> &entries, const bool compares)
  {
    return checked_scene(file, entries, compares, [&](Scene &scene) {
      complete_law(scene, file, entries);
      check_scene(scene, file, entries, compares);
    });
  }

  Scene read_computed_scene(const std::string &file, const std::vector<std::string> &overrides, const bool compares)
  {
    const std::vector<Entry> entries = entries_with(file, entries_of_overrides(overrides));
    if (!sets_every_key(entries))
      throw SceneError(file + " does not set every key. A run writes the scene that it used in this place; do not edit it.");
    return checked_scene(file, entries, compares, [&](const Scene &scene) { check_comparison(scene, file, entries, compares); });
  }

  std::vector<Entry> read_fragment(const std::string &file)
  {
    std::istringstream       in      = scene_input(file);
    const std::vector<Entry> entries = entries_of(file, in);
    for (const Entry &entry : entries)
      check_entry(entry);
    return entries;
  }

  std::optional<Scene> resolved_scene(const std::string &file)
  {
    std::error_code none;
    if (!std::filesystem::is_regular_file(file, none))
      return std::nullopt;
    try
      {
        std::istringstream       in      = scene_input(file);
        const std::vector<Entry> entries = entries_of(file, in);
        if (!sets_every_key(entries))
          return std::nullopt;
        Scene scene;
        for (const Entry &entry : entries)
          set(scene, entry);
        return scene;
      }
    catch (const SceneError &) // the file is from another version
      {
        return std::nullopt;
      }
  }

  std::string resolved_text(const Scene &scene)
  {
    std::ostringstream out;
    out << "# " << scene.name << ": every parameter, as it was used\n";
    if (!scene.method_reason.empty())
      out << "# discrete/method = auto became " << discrete::name_of(scene.discrete.method.method) << ": " << scene.method_reason
          << '\n';
    std::string section;
    for (const KeyDescription &key : keys_of(scene))
      {
        if (key.section != section)
          out << (section.empty() ? "" : "end\n") << "\nsubsection " << key.section << '\n';
        section = key.section;
        out << "  # " << key.meaning << " [" << key.unit << "]; " << key.allowed << "\n  set " << key.name << " = "
            << prm_value(key.value) << '\n';
      }
    out << "end\n";
    return out.str();
  }

  std::string explain(const std::string &section)
  {
    std::vector<std::string>    known = section_names();
    std::vector<KeyDescription> keys  = described_keys(section);
    if (!section.empty() && std::find(known.begin(), known.end(), section) == known.end())
      {
        keys = keys_like(section);
        known.push_back("results"); // the command explains this word
        if (keys.empty())
          refuse_section({}, section, known);
      }
    std::ostringstream out;
    std::string        current;
    for (const KeyDescription &key : keys)
      {
        if (key.section != current)
          out << (current.empty() ? "" : "\n") << key.section << '\n';
        current = key.section;
        out << "  " << key.name << " = " << (key.value.empty() ? "(empty)" : key.value) << "  [" << key.unit << "]  "
            << key.allowed << "\n      " << key.meaning << '\n';
      }
    return out.str();
  }
} // namespace diptych::coupling
